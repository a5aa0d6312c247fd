// Where a fragment lies in its splat, and whether it is covered: the "three instructions" of Guennebaud et al. 2006,
// section 3.2, where the rasterizer is theirs. The depth w = near / z must come out bit-equal in every pass, so it is
// computed here only and is `precise`.
//
// The filter `max` (Botsch, Hornung, Zwicker, Kobbelt 2005) takes the larger one of kernel and low-pass filter, whose
// kernel is the same about the projected center with radius sqrt(2) pixels: kernels fall, so the smaller argument decides.

#define VARYING in
#include "inc/varyings.glsl"

const float FILTER_RADIUS_PX = 1.41421356;

struct Covered {
    vec2 uv; // the kernel's argument
    float w; // depth
};

// From the middle of the image: exact, both are multiples of a half, or of a 256th where the camera is off by a part of a pixel.
vec2 at_px()
{
    return gl_FragCoord.xy - frame.middle_px;
}

// From a place as the vertex stage hands it over (`handed_over_px`).
vec2 from_px(vec2 place)
{
    return PLACES_FROM_CORNER ? gl_FragCoord.xy - place : at_px() - place;
}

#if defined(FOURTH)
#define EXTRA_W fourth
#elif defined(FULL) || defined(CENTER)
#define EXTRA_W uv_affine.w
#else
#define EXTRA_W 0.0
#endif

#define PLANES_SET 2
#define PLANES_BINDING BIND_READ_PLANES
#include "inc/planes.glsl"

// Discards the fragment if a plane cuts it off.
void cut_fragment(float w)
{
    if (PLANES > 0 && is_cut_off(at_px(), w)) {
        discard;
    }
}

#if defined(CLIPPED)
#include "inc/clip.glsl"

// Discards the fragment if a clip curve cuts it off.
void clip_fragment()
{
    vec2 px = at_px();
    bool first = keeps(Curve(clip_curves[0], clip_curves[1], clip_curves[2]), px);
    bool second = keeps(Curve(clip_curves[3], clip_curves[4], clip_curves[5]), px);
    if (!(is_told(clip_curves[3], CURVE_BOTH) ? first || second : first && second)) {
        discard;
    }
}
#else
void clip_fragment() {}
#endif

#if defined(TRIANGLES)

// Discards the fragment if u^2 + v^2 is above the limit.
Covered covered(float limit_r2)
{
    clip_fragment();
    if (!(dot(triangle_uv, triangle_uv) <= FORMULA(FORMULA_COVERAGE, limit_r2))) {
        discard;
    }
#if defined(MOVED_DEPTH)
    // Found again, and so off by a rounding: what is seen here must be accumulated later.
    float w = ORTHOGRAPHIC ? gl_FragCoord.z + triangle_extra.x : gl_FragCoord.z / triangle_extra.x;
    if (PLANES > 0 && is_cut_off(at_px(), w, 1e-6)) {
        discard;
    }
#else
    cut_fragment(gl_FragCoord.z);
#endif
    return Covered(triangle_uv, gl_FragCoord.z);
}

vec4 extra()
{
    return triangle_extra;
}

#else

#if defined(RAYS)

// Half the side of the square to which a splat's approximate size cuts it, and whether its plane is expanded about its center.
float half_square_px()
{
    return ray_v_square.w < 0.0 ? -1.0 - ray_v_square.w : ray_v_square.w;
}

// The ray of the fragment meets the splat's plane n . q = n . p (Botsch et al. 2005): 1 / z is linear along the image. With d from
// the center's image c in the image, q - p = z (d, 0) + (z - p_z) (c, 1), and z - p_z = -p_z z (slope . d): nothing cancels, however
// small the splat is beside its distance.
vec3 evaluate()
{
    precise vec2 place = at_px(); // x and y in focal lengths, like all that was handed over
    if (ORTHOGRAPHIC) {
        precise vec2 d = place - ray_center_extra.xy;
        precise float deeper = ray_plane_extra.x * d.x + ray_plane_extra.y * d.y;
        precise float w = FORMULA(FORMULA_RAY_DEPTH, 1.0 - (ray_plane_extra.z + deeper) / frame.near);
        vec3 q = vec3(d, deeper);
        return vec3(dot(FORMULA(FORMULA_RAY_AXIS, ray_u_extra.xyz), q), dot(ray_v_square.xyz, q), w);
    }
    vec3 q;
    precise float inverse_z;
    if (ray_v_square.w >= 0.0) {
        vec2 c = ray_center_extra.xy / ray_center_extra.z;
        precise vec2 d = place - c;
        precise float change = ray_plane_extra.x * d.x + ray_plane_extra.y * d.y;
        inverse_z = ray_plane_extra.z + change;
        float deeper = -ray_center_extra.z * change / inverse_z;
        q = vec3(d / inverse_z + c * deeper, deeper);
    } else {
        inverse_z = ray_plane_extra.x * place.x + ray_plane_extra.y * place.y + ray_plane_extra.z;
        q = vec3(place, 1.0) / inverse_z - ray_center_extra.xyz;
    }
    precise float w = FORMULA(FORMULA_RAY_DEPTH, frame.near * inverse_z);
    return vec3(dot(FORMULA(FORMULA_RAY_AXIS, ray_u_extra.xyz), q), dot(ray_v_square.xyz, q), w);
}

