//! All that a run of `surfel bench` found: tables with what explains them, and what a later run is judged by.

mod clips;
mod conversion;
mod empty_layers;
mod floor;
pub mod gate;
mod growth;
mod hierarchy;
mod hybrid;
mod instructions;
mod judgement;
mod layers;
mod level_error;
mod limits;
mod limits_table;
mod measurement;
mod plots;
mod slides;
mod throughput;
mod tolerances;
mod transition;
mod trust;

use std::collections::BTreeMap;

use serde::Serialize;

pub use clips::{Clipped, ClipsReport, ClipsRow, PAPER_OCCUPANCIES, PAPER_PARTS};
pub use conversion::{ConversionReport, ConversionRow};
pub use empty_layers::{EmptyLayers, LayerPass};
pub use floor::{FloorReport, FloorRound, FloorRow};
pub use growth::{GrowthPoint, GrowthRate, GrowthReport, growth_powers};
pub use hierarchy::{HierarchyReport, HierarchyRow, PAPER_HIERARCHIES};
pub use hybrid::{HybridReport, HybridView, HybridWay};
pub use instructions::{InstructionReport, InstructionRow, IsaRow, PipelineNames};
pub use judgement::{Judged, Judgement};
pub use layers::{LayersDrawn, LayersReport, OpaqueClaim, Places};
pub use level_error::LevelError;
pub use limits::{BoundRow, LimitRow, LimitWork, LimitsReport, PassWork};
pub use measurement::Measurement;
pub use plots::{conversion_plot, growth_plot, throughput_plot};
pub use slides::{SLIDES, Slide};
pub use throughput::{
    PAPER_SPLATS, PaperMethod, PaperThroughput, Throughput, ThroughputRow, paper_throughput,
};
pub use tolerances::{PAPER_TOLERANCES, PaperTolerance, Tolerance, TolerancesReport};
pub use transition::{HalfAndHalf, Primitives, TransitionReport};
pub use trust::{CardUse, Machine, TrustLimits, drift, drift_flag, slowness, spread_flag};

use super::{DeviceReport, Grid, InputReport};
use gate::{Gate, GateFigure};
use slides::slides_grid;
use throughput::{passes_grid, throughput_gate, throughput_grid};

/// Everything that is needed to understand, repeat and judge a benchmark.
#[derive(Clone, Debug, Default, Serialize)]
pub struct BenchReport {
    /// The version of surfel.
    pub surfel: String,
    /// The commit that it was built from; `None` outside of a checkout.
    pub commit: Option<String>,
    /// The device; `None` where nothing was timed.
    pub device: Option<DeviceReport>,
    /// The settings that all methods share, by the names of their options.
    pub settings: BTreeMap<&'static str, String>,
    /// The inputs drawn.
    pub inputs: Vec<InputReport>,
    /// Frames timed of each method.
    pub frames: u32,
    /// The machine meanwhile; `None` where nothing was timed.
    pub machine: Option<Machine>,
    /// Beyond which figures are flagged.
    pub limits: TrustLimits,
    /// `floor`: the three passes against the floor under them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub floor: Option<FloorReport>,
    /// `table1`: throughput over numbers of splats.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub table1: Vec<ThroughputRow>,
    /// `slides`: methods side by side at one number of splats.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slides: Option<ThroughputRow>,
    /// `layers`: what transparent layers cost.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layers: Option<LayersReport>,
    /// `transition`: what the transition between splats and polygons costs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub transition: Option<TransitionReport>,
    /// `growth`: frames over numbers of splats and of pixels.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub growth: Option<GrowthReport>,
    /// `p1`: levels of detail in the making.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub p1: Option<HierarchyReport>,
    /// `p2`: frames by levels of detail.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub p2: Option<TolerancesReport>,
    /// `hybrid`: polygons near, splats far.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hybrid: Option<HybridReport>,
    /// `i1`: what clip curves cost over numbers of splats.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub i1: Option<ClipsReport>,
    /// `i2`: what they cost over how much of the image splats cover.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub i2: Option<ClipsReport>,
    /// `i3`: clipped splats in the making.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub i3: Option<ConversionReport>,
    /// `counts`: the instructions of every pipeline.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub counts: Option<InstructionReport>,
    /// Why figures are doubtful, a sentence each; empty where they are not.
    pub flags: Vec<String>,
    /// The figures that a later run is judged by.
    pub gate: Gate,
    /// Against an earlier run, where one was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub judgement: Option<Judgement>,
}

/// The tables that are written as CSV, by the names of their files.
pub const TABLES: [&str; 22] = [
    "floor",
    "floor-limits",
    "floor-bounds",
    "table1",
    "table1-passes",
    "slides",
    "slides-throughput",
    "slides-passes",
    "layers",
    "layers-empty",
    "transition",
    "growth-splats",
    "growth-pixels",
    "growth-passes",
    "p1",
    "p2",
    "p2-paper",
    "hybrid",
    "i1",
    "i2",
    "i3",
    "counts",
];

