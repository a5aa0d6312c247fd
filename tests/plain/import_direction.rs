//! The folders of `src/` form layers, and imports point one way: to the layers above, as ARCHITECTURE.md lists them.
//!
//! Works on the text, not on a build, so that also code behind features and in tests is held to it.

pub mod paths;

use std::{fs, path::Path};

use paths::{UsedPath, used_paths};

/// A folder or file of `src/` may import what stands in a line above its own, and nothing else.
const LAYERS: &[&[&str]] = &[
    &["arena", "error", "inline_vec", "notes", "progress"],
    &["math", "small_file"],
    &["scene"],
    &["load", "save", "hard_scenes"],
    &["geometry"],
    &["levels_file"],
    &["reference"],
    &["count"],
    &["report"],
    &["compose"],
    &["vk"],
    &["graph"],
    &["shaders"],
    &["prepare"],
    &["passes"],
    &["frame"],
    &["renderer"],
    &["embed"],
    &["instruments"],
    &["selftest"],
];

/// The rooms and files of `passes/` alike; its `mod.rs`, the frame, may use all.
const ROOMS: &[&[&str]] = &[
    &["pipeline"],
    &["place"],
    &["recording"],
    &["pass"],
    &["plan"],
    &["inputs"],
    &["predicate"],
    &["cull"],
    &["splats"],
    &["polygons", "tiles"],
    &["resolve"],
    &["layers", "pick"],
    &["in_parts"],
    &["host"],
];

/// What a folder may not import although it stands above: (folder, import, why).
const FORBIDDEN: &[(&str, &str, &str)] =
    &[("reference", "math", "the oracle shares no formula with the code it judges")];

/// The one folder of `graph/` in which a device may appear: compiling a graph is plain data.
const GRAPH_WITH_DEVICE: &str = "graph/execute/";

fn layer(folder: &str) -> Option<usize> {
    LAYERS.iter().position(|layer| layer.contains(&folder))
}

/// Why a file of `passes/` may not use something of `passes/`.
fn between_rooms(file: &str, used: &UsedPath) -> Option<&'static str> {
    let own = file.strip_prefix("passes/")?.split('/').next()?.trim_end_matches(".rs");
    let [root, folder, target] = used.segments.as_slice() else { return None };
    if own == "mod" || root != "crate" || folder != "passes" || target == own {
        return None;
    }
    let room = |name: &str| ROOMS.iter().position(|room| room.contains(&name));
    match (room(own), room(target)) {
        (None, _) => Some("not in the list of rooms"),
        (_, None) => Some("no room of passes/; name the file itself"),
        (Some(own), Some(other)) if other >= own => Some("imports point only to rooms above"),
        _ => None,
    }
}

/// Every illegal import of a file, as `src/<file>:<line>: <edge>: <why>`. `file` is relative to `src/`.
fn violations(file: &str, text: &str) -> Vec<String> {
    let folder = file.split('/').next().unwrap_or(file).trim_end_matches(".rs");
    // The crate's root only lists the layers.
    if folder == "lib" {
        return Vec::new();
    }
    let Some(own) = layer(folder) else {
        return vec![format!("src/{file}:1: {folder}: not in the list of layers")];
    };
    let judge = |used: &UsedPath| -> Option<String> {
        if let [root, target, room] = used.segments.as_slice() {
            let why = between_rooms(file, used)?;
            return Some(format!("src/{file}:{}: {folder} -> {root}::{target}::{room}: {why}", used.line));
        }
        let in_graph_core = folder == "graph" && !file.starts_with(GRAPH_WITH_DEVICE);
        let (root, target) =
            (used.segments.first()?.as_str(), used.segments.get(1).map_or("", String::as_str));
        let why = match root {
            "ash" if in_graph_core && matches!(target, "Device" | "*") => {
                format!("the graph's core has no device in it; only {GRAPH_WITH_DEVICE} may")
            }
            "crate" if target == folder => return None,
            "crate" if in_graph_core && target == "vk" => {
                format!("the graph's core has no device in it; only {GRAPH_WITH_DEVICE} may")
            }
            "crate" => {
                let forbidden = FORBIDDEN.iter().find(|(from, to, _)| *from == folder && *to == target);
                match (layer(target), forbidden) {
                    (_, Some((.., why))) => (*why).to_owned(),
                    (None, _) => "not in the list of layers; name the module itself".to_owned(),
                    (Some(other), _) if other >= own => "imports point only to layers above".to_owned(),
                    _ => return None,
                }
            }
            _ => return None,
        };
        Some(format!("src/{file}:{}: {folder} -> {root}::{target}: {why}", used.line))
    };
    used_paths(file, text).iter().filter_map(judge).collect()
}

/// All Rust files below `folder`, as paths relative to `root`, except the part of the build script in `src/`.
fn rust_files(root: &Path, folder: &Path, found: &mut Vec<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let relative = path.strip_prefix(root).unwrap().to_str().unwrap().replace('\\', "/");
        if relative == "shaders/build" {
            continue;
        }
        if path.is_dir() {
            rust_files(root, &path, found);
        } else if relative.ends_with(".rs") {
            found.push(relative);
        }
    }
}

