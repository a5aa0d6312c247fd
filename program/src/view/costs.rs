//! What frames have cost: the pace learns it, and the panel and `--print-frames` tell it.

use std::time::{Duration, Instant};

use surfel::Result;

use super::{hidden, picture::Use, printed, viewer::Viewer};
use crate::console;

/// How soon the cost of a frame is looked for again that is not done.
pub const COST: Duration = Duration::from_millis(10);

/// What is known of costs until so many frames of a hand is of those that take their images and their memory: the next ones may cost far less.
const FIRST_FRAMES: u32 = 3;

impl Viewer {
    /// Learns what frames have cost.
    ///
    /// # Errors
    /// Of the device.
    pub fn learn(&mut self, is_moving: bool) -> Result<()> {
        self.looks_for_costs = None;
        // With what it takes to show the picture, too.
        let period = self.gpu.take_period().filter(|_| is_moving && self.moving_frames > 0);
        self.moving_frames = if is_moving { self.moving_frames.saturating_add(1) } else { 0 };
        let is_first = self.moving_frames <= FIRST_FRAMES;
        for which in Use::ALL {
            let (costs, all) = self.gpu.take_costs(which)?;
            for cost in costs {
                if self.options.prints_frames {
                    console::print(&printed::frame(&cost))?;
                }
                if which == Use::Other {
                    continue;
                }
                // A picture at rest tells of moving ones where they are the same.
                let is_hidden = hidden::is_of_hidden(cost.what);
                if is_moving && !is_hidden && (which == Use::Moving || self.pace.is_finest()) {
                    let secs = period.map_or(cost.secs, |period| period.as_secs_f64());
                    self.pace.learn(secs, cost.compiles || is_first);
                }
                if ["whole", hidden::AGAIN].contains(&cost.what) && !cost.compiles {
                    self.pace.learn_whole(cost.secs);
                    let hidden = self.next_hidden(&self.whole());
                    self.refines = self.refines.or(hidden.map(|_| self.hidden_from(Instant::now())));
                }
                if cost.what != "step" && !is_hidden {
                    self.ui.history.push(&cost);
                }
            }
            if !all && self.shows_costs() {
                self.looks_for_costs = Some(Instant::now() + COST);
            }
        }
        Ok(())
    }

    /// Whether somebody is to be told what frames have cost, or the pace is.
    pub fn shows_costs(&self) -> bool {
        self.ui.shows_times() || self.options.prints_frames || !self.pace.has_moved()
    }
}
