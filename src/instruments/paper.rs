//! Draws with the splat passes as published in 2006; see [`paper_frame`].

use ash::vk;

use super::paper_passes::paper_frame;
use crate::renderer::{Headless, headless::submit_and_wait, import_readback};
use crate::{
    arena::Arena,
    error::{Error, Result},
    frame::{FrameSlot, HeadlessTarget, SlotParts},
    graph::{Graph, ImageDesc, execute::Physical},
    passes::{self, DepthRange, Inputs, Needs, Place},
    prepare::{Placed, PreparedScene},
    scene::{Camera, Settings},
    vk::{Buffer, BufferDesc, MemoryUse, PoolSizes},
};

/// The picture that the paper's own programs draw: RGBA, linear, row by row from the top. Of the settings that concern splats,
/// kernel and ε count; the filter is the paper's. `filtered`: visibility is filtered too, which theirs is not.
///
/// # Errors
/// [`crate::error::ErrorKind::Option`] for ellipses, which the paper's filter does not know, and packed splats; whatever the driver answers.
pub fn draw_as_published(
    headless: &Headless,
    scene: &PreparedScene,
    camera: &Camera,
    settings: &Settings,
    filtered: bool,
) -> Result<Vec<[f32; 4]>> {
    headless.renderer.check(camera, settings)?;
    let settings = &passes::with_sums(settings, &headless.renderer.limits);
    if scene.chunks.iter().any(|chunk| chunk.ellipses) {
        return Err(Error::option(
            "as published",
            "the scene has elliptic splats, the paper's filter is for disks",
        ));
    }
    if scene.chunks.iter().any(|chunk| chunk.packed || chunk.fine) {
        let problem = "the paper's programs know no packed splats, nor such with coordinates beyond f32";
        return Err(Error::option("as published", problem));
    }
    let device = headless.device();
    let format = vk::Format::R32G32B32A32_SFLOAT;
    let drawn = HeadlessTarget::new(device, format, settings.size_px)?;
    let [width, height] = settings.size_px.map(u64::from);
    let size = width * height * crate::renderer::bytes_per_pixel(format);
    let desc = BufferDesc { name: "read-back", size, usage: vk::BufferUsageFlags::TRANSFER_DST };
    let pixels = Buffer::new(device, desc, MemoryUse::Readback)?;
    let mut slot = FrameSlot::new(device);

    let arena = Arena::new();
    let draws = passes::draws(
        &arena,
        Placed::at_home(scene),
        (camera, DepthRange::default()),
        settings,
        &headless.renderer.limits,
    );
    let draws: Vec<_> = draws.collect();
    // Two sets that fragments read, with the kernel, and one of sums: with stand-ins where nothing is read.
    let room = PoolSizes {
        sets: 3,
        uniform_buffers: 3,
        images: 2 * 2 + 5,
        filtered_images: 2,
        ..PoolSizes::default()
    };
    // SAFETY: the slot is new.
    unsafe { slot.begin(Needs { room, ..Needs::default() }, None) }?;
    let SlotParts { descriptors, execution, .. } = slot.parts()?;
    let shaders = &headless.renderer.shaders;
    let inputs =
        Inputs { draws: &draws, ..Inputs::new(camera, settings, Place::Device(shaders, descriptors)) };
    let arena = Arena::new();
    let mut graph = Graph::new(&arena);
    let target = drawn.target();
    let desc = ImageDesc { format, extent: target.extent };
    let mut image = graph.import_image("target", desc, target.initial, None);
    paper_frame(&mut graph, inputs, &mut image, format, filtered)?;
    let mut buffer = import_readback(&mut graph, "target", format, target.extent);
    let imports = [
        (image.id(), Physical::Image(target.image, target.view)),
        (buffer.id(), Physical::Buffer(pixels.raw())),
    ];
    passes::readback(
        &mut graph,
        inputs.source,
        "read back target",
        &image,
        (format, target.extent),
        &mut buffer,
    );
    submit_and_wait(headless, |commands| {
        // SAFETY: recording; all that is used is alive until the wait.
        unsafe {
            shaders.begin_frame(commands)?;
            execution.record(commands, &graph, &imports).map(drop)
        }
    })?;
    // SAFETY: waited for.
    Ok(unsafe { pixels.bytes() }.chunks_exact(16).map(bytemuck::pod_read_unaligned).collect())
}
