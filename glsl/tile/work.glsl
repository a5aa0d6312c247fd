// What a workgroup works on: a tile, and of its list as much as one dispatch takes; and where its pixels are.

layout(set = 0, binding = BIND_STARTS, std430) readonly buffer Starts { uint starts[]; };
layout(set = 0, binding = BIND_NON_EMPTY_TILES, std430) readonly buffer NonEmptyTiles { uint non_empty_tiles[]; };
layout(set = 0, binding = BIND_OVERFLOW_TILES, std430) readonly buffer OverflowTiles { uint overflow_tiles[]; };

// llvmpipe ends a shader's loops after 65535 iterations, silently: src/passes/tiles/overflow.rs.
layout(constant_id = SPEC_PART_LENGTH) const uint PART_LENGTH = 200000;
layout(constant_id = SPEC_HALF_FLOATS) const bool HALF_FLOATS = false; // in images; in registers there are none

// Entries of a list; CUTS: from `clipped` on of splats that curves or planes cut.
struct Range {
    uint first;
    uint clipped;
    uint end;
};

// Rows are counted from one of the image's that is a multiple of 8, so that pixels have the same bits in tiles of either height.
ivec2 top;     // the pixel of the invocation's column in that row
vec2 top_px;   // the same, from the middle of the image
int first_row; // the first of the invocation's

void enter_tile(uint tile)
{
    uint of_image = push.first_tile + tile;
    top = ivec2(TILE_WIDTH, TILE_HEIGHT) * ivec2(of_image % push.tiles_x, of_image / push.tiles_x);
    int rows_above = TILE_HEIGHT < MOST_TILE_HEIGHT ? top.y % MOST_TILE_HEIGHT : 0;
    top += ivec2(gl_LocalInvocationID.x, -rows_above);
    top_px = vec2(top) + 0.5 - push.middle_px;
    first_row = rows_above + OWN_ROW;
}

// Answers whether there is any work; all of a workgroup have the same. `whole`: this dispatch does whole tiles and leaves out overflow
// tiles; CUTS: those with clipped splats. Else it does the part push.part of overflow tiles.
bool find_work(bool whole, out Range range)
{
    if (GROUP_NUMBER >= starts[!whole ? STARTS_OVERFLOW : CUTS ? STARTS_CLIPPED : STARTS_TILES]) {
        return false;
    }
    uint tile = whole ? non_empty_tiles[place_of_tile(CUTS, GROUP_NUMBER)] : overflow_tiles[GROUP_NUMBER];
    enter_tile(tile);
    uint bin = TILE_BINS * tile;
    uint end = starts[bin + TILE_BINS];
    range = Range(starts[bin], CUTS ? starts[bin + 1] : end, end);
    if (whole) {
        return range.end - range.first <= PART_LENGTH;
    }
    range.first = min(range.first + push.part * PART_LENGTH, range.end);
    range.end = min(range.first + PART_LENGTH, range.end);
    range.clipped = clamp(range.clipped, range.first, range.end);
    return true;
}

// The pixel of one of the invocation's rows.
ivec2 pixel_of(int row)
{
    return top + ivec2(0, first_row + row);
}

// The same within the image: tiles at its borders reach beyond.
ivec2 pixel_within_image(int row)
{
    return min(pixel_of(row), ivec2(2.0 * push.half_size_px) - 1);
}

// The same in images that hold overflow tiles alone, in their order.
ivec2 pixel_in_slot(int row)
{
    ivec2 slot = ivec2(GROUP_NUMBER % SLOTS_IN_ROW, GROUP_NUMBER / SLOTS_IN_ROW);
    return ivec2(TILE_WIDTH, TILE_HEIGHT) * slot + ivec2(gl_LocalInvocationID.x, OWN_ROW + row);
}

// The direction to the eye from a place, counted from the middle of the image; view space.
vec3 to_eye(vec2 at_px)
{
    return direction_to_eye(vec3(FORMULA(FORMULA_EYE_DIRECTION, at_px / push.focal_px), 1.0));
}
