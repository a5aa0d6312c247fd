//! The methods side by side, for the parts that show them.

use surfel::{
    Result,
    renderer::Headless,
    report::{
        bench::{Machine, TrustLimits, spread_flag},
        compare::{CompareReport, Method, MethodRow},
    },
    scene::{Accumulate, Camera, Rasterizer, Settings},
};

use super::{arguments::ReportArguments, command_line::CommandLine, part::Panel};
use crate::{
    compare::{self, BACKGROUND, CompareArguments, MAGNIFIED, Shown, difference},
    console::Bars,
    machine::Watch,
    scene::Loaded,
};

/// The compared methods.
pub struct Comparison {
    /// The command line that gives the same.
    pub line: CommandLine,
    /// The figures.
    pub report: CompareReport,
    /// The machine meanwhile.
    pub machine: Machine,
    /// The reasons to doubt the times.
    pub flags: Vec<String>,
    /// The picture that all filters aim at.
    pub truth: Option<Panel>,
    /// The pictures of methods that differ from the default in filter or rasterizer, and their distances from the truth.
    pub pictures: Vec<[Panel; 2]>,
}

/// Compares the methods, with an eye on the machine.
pub fn gather(
    headless: &mut Headless,
    arguments: &ReportArguments,
    (loaded, camera): (&Loaded, &Camera),
    bars: &Bars,
) -> Result<Comparison> {
    let line = arguments.compare();
    let compare: CompareArguments = line.arguments()?;
    let mut truth = None;
    let mut pictures = Vec::new();
    let mut show = |shown: Shown<'_>| {
        match shown {
            Shown::Truth(surface) => {
                let caption = "what every filter aims at";
                let pixels = surface.srgb_over(BACKGROUND);
                truth = Some(Panel::new("ground truth", caption, "The model", surface.size_px, &pixels)?);
            }
            Shown::Method { method, drawn, truth: exact, .. } if is_shown(method) => {
                let name = format!("{}, {}", method.rasterizer.name(), method.filter);
                let (size_px, pixels) = (drawn.size_px, drawn.srgb_over(BACKGROUND));
                let caption = format!("from the ground truth, {MAGNIFIED} times");
                let far = Panel::new("difference", caption, &name, size_px, &difference(drawn, exact))?;
                pictures.push([Panel::new(name, "", "The model", size_px, &pixels)?, far]);
            }
            Shown::Method { .. } => {}
        }
        Ok(())
    };
    let device = headless.device().clone();
    let watch = Watch::begin(device.facts());
    let report = compare::gather(headless, &compare, loaded, camera, bars, &mut show)?;
    let machine = watch.end(&[]);
    let limits = TrustLimits::default();
    let mut flags = machine.flags(&limits);
    if arguments.device.validate {
        flags.push("measured under validation: the times are worthless".to_owned());
    }
    let spread = |row: &MethodRow| spread_flag(&row.method.to_string(), row.frame_ms.as_ref(), &limits);
    flags.extend(shortened(report.methods.iter().filter_map(spread).collect()));
    let own = |row: &MethodRow| row.flags.iter().map(|flag| format!("{}: {flag}", row.method)).collect();
    let own: Vec<Vec<String>> = report.methods.iter().map(own).collect();
    flags.extend(shortened(own.concat()));
    Ok(Comparison { line, report, machine, flags, truth, pictures })
}

/// Whether a method differs from the default in its filter or its rasterizer alone.
fn is_shown(method: &Method) -> bool {
    // The first that is compared of each.
    let accumulate = Accumulate::PRECISIONS[0].1;
    let default = Settings { rasterizer: Rasterizer::Perspective, accumulate, ..Settings::default() };
    let own = method.settings(&default);
    let with_filter = Settings { filter: own.filter, ..default.clone() };
    let with_rasterizer = Settings { rasterizer: own.rasterizer, ..default };
    own == with_filter || own == with_rasterizer
}

/// The sentences of a flag that many rows have: all of a few, else the first with how many more there are.
fn shortened(flags: Vec<String>) -> Vec<String> {
    const FEW: usize = 3;
    match flags.as_slice() {
        [first, others @ ..] if others.len() >= FEW => {
            vec![format!("{first}; and {} more like this one", others.len())]
        }
        _ => flags,
    }
}