impl BenchReport {
    /// Every table that has a row, with its name.
    fn tables(&self) -> Vec<(&'static str, Grid)> {
        let mut tables = Vec::new();
        if let Some(floor) = &self.floor {
            tables.push(("floor", floor.grid()));
            tables.push(("floor-limits", floor.limits.limits_grid()));
            tables.push(("floor-bounds", floor.limits.bounds_grid()));
        }
        tables.push(("table1", throughput_grid("table 1: throughput", &self.table1)));
        tables.push(("table1-passes", passes_grid("table 1: where the time goes", &self.table1)));
        if let Some(row) = &self.slides {
            let rows = std::slice::from_ref(row);
            tables.push(("slides", slides_grid(row)));
            tables.push(("slides-throughput", throughput_grid("the slides' methods: throughput", rows)));
            tables.push(("slides-passes", passes_grid("the slides' methods: where the time goes", rows)));
        }
        if let Some(layers) = &self.layers {
            tables.push(("layers", layers.grid()));
            tables.extend(layers.empty.as_ref().map(|empty| ("layers-empty", empty.grid())));
        }
        tables.extend(self.transition.as_ref().map(|transition| ("transition", transition.grid())));
        tables.extend(self.growth.iter().flat_map(GrowthReport::grids));
        tables.extend(self.p1.as_ref().map(|p1| ("p1", p1.grid())));
        tables.extend(self.p2.iter().flat_map(TolerancesReport::grids));
        tables.extend(self.hybrid.as_ref().map(|hybrid| ("hybrid", hybrid.grid())));
        tables.extend(self.i1.as_ref().map(|i1| ("i1", i1.grid())));
        tables.extend(self.i2.as_ref().map(|i2| ("i2", i2.grid())));
        tables.extend(self.i3.as_ref().map(|i3| ("i3", i3.grid())));
        if let Some(counts) = &self.counts {
            tables.push(("counts", counts.grid()));
            tables.extend(counts.isa_grid().map(|grid| ("", grid)));
        }
        // What was not measured, or is left out; the flags say why.
        tables.retain(|(_, grid)| !grid.rows.is_empty());
        tables
    }

    /// Every table, for people.
    pub fn grids(&self) -> impl Iterator<Item = Grid> {
        self.tables().into_iter().map(|(_, grid)| grid)
    }

    /// Every table for programs, by its name in [`TABLES`].
    pub fn csvs(&self) -> Vec<(&'static str, String)> {
        let csv = |(name, grid): (&'static str, Grid)| match &self.counts {
            // People see a part of it.
            Some(counts) if name == "counts" => (name, counts.csv()),
            _ => (name, grid.csv()),
        };
        self.tables().into_iter().filter(|(name, _)| TABLES.contains(name)).map(csv).collect()
    }

    /// The figures by which it is judged.
    pub fn figures(&self) -> Vec<GateFigure> {
        let mut figures = throughput_gate("table1", &self.table1);
        figures.extend(throughput_gate("slides", self.slides.as_slice()));
        figures.extend(self.floor.iter().flat_map(FloorReport::gate));
        figures.extend(self.layers.iter().flat_map(LayersReport::gate));
        figures.extend(self.transition.iter().flat_map(TransitionReport::gate));
        figures.extend(self.growth.iter().flat_map(GrowthReport::gate));
        figures.extend(self.i1.iter().chain(&self.i2).flat_map(ClipsReport::gate));
        figures.extend(self.i3.iter().flat_map(ConversionReport::gate));
        figures.extend(self.p1.iter().flat_map(HierarchyReport::gate));
        figures.extend(self.p2.iter().flat_map(TolerancesReport::gate));
        figures.extend(self.hybrid.iter().flat_map(HybridReport::gate));
        figures.extend(self.counts.iter().flat_map(InstructionReport::gate));
        figures
    }

    /// As text: what it ran on, every table, the flags, the judgement.
    pub fn text(&self) -> String {
        let mut text = match &self.device {
            Some(DeviceReport { name, driver, .. }) => {
                format!("{name} ({driver}); {}\n\n", self.what_was_timed())
            }
            None => String::new(),
        };
        text += &self.grids().map(|grid| grid.to_string()).collect::<Vec<_>>().join("\n");
        text.extend(self.flags.iter().map(|flag| format!("note: {flag}\n")));
        text.extend(self.judgement.iter().map(|judgement| format!("\n{}", judgement.grid())));
        text
    }

    /// The models, the size where all have one, and how often.
    fn what_was_timed(&self) -> String {
        let names = self.inputs.iter().map(|input| input.name.as_str()).collect::<Vec<_>>().join(" and ");
        let size = self.settings.get("size").map(|size| format!(", {size}")).unwrap_or_default();
        format!("{names}{size}, {} frames of each, in turn", self.frames)
    }

    /// As Markdown.
    pub fn markdown(&self) -> String {
        let commit = self.commit.as_ref().map_or_else(String::new, |commit| format!(" ({commit})"));
        let mut text = format!("surfel {}{commit}", self.surfel);
        if let Some(DeviceReport { name, driver, api_version, .. }) = &self.device {
            text += &format!(" on {name}, {driver}, Vulkan {api_version}; {}", self.what_was_timed());
        }
        text += ".\n";
        text.extend(self.grids().map(|grid| format!("\n{}", grid.markdown())));
        text.extend(self.flags.iter().map(|flag| format!("\nNote: {flag}.\n")));
        text.extend(self.judgement.iter().map(|judgement| format!("\n{}", judgement.grid().markdown())));
        text
    }
}
