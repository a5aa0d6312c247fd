//! What the pipelines cost in instructions: one row a pipeline.

use std::fmt::{self, Write as _};

use serde::{Deserialize, Serialize};

use crate::count::{Counts, PassCounts};

/// The instructions of all pipelines.
#[derive(Clone, Debug, Serialize)]
pub struct InstructionReport {
    /// One row a pipeline.
    pub rows: Vec<InstructionRow>,
    /// What a reader has to know, a sentence each.
    pub notes: Vec<String>,
}

/// One pipeline. Settings that a pass does not depend on are empty.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize)]
pub struct PipelineNames {
    /// The pass.
    pub pass: String,
    /// What it draws, such as `points`; empty where that is the whole target.
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

impl PipelineNames {
    /// All of them, in the order of their columns.
    pub fn parts(&self) -> [&str; 9] {
        [
            &self.pass,
            &self.draws,
            &self.rasterizer,
            &self.filter,
            &self.kernel_eval,
            &self.accumulate,
            &self.shading,
            &self.splats,
            &self.shaders,
        ]
    }
}

/// A pipeline's instructions.
#[derive(Clone, Debug, Serialize)]
pub struct InstructionRow {
    /// Which it is.
    #[serde(flatten)]
    pub names: PipelineNames,
    /// Counted by the two rules.
    pub counts: PassCounts,
    /// What table 1 of Guennebaud et al. 2006 has for it: vertex and fragment program.
    pub published: Option<[u32; 2]>,
    /// What drivers' compilers made of it.
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
    /// What the driver tells, by its names.
    pub statistics: Vec<(String, f64)>,
}

/// The columns of a stage in CSV.
const STAGE_COLUMNS: [&str; 11] = [
    "arb",
    "arb_longest_path",
    "scalar",
    "loads",
    "stores",
    "moves",
    "kills",
    "alpha_tests",
    "addresses",
    "bit_operations",
    "loops",
];

impl InstructionReport {
    /// One line a pipeline, or for each shader of each device where drivers were asked.
    pub fn csv(&self) -> String {
        let mut csv = "pass,draws,rasterizer,filter,kernel_eval,accumulate,shading,splats,shaders".to_owned();
        for stage in ["vertex", "fragment", "compute"] {
            for column in STAGE_COLUMNS {
                // Writing to a string can't fail, here and below.
                let _ = write!(csv, ",{stage}_{column}");
            }
        }
        csv += ",published_vertex,published_fragment,device,executable,subgroup";
        let statistics = self.statistics();
        for name in &statistics {
            let _ = write!(csv, ",{}", quoted(name));
        }
        csv.push('\n');
        for row in &self.rows {
            let own = row.columns();
            if row.isa.is_empty() {
                csv += &own;
                csv += &",".repeat(3 + statistics.len());
                csv.push('\n');
            }
            for isa in &row.isa {
                let _ =
                    write!(csv, "{own},{},{},{}", quoted(&isa.device), quoted(&isa.executable), isa.subgroup);
                for name in &statistics {
                    let value = isa.statistic(name).map_or_else(String::new, |value| value.to_string());
                    let _ = write!(csv, ",{value}");
                }
                csv.push('\n');
            }
        }
        csv
    }

    /// The names of all statistics, in the order in which they come.
    pub fn statistics(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for (name, _) in self.rows.iter().flat_map(|row| &row.isa).flat_map(|isa| &isa.statistics) {
            if !names.contains(name) {
                names.push(name.clone());
            }
        }
        names
    }
}

impl IsaRow {
    /// The statistic of that name, whatever its case.
    pub fn statistic(&self, name: &str) -> Option<f64> {
        self.statistics.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, value)| *value)
    }
}

impl InstructionRow {
    fn columns(&self) -> String {
        let mut columns: Vec<String> = self.names.parts().map(quoted).to_vec();
        for stage in [&self.counts.vertex, &self.counts.fragment, &self.counts.compute] {
            columns.extend(stage_columns(stage.as_ref()));
        }
        for i in 0..2 {
            columns.push(self.published.map_or_else(String::new, |published| published[i].to_string()));
        }
        columns.join(",")
    }
}

