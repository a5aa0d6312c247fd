//! Where frames go, and what lives as long as one is under way.

mod slot;
mod target;

pub use slot::FrameSlot;
pub(crate) use slot::{Execution, SlotParts, Written, planes_desc};
pub use target::{HeadlessTarget, Target};
