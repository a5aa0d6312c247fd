// Of the visible splats, marks those that may belong to the visible surface: the second pass of Guennebaud, Barthe, Paulin,
// "Deferred Splatting", Eurographics 2004, with a hierarchy of the visible depth in place of each splat's pixel. A splat is hidden
// where its nearest point is behind the farthest visible depth of all cells that its box touches. That is what accumulation's depth
// test does to each fragment, so that the picture is the same to the bit.
//
// Marked in any case: what is not regular, what is not found to hold a pixel's center here (a vertex stage may round it otherwise), and boxes of more
// than MOST_CELLS blocks along a side. The box is taken a pixel larger, for the same rounding.
#version 460
#include "inc/setup.glsl"
#include "inc/depth_bound.glsl"
#include "inc/list.glsl"
#include "inc/depth_cells.glsl"

#define MOST_CELLS 5

layout(local_size_x = LIST_GROUP_SIZE) in;
layout(set = 1, binding = BIND_LIST_BITS, std430) readonly buffer Bits { uint visible_bits[]; };
layout(set = 1, binding = BIND_LIST_UNHIDDEN_BITS, std430) writeonly buffer UnhiddenBits { uint unhidden_bits[]; };
layout(set = 1, binding = BIND_LIST_CELLS, std430) readonly buffer DepthCells { float depth_cells[]; };

bool is_hidden(uint index)
{
    Mapping m;
    if (!map_splat(index, m)) {
        return true; // no stage draws it
    }
    PixelBox px;
    if (!m.regular || !pixel_box(splat_box(m), px)) {
        return false;
    }
    ivec2 size = ivec2(SIZE_PX);
    ivec2 first = max(px.first - 1, ivec2(0)) / DEPTH_CELLS_SIDE;
    ivec2 last = min(px.last + 1, size - 1) / DEPTH_CELLS_SIDE;
    bool by_blocks = any(greaterThanEqual(last - first, ivec2(MOST_CELLS)));
    first = by_blocks ? first / DEPTH_CELLS_SIDE : first;
    last = by_blocks ? last / DEPTH_CELLS_SIDE : last;
    if (any(greaterThanEqual(last - first, ivec2(MOST_CELLS)))) {
        return false;
    }
    float farthest = 1e30;
    for (int y = first.y; y <= last.y; y++) {
        for (int x = first.x; x <= last.x; x++) {
            ivec2 at = ivec2(x, y);
            int place = by_blocks ? place_of_block(size, at) : place_of_cell(size, at);
            farthest = min(farthest, depth_cells[place]);
        }
    }
    return nearest_of_regular(m) < farthest;
}

void main()
{
    uint word = LIST_INVOCATION;
    if (word >= words_of_chunk()) {
        return;
    }
    uint place = first_word_of_chunk() + word;
    uint unhidden = visible_bits[place];
    uint first = first_splat_of(block_of(word), word);
    for (uint bits = unhidden; bits != 0; bits &= bits - 1) {
        uint i = findLSB(bits);
        unhidden &= is_hidden(first + i) ? ~(1u << i) : 0xffffffffu;
    }
    unhidden_bits[place] = unhidden;
}
