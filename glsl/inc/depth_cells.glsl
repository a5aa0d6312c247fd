// Where the hierarchy of depth_cells.comp.glsl has what: cells of DEPTH_CELLS_SIDE x DEPTH_CELLS_SIDE pixels in whole blocks, row by row; behind them blocks
// of DEPTH_CELLS_SIDE x DEPTH_CELLS_SIDE cells.

#include "inc/config.glsl"

ivec2 blocks_of(ivec2 size_px)
{
    return (size_px + (DEPTH_CELLS_SIDE * DEPTH_CELLS_SIDE - 1)) / (DEPTH_CELLS_SIDE * DEPTH_CELLS_SIDE);
}

int place_of_cell(ivec2 size_px, ivec2 cell)
{
    return cell.y * blocks_of(size_px).x * DEPTH_CELLS_SIDE + cell.x;
}

int place_of_block(ivec2 size_px, ivec2 block)
{
    ivec2 blocks = blocks_of(size_px);
    return blocks.x * blocks.y * DEPTH_CELLS_SIDE * DEPTH_CELLS_SIDE + block.y * blocks.x + block.x;
}
