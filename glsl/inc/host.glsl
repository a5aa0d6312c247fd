// What passes are told that meet a host's own depth. The host's mirror is `HostDepth` in src/passes/pipeline/constants.rs; the build
// compares the offsets.
//
// A host's depth is a + b / z, or a + b z of parallel rays, with z the view-space depth: linear in w (inc/projection.glsl) in both, so that
// one multiplication and one addition take one to the other.

struct HostDepth {
    ivec2 corner_px;  // where the picture's corner lies in the host's image
    float scale;      // the host's depth of w: scale w ...
    float offset;     // ... + offset
};
layout(push_constant, std430) uniform Push { HostDepth push; };
