//! `surfel report`: one page that loads nothing, whatever it shows. Small pictures of a small model.

use std::fs;

use super::{
    program::{Folder, Run, surfel},
    splats,
};

/// The parts of the page, by their names in links and in the JSON.
const PARTS: [(&str, &str); 13] = [
    ("pictures", "Pictures"),
    ("methods", "Methods: speed against error"),
    ("distance", "Filters over distance"),
    ("figures", "The papers' figures"),
    ("bench", "What frames cost"),
    ("tables", "The paper's tables"),
    ("layers", "Transparent layers"),
    ("transition", "From splats to polygons"),
    ("levels", "Levels of detail"),
    ("hybrid", "Polygons near, splats far"),
    ("clips", "Clip curves"),
    ("counts", "Instructions"),
    ("stability", "Numerical stability"),
];

/// Elements of HTML without an end.
const VOID: [&str; 3] = ["meta", "img", "br"];

/// A board of disks, in a file whose name would be markup.
const MODEL: &str = "<b>&\"`a.ply";

fn folder() -> Folder {
    let folder = Folder::new();
    let line = |i: i32| {
        let (x, y) = (0.1 * f64::from(i % 16), 0.1 * f64::from(i / 16));
        format!("{x} {y} 0 0 0 1 0.12 {} 0 255\n", i % 256)
    };
    folder.write(MODEL, splats(&(0..256).map(line).collect::<String>()));
    folder
}

fn report(folder: &Folder, words: &[&str]) -> Run {
    let small = ["--quick", "--size", "32x32", "--samples", "2", "--frames", "2", "--zoom-steps", "2"];
    surfel(folder, &[&["report", "--model", MODEL], &small[..], words].concat())
}

/// A tag of the page: its name, and its text from the name on.
struct Tag<'a> {
    name: &'a str,
    text: &'a str,
}

impl<'a> Tag<'a> {
    /// The value of an attribute.
    fn value(&self, attribute: &str) -> Option<&'a str> {
        let (_, rest) = self.text.split_once(&format!(" {attribute}=\""))?;
        rest.split_once('"').map(|(value, _)| value)
    }
}

/// Every tag that begins an element; fails unless each element ends where it should.
fn elements(page: &str) -> Vec<Tag<'_>> {
    let (mut found, mut open) = (Vec::new(), Vec::new());
    let mut rest = page.strip_prefix("<!DOCTYPE html>").expect("a page of HTML");
    while let Some((_, tag)) = rest.split_once('<') {
        let (text, after) = tag.split_once('>').expect("a tag ends");
        rest = after;
        if let Some(name) = text.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "in {} elements", open.len());
            continue;
        }
        let name = text.split([' ', '/']).next().unwrap();
        if !VOID.contains(&name) && !text.ends_with('/') {
            open.push(name);
        }
        found.push(Tag { name, text });
    }
    assert!(open.is_empty(), "{open:?} are left open");
    found
}

#[test]
fn the_page_has_every_part_is_well_formed_and_loads_nothing() {
    let folder = folder();
    let run = report(&folder, &["-o", "new/folder", "--validate"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.contains("validation: no message"), "{}", run.stderr);
    assert_eq!(folder.names_in("new/folder"), ["index.html", "report.json"]);
    let page = fs::read_to_string(folder.path("new/folder/index.html")).unwrap();
    let elements = elements(&page);
    for element in &elements {
        for attribute in ["src", "href", "srcset", "data", "action", "xlink:href"] {
            if let Some(value) = element.value(attribute) {
                assert!(value.starts_with('#') || value.starts_with("data:image/png;base64,"), "{value:.60}");
            }
        }
        assert!(!["script", "link", "iframe", "object"].contains(&element.name), "{}", element.name);
    }
    assert!(!page.contains("url(") && !page.contains("@import"));
    let of = |name: &str| elements.iter().filter(move |element| element.name == name).collect::<Vec<_>>();
    // Three shadings, the truth, thirteen methods with their differences, panels of the papers' figures.
    assert_eq!(of("img").len(), 3 + 1 + 2 * 13 + 15 + 4 + 3 + 4 + 4 + 6 + 3 + 3);
    assert!(of("img").iter().all(|image| image.value("alt").is_some_and(|alt| alt.len() > 5)));
    assert_eq!(of("svg").len(), 4, "speed against error, error over distance, two plots of kernels");
    assert!(of("svg").iter().all(|plot| plot.value("aria-label").is_some_and(|alt| alt.len() > 20)));
    // Costs, errors of the picture, of the method, and of the implementation; three over distance; the floor, limits, bounds; layers, and an empty one; instructions; five of stability. A
    // file of splats has neither table 1 nor halves.
    assert_eq!(of("table").len(), 4 + 3 + 3 + 2 + 1 + 5);
    assert!(page.contains("Not on this page: ") && page.contains("the file holds splats"));
    for (id, title) in PARTS {
        assert!(page.contains(&format!("<section id=\"{id}\"><h2>{title}</h2>")), "{id}");
        assert!(page.contains(&format!("<a href=\"#{id}\">{title}")), "{id}");
    }
    // What is named by others is text, not markup.
    assert!(page.contains("&lt;b&gt;&amp;") && !page.contains("<b>&"), "the model's name");
    assert!(page.contains("the times are worthless"), "timed under validation");
    assert!(page.contains("surfel compare '&lt;b&gt;"), "how to repeat it");

    let json = folder.json("new/folder/report.json");
    assert_eq!(json["head"]["surfel"], env!("CARGO_PKG_VERSION"));
    for part in ["methods", "bench", "layers"] {
        let flags = json["flags"][part].as_array().unwrap();
        assert!(flags.iter().any(|flag| flag.as_str().unwrap().contains("validation")), "{part}: {flags:?}");
    }
    let parts = &json["parts"];
    assert_eq!(parts["methods"]["methods"].as_array().map(Vec::len), Some(15));
    assert_eq!(parts["distance"]["steps"].as_array().map(Vec::len), Some(2));
    assert_eq!(parts["bench"]["floor"]["rows"].as_array().map(Vec::len), Some(4));
    assert!(json["machine"]["bench"]["threads"].as_u64() > Some(0));
}

#[test]
fn faults_are_found_before_the_long_work_and_leave_nothing() {
    let folder = folder();
    folder.write("file", "");
    let before = folder.names();
    let cases: [(&[&str], &str); 6] = [
        (&["-o", "file"], "file"),
        (&["-o", "file/below"], "file/below"),
        (&["--size", "0x5"], "--size"),
        (&["--size", "9999999x9999999"], "--size"),
        (&["--samples", "257"], "--samples"),
        (&["--device", "no such device"], "no such device"),
    ];
    for (words, expected) in cases {
        let all = [&["report", "--model", MODEL], words].concat();
        let run = surfel(&folder, &all);
        let said = run.stderr.lines().filter(|line| line.starts_with("surfel: ")).count();
        assert_eq!((run.code, said, run.stdout.as_str()), (1, 1, ""), "{words:?}: {}", run.stderr);
        assert!(run.stderr.contains(expected) && !run.stderr.contains("part 1"), "{words:?}: {}", run.stderr);
    }
    let missing = surfel(&folder, &["report", "--model", "missing.ply"]);
    assert_eq!((missing.code, missing.stderr.lines().count()), (1, 1), "{}", missing.stderr);
    assert_eq!(folder.names(), before);
}