#[test]
fn no_folder_imports_from_a_layer_below_or_beside() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&src, &src, &mut files);
    files.sort();
    assert!(
        files.iter().any(|f| f == "scene/mod.rs") && files.len() > 5,
        "looked in the wrong place: {files:?}"
    );
    let found: Vec<String> =
        files.iter().flat_map(|f| violations(f, &fs::read_to_string(src.join(f)).unwrap())).collect();
    assert!(found.is_empty(), "\n{}\n", found.join("\n"));
}

#[test]
fn legal_imports_pass() {
    let cases = [
        ("scene/camera.rs", "use super::Bounds;\nuse crate::error::{Error, Result};"),
        (
            "scene/deep/leaf.rs",
            "use super::super::mesh::Mesh; mod tests { use super::super::super::Camera; }",
        ),
        (
            "passes/mod.rs",
            "use crate::{graph::Graph, shaders, vk::{self, Buffer}};\nfn f() { crate::math::f() }",
        ),
        ("passes/layers/a.rs", "use crate::passes::{pass::Pass, splats::draw}; use super::b;"),
        ("reference/mod.rs", "use crate::scene::Scene; // use crate::math::x"),
        ("graph/execute/mod.rs", "use crate::vk::Queue; use ash::Device;"),
        ("graph/cull.rs", "use ash::vk;\n/// [`crate::passes`] \nconst A: &str = \"crate::passes\";"),
        ("math/mod.rs", "pub(crate) fn f() {} mod tests { use super::f; }"),
        ("lib.rs", "pub use crate::renderer::Renderer;"),
    ];
    for (file, text) in cases {
        assert_eq!(violations(file, text), [""; 0], "{file}: {text}");
    }
}

#[test]
fn illegal_imports_are_found_with_line_and_edge() {
    // A file, its text (`↵` stands for the end of a line), and how what is said begins behind the file's name.
    let cases = r###"
scene/mod.rs $ ↵use crate::passes::Frame; $ 2: scene -> crate::passes
scene/mod.rs $ use crate::{error::Error,↵ vk::Buffer}; $ 2: scene -> crate::vk
scene/mod.rs $ fn f() -> crate::vk::X {} $ 1: scene -> crate::vk
scene/mod.rs $ use super::vk; $ 1: scene -> crate::vk
scene/a/b.rs $ use super::super::super::vk; $ 1: scene -> crate::vk
scene/a.rs $ use super::{Mesh, super::vk::X}; $ 1: scene -> crate::vk
scene/a.rs $ mod t { use super::super::super::vk; } $ 1: scene -> crate::vk
math/mod.rs $ macro_rules! m { () => { $crate::vk::f() } } $ 1: math -> crate::vk
load/ply.rs $ use crate::save::x; $ 1: load -> crate::save
reference/mod.rs $ use crate::math::x; $ 1: reference -> crate::math: the oracle
scene/mod.rs $ use crate::utils::x; $ 1: scene -> crate::utils: not in the list
scene/mod.rs $ use crate::Error; $ 1: scene -> crate::Error: not in the list
scene/mod.rs $ use crate::*; $ 1: scene -> crate::*: not in the list
utils/mod.rs $  $ 1: utils: not in the list
graph/cull.rs $ use crate::vk::X; $ 1: graph -> crate::vk: the graph's core
graph/cull.rs $ fn f(d: &ash::Device) {} $ 1: graph -> ash::Device: the graph's core
graph/cull.rs $ use ash::{vk, Device}; $ 1: graph -> ash::Device: the graph's core
vk/a.rs $ const C: char = '"'; use crate::graph::X; // " $ 1: vk -> crate::graph
passes/cull/a.rs $ use crate::passes::{pass::Pass, splats::draw}; $ 1: passes -> crate::passes::splats: imports point only to rooms
passes/tiles/a.rs $ use super::super::layers::x; $ 1: passes -> crate::passes::layers: imports
passes/tiles/a.rs $ use crate::passes::Draw; $ 1: passes -> crate::passes::Draw: no room
vk/a.rs $ /* /* */ " */ use crate::graph::X; $ 1: vk -> crate::graph
vk/a.rs $ const R: &str = r#"\"#; use crate::graph::X; $ 1: vk -> crate::graph
vk/a.rs $ fn f<'a>(x: &'a str) -> crate::graph::X<'a> {} $ 1: vk -> crate::graph"###;
    for case in cases.lines().skip(1) {
        let [file, text, start] = case.split(" $ ").collect::<Vec<_>>()[..] else { panic!("{case}") };
        let found = violations(file, &text.replace('↵', "\n"));
        assert!(
            found.len() == 1 && found[0].starts_with(&format!("src/{file}:{start}")),
            "{case}: {found:?}"
        );
    }
}
