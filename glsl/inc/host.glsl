// What passes are told that meet a host's own depth. The host's mirror is `HostDepth` in src/passes/pipeline/constants.rs; the build
// compares the offsets.
//
// A host's depth is a + b / z, or a + b z of parallel rays, with z the view-space depth: linear in w (inc/projection.glsl) in both, so that
// one multiplication and one addition take one to the other.

struct HostDepth {
    ivec2 corner_px;  // where the picture's corner lies in the host's image
    float scale;      // the host's depth of w: scale w ...
    float offset;     // ... + offset
    int columns;      // of the picture, where it is a mirror's; else 0
};
layout(push_constant, std430) uniform Push { HostDepth push; };

// Where a pixel of the host's, from the picture's corner on, is in ours, and the other way around: a mirror's picture is drawn as seen without
// the mirror, which turns every sign of the frame's, and turned over as it meets the host's.
ivec2 turned_over(ivec2 pixel)
{
    return push.columns > 0 ? ivec2(push.columns - 1 - pixel.x, pixel.y) : pixel;
}
