// What a workgroup works on: a tile, and of its list as much as one dispatch takes. An invocation draws a column of the tile's
// pixels; with PIXELS a row of it, one pixel. SHORT: columns, and so tiles, are half as high.
//
// IS_WHOLE: whether this dispatch does whole tiles and leaves out the overfull; else it does part push.part of those.

layout(set = 0, binding = 6, std430) readonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 8, std430) readonly buffer SeenTiles { uint seen_tiles[]; };
layout(set = 0, binding = 10, std430) readonly buffer OverfullTiles { uint overfull_tiles[]; };

layout(constant_id = 19) const uint PART = 200000; // entries of a tile that one dispatch takes (inc/tiles.glsl)

#if defined(SHORT)
#define TILE_HEIGHT 4
#else
#define TILE_HEIGHT 8
#endif
#if defined(PIXELS)
#define ROWS 1
#define OWN_ROW int(gl_LocalInvocationID.y)
#else
#define ROWS TILE_HEIGHT
#define OWN_ROW 0
#endif

// Rows are counted from one of the image's that is a multiple of 8, so that pixels have the same bits in tiles of either height.
#if defined(SHORT)
int rows_above; // between that and the tile's first; known once top_pixel was asked
#else
const int rows_above = 0;
#endif
#define FIRST_ROW (rows_above + OWN_ROW)
layout(local_size_x = TILE_WIDTH, local_size_y = TILE_HEIGHT / ROWS) in;

struct Range {
    uint first;
    uint end;
};

struct Work {
    uint tile;
    Range range;
};

// Answers whether there is any; all of a workgroup have the same.
bool find_work(out Work work)
{
    if (GROUP_NUMBER >= starts[IS_WHOLE ? STARTS_SEEN : STARTS_OVERFULL]) {
        return false;
    }
    work.tile = IS_WHOLE ? seen_tiles[GROUP_NUMBER] : overfull_tiles[GROUP_NUMBER];
    uint first = starts[work.tile];
    uint end = starts[work.tile + 1];
    if (IS_WHOLE) {
        work.range = Range(first, end);
        return end - first <= PART;
    }
    first = min(first + push.part * PART, end);
    work.range = Range(first, min(first + PART, end));
    return true;
}

// The pixel from which the column's rows are counted.
ivec2 top_pixel(uint tile)
{
    uint of_image = push.first_tile + tile;
    ivec2 top = ivec2(TILE_WIDTH, TILE_HEIGHT) * ivec2(of_image % push.tiles_x, of_image / push.tiles_x);
#if defined(SHORT)
    rows_above = top.y % 8;
#endif
    return top + ivec2(gl_LocalInvocationID.x, -rows_above);
}

// The pixel of one of the invocation's rows.
ivec2 pixel_of(ivec2 top, int row)
{
    return top + ivec2(0, FIRST_ROW + row);
}

// The same in images that hold overfull tiles alone, in their order.
ivec2 pixel_in_slot(int row)
{
    ivec2 slot = ivec2(GROUP_NUMBER % SLOTS_IN_ROW, GROUP_NUMBER / SLOTS_IN_ROW);
    return ivec2(TILE_WIDTH, TILE_HEIGHT) * slot + ivec2(gl_LocalInvocationID.x, OWN_ROW + row);
}

// From the middle of the image to the pixel's.
vec2 from_middle_px(ivec2 pixel)
{
    return vec2(pixel) + 0.5 - push.half_size_px;
}

// The direction from the surface there to the eye, view space.
vec3 to_eye(vec2 at_px)
{
    return -normalize(vec3(FORMULA(FORMULA_EYE_DIRECTION, at_px / push.focal_px), 1.0));
}

// A pixel of the image: tiles at its borders reach beyond.
ivec2 within_image(ivec2 pixel)
{
    return min(pixel, ivec2(2.0 * push.half_size_px) - 1);
}
