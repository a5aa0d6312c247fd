//! The methods side by side, for the parts that show them.

use surfel::{
    Result,
    report::{
        Machine, TrustLimits,
        compare::{CompareReport, Method, MethodRow},
        spread_flag,
    },
    scene::{Rasterizer, Settings},
};

use super::{
    command_line::CommandLine,
    part::Panel,
    session::{Session, shortened},
};
use crate::compare::{self, BACKGROUND, CompareArguments, MAGNIFIED, Shown, difference};

/// What was compared.
pub struct Comparison {
    /// What to type for the same.
    pub line: CommandLine,
    /// The figures.
    pub report: CompareReport,
    /// The machine meanwhile.
    pub machine: Machine,
    /// What makes the times doubtful.
    pub flags: Vec<String>,
    /// What all filters aim at.
    pub truth: Option<Panel>,
    /// Methods that differ from the default in filter or rasterizer.
    pub pictures: Vec<MethodPicture>,
}

/// What a method draws.
pub struct MethodPicture {
    /// Its picture.
    pub drawn: Panel,
    /// How far that is from the truth.
    pub difference: Panel,
}

/// Compares the methods.
///
/// # Errors
/// As [`compare::gather`].
pub fn gather(session: &mut Session<'_>) -> Result<Comparison> {
    let line = session.arguments.compare();
    let arguments: CompareArguments = line.arguments()?;
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
                let names = method.names();
                let name = format!("{}, {}", names.rasterizer, names.filter_and_weight());
                let (size_px, pixels) = (drawn.size_px, drawn.srgb_over(BACKGROUND));
                let far = difference(drawn, exact);
                let caption = format!("from the ground truth, {MAGNIFIED} times");
                pictures.push(MethodPicture {
                    difference: Panel::new("difference", caption, &name, size_px, &far)?,
                    drawn: Panel::new(name, "", "The model", size_px, &pixels)?,
                });
            }
            Shown::Method { .. } => {}
        }
        Ok(())
    };
    let (report, machine, mut flags) = session.watched(|session| {
        let Session { headless, loaded, camera, bars, .. } = session;
        compare::gather(headless, &arguments, loaded, camera, bars, &mut show)
    })?;
    flags.extend(doubts(&report));
    Ok(Comparison { line, report, machine, flags, truth, pictures })
}

impl Comparison {
    /// How it was measured.
    pub fn text(&self) -> String {
        let report = &self.report;
        let [[width, height], [error_width, error_height]] = [report.time_size_px, report.error_size_px];
        format!(
            "Times and fragments at {width}x{height} pixels, {} frames of each method, the methods in turn; errors at \
             {error_width}x{error_height} pixels, against a ground truth of {} samples a pixel.",
            report.timed_frames,
            u64::from(report.samples_per_side).pow(2)
        )
    }
}

/// Whether a method differs from the default in its filter or its rasterizer alone.
fn is_shown(method: &Method) -> bool {
    let default = Settings { rasterizer: Rasterizer::Perspective, ..Settings::default() };
    let own = method.settings(&default);
    let with_filter = Settings { filter: own.filter, ..default.clone() };
    let with_rasterizer = Settings { rasterizer: own.rasterizer, ..default };
    own == with_filter || own == with_rasterizer
}

/// What is odd about the methods' times.
fn doubts(report: &CompareReport) -> Vec<String> {
    let limits = TrustLimits::default();
    let spread = |row: &MethodRow| spread_flag(&row.method.line(), row.frame_ms.as_ref(), &limits);
    let own =
        |row: &MethodRow| row.flags.iter().map(|flag| format!("{}: {flag}", row.method.line())).collect();
    let spreads = shortened(report.methods.iter().filter_map(spread).collect());
    let own: Vec<Vec<String>> = report.methods.iter().map(own).collect();
    spreads.into_iter().chain(shortened(own.concat())).collect()
}
