//! What shows how splats lie.

use super::option::named;

named! {
    /// What is drawn over splats, to see how they lie.
    Outlines {
        /// Nothing.
        None = "none",
        /// Their rims, in black: the outer tenth of each splat's radius, of the surfaces that are seen.
        Splats = "splats",
    }
}
