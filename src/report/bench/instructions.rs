//! The pipelines' costs in instructions: one row a pipeline.

use serde::{Deserialize, Serialize};

use super::gate::{GateFigure, GateKind};
use crate::{
    count::{Counts, PassCounts},
    report::{Grid, cells::figure},
};

/// The instructions of all pipelines.
#[derive(Clone, Debug, Serialize)]
pub struct InstructionReport {
    /// One row a pipeline.
    pub rows: Vec<InstructionRow>,
    /// Notes for a reader, a sentence each.
    pub notes: Vec<String>,
}

/// One pipeline. Settings that a pass does not depend on are empty.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize)]
pub struct PipelineNames {
    /// The pass.
    pub pass: String,
    /// Its primitives, such as `points`; empty where that is the whole target.
    pub draws: String,
    /// `--rasterizer`.
    pub rasterizer: String,
    /// `--filter`, with the weight where that is not the default.
    pub filter: String,
    /// `--kernel-eval`.
    pub kernel_eval: String,
    /// `--accumulate`, where that is not the default.
    pub accumulate: String,
    /// `--shading`.
    pub shading: String,
    /// `disks` or `ellipses`.
    pub splats: String,
    /// The shaders.
    pub shaders: String,
}

/// A name of a pipeline: its column in CSV, its column in tables (nothing where it is not in them), and the name.
type NameColumn = (&'static str, &'static str, fn(&PipelineNames) -> &str);

const NAMES: [NameColumn; 9] = [
    ("pass", "pass", |names| &names.pass),
    ("draws", "draws", |names| &names.draws),
    ("rasterizer", "rasterizer", |names| &names.rasterizer),
    ("filter", "filter", |names| &names.filter),
    ("kernel_eval", "kernel", |names| &names.kernel_eval),
    ("accumulate", "sums", |names| &names.accumulate),
    ("shading", "", |names| &names.shading),
    ("splats", "splats", |names| &names.splats),
    ("shaders", "", |names| &names.shaders),
];

/// A pipeline's instructions.
#[derive(Clone, Debug, Serialize)]
pub struct InstructionRow {
    /// Which it is.
    #[serde(flatten)]
    pub names: PipelineNames,
    /// Counted by the two rules.
    pub counts: PassCounts,
    /// Its vertex and fragment program in table 1 of Guennebaud et al. 2006.
    pub published: Option<[u32; 2]>,
    /// The shaders that drivers' compilers made of it.
    pub isa: Vec<IsaRow>,
}

/// A shader as a driver's compiler made it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct IsaRow {
    /// The device.
    pub device: String,
    /// The shader, as the driver names it.
    pub executable: String,
    /// Invocations that run together.
    pub subgroup: u32,
    /// The driver's statistics, by its names.
    pub statistics: Vec<(String, f64)>,
}

/// A stage's name, and its counts in a pass.
type Stage = (&'static str, fn(&PassCounts) -> Option<&Counts>);

/// A figure's name, and its value for a stage.
type StageFigure = (&'static str, fn(&Counts) -> Option<u32>);

/// The stages of a pipeline, each with its instructions.
const STAGES: [Stage; 3] = [
    ("vertex", |counts| counts.vertex.as_ref()),
    ("fragment", |counts| counts.fragment.as_ref()),
    ("compute", |counts| counts.compute.as_ref()),
];

/// The figures of a stage in CSV.
const STAGE_FIGURES: [StageFigure; 11] = [
    ("arb", |counts| counts.arb),
    ("arb_longest_path", |counts| counts.arb_longest_path),
    ("scalar", |counts| Some(counts.scalar)),
    ("loads", |counts| Some(counts.listed.loads)),
    ("stores", |counts| Some(counts.listed.stores)),
    ("moves", |counts| Some(counts.listed.moves)),
    ("kills", |counts| Some(counts.listed.kills)),
    ("alpha_tests", |counts| Some(counts.listed.alpha_tests)),
    ("addresses", |counts| Some(counts.listed.addresses)),
    ("bit_operations", |counts| Some(counts.listed.bit_operations)),
    ("loops", |counts| Some(counts.listed.loops)),
];

/// The statistics of a driver in tables, by RADV's names; CSV and JSON have all of them.
const SHOWN_STATISTICS: [&str; 6] =
    ["Instructions", "VGPRs", "SGPRs", "Code size", "Latency", "Inverse Throughput"];

impl IsaRow {
    /// The statistic of that name, whatever its case.
    pub fn statistic(&self, name: &str) -> Option<f64> {
        self.statistics.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, value)| *value)
    }

    /// The device without what is in brackets, and the shader.
    fn device_and_shader(&self) -> String {
        let device = self.device.split(['(', ',']).next().unwrap_or_default().trim();
        format!("{device}: {}", self.executable)
    }
}

/// A cell of CSV: empty where there is nothing.
fn plain(figure: Option<impl ToString>) -> String {
    figure.map_or_else(String::new, |figure| figure.to_string())
}

