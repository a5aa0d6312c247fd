//! The files of `surfel bench`.

use std::path::{Path, PathBuf};

use surfel::{
    Error, Result,
    report::{BenchReport, growth_plot, throughput_plot},
    save,
};

use super::arguments::{Bench, BenchArguments};
use crate::{json::to_json, outputs};

/// Checks that all files that are asked for can be written.
///
/// # Errors
/// A place that can't be written to, that is an input, or that is named twice; a plot without anything to plot.
pub fn check(arguments: &BenchArguments) -> Result<()> {
    let BenchArguments { json, markdown, plot, csv, model, baseline, table, .. } = arguments;
    if plot.is_some() && !table.has(Bench::Table1) && !table.has(Bench::Growth) {
        return Err(Error::option("--plot", format!("{} is not over numbers of splats", table.name())));
    }
    let files: Vec<&Path> = [json, markdown, plot].into_iter().flatten().map(PathBuf::as_path).collect();
    let inputs: Vec<&Path> = [model, baseline].into_iter().flatten().map(PathBuf::as_path).collect();
    let names: Vec<&str> = TABLES.iter().map(|(name, _)| *name).collect();
    outputs::check_places(&files, csv.as_deref(), &names, &inputs)
}

/// The files of `--csv`, and how the titles of their tables begin.
const TABLES: [(&str, &str); 15] = [
    ("floor.csv", "floor: "),
    ("floor-limits.csv", "limits: "),
    ("floor-bounds.csv", "bounds: "),
    ("table1.csv", "table 1: throughput"),
    ("table1-passes.csv", "table 1: where"),
    ("slides.csv", "the slides' methods, "),
    ("slides-throughput.csv", "the slides' methods: throughput"),
    ("slides-passes.csv", "the slides' methods: where"),
    ("layers.csv", "layers, "),
    ("layers-empty.csv", "layers: what an empty"),
    ("transition.csv", "transition, "),
    ("growth-splats.csv", "growth over splats"),
    ("growth-pixels.csv", "growth over pixels"),
    ("growth-passes.csv", "growth: where"),
    ("counts.csv", "counts: "),
];

/// Writes them.
///
/// # Errors
/// Whatever the file system answers.
pub fn write(arguments: &BenchArguments, report: &BenchReport) -> Result<()> {
    if let Some(path) = &arguments.json {
        save::text(path, &to_json(report)?)?;
    }
    if let Some(path) = &arguments.markdown {
        save::text(path, &report.markdown())?;
    }
    if let Some(path) = &arguments.plot {
        let name = report.device.as_ref().map_or("", |device| device.name.as_str());
        let svg = match &report.growth {
            Some(growth) => growth_plot(growth, name)?,
            None => throughput_plot(&report.table1, name)?,
        };
        save::text(path, &svg)?;
    }
    if let Some(folder) = &arguments.csv {
        std::fs::create_dir_all(folder).map_err(|e| Error::file(folder, "write", e))?;
        for grid in report.grids() {
            if let Some((name, _)) = TABLES.iter().find(|(_, title)| grid.title.starts_with(title)) {
                save::text(&folder.join(name), &grid.csv())?;
            }
        }
        if let Some(counts) = &report.counts {
            save::text(&folder.join("counts.csv"), &counts.csv())?;
        }
    }
    Ok(())
}
