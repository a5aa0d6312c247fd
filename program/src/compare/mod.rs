//! `surfel compare`: methods side by side, each with its speed and its errors.

mod arguments;
mod candidates;
mod context;
mod methods;
mod pictures;
mod zoom;

use std::fmt::Display;

use serde::Serialize;
use surfel::{
    Result,
    renderer::Headless,
    report::{PLOT_SIZE_PX, Plot},
    save,
    scene::Budget,
};

pub use arguments::CompareArguments;
pub use methods::{gather, timed_settings};
pub use pictures::{BACKGROUND, MAGNIFIED, Shown, difference};
pub use zoom::gather as gather_zoom;

use crate::{
    camera::CameraChoice,
    console::{self, Bars},
    json::write_json,
    outputs,
    scene::load_scene,
    unused,
};

/// Runs the subcommand.
///
/// # Errors
/// Whatever goes wrong; a method that fails is listed with the reason unless none is left.
pub fn run(arguments: &CompareArguments) -> Result<()> {
    let base = arguments.settings();
    base.validate()?;
    check_outputs(arguments)?;
    arguments.device.watch(arguments.device.open()?, |headless| match arguments.zoom {
        true => over_distance(headless, arguments),
        false => compare(headless, arguments),
    })
}

fn check_outputs(arguments: &CompareArguments) -> Result<()> {
    let CompareArguments { input, camera, json, plot, pictures, .. } = arguments;
    plot.iter().try_for_each(|path| outputs::check_name("--plot", path, &["svg"]))?;
    let inputs = input.inputs.iter().chain(&camera.camera);
    outputs::check_places([json, plot].into_iter().flatten(), pictures.as_deref(), &[], inputs)
}

fn compare(headless: &mut Headless, arguments: &CompareArguments) -> Result<()> {
    timed_settings(headless, arguments)?; // before anything takes long
    let choice = CameraChoice::of(&arguments.camera)?;
    let bars = Bars::new();
    let mut loaded = load_scene(&arguments.input.as_splats(), &bars)?;
    if unused::is_triangles(&loaded) {
        console::say(
            "what is compared is how splats are drawn, and this scene is drawn as triangles; --representation splats draws it as splats",
        );
    }
    loaded.scene.levels = arguments.settings().wants_levels();
    loaded.scene.budget = arguments.settings().budget != Budget::Unlimited;
    let camera = choice.camera(&loaded, arguments.settings().size_px)?;
    let mut show = |shown: Shown<'_>| match &arguments.pictures {
        Some(folder) => pictures::write(folder, &shown),
        None => Ok(()),
    };
    let report = gather(headless, arguments, &loaded, &camera, &bars, &mut show)?;
    tell(arguments, &report, &report.plot())
}

fn over_distance(headless: &mut Headless, arguments: &CompareArguments) -> Result<()> {
    let report = gather_zoom(headless, arguments, &Bars::new())?;
    tell(arguments, &report, &report.plot())
}

/// Prints what was found, and writes what is asked for.
fn tell<R: Display + Serialize>(arguments: &CompareArguments, report: &R, plot: &Plot) -> Result<()> {
    console::print(&report.to_string())?;
    write_json(arguments.json.as_deref(), report)?;
    match &arguments.plot {
        Some(path) => save::text(path, &plot.svg(PLOT_SIZE_PX)?),
        None => Ok(()),
    }
}
