//! What a dependency is between: stages and accesses, layouts, and its cause.

use ash::vk;

/// Stages and what they access: one side of a dependency.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Scope {
    /// The stages.
    pub stages: vk::PipelineStageFlags2,
    /// Their accesses. Of what is waited for, only the writes, which become available.
    pub access: vk::AccessFlags2,
}

/// A change of an image's layout; none where both are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transition {
    /// The layout before; `UNDEFINED` where the content isn't needed.
    pub old: vk::ImageLayout,
    /// The layout after.
    pub new: vk::ImageLayout,
}

/// Why a barrier is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// A reader sees what was written.
    ReadAfterWrite,
    /// A writer lets the readers finish.
    WriteAfterRead,
    /// A writer lets an earlier one finish.
    WriteAfterWrite,
    /// A reader needs another layout than those before it.
    Layout,
    /// The first access of a transient lets the former tenants of its memory finish: other transients, or itself
    /// in the execution before.
    FirstUse,
}
