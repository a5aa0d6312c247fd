//! The wall-clock time of what is done once.

use std::time::Instant;

use surfel::report::Step;

/// The steps so far, in order.
#[derive(Default)]
pub struct Steps(pub Vec<Step>);

impl Steps {
    /// Does a step and notes its time.
    pub fn time<T>(&mut self, name: impl Into<String>, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let done = work();
        self.add(name, start.elapsed().as_secs_f64());
        done
    }

    /// Notes a step that was timed otherwise.
    pub fn add(&mut self, name: impl Into<String>, secs: f64) {
        self.0.push(Step { name: name.into(), secs });
    }
}
