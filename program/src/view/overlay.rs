//! The pass that draws what lies over the picture: triangles of egui. The crate `egui-ash-renderer` would do it with an allocator and
//! submissions of its own and objects without names; see DECISIONS.md.

use std::sync::Arc;

use ash::vk;
use bytemuck::{Pod, Zeroable};
use egui::{
    ClippedPrimitive, ImageData, TexturesDelta,
    epaint::{ImageDelta, Primitive},
};
use surfel::{
    Result, shaders,
    vk::{
        Binding, Blend, Buffer, BufferDesc, Descriptor, DescriptorPool, Device, GraphicsPipeline,
        GraphicsPipelineDesc, MemoryUse, PipelineCache, PipelineLayout, PoolSizes, SetLayout, Stage,
    },
};

/// The pipeline and the atlas of letters.
pub struct OverlayPass {
    device: Device,
    set: SetLayout,
    layout: PipelineLayout,
    pipeline: GraphicsPipeline,
    atlas: Atlas,
}

/// The one texture: egui's letters.
#[derive(Default)]
struct Atlas {
    size_px: [usize; 2],
    texels: Vec<u32>,
    /// `None` where it has changed since.
    buffer: Option<Arc<Buffer>>,
}

/// Triangles of a frame.
pub struct OverlayFrame {
    /// What egui made.
    pub primitives: Vec<ClippedPrimitive>,
    /// Pixels of a point.
    pub px_a_point: f32,
}

/// What a frame in flight keeps alive.
#[derive(Default)]
pub struct OverlayBuffers {
    vertices: Option<Buffer>,
    indices: Option<Buffer>,
    _atlas: Option<Arc<Buffer>>,
}

/// `Overlay` of `glsl/view_overlay.vert.glsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Constants {
    window_points: [f32; 2],
    atlas_px: [i32; 2],
}

impl OverlayPass {
    /// What a set of it takes from a pool.
    pub const ROOM: PoolSizes = PoolSizes {
        sets: 1,
        buffers: 3,
        uniform_buffers: 0,
        texel_buffers: 0,
        images: 0,
        filtered_images: 0,
        storage_images: 0,
    };

    /// The pipeline for windows of a format. `before`: the one for another format, whose letters it takes over.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(
        device: &Device,
        cache: &PipelineCache,
        format: vk::Format,
        before: Option<Self>,
    ) -> Result<Self> {
        let (vertex, fragment) = (vk::ShaderStageFlags::VERTEX, vk::ShaderStageFlags::FRAGMENT);
        let buffer = |stages| Binding { kind: vk::DescriptorType::STORAGE_BUFFER, stages };
        let set = SetLayout::new(device, "overlay", &[buffer(vertex), buffer(vertex), buffer(fragment)])?;
        let bytes = size_of::<Constants>() as u32;
        let layout = PipelineLayout::new(device, "overlay", &[&set], bytes, vertex | fragment)?;
        let stage = |shader: &'static shaders::Shader| Stage {
            name: shader.name,
            spirv: shader.spirv(),
            constants: &[],
        };
        // SAFETY: shaders of `glsl/` with their layout; every device draws into the formats of windows that it has.
        let pipeline = unsafe {
            GraphicsPipeline::new(
                device,
                cache,
                &GraphicsPipelineDesc {
                    name: "overlay",
                    vertex: stage(&shaders::VIEW_OVERLAY_VERT),
                    fragment: stage(&shaders::VIEW_OVERLAY_FRAG),
                    topology: vk::PrimitiveTopology::TRIANGLE_LIST,
                    cull_clockwise: false,
                    color_formats: &[format],
                    blend: Blend::Over,
                    depth: None,
                    attachments: surfel::vk::Attachments::default(),
                    layout: &layout,
                },
            )
        }?;
        Ok(Self {
            device: device.clone(),
            set,
            layout,
            pipeline,
            atlas: before.map(|before| before.atlas).unwrap_or_default(),
        })
    }

    /// Takes in what egui says of its textures; of those that are no atlas of letters there is none.
    pub fn update(&mut self, delta: &TexturesDelta) {
        for (_, image) in &delta.set {
            self.atlas.update(image);
        }
    }

    /// Records the draws.
    ///
    /// # Safety
    /// `commands` is recording inside of rendering to a color attachment of the pipeline's format and of this size; `buffers` are those of
    /// no unfinished submission, and stay until the commands have run, as this pass does; `pool` has [`Self::ROOM`].
    ///
    /// # Errors
    /// Whatever the driver or the allocator answers.
    pub unsafe fn record(
        &mut self,
        commands: vk::CommandBuffer,
        pool: &DescriptorPool,
        buffers: &mut OverlayBuffers,
        frame: &OverlayFrame,
        window_px: [u32; 2],
    ) -> Result<()> {
        let (vertices, indices, draws) = collect(frame, window_px);
        let Some(atlas) = self.atlas.buffer(&self.device)? else { return Ok(()) };
        if draws.is_empty() {
            return Ok(());
        }
        let filled = |slot: &mut Option<Buffer>, name, words: &[u32]| {
            // SAFETY: this function's contract.
            unsafe { fill(&self.device, slot, name, words) }
                .map(|buffer| Descriptor::Buffer(buffer.raw(), buffer.size()))
        };
        let of_vertices = filled(&mut buffers.vertices, "overlay vertices", &vertices)?;
        let of_indices = filled(&mut buffers.indices, "overlay indices", &indices)?;
        let of_atlas = Descriptor::Buffer(atlas.raw(), atlas.size());
        // SAFETY: storage buffers of this device; they are kept as long as the frame.
        let set = unsafe { pool.set(&self.set, &[(0, of_vertices), (1, of_indices), (2, of_atlas)]) }?;
        buffers._atlas = Some(atlas);
        let constants = Constants {
            window_points: window_px.map(|side| side as f32 / frame.px_a_point),
            atlas_px: self.atlas.size_px.map(|side| side as i32),
        };
        let raw = self.device.raw();
        // SAFETY: this function's contract; set and constants are of the pipeline's layout, and each range of indices was written just
        // now, as were the vertices that they name.
        unsafe {
            raw.cmd_bind_pipeline(commands, vk::PipelineBindPoint::GRAPHICS, self.pipeline.raw());
            let point = vk::PipelineBindPoint::GRAPHICS;
            raw.cmd_bind_descriptor_sets(commands, point, self.layout.raw(), 0, &[set], &[]);
            let bytes = bytemuck::bytes_of(&constants);
            raw.cmd_push_constants(commands, self.layout.raw(), self.layout.push_stages(), 0, bytes);
            for (scissor, first, count) in draws {
                raw.cmd_set_scissor(commands, 0, &[scissor]);
                raw.cmd_draw(commands, count, 1, first, 0);
            }
        }
        Ok(())
    }
}

