//! What a run was made of and what it cost, as plain data: serialized it is the JSON of `--timings`, printed it is a
//! table for people.
//!
//! No figure is made up: what was not measured is `None` (`null` in JSON) and a sentence among the flags says why.

mod bench;
#[cfg(feature = "compare")]
pub mod compare;
mod contest;
#[cfg(feature = "compare")]
pub mod curves;
mod empty_layers;
mod floor;
mod frames;
pub mod gate;
mod grid;
mod growth;
#[cfg(feature = "compare")]
mod growth_plot;
mod growth_table;
#[cfg(feature = "counts")]
mod instructions;
mod layers;
mod layers_table;
mod limits;
mod limits_table;
#[cfg(feature = "compare")]
mod plot;
mod run;
mod slides;
mod spread;
mod table;
mod throughput;
#[cfg(feature = "compare")]
mod throughput_plot;
mod throughput_table;
mod transition;
mod trust;
#[cfg(feature = "compare")]
pub mod zoom;

#[cfg(feature = "counts")]
pub use bench::counts_gate;
pub use bench::{BenchReport, floor_gate, throughput_gate};
pub use contest::Contestant;
pub use empty_layers::{EmptyLayers, LayerPass};
pub use floor::{FloorReport, FloorRow, Round};
pub use frames::{FrameSample, FrameTimes, PassFigures, passes_flag};
pub use grid::{Grid, NONE, cell, count_cell};
pub use growth::{GrowthMethod, GrowthPoint, GrowthReport, growth_powers};
#[cfg(feature = "compare")]
pub use growth_plot::growth_plot;
#[cfg(feature = "counts")]
pub use instructions::{InstructionReport, InstructionRow, IsaRow, PipelineNames};
pub use layers::{LayersContestant, LayersReport, OpaqueClaim, Places, Way};
pub use layers_table::layers_grids;
pub use limits::{BoundRow, Limit, LimitRound, LimitRow, LimitWork, LimitsReport, PassWork};
pub use run::{CameraReport, DeviceReport, InputReport, RunReport, SceneReport, Step};
pub use slides::{SLIDES, Slide, slides_grid};
pub use spread::Spread;
pub use throughput::{
    Measured, MethodThroughput, PAPER_SPLATS, PaperMethod, PaperThroughput, ThroughputRow, paper_throughput,
};
#[cfg(feature = "compare")]
pub use throughput_plot::throughput_plot;
pub use throughput_table::{passes_grid, throughput_grid};
pub use transition::{Drawn, TransitionContestant, TransitionReport};
pub use trust::{CardUse, Machine, TrustLimits, drift, drift_flag, slowness, spread_flag};
