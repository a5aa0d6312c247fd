//! The pipelines that lay a frame over what a host has drawn.

use ash::vk;

use crate::{
    passes::pipeline::key::{GraphicsKey, Layout},
    shaders::{self, config::*},
    vk::{Attachments, Blend},
};

/// What the host's rendering is, within which a view is drawn: as in `VkPipelineRenderingCreateInfo`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rendering {
    /// The formats of its color attachments.
    pub color_formats: Vec<vk::Format>,
    /// Which of them is drawn to; the others are left as they are.
    pub color: usize,
    /// The format of its depth attachment; `UNDEFINED`: there is none, and all of the view is drawn.
    pub depth_format: vk::Format,
    /// The format of its stencil attachment, which is left as it is.
    pub stencil_format: vk::Format,
    /// Samples of a pixel. All samples of one get the same.
    pub samples: vk::SampleCountFlags,
    /// How depths are compared: `LESS` or, where depth is reversed, `GREATER`.
    pub compare: vk::CompareOp,
    /// Colors are encoded as sRGB before they are blended: for hosts that keep encoded colors in `UNORM` formats. Linear light is for all
    /// others: sRGB formats encode by themselves, and float formats keep it.
    pub encodes: bool,
}

impl Default for Rendering {
    /// One color attachment of linear halves, a reversed depth of 32 bits, one sample.
    fn default() -> Self {
        Self {
            color_formats: vec![vk::Format::R16G16B16A16_SFLOAT],
            color: 0,
            depth_format: vk::Format::D32_SFLOAT,
            stencil_format: vk::Format::UNDEFINED,
            samples: vk::SampleCountFlags::TYPE_1,
            compare: vk::CompareOp::GREATER,
            encodes: false,
        }
    }
}

/// What a draw lays over the host's picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// What covers half of a pixel or more: tested, and its depth written.
    Covering,
    /// What covers less, at edges: tested.
    CoveringLess,
    /// Transparent layers, which are tested already.
    Layers,
}

impl Rendering {
    /// The format in which light is brought to the host's: as exact as that.
    pub(super) fn surface_format(&self) -> vk::Format {
        match self.color_formats.get(self.color) {
            Some(&vk::Format::R32G32B32A32_SFLOAT) => vk::Format::R32G32B32A32_SFLOAT,
            _ => vk::Format::R16G16B16A16_SFLOAT,
        }
    }

    pub(super) fn has_depth(&self) -> bool {
        self.depth_format != vk::Format::UNDEFINED
    }

    /// The pipeline of a part.
    pub(super) fn key(&self, part: Part) -> GraphicsKey {
        let of_surface = part != Part::Layers;
        let constants = vec![
            (SPEC_WITH_DEPTH, u32::from(of_surface)),
            (SPEC_COVERS_LESS, u32::from(part == Part::CoveringLess)),
            (SPEC_ENCODED, u32::from(self.encodes)),
        ];
        let compare = if of_surface { self.compare } else { vk::CompareOp::ALWAYS };
        GraphicsKey {
            color_formats: self.color_formats.clone(),
            blend: Blend::Over,
            depth: self.has_depth().then_some((compare, part == Part::Covering)),
            depth_format: self.depth_format,
            attachments: Attachments {
                samples: self.samples,
                stencil_format: self.stencil_format,
                written: Some(self.color),
            },
            ..GraphicsKey::fullscreen(&shaders::HOST_OVER_FRAG, Layout::Host, constants)
        }
    }
}
