//! The render graph: passes declare what they access; order, barriers, attachments' operations and the memory of
//! transients follow from it. Nothing in its core knows a device, so all of it is tested as plain data.
//!
//! 1. [`Graph`]: resources are created (transients, which live inside one execution) or imported (the caller's, in a
//!    declared state), and passes say how they [`Access`] them.
//! 2. [`Graph::compile`] turns that into a [`Plan`], stage by stage: validate, cull and order, lifetimes, alias,
//!    barriers, load and store operations.
//! 3. A plan is recorded into a command buffer; again and again, if wanted. It never submits and never waits.
//!
//! **A plan's contract.** It is executed on one queue. Its transients' memory is the same in every execution, which may
//! follow each other without a wait: the first access to memory waits on the last accesses of the execution before.
//! It belongs to it alone, or to other plans, too, executions of which have finished. At the start of each execution
//! every import is in its declared initial state.

mod access;
mod alias;
mod barrier;
mod compile;
mod cull;
mod declare;
mod dump;
pub mod execute;
mod lifetime;
mod load_store;
mod plan;
mod resource;
mod scope;
mod shape;
#[cfg(test)]
mod tests;
mod track;
mod traffic;
mod validate;

pub use access::{Access, AccessInfo, PassKind};
use alias::BLOCK_BYTES;
pub use alias::{Block, MemoryClass, MemoryNeed, Slot};
pub use barrier::{Barrier, Batch};
pub use declare::{Graph, PassBuilder, Role, Start, Use};
pub use lifetime::{Lifetime, Usage};
pub use load_store::{Attachment, Rendering};
pub use plan::{CulledPass, Plan, PlannedPass, PlannedResource};
pub use resource::{
    Buffer, BufferDesc, BufferState, ClearValue, Handle, Image, ImageDesc, ImageState, Origin, ResourceDesc,
    ResourceId, State, aspect_of,
};
pub use scope::{Cause, Scope, Transition};
pub use traffic::Executed;
