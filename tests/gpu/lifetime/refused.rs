//! What a device does not have is refused before Vulkan is called: no safe function may call it with what it does not allow. The layer would say so.

use ash::vk;
use surfel::vk::{
    Binding, Buffer, BufferDesc, DescriptorPool, Image, ImageDesc, MemoryUse, Occlusion, PipelineLayout,
    PoolSizes, SetLayout,
};

use crate::common::watched::Watched;

#[test]
fn what_a_device_does_not_have_is_refused_and_the_layer_is_silent() {
    let (watched, other) = (Watched::new(), Watched::new());
    let device = &watched.device;
    use vk::{BufferUsageFlags as B, Format as F, ImageUsageFlags as I};
    for usage in [B::empty(), B::SHADER_DEVICE_ADDRESS, B::from_raw(1 << 31)] {
        let desc = BufferDesc { name: "buffer", size: 16, usage };
        assert!(Buffer::new(device, desc, MemoryUse::Device).is_err(), "{usage:?}");
    }
    let images = [
        (F::R8G8B8A8_UNORM, I::empty()),
        (F::UNDEFINED, I::SAMPLED),
        (F::from_raw(77_777), I::SAMPLED),
        (F::R8G8B8A8_SRGB, I::STORAGE),
        (F::R8G8B8A8_UNORM, I::DEPTH_STENCIL_ATTACHMENT),
        (F::D24_UNORM_S8_UINT, I::DEPTH_STENCIL_ATTACHMENT),
        (F::G8_B8R8_2PLANE_420_UNORM, I::SAMPLED),
        (F::R8G8B8A8_UNORM, I::from_raw(1 << 31)),
    ];
    for (format, usage) in images {
        let desc = ImageDesc { name: "image", format, extent: vk::Extent2D { width: 4, height: 4 }, usage };
        assert!(Image::new(device, desc).is_err(), "{format:?} {usage:?}");
    }
    let binding = |kind| Binding { kind, stages: vk::ShaderStageFlags::COMPUTE };
    let unknown = [binding(vk::DescriptorType::ACCELERATION_STRUCTURE_KHR)];
    assert!(SetLayout::new(device, "set", &unknown).is_err());
    let known = [binding(vk::DescriptorType::STORAGE_BUFFER)];
    let [own, foreign] = [device, &other.device].map(|device| SetLayout::new(device, "set", &known).unwrap());
    let layout = |sets: &[&SetLayout], bytes, stages| {
        PipelineLayout::new(device, "layout", sets, bytes, stages).is_ok()
    };
    let compute = vk::ShaderStageFlags::COMPUTE;
    assert!(layout(&[&own], 128, compute));
    assert!(!layout(&[&foreign], 0, compute));
    assert!(!layout(&[&own; 5], 0, compute));
    assert!(!layout(&[&own], 132, compute));
    assert!(!layout(&[&own], 6, compute));
    assert!(!layout(&[&own], 4, vk::ShaderStageFlags::empty()));
    assert!(DescriptorPool::new(device, "pool", PoolSizes::default()).is_err());
    assert!(Occlusion::new(device, "queries", 0).is_err());
    drop((own, foreign));
    for watched in [watched, other] {
        let messages = watched.messages.clone();
        drop(watched);
        assert_eq!(messages.all(), []);
    }
}