/// A mesh: its part of the window, its first index and how many it has.
type MeshDraw = (vk::Rect2D, u32, u32);

/// Vertices and indices of all meshes as words.
fn collect(frame: &OverlayFrame, window_px: [u32; 2]) -> (Vec<u32>, Vec<u32>, Vec<MeshDraw>) {
    let (mut vertices, mut indices, mut draws) = (Vec::new(), Vec::new(), Vec::new());
    for primitive in &frame.primitives {
        let Primitive::Mesh(mesh) = &primitive.primitive else { continue };
        let begin = (vertices.len() / 5) as u32;
        let within = |at: f32, most: u32| (at * frame.px_a_point).round().clamp(0.0, most as f32) as i32;
        let clip = primitive.clip_rect;
        let [left, right] = [clip.min.x, clip.max.x].map(|x| within(x, window_px[0]));
        let [top, bottom] = [clip.min.y, clip.max.y].map(|y| within(y, window_px[1]));
        // An index beyond its vertices would read another mesh's.
        let is_whole = mesh.indices.iter().all(|index| (*index as usize) < mesh.vertices.len());
        if right <= left || bottom <= top || mesh.indices.is_empty() || !is_whole {
            continue;
        }
        let extent = vk::Extent2D { width: (right - left) as u32, height: (bottom - top) as u32 };
        let scissor = vk::Rect2D { offset: vk::Offset2D { x: left, y: top }, extent };
        draws.push((scissor, indices.len() as u32, mesh.indices.len() as u32));
        indices.extend(mesh.indices.iter().map(|index| begin + index));
        for vertex in &mesh.vertices {
            let floats = [vertex.pos.x, vertex.pos.y, vertex.uv.x, vertex.uv.y];
            vertices.extend(floats.map(f32::to_bits));
            vertices.push(u32::from_le_bytes(vertex.color.to_array()));
        }
    }
    (vertices, indices, draws)
}

/// Writes words to a buffer, to another one where this has no room for them.
///
/// # Safety
/// The frame has finished that read it last.
unsafe fn fill<'a>(
    device: &Device,
    slot: &'a mut Option<Buffer>,
    name: &str,
    words: &[u32],
) -> Result<&'a mut Buffer> {
    let bytes: &[u8] = bytemuck::cast_slice(words);
    let kept = slot.take().filter(|buffer| buffer.size() >= bytes.len() as u64);
    let buffer = match kept {
        Some(buffer) => slot.insert(buffer),
        None => {
            let size = (bytes.len() as u64).next_power_of_two().max(1 << 16);
            let desc = BufferDesc { name, size, usage: vk::BufferUsageFlags::STORAGE_BUFFER };
            slot.insert(Buffer::new(device, desc, MemoryUse::Upload)?)
        }
    };
    // SAFETY: this function's contract.
    if let Some(room) = unsafe { buffer.bytes_mut() }.get_mut(..bytes.len()) {
        room.copy_from_slice(bytes);
    }
    Ok(buffer)
}

impl Atlas {
    fn update(&mut self, delta: &ImageDelta) {
        let ImageData::Color(image) = &delta.image;
        let [width, height] = image.size;
        let [x, y] = match delta.pos {
            Some(corner) => corner,
            None => {
                self.size_px = image.size;
                self.texels = vec![0; width * height];
                [0, 0]
            }
        };
        for (row, pixels) in image.pixels.chunks_exact(width.max(1)).enumerate().take(height) {
            let begin = (y + row) * self.size_px[0] + x;
            if let Some(texels) = self.texels.get_mut(begin..begin + width) {
                for (texel, pixel) in texels.iter_mut().zip(pixels) {
                    *texel = u32::from_le_bytes(pixel.to_array());
                }
            }
        }
        self.buffer = None;
    }

    /// The atlas on the device; `None` before there is one.
    fn buffer(&mut self, device: &Device) -> Result<Option<Arc<Buffer>>> {
        if self.buffer.is_none() && !self.texels.is_empty() {
            let mut slot = None;
            // SAFETY: a new one.
            unsafe { fill(device, &mut slot, "overlay atlas", &self.texels) }?;
            self.buffer = slot.map(Arc::new);
        }
        Ok(self.buffer.clone())
    }
}
