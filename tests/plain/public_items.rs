//! The interface of the library as text: what `docs/embedding.md` promises to keep by semantic versioning, with its signatures, compared with what it was.
//!
//! Works on the text, not on a build, so that it takes no other compiler. Lifetimes and comments are not in it. A change that a host would notice is a change of the
//! snapshot: it is written anew with SURFEL_UPDATE_SNAPSHOTS=1, and CHANGELOG.md tells it.

mod declarations;
mod lists;

use std::{fmt::Write as _, fs, path::Path};

use declarations::{declaration, head, implemented, tokens};
use lists::{FOREIGN, INSIDE, INTERFACE};

/// Every file of `src/` below these paths, but tests, with its text, in order.
fn sources(paths: &[&str]) -> Vec<(String, String)> {
    fn walk(folder: &Path, found: &mut Vec<std::path::PathBuf>) {
        for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if entry.is_dir() { walk(&entry, found) } else { found.push(entry) }
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    walk(&root, &mut files);
    files.sort();
    let named = |file: &std::path::PathBuf| file.strip_prefix(&root).unwrap().to_string_lossy().into_owned();
    let is_meant = |name: &str| {
        paths.iter().any(|path| name.starts_with(path)) && !name.contains("tests") && name.ends_with(".rs")
    };
    let files = files.into_iter().map(|file| (named(&file), file)).filter(|(name, _)| is_meant(name));
    files.map(|(name, file)| (name, fs::read_to_string(file).unwrap())).collect()
}

fn interface() -> String {
    let mut all = String::new();
    for (paths, names) in INTERFACE {
        let files: Vec<_> = sources(paths).into_iter().map(|(name, text)| (name, tokens(&text))).collect();
        for name in *names {
            let mut declared = Vec::new();
            let mut functions = Vec::new();
            for (_, tokens) in &files {
                for at in 0..tokens.len().saturating_sub(2) {
                    let words: Vec<&str> =
                        head(&tokens[at..]).iter().take(4).map(|token| token.text.as_str()).collect();
                    let is_it = match words.as_slice() {
                        ["pub", "struct" | "enum" | "const" | "fn" | "trait", own, ..] => own == name,
                        ["pub", "unsafe", "fn" | "trait", own] => own == name,
                        _ => false,
                    };
                    let of_settings = tokens[at].text == *name
                        && tokens[at + 1].text == "{"
                        && tokens[..at].iter().rev().take(30).any(|token| token.text == "settings")
                        && tokens[..at].last().is_some_and(|token| token.text == "]");
                    let of_names = tokens[at].text == *name
                        && tokens[at + 1].text == "{"
                        && tokens[..at]
                            .iter()
                            .rev()
                            .take(3)
                            .map(|token| token.text.as_str())
                            .eq(["{", "!", "named"]);
                    if is_it || of_settings || of_names {
                        declared.push(declaration(&tokens[at..]));
                    }
                }
                implemented(tokens, name, &mut functions);
            }
            assert_eq!(declared.len(), 1, "{name}: declared once in {paths:?}: {declared:?}");
            functions.sort();
            writeln!(all, "{}", declared[0]).unwrap();
            functions.iter().for_each(|function| writeln!(all, "  {function}").unwrap());
            all.push('\n');
        }
    }
    all
}

#[test]
fn the_interface_is_what_it_was() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots/interface.txt");
    let now = interface();
    if std::env::var_os("SURFEL_UPDATE_SNAPSHOTS").is_some() {
        fs::write(&file, &now).unwrap();
    }
    let before = fs::read_to_string(&file).unwrap();
    let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    let (before, now) = (lines(&before), lines(&now));
    let gone: Vec<_> = before.iter().filter(|line| !now.contains(line)).collect();
    let new: Vec<_> = now.iter().filter(|line| !before.contains(line)).collect();
    assert!(
        before == now,
        "gone: {gone:#?}\nnew: {new:#?}\nis it in CHANGELOG.md? Then SURFEL_UPDATE_SNAPSHOTS=1"
    );
}

/// A host reads of every type that it gets or gives: each that the snapshot names is in it, too, or is said to be inside.
#[test]
fn every_type_that_the_interface_names_is_in_it() {
    let snapshot = interface();
    let is_type = |word: &str| {
        word.starts_with(|c: char| c.is_uppercase()) && word.contains(|c: char| c.is_lowercase())
    };
    let known: Vec<&str> = INTERFACE.iter().flat_map(|(_, names)| names.iter().copied()).collect();
    let (mut missing, mut inside) = (Vec::new(), Vec::new());
    let mut of_enum = false;
    for line in snapshot.lines() {
        if line.starts_with("pub ") {
            of_enum = line.starts_with("pub enum");
        }
        // A variant's own name is none of a type, nor is what another crate has in its module.
        let line =
            if of_enum { line.trim_start().trim_start_matches(|c: char| c.is_alphanumeric()) } else { line };
        let mut begin = 0;
        while let Some(next) = line[begin..].find(|c: char| c.is_alphanumeric() || c == '_') {
            let at = begin + next;
            let word = line[at..].split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap();
            let foreign =
                ["vk::", "ash::", "io::", "fmt::"].iter().any(|module| line[..at].ends_with(module));
            if is_type(word) && !foreign && !known.contains(&word) && !FOREIGN.contains(&word) {
                let found = if INSIDE.contains(&word) { &mut inside } else { &mut missing };
                found.push(word.to_owned());
            }
            begin = at + word.len();
        }
    }
    missing.sort();
    missing.dedup();
    assert!(missing.is_empty(), "in no list: {missing:?}");
    let idle: Vec<_> = INSIDE.iter().filter(|name| !inside.iter().any(|found| found == *name)).collect();
    assert!(idle.is_empty(), "named by nothing: {idle:?}");
}

/// All that `surfel::embed` gives is in the snapshot.
#[test]
fn nothing_of_embed_is_left_out() {
    let head = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/embed/mod.rs")).unwrap();
    let tokens = tokens(&head);
    let known: Vec<&str> = INTERFACE.iter().flat_map(|(_, names)| names.iter().copied()).collect();
    let mut count = 0;
    for at in (0..tokens.len()).filter(|at| tokens[*at].text == "pub" && tokens[at + 1].text == "use") {
        let end = tokens[at..].iter().position(|token| token.text == ";").unwrap();
        for i in at..at + end {
            let last = matches!(tokens[i + 1].text.as_str(), "," | "}" | ";");
            let name = tokens[i].text.as_str();
            if last && !matches!(name, "," | "}") && name != "dynamic" {
                assert!(known.contains(&name), "{name}");
                count += 1;
            }
        }
    }
    assert!(count >= 15, "{count}");
}

#[test]
fn declarations_are_found_without_what_is_private() {
    let tokens = tokens(
        "impl Own<'_> { pub const A: u32 = 3; fn no() {} pub unsafe fn go<T: Copy>(&self, x: [u32; 2]) -> Result<()> { pub_(); } } \
         pub struct Own<'a> { #[doc(hidden)] pub x: &'a [f32], y: u32, pub(super) z: u8 } impl Drop for Own { fn drop(&mut self) {} }",
    );
    let at = tokens.iter().position(|token| token.text == "struct").unwrap() - 1;
    assert_eq!(declaration(&tokens[at..]), "pub struct Own\n    pub x: &[f32]");
    let mut found = Vec::new();
    implemented(&tokens, "Own", &mut found);
    assert_eq!(
        found,
        [
            "pub const A: u32",
            "pub unsafe fn go<T: Copy>(&self, x: [u32; 2]) -> Result<()>",
            "impl Drop for Own"
        ]
    );
}
