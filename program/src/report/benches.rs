//! The parts of which the tables are `surfel bench`'s: what frames cost beside the least that the same pixels can cost, the paper's
//! tables, transparent layers, transitions from splats to polygons, instructions.

use surfel::{
    Result,
    report::{
        PLOT_SIZE_PX,
        bench::{BenchReport, HybridView, LayersDrawn, Measurement, conversion_plot, throughput_plot},
    },
};

use super::{
    part::{Block, Part},
    session::Session,
};
use crate::{
    bench::{self, BenchArguments},
    json::to_value,
};

/// The part and the report of `surfel bench NAME`; `finding` is `None` where the device tells no times.
fn of_bench(
    session: &mut Session<'_>,
    name: &str,
    finding: fn(&BenchReport) -> Option<String>,
) -> Result<(Part, BenchReport)> {
    let line = session.arguments.bench(name);
    let arguments: BenchArguments = line.arguments()?;
    let headless = arguments.table.needs_device().then_some(&mut *session.headless);
    let report = bench::gather(headless, &arguments)?;
    let part = Part {
        finding: finding(&report).unwrap_or_else(|| "The device tells no times.".to_owned()),
        blocks: report.grids().map(|grid| Block::Table(grid, Vec::new())).collect(),
        commands: vec![line],
        flags: report.flags.clone(),
        machine: report.machine.clone(),
        data: to_value(&report)?,
        ..Part::default()
    };
    Ok((part, report))
}

/// The smallest and the largest.
fn ends(ratios: impl Iterator<Item = f64> + Clone) -> Option<(f64, f64)> {
    ratios.clone().reduce(f64::min).zip(ratios.reduce(f64::max))
}

/// The passes beside their floor and the device's limits.
///
/// # Errors
/// Whatever goes wrong; a device without timestamps.
pub fn floor(session: &mut Session<'_>) -> Result<Part> {
    let (mut part, _) = of_bench(session, "floor", |report| {
        let frame = report.floor.as_ref()?.rows.last()?;
        Some(format!(
            "A frame takes {:.2} times what the same points cost with nothing computed, {:.2} times the strict \
             floor: whatever is done to the shaders, no more than that can be gained.",
            frame.ratio?.median, frame.strict_ratio?.median
        ))
    })?;
    let text = "The floor draws the same points through the same fixed-function stages into the same formats with nothing computed; \
         the strict floor leaves out what the passes cull. All three in turn, and in the same rounds what the device does at \
         most: of that, each pass's points, fragments and bytes take a time below which it can't get.";
    part.blocks.insert(0, Block::Text(text.to_owned()));
    Ok(part)
}

/// Throughput over numbers of splats, and the slides' methods side by side. The paper's claim: perspective splatting is 1.3 to 1.7
/// times as fast as ray casting.
///
/// # Errors
/// Whatever goes wrong; a model that is no mesh, which can't be resampled.
pub fn tables(session: &mut Session<'_>) -> Result<Part> {
    let (mut part, report) = of_bench(session, "table1", |report| {
        let rows = report.table1.iter();
        let (least, most) = ends(rows.filter_map(|row| Some((*row.beside_first.get(1)?)?.median)))?;
        Some(format!(
            "Ray casting takes {least:.2} to {most:.2} times as long as perspective splatting; on the paper's hardware 1.3 to 1.7."
        ))
    })?;
    let device = report.device.as_ref().map_or("", |device| device.name.as_str());
    let plot = Block::Plot {
        svg: throughput_plot(&report.table1, device).svg(PLOT_SIZE_PX)?,
        alt: "milliseconds a frame over numbers of splats, both logarithmic".to_owned(),
        caption: "Milliseconds a frame over numbers of splats, beside the paper's on its own hardware of 2006. The \
                  distance from a line to the floor is what the method's own work costs."
            .to_owned(),
    };
    part.blocks.insert(0, plot);
    let (slides, _) = of_bench(session, "slides", |_| None)?;
    let slides = part.go_on_with(slides);
    part.data = vec![part.data, slides].into();
    Ok(part)
}

/// The cost of transparent layers: the paper's figure 6 beside this device. The paper's claim: half of the layers are drawn more
/// than twice as fast, and with the rest blended faster still.
pub fn layers(session: &mut Session<'_>) -> Result<Part> {
    let (part, _) = of_bench(session, "layers", |report| {
        let report = report.layers.as_ref()?;
        let (first, others) = report.contestants.split_first()?;
        let speed = |own: &Measurement<LayersDrawn>| {
            let (speed, paper) = (1.0 / own.beside_first?.median, report.paper_speed(own)?);
            Some(format!("{} {speed:.2} times as fast (the paper: {paper:.2})", own.name))
        };
        let said: Vec<String> = others.iter().filter_map(speed).collect();
        let share = report.empty.as_ref().and_then(|empty| empty.passes.last()?.share);
        let empty = share.map_or_else(String::new, |share| {
            format!(" A layer in which nothing is costs {:.2}% of a full one.", 100.0 * share.median)
        });
        let said = (!said.is_empty()).then(|| said.join(", "))?;
        Some(format!("Layers beside {}: {said}.{empty}", first.name))
    })?;
    Ok(part)
}

