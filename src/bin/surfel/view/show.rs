//! The pass that brings a drawn picture to a window.

use ash::vk;
use bytemuck::{Pod, Zeroable};
use surfel::{
    Result,
    math::srgb::linear_from_srgb,
    scene::{Encoding, Tonemap},
    shaders,
    vk::{
        Binding, Blend, Descriptor, DescriptorPool, Device, GraphicsPipeline, GraphicsPipelineDesc,
        PipelineCache, PipelineLayout, PoolSizes, SetLayout, Stage,
    },
};

/// How two pictures are shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shown {
    /// The first alone.
    One,
    /// The first to the left of a column, the second to its right.
    Both(f32),
    /// How far they differ.
    Difference,
}

/// What the pass does with the pictures.
#[derive(Clone, Copy, Debug)]
pub struct ShowDesc {
    /// Width and height of the window.
    pub window_px: [u32; 2],
    /// How light becomes colors, where the pictures are light.
    pub light: Option<Encoding>,
    /// What is empty in light, sRGB.
    pub background: Option<[f32; 3]>,
    /// How they are shown.
    pub shown: Shown,
}

/// The pipeline.
pub struct Show {
    device: Device,
    set: SetLayout,
    layout: PipelineLayout,
    pipeline: GraphicsPipeline,
}

/// `Show` of `glsl/view_show.frag.glsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Constants {
    background: [f32; 4],
    window_px: [i32; 2],
    split_px: f32,
    mode: u32,
    exposure: f32,
    curve: u32,
    is_light: u32,
}

impl Show {
    /// What a set of it takes from a pool.
    pub const ROOM: PoolSizes = PoolSizes {
        sets: 1,
        buffers: 0,
        uniform_buffers: 0,
        texel_buffers: 0,
        images: 0,
        filtered_images: 2,
        storage_images: 0,
    };

    /// The pipeline for windows of a format.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, cache: &PipelineCache, format: vk::Format) -> Result<Self> {
        let stages = vk::ShaderStageFlags::FRAGMENT;
        let binding = Binding { kind: vk::DescriptorType::COMBINED_IMAGE_SAMPLER, stages };
        let set = SetLayout::new(device, "pictures of a window", &[binding; 2])?;
        let bytes = size_of::<Constants>() as u32;
        let layout = PipelineLayout::new(device, "window", &[&set], bytes, stages)?;
        let stage = |shader: &'static shaders::Shader| Stage {
            name: shader.name,
            spirv: shader.spirv(),
            constants: &[],
        };
        let pipeline = GraphicsPipeline::new(
            device,
            cache,
            &GraphicsPipelineDesc {
                name: "window",
                vertex: stage(&shaders::FULLSCREEN_VERT),
                fragment: stage(&shaders::VIEW_SHOW_FRAG),
                topology: vk::PrimitiveTopology::TRIANGLE_LIST,
                cull_clockwise: false,
                color_formats: &[format],
                blend: Blend::Replace,
                depth: None,
                layout: &layout,
            },
        )?;
        Ok(Self { device: device.clone(), set, layout, pipeline })
    }

    /// Records the draw. `pictures`: two views, which may be the same.
    ///
    /// # Safety
    /// `commands` is recording inside of rendering to a color attachment of the pipeline's format, with viewport and scissor set; the
    /// views are of images that are in the layout `READ_ONLY_OPTIMAL` and that fragments may sample, alive until the commands have run;
    /// `pool` has [`Self::ROOM`].
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub unsafe fn record(
        &self,
        commands: vk::CommandBuffer,
        pool: &DescriptorPool,
        pictures: [vk::ImageView; 2],
        desc: &ShowDesc,
    ) -> Result<()> {
        let sampled = |view| Descriptor::Sampled(view, vk::ImageLayout::READ_ONLY_OPTIMAL);
        let set = pool.set(&self.set, &[(0, sampled(pictures[0])), (1, sampled(pictures[1]))])?;
        let constants = desc.constants();
        let raw = self.device.raw();
        // SAFETY: this function's contract; set and constants are of the pipeline's layout.
        unsafe {
            raw.cmd_bind_pipeline(commands, vk::PipelineBindPoint::GRAPHICS, self.pipeline.raw());
            let point = vk::PipelineBindPoint::GRAPHICS;
            raw.cmd_bind_descriptor_sets(commands, point, self.layout.raw(), 0, &[set], &[]);
            let bytes = bytemuck::bytes_of(&constants);
            raw.cmd_push_constants(commands, self.layout.raw(), self.layout.push_stages(), 0, bytes);
            raw.cmd_draw(commands, 3, 1, 0, 0);
        }
        Ok(())
    }
}

impl ShowDesc {
    fn constants(&self) -> Constants {
        let [red, green, blue] = self.background.unwrap_or_default().map(linear_from_srgb);
        let encoding = self.light.unwrap_or_default();
        let (mode, split_px) = match self.shown {
            Shown::One => (0, 0.0),
            Shown::Both(split_px) => (1, split_px.floor()),
            Shown::Difference => (2, 0.0),
        };
        Constants {
            background: [red, green, blue, 1.0],
            window_px: self.window_px.map(|side| side as i32),
            split_px,
            mode,
            exposure: encoding.exposure.0.exp2() as f32,
            curve: match encoding.tonemap {
                Tonemap::None => 0,
                Tonemap::Aces => 1,
                Tonemap::Agx => 2,
            },
            is_light: self.light.is_some().into(),
        }
    }
}
