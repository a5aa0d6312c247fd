//! Which pipelines there are, which may be made, and which of them stay.

use std::sync::atomic::Ordering;

use super::{super::made::first_to_stay, MissingPipelines, Shaders};
use crate::error::{ErrorKind, Result};

impl Shaders {
    /// The pipelines made so far, by name: vertex and fragment shader, or compute shader.
    pub fn pipeline_names(&self) -> Vec<String> {
        let mut names = self.graphics.for_each(|key, _| key.name());
        names.extend(self.compute.for_each(|key, _| key.shader.name.to_owned()));
        names.sort();
        names
    }

    /// How many pipelines were made so far, those counted that are gone.
    pub fn made(&self) -> u64 {
        self.made.load(Ordering::Relaxed)
    }

    /// Counts a pipeline that is made, or refuses to make it.
    pub(super) fn makes(&self, missing: MissingPipelines, name: impl Fn() -> String) -> Result<()> {
        let is_refused = match missing {
            MissingPipelines::Make => false,
            MissingPipelines::Refuse => true,
            MissingPipelines::UpTo(most) => self.made() >= most,
        };
        if is_refused {
            return Err(ErrorKind::NotReady { pipeline: name() }.into());
        }
        self.made.fetch_add(1, Ordering::Relaxed);
        Ok(())
    }

    /// Keeps so many pipelines, those that were asked for last, and tells how many go; a frame that needs another makes it again. For hosts whose frames change
    /// for hours: each has its pipelines, and a driver may take a megabyte for one.
    ///
    /// # Safety
    /// All that was recorded with pipelines of this is submitted, by the last submission or one before it, and no [`crate::embed::View`] is prepared that is
    /// still to be drawn.
    pub unsafe fn keep_newest(&self, most: usize) -> usize {
        if self.graphics.len() + self.compute.len() <= most {
            return 0;
        }
        let mut times = self.graphics.for_each(|_, used| used);
        times.extend(self.compute.for_each(|_, used| used));
        let first = first_to_stay(times, most);
        let mut dropped = self.graphics.drop_before(first);
        dropped.extend(self.compute.drop_before(first));
        self.ran().dropped(&dropped);
        dropped.len()
    }
}