vec2 from_center_px()
{
    vec2 center_px = ORTHOGRAPHIC ? ray_center_extra.xy : ray_center_extra.xy / ray_center_extra.z;
    return at_px() - center_px;
}

// From the projected center, in pixels, and the depth there; 0 without a low-pass filter.
vec3 low_pass()
{
    float z = ray_center_extra.z;
    if (ORTHOGRAPHIC) {
        return vec3(from_center_px(), z > 0.0 ? 1.0 - z / frame.near : 0.0);
    }
    return vec3(from_center_px(), z > frame.near ? frame.near / z : 0.0);
}

vec4 extra()
{
    return vec4(ray_center_extra.w, ray_plane_extra.w, ray_u_extra.w, EXTRA_W);
}

#else

vec3 evaluate()
{
#if defined(PLAIN)
    const bool about_middle = RASTERIZER == RASTERIZER_PERSPECTIVE_PAPER;
    precise vec2 d = about_middle ? at_px() : from_px(x0_w_extra.xy);
    precise vec3 uvw = per_x_extra.xyz * d.x + per_y_extra.xyz * d.y;
    if (about_middle) {
        uvw += x0_w_extra.xyz;
    } else {
        uvw.z += x0_w_extra.z;
    }
    bool affine = AFFINE;
#else
    precise vec2 d = from_px(x0_w_extra.xy);
    precise vec3 uvw = vec3(uv_affine.xy, x0_w_extra.z) + (per_x_extra.xyz * d.x + per_y_extra.xyz * d.y);
    bool affine = (AFFINE || FILTER == FILTER_MAX) && uv_affine.z != 0.0;
#endif
    // Divided before it is squared: the square of a small w would underflow.
    return affine ? uvw : vec3(uvw.xy / uvw.z, uvw.z);
}

vec3 low_pass()
{
#if defined(CENTER)
    return vec3(from_px(center_low_pass.xy), center_low_pass.z);
#else
    return vec3(from_px(x0_w_extra.xy), x0_w_extra.z); // expanded about the center
#endif
}

vec4 extra()
{
    return vec4(x0_w_extra.w, per_x_extra.w, per_y_extra.w, EXTRA_W);
}

#endif

// Discards the fragment if u^2 + v^2 is above the limit or it lies in front of the near plane.
Covered covered(float limit_r2)
{
    clip_fragment();
#if defined(RAYS)
    if (RASTERIZER == RASTERIZER_RAYCAST_APPROXIMATE && half_square_px() > 0.0) {
        vec2 d = abs(from_center_px());
        if (max(d.x, d.y) > half_square_px()) {
            discard; // sprites end at pixels, so that the square is cut here
        }
    }
#endif
    precise vec3 uvw = evaluate();
    bool inside = dot(uvw.xy, uvw.xy) <= FORMULA(FORMULA_COVERAGE, limit_r2);
#if defined(PLAIN)
    // A regular splat lies wholly beyond the near plane, but an affine map reaches further than the splat.
    const bool may_be_too_near = AFFINE;
#else
    const bool may_be_too_near = true;
#endif
    if (may_be_too_near) {
        // w = near / z: above 1 in front of the near plane, not above 0 behind the eye. A NaN fails too.
        inside = inside && uvw.z > 0.0 && uvw.z <= FORMULA(FORMULA_NEAR_CUT, 1.0);
    }
    if (FILTER == FILTER_MAX) {
        vec3 center = low_pass();
        vec2 argument = center.xy / FORMULA(FORMULA_LOW_PASS, FILTER_RADIUS_PX);
        float r2 = dot(argument, argument);
        if (center.z > 0.0 && r2 <= limit_r2) {
            float w = inside ? uvw.z : center.z;
            bool kernel_is_larger = inside && dot(uvw.xy, uvw.xy) <= r2;
            cut_fragment(w);
            return Covered(kernel_is_larger ? uvw.xy : argument, min(w, 1.0));
        }
    }
    if (!inside) {
        discard;
    }
    cut_fragment(uvw.z);
    // At the near plane w is 1 but for rounding; a depth above 1 is undefined.
    return Covered(uvw.xy, min(uvw.z, 1.0));
}

#endif
