//! Sizes of what shaders read on CPUs. llvmpipe compiles a shader anew where some facts of what it reads change: whether an image has a side that is a power of two, the same of the bytes of
//! a buffer that is read by texels, and whether the second byte of that number is 0 (`lp_sampler_static_texture_state` takes it for the number of an image's levels). That is the largest shader of a frame, which takes seconds, whenever a window or a list comes to such a size or leaves it, and no pipeline tells. So none is of such a size.

use ash::vk;

use super::super::ImageDesc;
use crate::vk::{Limits, texel_bytes};

/// The extent of an image for this usage: a row or column more where there is a power of two of them. Shaders never ask images that they read or write for their sides but for the half of an
/// even number of rows or columns, which stays.
pub(super) fn image_extent(limits: &Limits, desc: ImageDesc, usage: vk::ImageUsageFlags) -> vk::Extent2D {
    let vk::Extent2D { width, height } = desc.extent;
    let is_read = usage.intersects(vk::ImageUsageFlags::STORAGE | vk::ImageUsageFlags::SAMPLED);
    if !(is_read && limits.is_cpu) {
        return desc.extent;
    }
    let most = limits.max_image_side;
    let beside = |side: u32| (side..=most).find(|side| !side.is_power_of_two()).unwrap_or(side);
    vk::Extent2D { width: beside(width), height: beside(height) }
}

/// The bytes of a buffer with this many for these texels, where its usage has it read by them: 256 or 512 more where there are such as are told above, if the device has so many texels.
pub(super) fn buffer_bytes(
    limits: &Limits,
    size_bytes: u64,
    texels: vk::Format,
    usage: vk::BufferUsageFlags,
) -> u64 {
    let is_read = usage.contains(vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER);
    let (true, true, Some(texel_bytes)) = (is_read, limits.is_cpu, texel_bytes(texels)) else {
        return size_bytes;
    };
    let most = (u64::from(limits.max_texels) * texel_bytes).min(limits.max_buffer_size);
    let is_other = |bytes: &u64| !bytes.is_power_of_two() && bytes >> 8 & 0xff != 0;
    (size_bytes..=most).step_by(256).find(is_other).unwrap_or(size_bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cpu() -> Limits {
        Limits { is_cpu: true, max_texels: 1 << 20, ..Limits::plain() }
    }

    fn sampled(limits: &Limits, [width, height]: [u32; 2]) -> [u32; 2] {
        let desc = ImageDesc { format: vk::Format::R32_SFLOAT, extent: vk::Extent2D { width, height } };
        let vk::Extent2D { width, height } = image_extent(limits, desc, vk::ImageUsageFlags::SAMPLED);
        [width, height]
    }

    #[test]
    fn no_side_is_a_power_of_two_and_half_of_an_even_one_stays_half() {
        for side in 1..5000 {
            let [width, height] = sampled(&cpu(), [side, 2 * side]);
            assert!(!width.is_power_of_two() && !height.is_power_of_two());
            assert!((side..=side + 2).contains(&width) && height / 2 == side);
        }
        assert_eq!(sampled(&Limits { max_image_side: 64, ..cpu() }, [64; 2]), [64; 2]);
        assert_eq!(sampled(&Limits { is_cpu: false, ..cpu() }, [64; 2]), [64; 2]);
    }

    #[test]
    fn no_buffer_of_texels_has_a_size_that_is_told_apart() {
        let of = |limits: &Limits, bytes| {
            buffer_bytes(limits, bytes, vk::Format::R32_UINT, vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER)
        };
        for bytes in (4..400_000).step_by(4) {
            let more = of(&cpu(), bytes);
            assert!(!more.is_power_of_two() && more / 256 % 256 != 0, "{bytes}");
            assert!((bytes..=bytes + 512).contains(&more), "{bytes}: {more}");
        }
        assert_eq!(of(&Limits { max_texels: 256, ..cpu() }, 1024), 1024);
        assert_eq!(of(&Limits { is_cpu: false, ..cpu() }, 1024), 1024);
        assert_eq!(
            buffer_bytes(&cpu(), 1024, vk::Format::R32_UINT, vk::BufferUsageFlags::STORAGE_BUFFER),
            1024
        );
    }
}
