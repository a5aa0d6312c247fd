//! A frame under way, and what it has cost.

use std::time::{Duration, Instant};

use surfel::graph::execute::FrameProfile;

/// A frame under way.
#[derive(Clone, Copy)]
pub struct Begun {
    /// When its recording began.
    pub at: Instant,
    /// The input that it answers to.
    pub input: Option<Instant>,
    /// What it is to the picture.
    pub what: &'static str,
    /// Width and height.
    pub size_px: [u32; 2],
    /// Pipelines were made for it, or ran for the first time.
    pub compiles: bool,
    /// How many had run nowhere before.
    pub unknown: usize,
    /// It is a step of a picture: its queries are those of several.
    pub is_step: bool,
}

/// What a frame has cost.
pub struct Cost {
    /// Seconds on the device; where it can't tell, from the recording to when the end was seen.
    pub secs: f64,
    /// Of its passes.
    pub profile: FrameProfile,
    /// Width and height.
    pub size_px: [u32; 2],
    /// Pipelines were made for it, which takes time on some devices' side, too.
    pub compiles: bool,
    /// How many of these had run nowhere before.
    pub unknown: usize,
    /// What it was to the picture.
    pub what: &'static str,
    /// From the input that it answers to when its end was seen.
    pub since_input: Option<Duration>,
}
