//! A frame beside what a host draws itself: the host's depth comes in, and what the host lays over its own picture is left to it: the opaque
//! surface and its own depth, and the transparent layers.
//!
//! Two draws of the view's lay the surface over the host's picture (`host_over.frag.glsl`): what covers half of a pixel or more with its depth, what covers less
//! without. Layers are a third, hidden by the host's depth when they are drawn (`depth_in`). Where numbers of objects or motion are asked for, a pass finds whose the
//! surface is by its depth (`objects_out`), and the draw reads of that thing its number and how it has moved.

pub(crate) mod depth_in;
pub(crate) mod depth_out;
pub(crate) mod layers_out;
pub(crate) mod objects_out;

use ash::vk;

use crate::graph::{Handle, Image};

/// The format in which the depth of the opaque surface is left: w as `glsl/inc/projection.glsl` has it, 0 where there is nothing.
pub(crate) const SURFACE_DEPTH_FORMAT: vk::Format = vk::Format::R32_SFLOAT;

/// The format in which it is left whose the surface is: one more than the number of what is seen among the splats and meshes of the frame, 0 where there is
/// nothing.
pub(crate) const OBJECTS_FORMAT: vk::Format = vk::Format::R32_UINT;

/// What a host gives to a frame, and gets of it beside the opaque surface, which is the frame's target.
pub(crate) struct BesideHost<'h> {
    /// The depth of what the host has drawn, and how it follows from w; it hides transparent layers.
    pub hides: Option<(&'h Handle<Image>, HostDepth)>,
    /// Where the opaque surface's own depth is left.
    pub depth: &'h mut Handle<Image>,
    /// Where it is left whose the surface is, in frames that find it ([`crate::passes::FramePlan::with_objects`]).
    pub objects: Option<&'h mut Handle<Image>>,
    /// Where transparent layers are left, where there are any.
    pub layers: Option<&'h mut Handle<Image>>,
}

pub use crate::passes::pipeline::constants::HostDepth;
