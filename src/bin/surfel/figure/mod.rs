//! `surfel figure`: the papers' figures as labeled pictures.
//!
//! One file a figure. Comparisons are panels on a `sheet`, written as PNG; curves are plots, written as SVG. Whatever is
//! shown was drawn by the device: curves of kernels are weights that it has written, no formulas.

mod arguments;
mod boards;
mod easel;
mod footprint;
mod g1;
mod g3;
mod g4;
mod g5;
mod g6;
mod glass;
mod kernels;
mod p10;
mod p18;
mod p19;
mod p9;
mod raster;
mod sheet;
mod slides;

use std::path::Path;

use surfel::{Error, Result, renderer::Headless, report::curves::CurvePlot, save};

pub use arguments::{Figure, FigureArguments};
pub use sheet::{Panel, Sheet};

use crate::{
    console::{self, Bars},
    outputs,
};
use easel::Easel;

/// What a figure is before it is a file.
pub enum Drawn {
    /// Pictures side by side.
    Sheet(Sheet),
    /// Curves.
    Plot(CurvePlot),
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
        let problem = format!("{} has a scene of its own; expected g5 or p19", figure.name());
        return Err(Error::option("--model", problem));
    }
    let inputs: Vec<&Path> = arguments.model.as_deref().into_iter().collect();
    outputs::check_places(&[&output], None, &[], &inputs)?;
    arguments.device.watch(arguments.device.open()?, |headless| {
        write(&draw_once(headless, arguments, figure)?, &output, size_px)
    })
}

fn draw_once(mut headless: Headless, arguments: &FigureArguments, figure: Figure) -> Result<Drawn> {
    let drawn = draw(&mut headless, &Bars::new(), arguments, figure);
    // A lost cache costs the next run some time, that is all.
    let _ = headless.renderer.shaders.save_cache();
    drawn
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
) -> Result<Drawn> {
    let size_px = arguments.size_px(figure)?;
    let mut easel = Easel { headless, bars, size_px, model: arguments.model.as_deref() };
    let drawn = match figure {
        Figure::G1 => g1::draw(&mut easel).map(Drawn::Sheet),
        Figure::G3 => g3::draw(&mut easel).map(Drawn::Sheet),
        Figure::G4 => g4::draw(&mut easel).map(Drawn::Sheet),
        Figure::G5 => g5::draw(&mut easel).map(Drawn::Sheet),
        Figure::G6 => g6::draw(&mut easel).map(Drawn::Sheet),
        Figure::Slides => slides::draw(&mut easel).map(Drawn::Sheet),
        Figure::P9 => p9::draw(&mut easel).map(Drawn::Plot),
        Figure::P10 => p10::draw(&mut easel).map(Drawn::Plot),
        Figure::P18 => p18::draw(&mut easel).map(Drawn::Sheet),
        Figure::P19 => p19::draw(&mut easel).map(Drawn::Sheet),
    };
    bars.clear();
    drawn
}

fn write(drawn: &Drawn, output: &Path, size_px: [u32; 2]) -> Result<()> {
    let [width, height] = match drawn {
        Drawn::Sheet(sheet) => {
            let raster = sheet.draw()?;
            save::png(output, raster.size_px, 3, raster.pixels.as_flattened())?;
            raster.size_px
        }
        Drawn::Plot(plot) => {
            save::text(output, &plot.svg(size_px)?)?;
            size_px
        }
    };
    console::say(&format!("wrote {}, {width}x{height} pixels", output.display()));
    Ok(())
}
