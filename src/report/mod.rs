//! Measurements and what they are of, as plain data: serialized it is the JSON of `--timings`, printed it is a
//! table for people.
//!
//! No figure is made up: what was not measured is `None` (`null` in JSON) and a sentence among the flags says why.

#[cfg(all(feature = "compare", feature = "counts"))]
pub mod bench;
#[cfg_attr(
    not(all(feature = "compare", feature = "counts")),
    allow(dead_code, reason = "most tables are the program's")
)]
mod cells;
#[cfg(feature = "compare")]
pub mod compare;
mod frames;
mod grid;
mod model;
pub mod picture;
#[cfg(feature = "compare")]
mod plot;
mod probe;
mod run;
mod spread;
mod timed;
#[cfg(feature = "compare")]
pub mod zoom;

pub use frames::{FrameSample, FrameTimes, PassFigures, passes_flag};
pub use grid::{Grid, Table};
pub use model::ModelReport;
#[cfg(feature = "compare")]
pub use plot::{Axis, Chart, PLOT_SIZE_PX, Plot};
pub use probe::ThroughputProbe;
pub use run::{CameraReport, DeviceReport, InputReport, RunReport, SceneReport, Step};
pub use spread::Spread;
pub use timed::{TimedFrames, UNTIMED_A_TURN};
