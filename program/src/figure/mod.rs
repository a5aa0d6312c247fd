//! `surfel figure`: the papers' figures as labeled pictures.
//!
//! Figures of a kind share a file. Comparisons are panels on a `sheet`, written as PNG; curves are plots, written as SVG. Whatever is
//! shown was drawn by the device: curves of kernels are weights that it has written, no formulas.

mod arguments;
mod boards;
mod clips;
mod coarse;
mod context;
mod curves;
mod footprint;
mod g1;
mod g5;
mod glass;
mod kernels;
mod p17;
mod p19;
mod p20;
mod raster;
mod samples;
mod sheet;

use std::path::Path;

use surfel::{Error, Result, renderer::Headless, report::Plot, save};

pub use arguments::{Figure, FigureArguments};
pub use sheet::{Panel, Sheet};

use crate::{
    console::{self, Bars},
    outputs,
};
use context::FigureContext;

/// A figure before it is a file.
pub enum Drawing {
    /// Pictures side by side.
    Sheet(Sheet),
    /// Curves.
    Plot(Plot),
}

/// Runs the subcommand.
///
/// # Errors
/// Whatever goes wrong; what can be known before the device is opened is found before it.
pub fn run(arguments: &FigureArguments) -> Result<()> {
    let Some(figure) = arguments.name else { return console::print(&Figure::list()) };
    let output = arguments.output(figure)?;
    let size_px = arguments.size_px(figure)?;
    if arguments.model.is_some() && !figure.takes_model() {
        let problem =
            format!("{} has a scene of its own; expected g5, p17, p19, p20, i1, i9 or i10", figure.name());
        return Err(Error::option("--model", problem));
    }
    outputs::check_places([&output], None, &[], &arguments.model)?;
    arguments.device.watch(arguments.device.open()?, |headless| {
        write(&draw(headless, &Bars::new(), arguments, figure)?, &output, size_px)
    })
}

/// Draws a figure.
///
/// # Errors
/// A size out of range; whatever goes wrong with the device.
pub fn draw(
    headless: &mut Headless,
    bars: &Bars,
    arguments: &FigureArguments,
    figure: Figure,
) -> Result<Drawing> {
    let size_px = arguments.size_px(figure)?;
    let mut context = FigureContext { headless, bars, size_px, model: arguments.model.as_deref() };
    let drawn = match figure {
        Figure::G1 => g1::draw(&mut context).map(Drawing::Sheet),
        Figure::G3 => boards::g3(&mut context).map(Drawing::Sheet),
        Figure::G4 => boards::g4(&mut context).map(Drawing::Sheet),
        Figure::G5 => g5::draw(&mut context).map(Drawing::Sheet),
        Figure::G6 => glass::g6(&mut context).map(Drawing::Sheet),
        Figure::Slides => glass::slides(&mut context).map(Drawing::Sheet),
        Figure::P9 => kernels::p9(&mut context).map(Drawing::Plot),
        Figure::P10 => kernels::p10(&mut context).map(Drawing::Plot),
        Figure::P17 => p17::draw(&mut context).map(Drawing::Sheet),
        Figure::P18 => boards::p18(&mut context).map(Drawing::Sheet),
        Figure::P19 => p19::draw(&mut context).map(Drawing::Sheet),
        Figure::P20 => p20::draw(&mut context).map(Drawing::Sheet),
        Figure::I1 => clips::i1(&mut context).map(Drawing::Sheet),
        Figure::I3 => curves::i3(&mut context).map(Drawing::Sheet),
        Figure::I5 => curves::i5(&mut context).map(Drawing::Sheet),
        Figure::I7 => curves::i7(&mut context).map(Drawing::Sheet),
        Figure::I9 => clips::i9(&mut context).map(Drawing::Sheet),
        Figure::I10 => clips::i10(&mut context).map(Drawing::Sheet),
        Figure::I11 => clips::i11(&mut context).map(Drawing::Sheet),
        Figure::Samples => samples::draw(&mut context).map(Drawing::Plot),
    };
    bars.clear();
    drawn
}

fn write(drawn: &Drawing, output: &Path, size_px: [u32; 2]) -> Result<()> {
    let [width, height] = match drawn {
        Drawing::Sheet(sheet) => {
            let raster = sheet.draw()?;
            save::png(output, raster.size_px, 3, raster.pixels.as_flattened())?;
            raster.size_px
        }
        Drawing::Plot(plot) => {
            save::text(output, &plot.svg(size_px)?)?;
            size_px
        }
    };
    console::say(&format!("wrote {}, {width}x{height} pixels", output.display()));
    Ok(())
}
