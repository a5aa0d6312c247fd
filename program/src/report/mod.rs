//! `surfel report`: pictures, tables and plots of one device on one page.
//!
//! One file a part, which gathers it and says what one sees; [`CHAPTERS`] lists them in the page's order: a new part is a
//! file and a line there. What a part shows is what its command lines give by themselves: they are parsed for it, and
//! printed in it.

mod arguments;
mod benches;
mod command_line;
mod comparison;
mod distance;
mod figures;
mod head;
mod methods;
mod page;
mod part;
mod pictures;
mod session;
mod stability;

use std::{collections::BTreeMap, fs};

use serde::Serialize;
use serde_json::Value;
use surfel::{Error, ErrorKind, Result, renderer::Headless, report::bench::Machine, save};

pub use arguments::ReportArguments;

use crate::{
    camera::CameraChoice,
    compare::{self, CompareArguments},
    console::{self, Bars},
    inputs::Inputs,
    json::to_json,
    outputs,
    scene::load_scene,
};
use head::Head;
use part::Part;
use session::Session;

/// A part of the page: its name in links and in the JSON, its heading, and what gathers it.
type Chapter = (&'static str, &'static str, fn(&mut Session<'_>) -> Result<Part>);

/// The parts of the page.
const CHAPTERS: &[Chapter] = &[
    ("pictures", "Pictures", pictures::gather),
    ("methods", "Methods: speed against error", methods::gather),
    ("distance", "Filters over distance", distance::gather),
    ("figures", "The papers' figures", figures::gather),
    ("bench", "What frames cost", benches::floor),
    ("tables", "The paper's tables", benches::tables),
    ("layers", "Transparent layers", benches::layers),
    ("transition", "From splats to polygons", benches::transition),
    ("levels", "Levels of detail", benches::levels),
    ("hybrid", "Polygons near, splats far", benches::hybrid),
    ("clips", "Clip curves", benches::clips),
    ("counts", "Instructions", benches::counts),
    ("stability", "Numerical stability", stability::gather),
];

/// The files in the folder.
const FILES: [&str; 2] = ["index.html", "report.json"];

/// All figures of the page.
#[derive(Serialize)]
struct Data<'a> {
    head: &'a Head,
    flags: BTreeMap<&'a str, &'a [String]>,
    machine: BTreeMap<&'a str, &'a Machine>,
    parts: BTreeMap<&'a str, &'a Value>,
}

/// Runs the subcommand.
///
/// # Errors
/// Whatever goes wrong; a part that does not exist on this device or for this model says so on the page instead.
pub fn run(arguments: &ReportArguments) -> Result<()> {
    outputs::check_places([], Some(&arguments.output), &FILES, &arguments.model)?;
    arguments.device.watch(arguments.device.open()?, |headless| make(headless, arguments))
}

fn make(headless: &mut Headless, arguments: &ReportArguments) -> Result<()> {
    check_sizes(headless, arguments)?;
    let bars = Bars::new();
    let inputs: Vec<_> = arguments.model.iter().cloned().collect();
    let loaded = load_scene(&Inputs::splats_of(inputs), &bars)?;
    let camera = CameraChoice::none().camera(&loaded, arguments.size_px())?;
    let head = Head::of(headless.device().facts(), arguments, &loaded);
    let (loaded, camera, bars) = (&loaded, &camera, &bars);
    let mut session = Session { headless, arguments, loaded, camera, bars, comparison: None };
    let mut parts = Vec::new();
    for (number, (id, title, gather)) in CHAPTERS.iter().enumerate() {
        console::say(&format!("part {} of {}: {title}", number + 1, CHAPTERS.len()));
        let gathered = gather(&mut session);
        bars.clear();
        let part = match gathered {
            // The input or an option, or too little memory for what this part draws: other parts may do without it.
            Err(error) if error.exit_code() == 1 || matches!(error.kind(), ErrorKind::Memory { .. }) => {
                console::say(&format!("{title}: {error}"));
                Part::missing(&error)
            }
            gathered => gathered?,
        };
        parts.push(Part { id, title, ..part });
    }
    write(arguments, &head, &parts)
}

/// Refuses sizes that only a later part would find too large.
fn check_sizes(headless: &Headless, arguments: &ReportArguments) -> Result<()> {
    let arguments: CompareArguments = arguments.compare().arguments()?;
    arguments.settings().validate()?;
    compare::timed_settings(headless, &arguments).map(|_| ())
}

/// The page last: where it is, all is.
fn write(arguments: &ReportArguments, head: &Head, parts: &[Part]) -> Result<()> {
    let data = Data {
        head,
        flags: parts.iter().map(|part| (part.id, part.flags.as_slice())).collect(),
        machine: parts.iter().filter_map(|part| Some((part.id, part.machine.as_ref()?))).collect(),
        parts: parts.iter().map(|part| (part.id, &part.data)).collect(),
    };
    let [page, json] = FILES.map(|name| arguments.output.join(name));
    let texts = [page::html(head, parts), to_json(&data)?];
    fs::create_dir_all(&arguments.output).map_err(|e| Error::file(&arguments.output, "write", e))?;
    save::text(&json, &texts[1])?;
    save::text(&page, &texts[0])?;
    let megabytes = texts[0].len() as f64 * 1e-6;
    console::say(&format!("wrote {}, {megabytes:.1} MB, and {}", page.display(), json.display()));
    Ok(())
}
