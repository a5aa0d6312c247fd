// Which splats of a hierarchy are drawn: those no larger on the screen than tau whose parent is (Pajarola, Sainz, Guidotti 2003, section
// 5.1). Each decides alone.
//
// A node has a ball around all below it, and how far it spreads, both within its parent's (src/geometry/hierarchy/select.rs, where that exactly one splat of every path
// from the root down is drawn is proved). Its size is focal spread / max(d - r, near), with d from the eye to the ball's center and r its
// radius; under parallel rays focal spread. So it is at most tau where spread <= tau / focal max(d - r, near). Both the parent's ball and a
// node's own are the same bits wherever they lie, and this is one function of them: of a parent and its child exactly one is drawn, whatever rounding does.
//
// BLENDED: nodes are drawn from a size of B tau on, and those below them until the node is as small as tau. How large a ball is makes a number F from 0 at
// tau to 1 at B tau, and a splat weighs F(parent) - F(own): on each path from the root, above which F is 1, to a splat, of which it is 0, weights add
// up to 1, and in sums of weights a node takes the place of those below it smoothly.
//
// All in the space of the hierarchy: from its origin, scaled by a power of two.

// Splats of a mesh's cells (LEVELS_OF_CELLS) are drawn where the ball of a cell of theirs is small; where it is not, its polygons are (choose_polygons.comp.glsl),
// which are so what is smallest on a path.
//
// Of each word of splats (src/prepare/level_words.rs) where its parents begin, and where the last one's end; of cells' splats the same of its cells. Then, of each
// node, its own ball: center, radius, spread. Then the parents, and the cells: a ball, and the bits of its splats in the word, which it is so looked at once for.
#if !defined(LEVELS_BINDING)
#define LEVELS_BINDING BIND_SPLATS_LEVELS
#endif
layout(set = 0, binding = LEVELS_BINDING, std430) readonly buffer Levels { float levels[]; };

#define BALL_FLOATS 5

// How the camera sees a chunk's hierarchy.
struct LevelView {
    vec3 eye;
    float share; // tau / focal
    float near;
    float share_of_blended; // the same of the size up to which nodes are drawn beside those below them; share, unless BLENDED
    float weight_of_share;  // one over the difference of both
};

// Behind all runs of blocks, that of the last chunk first.
LevelView level_view()
{
    uint first = visible_words.length() - LEVEL_WORDS * (CHUNK + 1);
    vec3 eye = vec3(
        uintBitsToFloat(visible_words[first]),
        uintBitsToFloat(visible_words[first + 1]),
        uintBitsToFloat(visible_words[first + 2]));
    return LevelView(
        eye,
        uintBitsToFloat(visible_words[first + 3]),
        uintBitsToFloat(visible_words[first + 4]),
        uintBitsToFloat(visible_words[first + 5]),
        uintBitsToFloat(visible_words[first + 6]));
}

// What a ball's spread is over to be a share of the focal length.
float distance_of(LevelView view, uint ball)
{
    vec3 from_eye = vec3(levels[ball], levels[ball + 1], levels[ball + 2]) - view.eye;
    float nearest = max(sqrt(precise_dot(from_eye, from_eye)) - levels[ball + 3], view.near);
    return ORTHOGRAPHIC ? 1.0 : nearest;
}

bool is_small(LevelView view, float share, uint ball)
{
    return levels[ball + 4] <= share * distance_of(view, ball);
}

// F.
float largeness(LevelView view, uint ball)
{
    return clamp((levels[ball + 4] / distance_of(view, ball) - view.share) * view.weight_of_share, 0.0, 1.0);
}

// Where what is behind the starts of a word's parents begins.
uint behind_starts()
{
    return (frame.splat_count + WORD - 1) / WORD + 1;
}

uint own_ball(uint index)
{
    return behind_starts() + BALL_FLOATS * index;
}

// Those of a word of splats of which a cell is small.
uint bits_of_cells(LevelView view, uint word)
{
    uint end = floatBitsToUint(levels[behind_starts() + word + 1]);
    uint bits = 0;
    for (uint cell = floatBitsToUint(levels[behind_starts() + word]); cell < end; cell += BALL_FLOATS + 1) {
        bits |= is_small(view, view.share, cell) ? floatBitsToUint(levels[cell + BALL_FLOATS]) : 0;
    }
    return bits;
}

// The part that a splat has of the weight on its path.
float weight_of_level(uint index)
{
    LevelView view = level_view();
    uint parent = floatBitsToUint(levels[index / WORD]);
    uint end = floatBitsToUint(levels[index / WORD + 1]) - (BALL_FLOATS + 1);
    uint bit = 1u << (index % WORD);
    while (parent < end && (floatBitsToUint(levels[parent + BALL_FLOATS]) & bit) == 0) {
        parent += BALL_FLOATS + 1;
    }
    float of_parent = largeness(view, parent);
    return LEVELS == LEVELS_NODES ? of_parent - largeness(view, own_ball(index)) : of_parent;
}

// Those of a word of splats that are drawn.
uint bits_of_level(uint word)
{
    LevelView view = level_view();
    uint end = floatBitsToUint(levels[word + 1]);
    uint bits = 0;
    for (uint parent = floatBitsToUint(levels[word]); parent < end; parent += BALL_FLOATS + 1) {
        bits |= is_small(view, view.share, parent) ? 0 : floatBitsToUint(levels[parent + BALL_FLOATS]);
    }
    if (LEVELS == LEVELS_OF_CELLS && bits != 0) {
        bits &= bits_of_cells(view, word);
    }
    if (LEVELS == LEVELS_NODES) {
        for (uint rest = bits; rest != 0; rest &= rest - 1) {
            uint bit = findLSB(rest);
            bits &= is_small(view, view.share_of_blended, own_ball(WORD * word + bit)) ? 0xffffffffu : ~(1u << bit);
        }
    }
    return bits;
}
