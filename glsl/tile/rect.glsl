// A tile rect, the tiles that a splat's box touches: tile of the first corner, x and y in PLACE_BITS each, then how many tiles more, in
// half of the bits that are left for each; those along x are below three quarters of what these hold. The last quarter is of small
// rects, whose tiles have 3 bits less each, and 4 bits for those in the corners that the splat does not touch (tile/corners.glsl).
// The largest small rect never leaves out all of its corners: what would be one that does means other things, from RECT_CHUNK on drawn by the
// graphics pipeline, of the chunk in the last bits; all ones, not seen.

layout(constant_id = SPEC_PLACE_BITS) const uint PLACE_BITS = 11;
const uint MORE_BITS = RECT_SIDE_BITS - PLACE_BITS;
const uint LAST_PLACE = (1u << PLACE_BITS) - 1;
const uint MOST_MORE = 3 * (1u << (MORE_BITS - 2)) - 1;
const uint SMALL_BITS = MOST_PLACE_BITS - PLACE_BITS;
const uint MOST_MORE_OF_SMALL = (1u << SMALL_BITS) - 1;
const uint SMALL = 3u << (2 * MORE_BITS - 2);
const uint RECT_NONE = 0xffffffffu;

// `outside`: bits of the corners that it does not touch: the first tile, the last of the first row, and both of the last row.
uint rect_from(uvec2 first, uvec2 more, uint outside)
{
    bool small = max(more.x, more.y) <= MOST_MORE_OF_SMALL;
    outside &= min(more.x, more.y) == MOST_MORE_OF_SMALL ? 14 : 15;
    uint size = small ? SMALL | outside << (2 * SMALL_BITS) | more.x << SMALL_BITS | more.y : more.x << MORE_BITS | more.y;
    return first.x | first.y << PLACE_BITS | size << (2 * PLACE_BITS);
}

uvec2 first_of(uint rect)
{
    return uvec2(rect, rect >> PLACE_BITS) & LAST_PLACE;
}

uvec2 more_of(uint rect)
{
    uint size = rect >> (2 * PLACE_BITS);
    return size >= SMALL ? uvec2(size >> SMALL_BITS, size) & MOST_MORE_OF_SMALL
                         : uvec2(size >> MORE_BITS, size & ((1u << MORE_BITS) - 1));
}

uint outside_of(uint rect)
{
    uint size = rect >> (2 * PLACE_BITS);
    return size >= SMALL ? (size >> (2 * SMALL_BITS)) & 15 : 0;
}

uint chunk_of(uint rect)
{
    return rect - RECT_CHUNK;
}

// A rect has CELLS_ALONG x CELLS_ALONG cells at the most, each of 1, 2, 4 .. tiles a side.
#define CELLS_ALONG 16

uint cell_shift(uvec2 more)
{
    return uint(max(findMSB(max(more.x, more.y)) - 3, 0));
}
