//! What a window gives back that rests: soon what the next frame would not use, and all that frames are drawn in once it has rested for longer.

use std::time::{Duration, Instant};

use super::{printed, viewer::Viewer};
use crate::console;

/// What is of no use before the next frame is given back once nothing was drawn for so long.
const TIDY: Duration = Duration::from_millis(500);

/// Once nothing was drawn for so long, all but the scene and the picture that is shown. The next frame takes it anew, which takes some milliseconds; and what a window has that nobody uses
/// does not depend on what it has shown before.
const IDLE: Duration = Duration::from_secs(5);

/// When that is.
#[derive(Default)]
pub struct Tidies {
    soon: Option<Instant>,
    /// Behind `soon`.
    all: Option<Instant>,
}

impl Tidies {
    /// After a frame.
    pub fn after(now: Instant) -> Self {
        Self { soon: Some(now + TIDY), all: Some(now + IDLE) }
    }

    /// When there is something to do.
    pub fn next(&self) -> Option<Instant> {
        self.soon.or(self.all)
    }
}

impl Viewer {
    /// Gives back what is of no use where nothing was drawn for a while.
    pub fn tidy(&mut self, now: Instant) {
        if self.tidies.next().is_none_or(|when| now < when) {
            return;
        }
        // Errors, such as a lost device, come with the next frame, too.
        if self.moved.is_some()
            || self.steps.is_some()
            || self.writing.is_some()
            || !self.gpu.is_idle().unwrap_or(true)
        {
            self.tidies = Tidies::after(now);
            return;
        }
        let all = self.tidies.soon.take().is_none();
        if all {
            self.tidies.all = None;
            let _ = self.gpu.forget_frames(self.shown);
        }
        let _ = self.gpu.tidy(self.comparing.is_some(), all);
        if self.options.prints_frames {
            let _ = console::print(&printed::at_rest(self.gpu.headless.device()));
        }
        if all {
            return;
        }
        if self.ui.shows_times() && self.splats_drawn.is_none() && self.counting.is_none() && !self.is_stale {
            let _ = self.count_drawn();
        }
        self.look_under_cursor();
    }
}
