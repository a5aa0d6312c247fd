//! Splats within an engine's own frame: the engine owns instance, device, queue, memory's lifetime, command buffers, images and submission; we record.
//!
//! 1. [`requirements`] says what a device must be created with; [`Device::import`] takes the device, and what was really enabled on it.
//! 2. [`Renderer::upload`] records the upload of a scene into the engine's commands.
//! 3. Each frame, [`View::prepare`] records all passes, outside of rendering, and [`View::draw`] one to three draws within the engine's own
//!    rendering: splats are hidden by what the engine has drawn and hide what it draws later, by the engine's own depth and its comparison.
//!    Or [`View::record`] does both, onto images of the engine's.
//! 4. [`Device::end_epoch`] at each submission, [`Device::epoch_done`] once the device has finished it: what was dropped goes then.
//!
//! `docs/embedding.md` tells all of it: state, threads, lifetimes.

mod ahead;
mod checks;
mod depth;
mod draw;
mod fields;
mod frame;
mod images;
mod measured;
mod motion;
mod needs;
mod onto;
mod over;
mod planned;
mod scenes;
mod table;
mod to;
mod under_way;
mod update;
mod view;

pub use crate::{
    frame::FrameSlot,
    graph::{
        ImageState,
        execute::{FrameProfile, PassCounts, PassFigures, PassProfile, Profile},
    },
    passes::{MissingPipelines, PickPlan, Picked, PickedPart},
    prepare::{DynamicBuffers, DynamicSplats, NO_TINT, Placed, PreparedScene, dynamic},
    renderer::Renderer,
    scene::{HostCamera, Placement},
    vk::{
        Device, Features, FeaturesApart, HostAllocation, HostMemory, Import, MemoryHeap, MemoryHeaps,
        MemoryInUse, MemoryNeeds, MemoryPiece, MemoryRequest, MemoryUse, Requirements, requirements,
    },
};
pub use frame::{DepthImage, ViewFrame};
pub use onto::HostImage;
pub use over::{NO_ID, Rendering};
pub use view::View;

/// The guide, whose code is to be pasted, compiles.
#[cfg(doctest)]
#[doc = include_str!("../../docs/embedding.md")]
struct Guide;