fn stage_columns(counts: Option<&Counts>) -> Vec<String> {
    let Some(counts) = counts else { return vec![String::new(); STAGE_COLUMNS.len()] };
    let listed = &counts.listed;
    let numbers = [
        counts.arb,
        counts.arb_longest_path,
        Some(counts.scalar),
        Some(listed.loads),
        Some(listed.stores),
        Some(listed.moves),
        Some(listed.kills),
        Some(listed.alpha_tests),
        Some(listed.addresses),
        Some(listed.bit_operations),
        Some(listed.loops),
    ];
    numbers.map(|number| number.map_or_else(String::new, |number| number.to_string())).to_vec()
}

/// A field of CSV: in quotes where it needs them.
fn quoted(text: &str) -> String {
    match text.contains([',', '"', '\n']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

impl fmt::Display for InstructionReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:18} {:15} {:21} {:17} {:8} {:4} {:8} {:>9} {:>9} {:>11} {:>7} {:>5} {:>6} {:>5} {:>6}",
            "pass",
            "draws",
            "rasterizer",
            "filter",
            "kernel",
            "sums",
            "splats",
            "VP/FP",
            "published",
            "scalar",
            "longest",
            "loads",
            "stores",
            "moves",
            "kills",
        )?;
        for row in &self.rows {
            let names = &row.names;
            writeln!(
                f,
                "{:18} {:15} {:21} {:17} {:8} {:4} {:8} {:>9} {:>9} {:>11} {:>7} {:>5} {:>6} {:>5} {:>6}",
                names.pass,
                names.draws,
                names.rasterizer,
                names.filter,
                names.kernel_eval,
                names.accumulate,
                names.splats,
                row.counts.vertex_and_fragment(),
                row.published.map_or_else(String::new, |[vertex, fragment]| format!("{vertex}/{fragment}")),
                row.counts.of_stages(|counts| Some(counts.scalar)),
                row.counts.of_stages(|counts| counts.arb_longest_path),
                row.counts.of_stages(|counts| Some(counts.listed.loads)),
                row.counts.of_stages(|counts| Some(counts.listed.stores)),
                row.counts.of_stages(|counts| Some(counts.listed.moves)),
                row.counts.of_stages(|counts| Some(counts.listed.kills)),
            )?;
        }
        if self.rows.iter().any(|row| !row.isa.is_empty()) {
            writeln!(f)?;
            self.isa(f)?;
        }
        for note in &self.notes {
            writeln!(f, "note: {note}")?;
        }
        Ok(())
    }
}

/// What is shown of a driver's statistics, by RADV's names, which CSV and JSON have all of.
const SHOWN_STATISTICS: [&str; 6] =
    ["Instructions", "VGPRs", "SGPRs", "Code size", "Latency", "Inverse Throughput"];

impl InstructionReport {
    fn isa(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:18} {:15} {:21} {:17} {:4} {:24}",
            "pass", "draws", "rasterizer", "filter", "sums", "device: shader"
        )?;
        for name in SHOWN_STATISTICS {
            write!(f, " {name:>12.12}")?;
        }
        writeln!(f)?;
        for row in &self.rows {
            for isa in &row.isa {
                let names = &row.names;
                let device = isa.device.split(['(', ',']).next().unwrap_or_default().trim();
                let shader = format!("{}: {}", device, isa.executable);
                write!(
                    f,
                    "{:18} {:15} {:21} {:17} {:4} {:24}",
                    names.pass, names.draws, names.rasterizer, names.filter, names.accumulate, shader
                )?;
                for name in SHOWN_STATISTICS {
                    match isa.statistic(name) {
                        Some(value) => write!(f, " {value:>12}")?,
                        None => write!(f, " {:>12}", "-")?,
                    }
                }
                writeln!(f)?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