/// The cost of a smooth transition between splats and polygons of one surface. The paper's claim: nothing.
///
/// # Errors
/// Whatever goes wrong; a model that is no mesh.
pub fn transition(session: &mut Session<'_>) -> Result<Part> {
    let (part, _) = of_bench(session, "transition", |report| {
        let ratios: Vec<f64> =
            report.transition.as_ref()?.ratios().filter_map(|own| Some(own?.median)).collect();
        let (least, most) = ends(ratios.into_iter())?;
        Some(format!(
            "Frames with a smooth transition take {least:.3} to {most:.3} times as long as those without; the paper has them \
             equal."
        ))
    })?;
    Ok(part)
}

/// Levels of detail in the making, and frames by them over tolerances.
///
/// # Errors
/// Whatever goes wrong; a model that is no mesh.
pub fn levels(session: &mut Session<'_>) -> Result<Part> {
    let (mut part, drawn) = of_bench(session, "p2", |report| {
        let report = report.p2.as_ref()?;
        let pixel = report.rows.iter().find(|own| own.subject.tau_px == 1.0)?;
        let share = pixel.subject.drawn as f64 / report.rows.first()?.subject.drawn as f64;
        Some(format!(
            "At a pixel {:.0}% of the splats are drawn in {:.2} times the time of all; the paper draws half of David at 0.01% of the window.",
            100.0 * share,
            pixel.beside_first?.median
        ))
    })?;
    let (made, _) = of_bench(session, "p1", |_| None)?;
    let made = part.go_on_with(made);
    part.data = vec![to_value(&drawn.p2)?, made].into();
    Ok(part)
}

/// A mesh from afar to near: as polygons, as polygons and splats in levels of detail, and as splats. The paper's claim: as fast as splats from afar, as good as polygons near.
///
/// # Errors
/// Whatever goes wrong; a model that is no mesh.
pub fn hybrid(session: &mut Session<'_>) -> Result<Part> {
    let (part, _) = of_bench(session, "hybrid", |report| {
        let views = &report.hybrid.as_ref()?.views;
        let of = |own: &HybridView| Some((own.zoom, own.ways.get(1)?.beside_first?.median));
        let (far, near) = (of(views.first()?)?, of(views.last()?)?);
        Some(format!(
            "A hybrid takes {:.2} times as long as polygons where the model is {} times as large as the view, and {:.2} times where it is {} times.",
            far.1, far.0, near.1, near.0
        ))
    })?;
    Ok(part)
}

/// What clip curves cost: the tables of Ivo et al. 2012 beside this device, of the built-in part or a mesh.
///
/// # Errors
/// Whatever goes wrong; a model that is no mesh.
pub fn clips(session: &mut Session<'_>) -> Result<Part> {
    let (mut part, over_splats) = of_bench(session, "i1", |report| {
        let rows = report.i1.as_ref()?.rows.iter();
        let (least, most) = ends(rows.filter_map(|row| Some(row.ways.last()?.beside_first?.median)))?;
        Some(format!(
            "Splats cut by curves take {least:.2} to {most:.2} times as long as the same that nothing cuts."
        ))
    })?;
    let (over_occupancy, _) = of_bench(session, "i2", |_| None)?;
    let over_occupancy = part.go_on_with(over_occupancy);
    let mut data = vec![to_value(&over_splats.i1)?, over_occupancy];
    // Its largest mesh takes what a quick report has for all.
    if !session.arguments.quick {
        let (making, report) = of_bench(session, "i3", |_| None)?;
        data.push(part.go_on_with(making));
        if let Some(made) = &report.i3 {
            part.blocks.push(Block::Plot {
                svg: conversion_plot(made).svg(PLOT_SIZE_PX)?,
                alt: "seconds over triangles of a mesh that becomes splats, both logarithmic".to_owned(),
                caption: "Seconds from a mesh to its clipped splats, beside what the first time would grow to by n log n."
                    .to_owned(),
            });
        }
    }
    part.data = data.into();
    Ok(part)
}

/// The instructions of every pipeline, beside the papers'.
pub fn counts(session: &mut Session<'_>) -> Result<Part> {
    let (part, _) = of_bench(session, "counts", |_| {
        let finding = "The papers' own programs come out as published, but for 1 or 2 instructions; ours have more, which is \
                       what keeps hard splats right.";
        Some(finding.to_owned())
    })?;
    Ok(part)
}
