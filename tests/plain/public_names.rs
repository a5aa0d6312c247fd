//! Every name that a host reaches without the feature `inside` is in a list, so that none becomes public by the way: `tests/snapshots/public_names.txt`, written anew with
//! SURFEL_UPDATE_SNAPSHOTS=1. What of `embed` and `scene` is promised, with its signatures, is in another one (`public_items.rs`).

use std::{collections::BTreeSet, fs, path::Path};

use crate::import_direction::paths::{self, Token};

fn read(path: &str) -> Option<String> {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(path)).ok()
}

/// How deep in braces each token lies.
fn depths(tokens: &[Token]) -> Vec<i32> {
    let mut depth = 0;
    let each = |token: &Token| {
        depth -= i32::from(token.text == "}");
        let is = depth;
        depth += i32::from(token.text == "{");
        is
    };
    tokens.iter().map(each).collect()
}

/// The names of a use's tree: its ends, under their other names where they have some.
fn of_use(tokens: &[Token]) -> Vec<String> {
    let is_end = |i: usize| tokens.get(i + 1).is_none_or(|next| [",", "}"].contains(&next.text.as_str()));
    let is_name = |text: &str| text.chars().all(|c| c.is_alphanumeric() || c == '_') && text != "self";
    let named = |i: usize| is_name(&tokens[i].text) && is_end(i);
    // Of one name alone there is no tree.
    (0..tokens.len()).filter(|i| named(*i)).map(|i| tokens[i].text.clone()).collect()
}

/// What a module declares as public, and gives on; the modules of it go into `modules`.
fn names(text: &str, modules: &mut Vec<String>) -> Vec<String> {
    let tokens = paths::tokens(text);
    let (depths, mut all) = (depths(&tokens), Vec::new());
    for at in (0..tokens.len()).filter(|at| tokens[*at].text == "pub" && depths[*at] == 0) {
        let rest: Vec<&str> = tokens[at + 1..].iter().take(3).map(|token| token.text.as_str()).collect();
        match rest[..] {
            ["use", ..] => {
                let end = tokens[at..].iter().position(|token| token.text == ";").unwrap();
                all.extend(of_use(&tokens[at + 2..at + end]));
            }
            ["mod", name, _] => modules.push(name.to_owned()),
            ["unsafe" | "const", "fn" | "trait", name]
            | ["struct" | "enum" | "fn" | "trait" | "const" | "type" | "static", name, _] => {
                all.push(name.to_owned())
            }
            _ => {}
        }
    }
    all
}

/// Those of a file or folder, and of the modules within.
fn of_module(path: &str, name: &str, all: &mut BTreeSet<String>) {
    let found = [format!("{path}.rs"), format!("{path}/mod.rs")].iter().find_map(|file| read(file));
    let text = found.unwrap_or_else(|| panic!("{path} is no module"));
    let mut modules = Vec::new();
    // A macro that declares what is inside says so by `$`.
    all.extend(names(&text, &mut modules).iter().map(|own| format!("{name}::{own}")));
    for own in modules {
        of_module(&format!("{path}/{own}"), &format!("{name}::{own}"), all);
    }
}

fn public_names() -> String {
    let text = read("lib.rs").unwrap();
    // Between: what is inside.
    let (before, rest) = text.split_once("#[path = \"\"]").unwrap();
    let (_, after) = rest.split_once("#[cfg(not(feature = \"inside\"))]\nuse inside::*;").unwrap();
    let (mut modules, mut all) = (Vec::new(), BTreeSet::new());
    let own: Vec<_> = [before, after].iter().flat_map(|part| names(part, &mut modules)).collect();
    all.extend(own.into_iter().map(|name| format!("surfel::{name}")));
    for module in modules {
        of_module(&module, &format!("surfel::{module}"), &mut all);
    }
    all.into_iter().map(|name| name + "\n").collect()
}

