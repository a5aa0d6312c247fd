//! What is recorded of a frame in parts, and the buffers of each stage.

use ash::vk;

use crate::{frame::Target, renderer::Readbacks};

/// A stage of a frame in parts: of opaque splats `See`, `Sum`; of transparent ones, layer by layer until one is empty, `SeeLayer`, `SumLayer` and
/// `Compose`, the last layer `SumRest` and `Compose` where settings want the rest in it; then `Shade`. Buffers have a value for each pixel, rows without
/// padding, top row first; usage `TRANSFER_DST` where a stage leaves something in them, `TRANSFER_SRC` where it reads them. No stage reads a buffer
/// that it leaves something in.
#[derive(Clone, Copy)]
pub enum Stage<'t> {
    /// What is seen of a part.
    See {
        /// Is left here: an f32 a pixel, near / z of the nearest surface, moved away from the eye by ε; 0 where there is none. That of all
        /// parts is the largest.
        depth: vk::Buffer,
    },
    /// What is summed of a part.
    Sum {
        /// That of all parts.
        depth: vk::Buffer,
        /// Are left here, four f32 a pixel each: Σ weight · linear albedo, Σ weight; Σ weight · normal in view space, and with `with_depth`
        /// Σ weight · z / z_visible. Those of all parts are their sums.
        sums: [vk::Buffer; 2],
        /// Depth is summed, too: for the surface as data, and for eye-dome lighting.
        with_depth: bool,
    },
    /// What is seen of a transparent layer of a part.
    SeeLayer {
        /// What of all parts lies around it.
        around: Around,
        /// Is left here, as of `See`, but at least the depth of opaque things. That of all parts is the largest.
        depth: vk::Buffer,
    },
    /// What is summed of a transparent layer of a part.
    SumLayer {
        /// What of all parts lies around it.
        around: Around,
        /// Its depth in all parts.
        depth: vk::Buffer,
        /// Are left here, as of `Sum`, with Σ weight · alpha in place of Σ weight · z / z_visible. Those of all parts are their sums.
        sums: [vk::Buffer; 2],
    },
    /// What is summed of all that lies behind the layer before, for the last one.
    SumRest {
        /// What of all parts lies around it.
        around: Around,
        /// Are left here, four f32 a pixel and one: Σ weight · alpha · lit color, Σ weight · alpha; Σ weight. Those of all parts are their sums.
        sums: [vk::Buffer; 2],
    },
    /// A layer of all parts, shaded, under those before it.
    Compose {
        /// Its sums.
        layer: PartLayer,
        /// Those before it, as this stage has left them; none before the first.
        before: Option<vk::Buffer>,
        /// Is left here, four f32 a pixel: linear light times alpha, alpha.
        composed: vk::Buffer,
    },
    /// The picture of all parts.
    Shade {
        /// Their depth.
        depth: vk::Buffer,
        /// Their sums.
        sums: [vk::Buffer; 2],
        /// Their transparent layers, as `Compose` has left them, where there are any.
        layers: Option<vk::Buffer>,
        /// As for [`crate::renderer::Renderer::record`].
        target: &'t Target,
        /// As for [`crate::renderer::Renderer::record`], without samples.
        readbacks: Readbacks,
    },
}

/// What of all parts lies around a transparent layer.
#[derive(Clone, Copy)]
pub struct Around {
    /// The depth of opaque splats, where there are any.
    pub opaque: Option<vk::Buffer>,
    /// That of the layer before; none for the first.
    pub before: Option<vk::Buffer>,
}

/// The sums of a transparent layer of all parts.
#[derive(Clone, Copy)]
pub enum PartLayer {
    /// Of [`Stage::SumLayer`].
    Surface([vk::Buffer; 2]),
    /// Of [`Stage::SumRest`]; the first ones of [`Stage::SumLayer`] of the layer before, where its weights are to count surfaces.
    Rest([vk::Buffer; 2], Option<vk::Buffer>),
}

impl Stage<'_> {
    /// Whether it is about transparent layers alone.
    pub(super) fn is_of_layers(&self) -> bool {
        !matches!(self, Self::See { .. } | Self::Sum { .. } | Self::Shade { .. })
    }
}
