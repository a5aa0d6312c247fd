// What a splat's vertex stage hands to its fragments. VARYING is `out` or `in`; the pass uses `extra` as it likes.
//
// PLAIN, 3 vectors: points that are expanded about where (u, v) is 0, or about the middle of the image.
// FULL, 4: any expansion point. CENTER, 5: the projected center too, for the filter `max`.
// RAYS, 4: the splat itself in view space. TRIANGLES: (u, v) as the rasterizer interpolates them.
//
// CLIPPED, 6 more: what clip curves cut off the splat.
//
// PLAIN and RAYS have no room for extra.w, which FOURTH gives a vector of its own: one that nobody reads costs a CPU driver, too.

#include "inc/places.glsl"

#if defined(RAYS)
layout(location = 0) flat VARYING vec4 ray_center_extra; // p, extra.x
layout(location = 1) flat VARYING vec4 ray_plane_extra;  // n / (n . p), extra.y
layout(location = 2) flat VARYING vec4 ray_u_extra;      // what a vector's product with is u, extra.z
layout(location = 3) flat VARYING vec4 ray_v_square;     // v alike; half the side in pixels of the square that is drawn, or 0
#elif defined(TRIANGLES)
layout(location = 0) VARYING vec2 triangle_uv;
layout(location = 1) flat VARYING vec4 triangle_extra;
#else
layout(location = 0) flat VARYING vec4 x0_w_extra;  // x0_px, w at x0, extra.x; PLAIN of perspective-paper: uvw, extra.x
layout(location = 1) flat VARYING vec4 per_x_extra; // change per pixel, extra.y
layout(location = 2) flat VARYING vec4 per_y_extra; // change per pixel, extra.z
#if defined(FULL) || defined(CENTER)
layout(location = 3) flat VARYING vec4 uv_affine; // (uw, vw) at x0, 1 where the map is affine, extra.w
#endif
#if defined(CENTER)
layout(location = 4) flat VARYING vec3 center_low_pass; // projected center in pixels; w there, or 0 without the filter
#endif
#endif
#if defined(CLIPPED)
layout(location = 7) flat VARYING vec4 clip_curves[CLIP_VECTORS]; // c, a and b of two curves (inc/clip.glsl)
#endif
#if defined(FOURTH)
layout(location = 6) flat VARYING float fourth; // extra.w
#endif
