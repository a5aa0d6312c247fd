//! From one level of detail to the next.

use super::option::named;

named! {
    /// How nodes of levels of detail take the place of those below them.
    LodSteps {
        /// At once, where they are no larger than `lod`.
        Hard = "hard",
        /// Both are drawn, the node with more of the weight the smaller it is, from 1.41 times `lod` on: little leaps where
        /// the camera moves. For opaque splats by tiles whose edges are covered in part; else as `hard`.
        Blend = "blend",
    }
}

impl LodSteps {
    /// A node is blended with those below it from this many times τ on: half an octave.
    pub const BLENDED: f64 = std::f64::consts::SQRT_2;
}
