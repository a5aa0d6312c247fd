//! One frame of a scene: what is seen, and what it is drawn to.

#[cfg(feature = "inside")]
use std::sync::Arc;

use ash::vk;

#[cfg(feature = "inside")]
use super::Renderer;
#[cfg(feature = "inside")]
use crate::{error::Result, frame::FrameSlot, graph::Plan};
use crate::{
    frame::Target,
    graph::execute::Profile,
    prepare::PreparedScene,
    scene::{Camera, Settings},
};

/// A scene as a camera sees it.
#[derive(Clone, Copy)]
pub struct Seen<'a> {
    /// What.
    pub scene: &'a PreparedScene,
    /// From where.
    pub camera: &'a Camera,
    /// How.
    pub settings: &'a Settings,
}

/// A frame of one scene, for [`super::Renderer::record`].
#[derive(Clone, Copy)]
pub struct SceneFrame<'a> {
    /// What is seen.
    pub seen: Seen<'a>,
    /// What it is drawn to.
    pub target: &'a Target,
    /// What it is copied to.
    pub readbacks: Readbacks,
    /// Each pass is timed, for [`crate::frame::FrameSlot::profiler`].
    pub profile: Option<Profile>,
}

#[cfg(feature = "inside")]
impl Renderer {
    /// Records one frame. Returns the plan that was recorded.
    ///
    /// # Errors
    /// As [`Renderer::check`], and whatever driver or allocator answer.
    ///
    /// # Safety
    /// `commands` must be a primary command buffer, recording, outside of rendering, without an active occlusion query (and,
    /// profiled by counts, statistics query), and be submitted to the device's queue. The scene, the
    /// target, the buffers of `readbacks`, the slot and the renderer must stay alive until it has run; the frame
    /// recorded before in this slot must have finished. The target is what it says and in its initial state; the host
    /// may read `readbacks` after its own wait.
    pub unsafe fn record(
        &self,
        commands: vk::CommandBuffer,
        slot: &mut FrameSlot,
        frame: &SceneFrame<'_>,
    ) -> Result<Arc<Plan>> {
        // SAFETY: this function's contract.
        unsafe { self.record_frame(commands, slot, frame) }
    }
}

impl<'a> SceneFrame<'a> {
    /// A frame that is copied to nothing and not timed.
    pub fn new(seen: Seen<'a>, target: &'a Target) -> Self {
        Self { seen, target, readbacks: Readbacks::default(), profile: None }
    }
}

/// Buffers that the frame is copied to, for the host to read: rows without padding, top row first. `Some` asks for
/// it. The surface's four images come together or not at all.
#[derive(Clone, Copy, Default)]
pub struct Readbacks {
    /// The target's pixels, in its format.
    pub target: Option<vk::Buffer>,
    /// Weight (R32F), albedo (RGBA32F), normal (RGBA32F), depth (R32F), as [`crate::passes::Exported`] has them.
    pub surface: Option<[vk::Buffer; 4]>,
    /// The frame is one of several samples of a picture ([`crate::scene::Samples`]).
    pub sample: Option<SampleSum>,
}

/// Where the samples of a picture are added up, for frames each of which is one of them: its camera is [`Camera::sample`], its settings say
/// how many there are. The target is written with the last one; before, neither it nor buffers are touched.
#[derive(Clone, Copy, Debug)]
pub struct SampleSum {
    /// An image of the target's size, R32G32B32A32_SFLOAT, that may be a color attachment and sampled.
    pub image: vk::Image,
    /// A view of all of it.
    pub view: vk::ImageView,
    /// Whether this is the first sample: nothing is in it yet.
    pub first: bool,
    /// Whether this is the last one.
    pub last: bool,
}
