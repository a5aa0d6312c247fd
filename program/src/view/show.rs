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
    /// Nothing new is: the pipeline of pictures that are not of the window's size runs, too, so that the first one that moves finds it compiled.
    pub is_ahead: bool,
}

/// A picture that was drawn.
#[derive(Clone, Copy)]
pub struct Shot {
    /// A view of it.
    pub view: vk::ImageView,
    /// Width and height.
    pub size_px: [u32; 2],
}

/// The pipelines, made when they are first needed.
pub struct Show {
    device: Device,
    format: vk::Format,
    set: SetLayout,
    layout: PipelineLayout,
    made: Vec<(Constants, GraphicsPipeline)>,
}

/// Specialization constants by their id.
type Constants = [(u32, u32); 4];

/// `Show` of `glsl/view_show.frag.glsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Pushed {
    background: [f32; 4],
    window_px: [i32; 2],
    split_px: f32,
    exposure: f32,
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

    /// For windows of a format.
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub fn new(device: &Device, format: vk::Format) -> Result<Self> {
        let stages = vk::ShaderStageFlags::FRAGMENT;
        let binding = Binding { kind: vk::DescriptorType::COMBINED_IMAGE_SAMPLER, stages };
        let set = SetLayout::new(device, "pictures of a window", &[binding; 2])?;
        let bytes = size_of::<Pushed>() as u32;
        let layout = PipelineLayout::new(device, "window", &[&set], bytes, stages)?;
        Ok(Self { device: device.clone(), format, set, layout, made: Vec::new() })
    }

    fn pipeline(&mut self, cache: &PipelineCache, constants: Constants) -> Result<vk::Pipeline> {
        if let Some((_, made)) = self.made.iter().find(|(own, _)| *own == constants) {
            return Ok(made.raw());
        }
        let stage = |shader: &'static shaders::Shader, constants| Stage {
            name: shader.name,
            spirv: shader.spirv(),
            constants,
        };
        // SAFETY: shaders of `glsl/` with their layout; every device draws into the formats of windows that it has.
        let pipeline = unsafe {
            GraphicsPipeline::new(
                &self.device,
                cache,
                &GraphicsPipelineDesc {
                    name: "window",
                    vertex: stage(&shaders::FULLSCREEN_VERT, &[]),
                    fragment: stage(&shaders::VIEW_SHOW_FRAG, &constants),
                    topology: vk::PrimitiveTopology::TRIANGLE_LIST,
                    cull_clockwise: false,
                    color_formats: &[self.format],
                    blend: Blend::Replace,
                    depth: None,
                    attachments: surfel::vk::Attachments::default(),
                    layout: &self.layout,
                },
            )
        }?;
        let raw = pipeline.raw();
        self.made.push((constants, pipeline));
        Ok(raw)
    }

    /// Records the draw. `pictures`: two, which may be the same.
    ///
    /// # Safety
    /// `commands` is recording inside of rendering to a color attachment of this format, with viewport and scissor set; the views are of images that are in the layout `READ_ONLY_OPTIMAL` and that fragments may sample, alive until the commands have run;
    /// `pool` has [`Self::ROOM`].
    ///
    /// # Errors
    /// Whatever the driver answers.
    pub unsafe fn record(
        &mut self,
        commands: vk::CommandBuffer,
        (cache, pool): (&PipelineCache, &DescriptorPool),
        pictures: [Shot; 2],
        desc: &ShowDesc,
    ) -> Result<()> {
        let sampled = |view| Descriptor::Sampled(view, vk::ImageLayout::READ_ONLY_OPTIMAL);
        let given = [(0, sampled(pictures[0].view)), (1, sampled(pictures[1].view))];
        // SAFETY: this function's contract: pictures of this device that live as long as the frame.
        let set = unsafe { pool.set(&self.set, &given) }?;
        let fits = pictures.iter().all(|picture| picture.size_px == desc.window_px);
        let pushed = desc.pushed();
        for fits in (desc.is_ahead && fits).then_some(false).into_iter().chain([fits]) {
            let pipeline = self.pipeline(cache, desc.constants(fits))?;
            let raw = self.device.raw();
            // SAFETY: this function's contract; set and constants are of the pipeline's layout.
            unsafe {
                raw.cmd_bind_pipeline(commands, vk::PipelineBindPoint::GRAPHICS, pipeline);
                let point = vk::PipelineBindPoint::GRAPHICS;
                raw.cmd_bind_descriptor_sets(commands, point, self.layout.raw(), 0, &[set], &[]);
                let bytes = bytemuck::bytes_of(&pushed);
                raw.cmd_push_constants(commands, self.layout.raw(), self.layout.push_stages(), 0, bytes);
                raw.cmd_draw(commands, 3, 1, 0, 0);
            }
        }
        Ok(())
    }
}

impl ShowDesc {
    fn constants(&self, fits: bool) -> Constants {
        let mode = match self.shown {
            Shown::One => 0,
            Shown::Both(_) => 1,
            Shown::Difference => 2,
        };
        let curve = match self.light.unwrap_or_default().tonemap {
            Tonemap::None => 0,
            Tonemap::Aces => 1,
            Tonemap::Agx => 2,
        };
        [(0, mode), (1, fits.into()), (2, self.light.is_some().into()), (3, curve)]
    }

    fn pushed(&self) -> Pushed {
        let [red, green, blue] = self.background.unwrap_or_default().map(linear_from_srgb);
        Pushed {
            background: [red, green, blue, 1.0],
            window_px: self.window_px.map(|side| side as i32),
            split_px: if let Shown::Both(split_px) = self.shown { split_px.floor() } else { 0.0 },
            exposure: self.light.unwrap_or_default().exposure.0.exp2() as f32,
        }
    }
}
