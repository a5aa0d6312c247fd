//! The pipelines that lay a frame over what a host has drawn.

use ash::vk;

use crate::{
    error::{Error, Result},
    graph::aspect_of,
    passes::pipeline::key::{GraphicsKey, Layout},
    shaders::{self, Shader, config::*},
    vk::{Attachments, Blend, DEPTH_FORMATS, Device, can, check_color},
};

/// What the host's rendering is, within which a view is drawn: as in `VkPipelineRenderingCreateInfo`.
///
/// ```no_run
/// use surfel::{ash::vk, embed::{Renderer, Rendering, View}};
///
/// /// A picture with numbers of objects, tested by a depth that is not reversed; and a map of shadows.
/// fn views(renderer: &Renderer) -> surfel::Result<[View; 2]> {
///     let compare = vk::CompareOp::LESS;
///     let color_formats = vec![vk::Format::R8G8B8A8_SRGB, vk::Format::R32_UINT];
///     let picture = Rendering { color_formats, ids: true, compare, ..Rendering::default() };
///     let shadows = Rendering { color_formats: Vec::new(), compare, ..Rendering::default() };
///     Ok([View::new(renderer, &picture)?, View::new(renderer, &shadows)?])
/// }
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rendering {
    /// The formats of its color attachments. The first, one of [`crate::embed::Requirements::color_formats`], is drawn to, then come those of [`Self::ids`] and [`Self::motion`]; the others are left as they are. For more than
    /// one the device needs `independentBlend`. None: depth alone is drawn, as for a map of shadows, of what is opaque.
    pub color_formats: Vec<vk::Format>,
    /// The format of its depth attachment, one of [`crate::embed::Requirements::depth_formats`]; `UNDEFINED`: there is none, and all of the view is drawn.
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
    /// The second color attachment, `R32_UINT` or `R16_UINT`, gets [`crate::prepare::Placed::id`] of what is seen, wherever depth is written: of all that covers a pixel
    /// the number of what is nearest to that depth. [`NO_ID`] where a cut leaves it open. Transparent layers leave it as it is.
    pub ids: bool,
    /// The second color attachment, or the third with `ids`, `R16G16_SFLOAT` or `R32G32_SFLOAT`, gets motion alike: where in the picture the point that is seen is now
    /// less where it was in the frame before, in pixels, x to the right and y down; 0 of what was behind the eye. By the cameras as they are given: what they are
    /// jittered by is in it.
    pub motion: bool,
}

/// The number of no object.
pub const NO_ID: u32 = u32::MAX;

impl Default for Rendering {
    /// One color attachment of linear halves, a reversed depth of 32 bits, one sample.
    fn default() -> Self {
        Self {
            color_formats: vec![vk::Format::R16G16B16A16_SFLOAT],
            depth_format: vk::Format::D32_SFLOAT,
            stencil_format: vk::Format::UNDEFINED,
            samples: vk::SampleCountFlags::TYPE_1,
            compare: vk::CompareOp::GREATER,
            encodes: false,
            ids: false,
            motion: false,
        }
    }
}

/// What a draw lays over the host's picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// What covers half of a pixel or more: tested, and its depth written, with numbers and motion.
    Covering,
    /// What covers less, at edges: tested.
    CoveringLess,
    /// Transparent layers, which are tested already.
    Layers,
}

impl Rendering {
    /// The format in which light is brought to the host's: as exact as that.
    pub(super) fn surface_format(&self) -> vk::Format {
        match self.color_formats.first() {
            Some(&vk::Format::R32G32B32A32_SFLOAT) => vk::Format::R32G32B32A32_SFLOAT,
            _ => vk::Format::R16G16B16A16_SFLOAT,
        }
    }

    /// Whether light is drawn; else depth alone is, and what writes none is left out.
    pub(super) fn has_color(&self) -> bool {
        !self.color_formats.is_empty()
    }

