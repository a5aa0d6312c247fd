// What an orthographic camera changes, whose rays are parallel.
//
// Its image plane is the view's own x and y, so that an "image-plane unit" is the view's, and focal_px so many pixels. Wherever a
// formula of a perspective has the direction of the ray through a point p, which is p itself, here (0, 0, 1) stands: with it M = [s t
// (0, 0, 1)] maps (u, v) to x and y, and its inverse is affine. Depth is w = 1 - z / end: reversed as near / z is, linear on the screen as
// that is, 1 where the eye is and 0 at `end`, which the host puts twice as far as the scene reaches (src/passes/plan/range.rs). Epsilon is
// taken off w as what it is of the end's distance, where a perspective divides by f.

layout(constant_id = SPEC_ORTHOGRAPHIC) const bool ORTHOGRAPHIC = false;

// Depths stay above 0, which is nothing.
const float LEAST_DEPTH = 1e-6;

// The depth w, moved away from the eye by a splat's `shift`.
float shifted(float w, float shift)
{
    return ORTHOGRAPHIC ? max(w - shift, LEAST_DEPTH) : w * shift;
}

// What is summed of a fragment's depth, so that the mean of z follows from it: z over that of the visible depth; of an orthographic camera by
// how much w is above the visible one, which is little, so that 16 bits lose little of it.
float depth_term(float w_visible, float w)
{
    return ORTHOGRAPHIC ? w - w_visible : w_visible / w;
}

// The depth of which that is the mean.
float depth_of_mean(float w_visible, float mean)
{
    return ORTHOGRAPHIC ? w_visible + mean : w_visible / mean;
}

// The direction to the eye where a view-space point is seen.
vec3 direction_to_eye(vec3 seen_at)
{
    return ORTHOGRAPHIC ? vec3(0.0, 0.0, -1.0) : -normalize(seen_at);
}
