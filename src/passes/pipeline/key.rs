//! All that a pipeline is made of: two passes with equal keys share one.

use ash::vk;

use crate::passes::pipeline::{formats::DEPTH_FORMAT, splat_shaders::Stages, variant::Constants};
use crate::{
    inline_vec::InlineVec,
    shaders::{self, Shader},
    vk::{Attachments, Blend},
};

/// One of the layouts that pipelines share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Layout {
    Splat,
    List,
    Finalize,
    Host,
    DepthCells,
    Record,
    Tile,
    TileQuads,
}

impl Layout {
    /// Whether its sets have a place for the planes that cut what is seen.
    pub fn has_planes(self) -> bool {
        matches!(self, Self::Splat | Self::List | Self::Record | Self::Tile)
    }

    /// Whether they have one for the tints of chunks.
    pub fn has_tints(self) -> bool {
        matches!(self, Self::Splat | Self::Record)
    }
}

/// The formats of color attachments: Vulkan has 8 at most wherever it is asked.
pub(crate) type ColorFormats = InlineVec<vk::Format, 8>;

/// All that a graphics pipeline is made of.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct GraphicsKey {
    pub vertex: &'static Shader,
    pub fragment: &'static Shader,
    pub layout: Layout,
    pub constants: Constants,
    pub topology: vk::PrimitiveTopology,
    /// Polygons that face away are not drawn.
    pub cull_clockwise: bool,
    pub color_formats: ColorFormats,
    pub blend: Blend,
    /// The depth test: the comparison and whether it writes.
    pub depth: Option<(vk::CompareOp, bool)>,
    /// The format of what is tested.
    pub depth_format: vk::Format,
    /// The rest of what it draws to.
    pub attachments: Attachments,
}

/// All that a compute pipeline is made of.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct ComputeKey {
    pub shader: &'static Shader,
    pub layout: Layout,
    pub constants: Constants,
}

impl GraphicsKey {
    /// A triangle over the whole target without blending and depth: to be completed.
    pub fn fullscreen(fragment: &'static Shader, layout: Layout, constants: Constants) -> Self {
        let stages = (&shaders::FULLSCREEN_VERT, fragment);
        Self::new(stages, layout, vk::PrimitiveTopology::TRIANGLE_LIST, constants)
    }

    /// Points, quads or triangles without color, blending and depth: to be completed.
    pub fn new(
        (vertex, fragment): Stages,
        layout: Layout,
        topology: vk::PrimitiveTopology,
        constants: Constants,
    ) -> Self {
        Self {
            vertex,
            fragment,
            layout,
            constants,
            topology,
            cull_clockwise: false,
            color_formats: ColorFormats::new(),
            blend: Blend::Replace,
            depth: None,
            depth_format: DEPTH_FORMAT,
            attachments: Attachments::default(),
        }
    }

    /// The names of its shaders.
    pub fn name(&self) -> String {
        format!("{} + {}", self.vertex.name, self.fragment.name)
    }
}
