// Where the hierarchy of depth_cells.comp.glsl has what: cells of SIDE x SIDE pixels in whole blocks, row by row; behind them blocks
// of SIDE x SIDE cells.

#define SIDE 8

ivec2 blocks_of(ivec2 size_px)
{
    return (size_px + (SIDE * SIDE - 1)) / (SIDE * SIDE);
}

int place_of_cell(ivec2 size_px, ivec2 cell)
{
    return cell.y * blocks_of(size_px).x * SIDE + cell.x;
}

int place_of_block(ivec2 size_px, ivec2 block)
{
    ivec2 blocks = blocks_of(size_px);
    return blocks.x * blocks.y * SIDE * SIDE + block.y * blocks.x + block.x;
}