#[test]
fn no_name_is_public_by_the_way() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots/public_names.txt");
    let now = public_names();
    if std::env::var_os("SURFEL_UPDATE_SNAPSHOTS").is_some() {
        fs::write(&file, &now).unwrap();
    }
    let before = fs::read_to_string(&file).unwrap();
    let missing = |from: &str, of: &str| {
        from.lines()
            .filter(|line| !of.lines().any(|other| other == *line))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let (gone, new) = (missing(&before, &now), missing(&now, &before));
    assert!(
        before == now,
        "gone: {gone:#?}\nnew: {new:#?}\nis it for hosts? Then SURFEL_UPDATE_SNAPSHOTS=1; else it is inside"
    );
}

/// Types of `embed` that come with another one, whose example has them, or is of their making.
const WITH_OTHERS: &[(&str, &str)] = &[
    ("Device", "Import"),
    ("DynamicBuffers", "DynamicSplats"),
    ("FeaturesApart", "Features"),
    ("FrameProfile", "Profile"),
    ("FrameSlot", "PickPlan"),
    ("HostAllocation", "HostMemory"),
    ("ImageState", "HostImage"),
    ("MemoryHeap", "MemoryHeaps"),
    ("MemoryInUse", "MemoryHeaps"),
    ("MemoryRequest", "HostMemory"),
    ("MemoryUse", "HostMemory"),
    ("PassCounts", "Profile"),
    ("PassFigures", "Profile"),
    ("PassProfile", "Profile"),
    ("Picked", "PickPlan"),
    ("PickedPart", "PickPlan"),
    ("Requirements", "requirements"),
];

/// All of `src/`.
fn sources(folder: &Path, all: &mut Vec<String>) {
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.is_dir() {
            sources(&entry, all);
        } else if entry.extension().is_some_and(|kind| kind == "rs") {
            all.push(fs::read_to_string(entry).unwrap());
        }
    }
}

/// What `embed` gives has an example where it is documented.
#[test]
fn what_a_host_needs_has_an_example() {
    let mut all = Vec::new();
    sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut all);
    let with_example = |name: &str| {
        let declared =
            ["struct", "enum", "unsafe trait", "unsafe fn"].map(|kind| format!("pub {kind} {name}"));
        let is_it = |line: &str| {
            let after = declared.iter().find_map(|declared| line.strip_prefix(declared.as_str()));
            after.is_some_and(|after| after.starts_with([' ', '<', '(', ':']))
        };
        let documented = |text: &String| {
            let lines: Vec<_> = text.lines().collect();
            let at = lines.iter().position(|line| is_it(line))?;
            let above =
                lines[..at].iter().rev().take_while(|line| line.starts_with("///") || line.starts_with("#["));
            Some(above.filter(|line| line.contains("```")).count() >= 2)
        };
        // Others inside may have the name.
        all.iter().filter_map(documented).max()
    };
    let mut modules = Vec::new();
    let (mut without, mut count) = (Vec::new(), 0);
    for name in names(&read("embed/mod.rs").unwrap(), &mut modules) {
        let other = WITH_OTHERS.iter().find(|(own, _)| *own == name).map_or(&*name, |(_, other)| *other);
        match with_example(other) {
            Some(true) => count += 1,
            Some(false) => without.push(name),
            // A constant, or a module.
            None => {}
        }
    }
    assert!(without.is_empty() && count > 35, "without an example: {without:?}, with one: {count}");
}

#[test]
fn names_are_found_wherever_they_are_declared() {
    let mut modules = Vec::new();
    let found = names(
        "mod private; pub mod one; pub use a::{b::C, d, E as F, self}; pub use g::H; pub(crate) use i::J; fn k() { pub fn no() {} } \
         pub const L: u8 = 1; pub unsafe trait M { fn n(); } macro_rules! inside { ($name:ident) => { pub use $name; }; } pub const fn o() {}",
        &mut modules,
    );
    assert_eq!(found, ["C", "d", "F", "H", "L", "M", "o"]);
    assert_eq!(modules, ["one"]);
}