impl InstructionReport {
    /// All figures as CSV: one line a pipeline, or for each shader of each device where drivers were asked.
    pub fn csv(&self) -> String {
        let mut lines: Vec<(&InstructionRow, Option<&IsaRow>)> = Vec::new();
        for row in &self.rows {
            lines.extend(row.isa.iter().map(|isa| (row, Some(isa))));
            lines.extend(row.isa.is_empty().then_some((row, None)));
        }
        let mut table = Grid::of("", &lines);
        for (name, _, of) in NAMES {
            table = table.column(name, |(row, _)| of(&row.names).to_owned());
        }
        for (stage, counts) in STAGES {
            for (name, of) in STAGE_FIGURES {
                let figure = |row: &InstructionRow| counts(&row.counts).and_then(of);
                table = table.column(format!("{stage}_{name}"), |(row, _)| plain(figure(row)));
            }
        }
        table = table
            .column("published_vertex", |(row, _)| plain(row.published.map(|[vertex, _]| vertex)))
            .column("published_fragment", |(row, _)| plain(row.published.map(|[_, fragment]| fragment)))
            .column("device", |(_, isa)| plain(isa.map(|isa| isa.device.clone())))
            .column("executable", |(_, isa)| plain(isa.map(|isa| isa.executable.clone())))
            .column("subgroup", |(_, isa)| plain(isa.map(|isa| isa.subgroup)));
        for name in self.statistics() {
            table = table.column(name, |(_, isa)| plain(isa.and_then(|isa| isa.statistic(name))));
        }
        table.grid().csv()
    }

    /// The names of all statistics, in the order in which they come.
    fn statistics(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for (name, _) in self.rows.iter().flat_map(|row| &row.isa).flat_map(|isa| &isa.statistics) {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        names
    }

    /// The instructions of every pipeline, by the two rules.
    pub(super) fn grid(&self) -> Grid {
        let mut table = Grid::of("counts: the instructions of every pipeline", &self.rows).names(7);
        for (_, name, of) in NAMES.into_iter().filter(|(_, name, _)| !name.is_empty()) {
            table = table.column(name, |row| of(&row.names).to_owned());
        }
        let published = |[vertex, fragment]: [u32; 2]| format!("{vertex}/{fragment}");
        table
            .column("VP/FP", |row| row.counts.vertex_and_fragment())
            .column("published", |row| plain(row.published.map(published)))
            .column("scalar", |row| row.counts.of_stages(|counts| Some(counts.scalar)))
            .column("longest", |row| row.counts.of_stages(|counts| counts.arb_longest_path))
            .column("loads", |row| row.counts.of_stages(|counts| Some(counts.listed.loads)))
            .column("stores", |row| row.counts.of_stages(|counts| Some(counts.listed.stores)))
            .column("moves", |row| row.counts.of_stages(|counts| Some(counts.listed.moves)))
            .column("kills", |row| row.counts.of_stages(|counts| Some(counts.listed.kills)))
            .with_notes(self.notes.iter().cloned())
    }

    /// The table of what drivers' compilers made of the pipelines; `None` where none was asked.
    pub(super) fn isa_grid(&self) -> Option<Grid> {
        let of_row = |row| move |isa| (row, isa);
        let rows: Vec<(&InstructionRow, &IsaRow)> =
            self.rows.iter().flat_map(|row| row.isa.iter().map(of_row(row))).collect();
        let mut table = Grid::of("counts: what drivers' compilers made of them", &rows).names(6);
        for (_, name, of) in NAMES.into_iter().filter(|(_, name, _)| !["", "kernel", "splats"].contains(name))
        {
            table = table.column(name, |(row, _)| of(&row.names).to_owned());
        }
        table = table.column("device: shader", |(_, isa)| isa.device_and_shader());
        for name in SHOWN_STATISTICS {
            table = table.column(name, |(_, isa)| figure(isa.statistic(name)));
        }
        (!rows.is_empty()).then(|| table.grid())
    }

    /// The figures by which the instructions of all pipelines are judged.
    pub fn gate(&self) -> Vec<GateFigure> {
        let of = |row: &InstructionRow| {
            let names = NAMES.map(|(.., of)| of(&row.names));
            let names: Vec<&str> = names.into_iter().filter(|name| !name.is_empty()).collect();
            stage_figures(&format!("counts, {}", names.join(" ")), &row.counts)
        };
        self.rows.iter().flat_map(of).collect()
    }
}

/// Each stage's instructions, by both rules, as they are judged.
pub(super) fn stage_figures(name: &str, counts: &PassCounts) -> Vec<GateFigure> {
    let of_stage = |(stage, of): (&str, fn(&PassCounts) -> Option<&Counts>)| {
        let counts = of(counts);
        let figure = |rule: &str, count: Option<u32>| {
            let name = format!("{name}, {stage} stage, {rule} instructions");
            GateFigure::count(name, GateKind::Instructions, count.map(u64::from))
        };
        let scalar = counts.map(|counts| counts.scalar);
        [figure("ARB", counts.and_then(|counts| counts.arb)), figure("scalar", scalar)]
    };
    STAGES.into_iter().flat_map(of_stage).flatten().collect()
}

#[cfg(test)]
mod tests;
