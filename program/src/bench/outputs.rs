//! The files of `surfel bench`.

use surfel::{
    Error, Result,
    report::{
        PLOT_SIZE_PX,
        bench::{BenchReport, TABLES, conversion_plot, growth_plot, throughput_plot},
    },
    save,
};

use super::arguments::{Bench, BenchArguments};
use crate::{json::write_json, outputs};

/// Checks that all files that are asked for can be written.
///
/// # Errors
/// A place that can't be written to, that is an input, or that is named twice; a plot without anything to plot.
pub fn check(arguments: &BenchArguments) -> Result<()> {
    let BenchArguments { json, markdown, plot, csv, model, baseline, table, .. } = arguments;
    if plot.is_some()
        && ![Bench::Table1, Bench::Growth, Bench::I3].into_iter().any(|plotted| table.has(plotted))
    {
        return Err(Error::option(
            "--plot",
            format!("{} is not over numbers of splats or triangles", table.name()),
        ));
    }
    plot.iter().try_for_each(|path| outputs::check_name("--plot", path, &["svg"]))?;
    let names = TABLES.map(|name| format!("{name}.csv"));
    let (files, inputs) = ([json, markdown, plot], [model, baseline]);
    let names = names.each_ref().map(String::as_str);
    outputs::check_places(files.into_iter().flatten(), csv.as_deref(), &names, inputs.into_iter().flatten())
}

/// Writes them.
pub fn write(arguments: &BenchArguments, report: &BenchReport) -> Result<()> {
    write_json(arguments.json.as_deref(), report)?;
    if let Some(path) = &arguments.markdown {
        save::text(path, &report.markdown())?;
    }
    if let Some(path) = &arguments.plot {
        let name = report.device.as_ref().map_or("", |device| device.name.as_str());
        let plot = match (&report.growth, &report.i3) {
            (Some(growth), _) => growth_plot(growth, name),
            (None, Some(conversion)) => conversion_plot(conversion),
            (None, None) => throughput_plot(&report.table1, name),
        };
        save::text(path, &plot.svg(PLOT_SIZE_PX)?)?;
    }
    if let Some(folder) = &arguments.csv {
        std::fs::create_dir_all(folder).map_err(|e| Error::file(folder, "write", e))?;
        for (name, csv) in report.csvs() {
            save::text(&folder.join(format!("{name}.csv")), &csv)?;
        }
    }
    Ok(())
}
