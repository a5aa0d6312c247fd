// Which splats of a hierarchy are drawn: those no larger on the screen than tau whose parent is (Pajarola, Sainz, Guidotti 2003, section
// 5.1). Each decides alone.
//
// A node has a ball around all below it, and how far it spreads, both within its parent's (src/geometry/hierarchy/select.rs, where that exactly one splat of every path
// from the root down is drawn is proved). Its size is focal spread / max(d - r, near), with d from the eye to the ball's center and r its
// radius; under parallel rays focal spread. So it is at most tau where spread <= tau / focal max(d - r, near). Both the parent's ball and a
// node's own are the same bits wherever they lie, and this is one function of them: of a parent and its child exactly one is drawn, whatever rounding does.
//
// All in the space of the hierarchy: from its origin, scaled by a power of two.

layout(set = 0, binding = BIND_SPLATS_LEVELS, std430) readonly buffer Levels { float levels[]; }; // the parent's ball, a node's own: center, radius, spread

// How the camera sees a chunk's hierarchy.
struct LevelView {
    vec3 eye;
    float share; // tau / focal
    float near;
};

// Behind all blocks, that of the last chunk first.
LevelView level_view()
{
    uint first = visible_blocks.length() - LEVEL_WORDS * (CHUNK + 1);
    vec3 eye = vec3(
        uintBitsToFloat(visible_blocks[first]),
        uintBitsToFloat(visible_blocks[first + 1]),
        uintBitsToFloat(visible_blocks[first + 2]));
    return LevelView(eye, uintBitsToFloat(visible_blocks[first + 3]), uintBitsToFloat(visible_blocks[first + 4]));
}

bool is_small(LevelView view, uint first)
{
    vec3 from_eye = vec3(levels[first], levels[first + 1], levels[first + 2]) - view.eye;
    float nearest = max(sqrt(precise_dot(from_eye, from_eye)) - levels[first + 3], view.near);
    return levels[first + 4] <= view.share * (ORTHOGRAPHIC ? 1.0 : nearest);
}

bool is_of_level(LevelView view, uint index)
{
    uint first = index * (LEVELS == LEVELS_NODES ? 10 : 5);
    return !is_small(view, first) && (LEVELS == LEVELS_LEAVES || is_small(view, first + 5));
}
