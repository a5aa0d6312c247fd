//! What a device does not have is refused before Vulkan is called: no safe function may call it with what it does not allow. The layer would say so.

use ash::vk;
use glam::{DVec3, Vec3};
use surfel::{
    graph::{self, ResourceDesc, Usage, execute::memory_need},
    prepare::{SplatSetLayout, prepare},
    scene::{Colors, Mesh, MeshObject, Scene},
    vk::{
        Binding, Buffer, BufferDesc, DescriptorPool, Image, ImageDesc, MemoryUse, Occlusion, PipelineLayout,
        PoolSizes, SetLayout, Staging,
    },
};

use crate::common::{scenes, watched::Watched};

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
    // Each set alone is as large as a set can be.
    use vk::DescriptorType as T;
    // SAFETY: both are alive.
    let has = unsafe { device.instance().raw().get_physical_device_properties(device.physical()) }.limits;
    for (kind, most, what) in [
        (T::STORAGE_BUFFER, has.max_per_stage_descriptor_storage_buffers, "storage buffers"),
        (T::UNIFORM_BUFFER, has.max_per_stage_descriptor_uniform_buffers, "uniform buffers"),
        (T::STORAGE_IMAGE, has.max_per_stage_descriptor_storage_images, "storage images"),
        (T::COMBINED_IMAGE_SAMPLER, has.max_per_stage_descriptor_sampled_images, "sampled images"),
    ] {
        let large = SetLayout::new(device, "large", &[binding(kind); 64]).unwrap();
        let error = PipelineLayout::new(device, "layout", &[&large; 4], 0, compute).err();
        let names = error.map(|error| error.to_string().contains(&format!("256 {what} in a stage")));
        assert!(if most < 256 { names == Some(true) } else { names != Some(true) }, "{what}: {most}");
    }
    let transient = |desc: ResourceDesc, usage: Usage| memory_need(device, &desc, usage).is_ok();
    let image = |width, format| {
        ResourceDesc::Image(graph::ImageDesc { extent: vk::Extent2D { width, height: 4 }, format })
    };
    let bytes = |size_bytes| ResourceDesc::Buffer(graph::BufferDesc { size_bytes, texels: F::UNDEFINED });
    assert!(transient(image(4, F::R8G8B8A8_UNORM), Usage::Image(I::SAMPLED)));
    assert!(!transient(image(0, F::R8G8B8A8_UNORM), Usage::Image(I::SAMPLED)));
    assert!(!transient(image(4, F::R8G8B8A8_SRGB), Usage::Image(I::STORAGE)));
    assert!(!transient(image(4, F::R8G8B8A8_UNORM), Usage::Buffer(B::STORAGE_BUFFER)));
    assert!(transient(bytes(16), Usage::Buffer(B::STORAGE_BUFFER)));
    assert!(!transient(bytes(0), Usage::Buffer(B::STORAGE_BUFFER)));
    assert!(!transient(bytes(16), Usage::Buffer(B::empty())));
    let mut staging = Staging::new(device, "staging", 64).unwrap();
    let mut target = |device, usage| {
        let target = Buffer::new(device, BufferDesc { name: "target", size: 16, usage }, MemoryUse::Device);
        staging.push(&target.unwrap(), 0, &[0; 16]).is_ok()
    };
    assert!(target(device, B::TRANSFER_DST | B::STORAGE_BUFFER));
    assert!(!target(device, B::STORAGE_BUFFER));
    assert!(!target(&other.device, B::TRANSFER_DST));
    drop(staging);
    assert!(DescriptorPool::new(device, "pool", PoolSizes::default()).is_err());
    assert!(Occlusion::new(device, "queries", 0).is_err());
    drop((own, foreign));
    for watched in [watched, other] {
        let messages = watched.messages.clone();
        drop(watched);
        assert_eq!(messages.all(), []);
    }
}

/// What a scene is drawn from is brought there first, through a layout of its own device: else a safe call would draw whatever lies in its memory, as indices, too.
#[test]
fn a_scene_of_which_a_batch_is_not_recorded_or_the_layout_is_foreign_is_refused() {
    let (watched, other) = (Watched::new(), Watched::new());
    let queue = &watched.queue;
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    let colors = Colors::Uniform([1.0; 4]);
    let mesh = Mesh { positions, normals: Some(vec![Vec3::Z; 3]), colors, triangles: vec![[0, 1, 2]] };
    let scene = Scene {
        objects: vec![scenes::sphere(3000, DVec3::ZERO)],
        meshes: vec![MeshObject { name: "triangle".to_owned(), mesh, closed: false }],
        levels: true,
        ..Scene::default()
    };
    let limits = watched.device.facts().limits;
    let [own, foreign] = [&watched, &other].map(|watched| SplatSetLayout::new(&watched.device).unwrap());
    // How many batches there were, where all but one of them are recorded.
    let batches = |layout: &SplatSetLayout, but: Option<usize>| {
        let mut batches = 0;
        let mut submit = |staging: Staging| {
            batches += 1;
            if but == Some(batches - 1) {
                return Ok(());
            }
            queue.run_once("upload", |commands| {
                // SAFETY: recording; `run_once` waits.
                unsafe { staging.record(commands) };
                Ok(())
            })
        };
        prepare(&watched.device, &limits, layout, &scene, &mut submit, &|_, _| {}).map(|_| batches)
    };
    let all = batches(&own, None).unwrap();
    assert!(all >= 4, "{all}: of splats, nodes, their levels and a mesh");
    for but in 0..all {
        let refused = batches(&own, Some(but)).unwrap_err().to_string();
        assert_eq!(refused, "submit: a batch of uploads was not recorded", "{but} of {all}");
    }
    let refused = batches(&foreign, None).unwrap_err().to_string();
    assert_eq!(refused, "layout: is another device's");
    drop((own, foreign));
    for watched in [watched, other] {
        let messages = watched.messages.clone();
        drop(watched);
        assert_eq!(messages.all(), []);
    }
}
