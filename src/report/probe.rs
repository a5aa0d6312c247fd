//! Work that a device is given alone, to find how much of it it does in a second at most.

use serde::Serialize;

/// Something of which a device does only so much in a second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ThroughputProbe {
    /// Points whose vertex stage passes them through, outside of the clip volume.
    Points,
    /// Points of one pixel in the image, all of whose fragments fail the depth test.
    DrawnPoints,
    /// Fragments of one color into 8-bit RGBA.
    Fragments,
    /// Fragments that only test and write a 32-bit depth.
    DepthFragments,
    /// Fragments added into two images of sums.
    BlendedFragments,
    /// Bytes read and written by a copy from buffer to buffer.
    Bytes,
    /// Invocations of a compute shader that does nothing.
    Invocations,
    /// Atomic sums, one of each invocation of a compute shader, on as many words as there are in 4096 workgroups of 256.
    Atomics,
    /// Splats at pixels, each seen and then added in registers, as tiles do it, without what brings them there.
    Kernels,
}

impl ThroughputProbe {
    /// Its name: in tables, and as the pass that measures it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Points => "points",
            Self::DrawnPoints => "drawn points",
            Self::Fragments => "fragments",
            Self::DepthFragments => "depth fragments",
            Self::BlendedFragments => "blended fragments",
            Self::Bytes => "bytes",
            Self::Invocations => "invocations",
            Self::Atomics => "atomics",
            Self::Kernels => "kernels",
        }
    }
}