    /// What a view draws at most.
    pub(super) fn parts(&self) -> &'static [Part] {
        if self.has_color() { &[Part::Covering, Part::CoveringLess, Part::Layers] } else { &[Part::Covering] }
    }

    pub(super) fn has_depth(&self) -> bool {
        self.depth_format != vk::Format::UNDEFINED
    }

    /// Refuses what no pipeline of this device can be drawn within.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`].
    pub(super) fn check(&self, device: &Device) -> Result<()> {
        let refused = |what: &str, problem: String| Err(Error::option(what, problem));
        let (instance, physical) = (device.instance().raw(), device.physical());
        // SAFETY: the device's own, which are alive.
        let limits = unsafe { instance.get_physical_device_properties(physical) }.limits;
        let can = |format: vk::Format, use_: vk::FormatFeatureFlags| can(device, format, use_);
        let first = self.color_formats.first().copied().unwrap_or_default();
        if !self.has_color() && !self.has_depth() {
            return refused(
                "color_formats",
                "there is neither color nor depth: expected one of them".to_owned(),
            );
        }
        if self.has_color() {
            check_color(device, "color_formats", first)?;
        }
        let others = self.color_formats.get(1 + self.written_beside()..).unwrap_or_default();
        self.check_written_beside(&can)?;
        if let Some(format) = others.iter().find(|format| {
            **format != vk::Format::UNDEFINED && !can(**format, vk::FormatFeatureFlags::COLOR_ATTACHMENT)
        }) {
            return refused("color_formats", format!("{format:?}: expected formats of color attachments"));
        }
        let most = if device.facts().independent_blend { limits.max_color_attachments.min(8) } else { 1 };
        if self.color_formats.len() > most as usize {
            let problem = format!(
                "{}: expected at most {most} on this device, as it was created",
                self.color_formats.len()
            );
            return refused("color_formats", problem);
        }
        let stencil = aspect_of(self.stencil_format);
        let attached = vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT;
        let is_depth = DEPTH_FORMATS.contains(&self.depth_format) && can(self.depth_format, attached);
        if self.has_depth() && !is_depth {
            return refused(
                "depth_format",
                format!("{:?}: expected one of {DEPTH_FORMATS:?} that the device has", self.depth_format),
            );
        }
        let has_stencil = self.stencil_format != vk::Format::UNDEFINED;
        let is_stencil =
            stencil.contains(vk::ImageAspectFlags::STENCIL) && can(self.stencil_format, attached);
        if has_stencil && !(is_stencil && (!self.has_depth() || self.stencil_format == self.depth_format)) {
            let problem = format!("{:?}: expected a stencil, and the format of depth", self.stencil_format);
            return refused("stencil_format", problem);
        }
        let mut counts = limits.framebuffer_color_sample_counts;
        if self.has_depth() {
            counts &= limits.framebuffer_depth_sample_counts;
        }
        if self.samples.as_raw().count_ones() != 1 || !counts.contains(self.samples) {
            return refused("samples", format!("{:?}: expected one of {counts:?}", self.samples));
        }
        match self.has_depth() && self.nearer_is_greater().is_none() {
            true => refused(
                "compare",
                format!("{:?}: expected LESS, LESS_OR_EQUAL, GREATER or GREATER_OR_EQUAL", self.compare),
            ),
            false => Ok(()),
        }
    }

    /// Whether it is found whose the surface is.
    pub(super) fn wants_objects(&self) -> bool {
        self.ids || self.motion
    }

    /// How many attachments are written beside the first.
    fn written_beside(&self) -> usize {
        usize::from(self.ids) + usize::from(self.motion)
    }

    fn check_written_beside(&self, can: &dyn Fn(vk::Format, vk::FormatFeatureFlags) -> bool) -> Result<()> {
        use vk::Format as F;
        let wanted = [
            (self.ids, 1, "ids", [F::R32_UINT, F::R16_UINT]),
            (self.motion, self.written_beside(), "motion", [F::R16G16_SFLOAT, F::R32G32_SFLOAT]),
        ];
        for (_, place, name, formats) in wanted.into_iter().filter(|(asked, ..)| *asked) {
            let given = self.color_formats.get(place).copied().unwrap_or_default();
            if !formats.contains(&given) || !can(given, vk::FormatFeatureFlags::COLOR_ATTACHMENT) {
                let problem = format!("color attachment {place} is {given:?}: expected one of {formats:?}");
                return Err(Error::option(name, problem));
            }
        }
        Ok(())
    }

    /// Whether what is nearer has the greater depth; `None` of a comparison that tells no order.
    pub(super) fn nearer_is_greater(&self) -> Option<bool> {
        match self.compare {
            vk::CompareOp::GREATER | vk::CompareOp::GREATER_OR_EQUAL => Some(true),
            vk::CompareOp::LESS | vk::CompareOp::LESS_OR_EQUAL => Some(false),
            _ => None,
        }
    }

    /// The pipeline of a part.
    pub(super) fn key(&self, part: Part) -> GraphicsKey {
        let of_surface = part != Part::Layers;
        let constants = [
            (SPEC_WITH_DEPTH, u32::from(of_surface)),
            (SPEC_COVERS_LESS, u32::from(part == Part::CoveringLess)),
            (SPEC_ENCODED, u32::from(self.encodes)),
        ]
        .into();
        let compare = if of_surface { self.compare } else { vk::CompareOp::ALWAYS };
        let shader: &'static Shader = match (part, self.ids, self.motion) {
            (Part::Covering, true, true) => &shaders::HOST_OVER_IDS_MOTION_FRAG,
            (Part::Covering, true, false) => &shaders::HOST_OVER_IDS_FRAG,
            (Part::Covering, false, true) => &shaders::HOST_OVER_MOTION_FRAG,
            _ => &shaders::HOST_OVER_FRAG,
        };
        GraphicsKey {
            color_formats: self.color_formats.iter().copied().collect(),
            blend: Blend::Over,
            depth: self.has_depth().then_some((compare, part == Part::Covering)),
            depth_format: self.depth_format,
            attachments: Attachments {
                samples: self.samples,
                stencil_format: self.stencil_format,
                beside_first: Some(if part == Part::Covering { self.written_beside() as u32 } else { 0 }),
            },
            ..GraphicsKey::fullscreen(shader, Layout::Host, constants)
        }
    }
}
