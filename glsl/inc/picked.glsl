// The nearest thing of several in the picked pixel. The host's mirror is `Picked` in src/passes/pick/mod.rs.

struct Picked {
    float moved; // its depth, moved away from the eye by epsilon; NOTHING_MOVED of nothing
    float depth; // its own
    uint index;  // in its chunk
    uint unused;
    vec4 normal; // unit, view space, toward the eye
};

// Parallel rays: what is moved may be behind where depth ends.
const float NOTHING_MOVED = -1e38;
const Picked NOTHING_PICKED = Picked(NOTHING_MOVED, 0.0, 0, 0, vec4(0.0));

layout(set = 1, binding = BIND_LIST_ITEMS, std430) writeonly buffer PickedThings { Picked picked[]; };
