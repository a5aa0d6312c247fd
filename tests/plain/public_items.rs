//! The interface of the library as text: what `docs/embedding.md` promises to keep by semantic versioning, with its signatures, compared with what it was.
//!
//! Works on the text, not on a build, so that it takes no other compiler. Lifetimes and comments are not in it. A change that a host would notice is a change of the
//! snapshot: it is written anew with SURFEL_UPDATE_SNAPSHOTS=1, and CHANGELOG.md tells it.

use std::{fmt::Write as _, fs, path::Path};

use crate::import_direction::paths::{self, Token};

/// The folders and files of `src/` in which what of the interface is declared, and what is implemented of it. Names are unique there.
const INTERFACE: &[(&[&str], &[&str])] = &[
    (
        &["embed/", "renderer/", "passes/pipeline/cache"],
        &[
            "View",
            "ViewFrame",
            "DepthImage",
            "HostImage",
            "Rendering",
            "NO_ID",
            "Renderer",
            "MissingPipelines",
        ],
    ),
    (&["prepare/"], &["Placed", "NO_TINT", "PreparedScene", "DynamicSplats", "DynamicBuffers"]),
    (&["prepare/dynamic.rs"], &["disk", "color"]),
    (&["frame/"], &["FrameSlot"]),
    (&["passes/pick/"], &["PickPlan", "Picked", "PickedPart"]),
    (&["graph/resource.rs"], &["ImageState"]),
    (
        &["graph/execute/profiler.rs"],
        &["Profile", "FrameProfile", "PassProfile", "PassFigures", "PassCounts"],
    ),
    (&["vk/"], &["Limits", "Device", "Features", "FeaturesApart", "Import", "Requirements", "requirements"]),
    (&["vk/memory_needs.rs"], &["MemoryNeeds", "MemoryPiece"]),
    (&["vk/budget.rs"], &["MemoryHeap", "MemoryHeaps", "MemoryInUse"]),
    (&["vk/memory.rs", "vk/host_memory.rs"], &["HostMemory", "MemoryRequest", "MemoryUse", "HostAllocation"]),
    (
        &["scene/"],
        &[
            "HostCamera",
            "Placement",
            "Scene",
            "Settings",
            "Object",
            "MeshObject",
            "Splats",
            "Shapes",
            "Colors",
            "Mesh",
            "Light",
            "LightKind",
            "Storage",
            "Room",
            // What those have in them.
            "Accumulate",
            "Backfaces",
            "Ball",
            "Bounds",
            "Budget",
            "Camera",
            "Clip",
            "ClipBox",
            "ClipPlanes",
            "ClipCurve",
            "Clips",
            "Cull",
            "Defect",
            "DefectCounts",
            "DepthOfHost",
            "Edges",
            "Epsilon",
            "Filter",
            "FilterWeight",
            "Kernel",
            "KernelEval",
            "LastLayer",
            "Layers",
            "Lod",
            "LodSteps",
            "Opacity",
            "Order",
            "Outlines",
            "Rasterizer",
            "Samples",
            "Shading",
            "SplatFormat",
            "TileInvocations",
            "TileMemory",
            "Transition",
            "Window",
        ],
    ),
    (&["error"], &["Error", "ErrorKind"]),
];

/// Types that signatures of the interface name, but which are the program's and the tests' own: what has them in its signature may change with them.
const INSIDE: &[&str] = &[
    "Chunk",
    "DeviceFacts",
    "Explanation",
    "Floors",
    "Formula",
    "FrameStep",
    "HybridLevels",
    "Instance",
    "LeveledObject",
    "MeshChunk",
    "OptionValue",
    "PickRay",
    "Plan",
    "Profiler",
    "Refinements",
    "SceneFrame",
    "Seen",
    "Shaders",
    "Stage",
    "Staging",
    "Surface",
    "ViewFromWorld",
];

/// Types of the language and of other crates: `glam` is public as `surfel::glam`, `ash` as `surfel::ash`.
const FOREIGN: &[&str] = &[
    "Arc", "BTreeMap", "CStr", "Clone", "Copy", "DAffine3", "DMat3", "DMat4", "DQuat", "DVec2", "DVec3",
    "DVec4", "Default", "Duration", "Fn", "FnMut", "From", "Into", "Item", "Iterator", "NonNull", "Option",
    "Range", "Path", "PathBuf", "Result", "Self", "Send", "String", "Sync", "Vec", "Vec2", "Vec3",
];

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

/// The tokens of a text without its lifetimes.
fn tokens(text: &str) -> Vec<Token> {
    let is_word = |c: &char| c.is_alphanumeric() || *c == '_';
    let chars: Vec<char> = text.chars().collect();
    let (mut plain, mut at) = (String::new(), 0);
    while at < chars.len() {
        let word = chars[at + 1..].iter().take_while(|c| is_word(c)).count();
        let is_lifetime = chars[at] == '\'' && word > 0 && chars.get(at + 1 + word) != Some(&'\'');
        if is_lifetime && at > 0 && !is_word(&chars[at - 1]) {
            at += 1 + word;
        } else {
            plain.push(chars[at]);
            at += 1;
        }
    }
    paths::tokens(&plain)
}

/// The tokens from one on up to where its declaration ends: at a `;`, or at the brace of its body, outside of all brackets.
fn head(tokens: &[Token]) -> &[Token] {
    let mut depth = 0;
    for (i, token) in tokens.iter().enumerate() {
        match token.text.as_str() {
            "(" | "[" => depth += 1,
            ")" | "]" => depth -= 1,
            ";" | "{" if depth == 0 => return &tokens[..i],
            _ => {}
        }
    }
    tokens
}

