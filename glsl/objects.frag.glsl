// Whose the visible surface is: the splat or polygon whose depth is nearest to that of the surface, 0 where none is. The depth test keeps the largest of what
// grows as both come nearer to each other; src/passes/host/objects_out.rs tells why that is always a splat of the surface.
//
// Permutations: plain full center rays triangles | _ clipped
// Permutations: polygons
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#if defined(POLYGONS)
#define PLANES_SET 2
#define PLANES_BINDING BIND_READ_PLANES
#include "inc/planes.glsl"
#else
#if defined(TRIANGLES)
#define MOVED_DEPTH // the rasterizer's
#endif
#include "inc/coverage.glsl"
#endif

layout(set = 2, binding = BIND_READ_DEPTH) uniform texture2D surface_depth; // w, 0 where nothing is

layout(location = 0) out uint object; // one more than the number of the chunk

// What the surface's own pass covers is covered here, by whatever way it rounds: so splats cover a hair more.
const float HAIR = 1.0 + 1e-3;

void main()
{
#if defined(POLYGONS)
    float w = gl_FragCoord.z;
    if (PLANES > 0 && is_cut_off(gl_FragCoord.xy - frame.middle_px, w)) {
        discard;
    }
#else
    float w = covered(HAIR * COVERAGE_R2).w;
#if defined(TRIANGLES)
    w = ORTHOGRAPHIC ? w + extra().x : w / extra().x;
#endif
#endif
    float surface = texelFetch(surface_depth, ivec2(gl_FragCoord.xy), 0).r;
    if (!(surface > 0.0 && w > 0.0)) {
        discard;
    }
    gl_FragDepth = min(w, surface) / max(w, surface);
    object = CHUNK + 1;
}
