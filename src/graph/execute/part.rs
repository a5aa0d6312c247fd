//! A part of a plan's passes, for hosts that go on between parts.

use ash::vk;

/// The passes that are recorded at once.
#[derive(Clone, Copy, Default)]
pub struct Part<'a> {
    /// The first of them; those before it are recorded already.
    pub first: usize,
    /// What tells where the part ends; `None` where it ends with the plan.
    pub runs: Option<&'a dyn Runs>,
}

/// Is told of pipelines, and says where a part ends.
pub trait Runs {
    /// A pipeline runs.
    fn runs(&self, pipeline: vk::Pipeline);

    /// Whether the pass that was recorded last is the part's last.
    fn ends(&self) -> bool;
}

impl Part<'_> {
    /// Whether the pass that was recorded last is the last.
    pub(super) fn ends(&self) -> bool {
        self.runs.is_some_and(Runs::ends)
    }
}