/// The tokens between a brace and the one that closes it.
fn body(tokens: &[Token]) -> &[Token] {
    let mut depth = 0;
    let open = tokens.iter().position(|token| token.text == "{").unwrap_or(tokens.len());
    for (i, token) in tokens.iter().enumerate().skip(open) {
        match token.text.as_str() {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return &tokens[open + 1..i];
        }
    }
    &[]
}

/// Tokens with the spaces that a reader wants.
fn text(tokens: &[Token]) -> String {
    let mut text = String::new();
    for token in tokens {
        let word = token.text.as_str();
        let tight =
            matches!(word, "," | ";" | ":" | ")" | "]" | ">" | "<" | "(" | "[" | "." | "?" | "!" | "::")
                || text.ends_with(['(', '[', '<', '&', '!', '*', '.', '#'])
                || text.ends_with("::")
                || text.is_empty();
        if !(tight || word == ">" && text.ends_with('-')) {
            text.push(' ');
        }
        text.push_str(word);
    }
    let plain = [
        ("- >", "->"),
        ("->", " -> "),
        ("= =", "=="),
        (":[", ": ["),
        ("=[", "= ["),
        (",[", ", ["),
        ("<, ", "<"),
        ("<>", ""),
        (",)", ")"),
        ("  ", " "),
    ];
    plain.into_iter().fold(text, |text, (from, to)| text.replace(from, to))
}

/// The parts of a body that commas part, outside of all brackets, without attributes.
fn parts<'t>(tokens: &'t [Token]) -> Vec<&'t [Token]> {
    let (mut depth, mut first, mut parts) = (0_i32, 0, Vec::new());
    for (i, token) in tokens.iter().enumerate() {
        match token.text.as_str() {
            "(" | "[" | "{" | "<" => depth += 1,
            ")" | "]" | "}" | ">" if !(token.text == ">" && i > 0 && tokens[i - 1].text == "-") => depth -= 1,
            "," if depth == 0 => {
                parts.push(&tokens[first..i]);
                first = i + 1;
            }
            _ => {}
        }
    }
    parts.push(&tokens[first..]);
    let plain = |mut part: &'t [Token]| {
        while let [hash, rest @ ..] = part {
            if hash.text == "#" {
                let end = rest.iter().position(|token| token.text == "]").map_or(rest.len(), |end| end + 1);
                part = &rest[end..];
            } else {
                break;
            }
        }
        part
    };
    parts.into_iter().map(plain).filter(|part| !part.is_empty()).collect()
}

/// What is public of a declaration that begins at a `pub` or, in a table of settings or an enum of names, at its name.
fn declaration(tokens: &[Token]) -> String {
    let of_settings = tokens[0].text != "pub";
    let is = |word: &str| head(tokens).iter().any(|token| token.text == word);
    // A table has types.
    let kind = if body(tokens).iter().any(|token| token.text == ":") { "struct" } else { "enum" };
    let first = if of_settings { format!("pub {kind} {}", tokens[0].text) } else { text(head(tokens)) };
    let mut lines = match is("struct") {
        // What is in parentheses is private.
        true => first.split('(').next().unwrap_or_default().to_owned(),
        false => first,
    };
    if is("fn") {
        return lines;
    }
    if is("trait") {
        let inside = body(tokens);
        for at in (0..inside.len()).filter(|at| inside[*at].text == "fn") {
            write!(lines, "\n    {}", text(head(&inside[at..]))).unwrap();
        }
        return lines;
    }
    if is("const") || is("type") {
        return lines.split(" = ").next().unwrap_or_default().to_owned();
    }
    for part in parts(body(tokens)) {
        let public = is("enum")
            || of_settings
            || part[0].text == "pub" && part.get(1).is_none_or(|next| next.text != "(");
        let part = text(part);
        let part = part.split(" = ").next().unwrap_or_default().trim_end_matches(" =");
        if public {
            write!(lines, "\n    {part}").unwrap();
        }
    }
    lines
}

/// The public functions and constants of the implementations of a type, in this file.
fn implemented(tokens: &[Token], name: &str, found: &mut Vec<String>) {
    for at in (0..tokens.len()).filter(|at| tokens[*at].text == "impl") {
        let whole = head(&tokens[at..]);
        // After `for`, or after what it is generic over.
        let of = whole.iter().rposition(|token| token.text == "for");
        let own =
            whole.iter().skip(1).filter(|token| token.text != "<" && token.text != ">" && token.text != "_");
        let is_own = of.is_none() && own.clone().next().is_some_and(|token| token.text == name);
        if let Some(of) = of {
            if whole.get(of + 1).is_some_and(|token| token.text == name) {
                found.push(text(whole));
            }
            continue;
        }
        if !is_own {
            continue;
        }
        let inside = body(&tokens[at..]);
        let mut depth = 0;
        for (i, token) in inside.iter().enumerate() {
            match token.text.as_str() {
                "{" => depth += 1,
                "}" => depth -= 1,
                "pub" if depth == 0 && inside.get(i + 1).is_some_and(|next| next.text != "(") => {
                    let head = text(head(&inside[i..]));
                    let is_const = inside[i + 1].text == "const" && inside[i + 2].text != "fn";
                    let end = if is_const { head.find(" = ") } else { None };
                    found.push(head[..end.unwrap_or(head.len())].to_owned());
                }
                _ => {}
            }
        }
    }
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
