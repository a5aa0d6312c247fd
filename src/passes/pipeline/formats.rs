//! Formats of the images of a frame.

use ash::vk;

use crate::scene::Accumulate;

/// The format of the sums. A plan leaves no `auto`.
pub(crate) fn sum_format(accumulate: Accumulate) -> vk::Format {
    match accumulate {
        Accumulate::F16 => vk::Format::R16G16B16A16_SFLOAT,
        Accumulate::F32 | Accumulate::Auto => vk::Format::R32G32B32A32_SFLOAT,
    }
}

/// The visibility pass's reversed depth: near / z.
pub(crate) const DEPTH_FORMAT: vk::Format = vk::Format::D32_SFLOAT;
