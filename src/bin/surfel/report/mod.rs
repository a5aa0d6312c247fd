//! `surfel report`: pictures, tables and plots of one device on one page.
//!
//! One file a part, which gathers it and says what one sees; [`CHAPTERS`] lists them in the page's order: a new part is a
//! file and a line there. What a part shows is what its command lines give by themselves: they are parsed for it, and
//! printed in it.

mod arguments;
mod bench;
mod cells;
mod command_line;
mod comparison;
mod counts;
mod distance;
mod figures;
mod head;
mod layers;
mod markdown;
mod methods;
mod page;
mod part;
mod pictures;
mod session;
mod stability;
mod table1;
mod transition;

use std::{collections::BTreeMap, fs};

use serde::Serialize;
use serde_json::Value;
use surfel::{Error, ErrorKind, Result, load::Representation, renderer::Headless, report::Machine, save};

pub use arguments::ReportArguments;

use crate::{
    camera::CameraChoice,
    compare::{self, CompareArguments},
    console::{self, Bars},
    json::to_json,
    outputs,
    scene::load_scene,
    steps::Steps,
};
use head::Head;
use part::{Chapter, Part};
use session::Session;

/// The parts of the page.
const CHAPTERS: &[Chapter] = &[
    Chapter { id: "pictures", title: "Pictures", gather: pictures::gather },
    Chapter { id: "methods", title: "Methods: speed against error", gather: methods::gather },
    Chapter { id: "distance", title: "Filters over distance", gather: distance::gather },
    Chapter { id: "figures", title: "The papers' figures", gather: figures::gather },
    Chapter { id: "bench", title: "What frames cost", gather: bench::gather },
    Chapter { id: "tables", title: "The paper's tables", gather: table1::gather },
    Chapter { id: "layers", title: "Transparent layers", gather: layers::gather },
    Chapter { id: "transition", title: "From splats to polygons", gather: transition::gather },
    Chapter { id: "counts", title: "Instructions", gather: counts::gather },
    Chapter { id: "stability", title: "Numerical stability", gather: stability::gather },
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
    let inputs: Vec<_> = arguments.model.iter().cloned().collect();
    let in_the_way: Vec<_> = outputs::paths(&inputs).collect();
    outputs::check_places(&[], Some(&arguments.output), &FILES, &in_the_way)?;
    arguments.device.watch(arguments.device.open()?, |headless| make(headless, arguments))
}

fn make(mut headless: Headless, arguments: &ReportArguments) -> Result<()> {
    check_sizes(&headless, arguments)?;
    let bars = Bars::new();
    let inputs: Vec<_> = arguments.model.iter().cloned().collect();
    let loaded = load_scene(&inputs, Representation::Splats, &bars, &mut Steps::default())?;
    let camera = CameraChoice::none().camera(&loaded, arguments.size_px())?;
    let head = Head::of(headless.device().facts(), arguments, &loaded);
    let mut session = Session::new(&mut headless, arguments, &loaded, &camera, &bars);
    let mut parts = Vec::new();
    for (number, chapter) in CHAPTERS.iter().enumerate() {
        console::say(&format!("part {} of {}: {}", number + 1, CHAPTERS.len(), chapter.title));
        let gathered = (chapter.gather)(&mut session);
        bars.clear();
        parts.push(match gathered {
            // The input or an option, or too little memory for what this part draws: other parts may do without it.
            Err(error) if error.exit_code() == 1 || matches!(error.kind(), ErrorKind::Memory { .. }) => {
                console::say(&format!("{}: {error}", chapter.title));
                Part::missing(&error)
            }
            gathered => gathered?,
        });
    }
    write(arguments, &head, &parts)?;
    // A lost cache costs the next run some time, that is all.
    let _ = headless.renderer.shaders.save_cache();
    Ok(())
}

/// Refuses sizes that only a later part would find too large.
fn check_sizes(headless: &Headless, arguments: &ReportArguments) -> Result<()> {
    let arguments: CompareArguments = arguments.compare().arguments()?;
    arguments.settings().validate()?;
    compare::timed_settings(headless, &arguments).map(|_| ())
}

/// The page last: where it is, all is.
fn write(arguments: &ReportArguments, head: &Head, parts: &[Part]) -> Result<()> {
    let both = || CHAPTERS.iter().zip(parts);
    let data = Data {
        head,
        flags: both().map(|(chapter, part)| (chapter.id, part.flags.as_slice())).collect(),
        machine: both().filter_map(|(chapter, part)| Some((chapter.id, part.machine.as_ref()?))).collect(),
        parts: both().map(|(chapter, part)| (chapter.id, &part.data)).collect(),
    };
    let [page, json] = FILES.map(|name| arguments.output.join(name));
    let texts = [page::html(head, CHAPTERS, parts), to_json(&data)?];
    fs::create_dir_all(&arguments.output).map_err(|e| Error::file(&arguments.output, "write", e))?;
    save::text(&json, &texts[1])?;
    save::text(&page, &texts[0])?;
    let megabytes = texts[0].len() as f64 * 1e-6;
    console::say(&format!("wrote {}, {megabytes:.1} MB, and {}", page.display(), json.display()));
    Ok(())
}
