//! The integrations of `docs/embedding.md` are parts of programs that are built and run: to the letter, so that who pastes them has what runs.

use std::fs;

/// No integration has more lines of code.
const MOST_LINES: usize = 50;

fn read(file: &str) -> String {
    fs::read_to_string(format!("{}/{file}", env!("CARGO_MANIFEST_DIR"))).expect(file)
}

/// What lies between two lines of a program that say so, as it stands at its margin.
fn marked(file: &str) -> String {
    let text = read(file);
    let mut lines = text.lines().skip_while(|line| !line.contains("---- Splats"));
    let margin = lines.next().expect(file).find(|c: char| !c.is_whitespace()).unwrap();
    let is_within = |line: &&str| !["// ----", "/* ---- */"].contains(&line.trim());
    lines.take_while(is_within).map(|line| format!("{}\n", line.get(margin..).unwrap_or_default())).collect()
}

/// Blocks of code of a page, in their order, of a language.
fn blocks(page: &str, language: &str) -> Vec<String> {
    let (text, begin) = (read(page), format!("```{language}\n"));
    let after = text.split(&begin).skip(1);
    after.map(|text| text.split("```").next().unwrap().to_owned()).collect()
}

fn lines_of_code(text: &str) -> usize {
    let is_code = |line: &&str| !line.is_empty() && !["//", "/*"].iter().any(|mark| line.starts_with(mark));
    text.lines().map(str::trim).filter(is_code).count()
}

#[test]
fn the_guides_integrations_are_what_programs_have() {
    let (rust, c) = (blocks("docs/embedding.md", "rust,ignore"), blocks("docs/embedding.md", "c"));
    let [device, ash, wgpu] = &rust[..] else { panic!("{} blocks that are no tests", rust.len()) };
    let [c] = &c[..] else { panic!("{} blocks of C", c.len()) };
    let [of_page] = &blocks("docs/wgpu.md", "rust,ignore")[..] else { panic!("one block") };
    for (is, expected, where_from) in [
        (device, &marked("examples/engine/mod.rs"), "examples/engine/mod.rs"),
        (ash, &marked("examples/embed/main.rs"), "examples/embed/main.rs"),
        (wgpu, of_page, "docs/wgpu.md"),
        (c, &marked("examples/embed_c/main.c"), "examples/embed_c/main.c"),
    ] {
        let other = is.lines().zip(expected.lines()).find(|(is, expected)| is != expected);
        assert!(is == expected, "docs/embedding.md is not {where_from}: {other:?}");
    }
    for (name, text) in [("ash", ash), ("wgpu", wgpu), ("C", c)] {
        let lines = lines_of_code(text);
        println!("{name}: {lines} lines");
        assert!((20..=MOST_LINES).contains(&lines), "{name}: {lines} lines");
    }
}
