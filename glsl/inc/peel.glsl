// Depth peeling of surfaces with a thickness (Guennebaud et al. 2006, section 6). Reversed depth: nearer is larger.
//
// A fragment j has its own depth w_j and a shifted one, w'_j <= w_j (what the visibility pass writes). With D_0 = infinity,
// layer k has the depth D_k = max { w'_j : w_j < D_(k-1) } and holds the fragments with D_k <= w_j < D_(k-1).
//
// Invariant: the intervals [D_k, D_(k-1)) do not overlap and leave no gap, so that each fragment is in one layer at most, and
// none between two layers is skipped, whatever their thicknesses, also where surfaces touch, coincide or cross. Each layer
// takes one fragment at least: the one whose w' is D_k has w >= w' = D_k, and w < D_(k-1). So D_k <= w < D_(k-1) falls
// strictly, no layer peels itself again, and n fragments are gone after n layers. Opaque things only raise D_k, to their own
// depth D: what is in front of them has w >= D, and is in a layer whose D_k is max(D, the above).
//
// What is said of fragments holds of surfaces as far as epsilon is as thick as one surface's fragments in a pixel spread:
// mapping.glsl lets it grow with the filter. Visibility covers a hair less of a splat than accumulation (visibility.frag.glsl):
// a fragment in that hair belongs to the layer in whose interval it falls, and founds none.
//
// All of it is comparisons, which are exact, of numbers that are bit-equal in all passes: w is (coverage.glsl), and D32 holds
// what was written. A fragment's w' <= w also after rounding: it is w times a factor of at most 1.

layout(constant_id = SPEC_PEELED) const bool PEELED = false; // behind a layer
layout(set = 2, binding = BIND_READ_DEPTH) uniform texture2D peeled_depth; // D_(k-1)

// Discards what is not behind the layer before.
void peel(float w)
{
    if (!(w < FORMULA_LESS(FORMULA_PEELED, texelFetch(peeled_depth, ivec2(gl_FragCoord.xy), 0).r))) {
        discard;
    }
}
