//! All that a run of `surfel bench` found: tables with what explains them, and what a later run is judged by.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{
    DeviceReport, FloorReport, GrowthReport, InputReport, LayersReport, Machine, ThroughputRow,
    TransitionReport, TrustLimits,
    gate::{Gate, GateFigure, GateKind, Judgement},
    grid::Grid,
    layers_grids, passes_grid, slides_grid, throughput_grid,
};
#[cfg(feature = "counts")]
use super::{InstructionReport, InstructionRow};

/// Everything that is needed to understand, repeat and judge a benchmark.
#[derive(Clone, Debug, Default, Serialize)]
pub struct BenchReport {
    /// The version of surfel.
    pub surfel: String,
    /// The commit that it was built from; `None` outside of a checkout.
    pub commit: Option<String>,
    /// What it ran on; `None` where nothing was timed.
    pub device: Option<DeviceReport>,
    /// The settings that all methods share, by the names of their options.
    pub settings: BTreeMap<&'static str, String>,
    /// What was drawn.
    pub inputs: Vec<InputReport>,
    /// Frames timed of each method.
    pub frames: u32,
    /// What the machine did meanwhile; `None` where nothing was timed.
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
    /// `counts`: the instructions of every pipeline.
    #[cfg(feature = "counts")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub counts: Option<InstructionReport>,
    /// Why figures are doubtful, a sentence each; empty where they are not.
    pub flags: Vec<String>,
    /// What a later run is judged by.
    pub gate: Gate,
    /// Against an earlier run, where one was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub judgement: Option<Judgement>,
}

impl BenchReport {
    /// Every table, for people.
    pub fn grids(&self) -> Vec<Grid> {
        let mut grids = Vec::new();
        if let Some(floor) = &self.floor {
            grids.push(floor.grid());
            grids.extend(floor.limits.grids());
        }
        if !self.table1.is_empty() {
            grids.push(throughput_grid("table 1: throughput", &self.table1));
            grids.push(passes_grid("table 1: where the time goes", &self.table1));
        }
        if let Some(row) = &self.slides {
            let rows = std::slice::from_ref(row);
            grids.push(slides_grid(row));
            grids.push(throughput_grid("the slides' methods: throughput", rows));
            grids.push(passes_grid("the slides' methods: where the time goes", rows));
        }
        grids.extend(self.layers.iter().flat_map(layers_grids));
        grids.extend(self.transition.as_ref().map(TransitionReport::grid));
        grids.extend(self.growth.iter().flat_map(GrowthReport::grids));
        grids
    }

    /// As text: what it ran on, every table, the flags, the judgement.
    pub fn text(&self) -> String {
        let mut text = match &self.device {
            Some(DeviceReport { name, driver, .. }) => {
                format!("{name} ({driver}); {} frames of each, in turn\n\n", self.frames)
            }
            None => String::new(),
        };
        let grids: Vec<String> = self.grids().iter().map(Grid::to_string).collect();
        text += &grids.join("\n");
        #[cfg(feature = "counts")]
        if let Some(counts) = &self.counts {
            let gap = if text.is_empty() { "" } else { "\n" };
            text += &format!("{gap}{counts}");
        }
        for flag in &self.flags {
            text += &format!("note: {flag}\n");
        }
        if let Some(judgement) = &self.judgement {
            text += &format!("\n{}", judgement.grid());
        }
        text
    }

    /// As Markdown.
    pub fn markdown(&self) -> String {
        let commit = self.commit.as_ref().map_or_else(String::new, |commit| format!(" ({commit})"));
        let mut text = format!("surfel {}{commit}", self.surfel);
        if let Some(DeviceReport { name, driver, api_version, .. }) = &self.device {
            let frames = self.frames;
            text += &format!(" on {name}, {driver}, Vulkan {api_version}; {frames} frames of each, in turn");
        }
        text += ".\n";
        for grid in self.grids() {
            text += &format!("\n{}", grid.markdown());
        }
        #[cfg(feature = "counts")]
        if let Some(counts) = &self.counts {
            text += &format!("\n```\n{counts}```\n");
        }
        for flag in &self.flags {
            text += &format!("\nNote: {flag}.\n");
        }
        if let Some(judgement) = &self.judgement {
            text += &format!("\n{}", judgement.grid().markdown());
        }
        text
    }
}

/// The figures by which rows of throughput are judged. `table` begins their names.
pub fn throughput_gate(table: &str, rows: &[ThroughputRow]) -> Vec<GateFigure> {
    let mut figures = Vec::new();
    for row in rows {
        for method in &row.methods {
            let name = |what: &str| format!("{table}, {} splats, {}, {what}", row.splats, method.name);
            let passes = method.frames.passes.iter().map(|pass| pass.name.as_str()).chain(["frame"]);
            for (pass, over) in passes.zip(&method.over_floor) {
                figures.extend(GateFigure::time(name(&format!("{pass}, x floor")), over.as_ref()));
            }
            #[cfg(feature = "counts")]
            for pass in &method.instructions {
                figures.extend(instruction_figures(&name(&pass.pass), pass));
            }
            for pass in &method.frames.passes {
                let count = |what: &str, count| {
                    GateFigure::count(name(&format!("{}, {what}", pass.name)), GateKind::Work, count)
                };
                figures.extend(count("vertices", pass.vertices));
                figures.extend(count("fragments", pass.fragments));
            }
        }
        let bytes = Some(row.splat_bytes + row.transient_bytes);
        let name = format!("{table}, {} splats, bytes", row.splats);
        figures.extend(GateFigure::count(name, GateKind::Work, bytes));
    }
    figures
}

/// The figures by which the floor is judged.
pub fn floor_gate(floor: &FloorReport) -> Vec<GateFigure> {
    let time =
        |row: &super::FloorRow| GateFigure::time(format!("floor, {}, x floor", row.name), row.ratio.as_ref());
    let work = |row: &super::FloorRow| {
        GateFigure::count(format!("floor, {}, fragments", row.name), GateKind::Work, row.fragments)
    };
    floor.rows.iter().flat_map(|row| [time(row), work(row)]).flatten().collect()
}

/// The figures by which the instructions of all pipelines are judged.
#[cfg(feature = "counts")]
pub fn counts_gate(counts: &InstructionReport) -> Vec<GateFigure> {
    let of = |row: &InstructionRow| {
        let parts: Vec<&str> = row.names.parts().into_iter().filter(|part| !part.is_empty()).collect();
        instruction_figures(&format!("counts, {}", parts.join(" ")), &row.counts)
    };
    counts.rows.iter().flat_map(of).collect()
}

/// Each stage's instructions, by both rules.
#[cfg(feature = "counts")]
fn instruction_figures(name: &str, counts: &crate::count::PassCounts) -> Vec<GateFigure> {
    let stages = [("vertex", &counts.vertex), ("fragment", &counts.fragment), ("compute", &counts.compute)];
    let figure = |stage: &str, rule: &str, count: Option<u32>| {
        let name = format!("{name}, {stage} stage, {rule} instructions");
        GateFigure::count(name, GateKind::Instructions, count.map(u64::from))
    };
    stages
        .into_iter()
        .filter_map(|(stage, counts)| counts.as_ref().map(|counts| (stage, counts)))
        .flat_map(|(stage, counts)| {
            [figure(stage, "ARB", counts.arb), figure(stage, "scalar", Some(counts.scalar))]
        })
        .flatten()
        .collect()
}
