//! Instructions of the renderer's pipelines: what the papers publish, ours pinned, and what compilers of real chips make of
//! every pipeline. The rule itself is tested on shaders counted by hand in `src/count/tests.rs`.

mod by_function;

use std::{
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use surfel::{
    count::{Counts, PassCounts, count},
    instruments::{Counter, counts_of, papers_pipelines},
    scene::{Filter, KernelEval, Rasterizer, Settings, TileInvocations},
    shaders::config::SPEC_TEXTURED,
};

fn arb(counts: &Option<Counts>) -> u32 {
    counts.as_ref().and_then(|counts| counts.arb).unwrap()
}

#[test]
fn the_published_programs_have_the_published_counts() {
    let mut counter = Counter::default();
    let mut checked = 0;
    for recipe in papers_pipelines().unwrap() {
        let counts = counter.pipeline(&recipe).unwrap();
        let [vertex, fragment] = [arb(&counts.vertex), arb(&counts.fragment)];
        let [published_vertex, published_fragment] = recipe.published().unwrap();
        if recipe.pass.starts_with("paper") {
            let fits = vertex <= published_vertex && fragment <= published_fragment;
            assert!(fits, "{}: {vertex}/{fragment}", recipe.pass);
        } else {
            let fits = vertex.abs_diff(published_vertex) <= 2 && fragment.abs_diff(published_fragment) <= 2;
            assert!(fits, "{}: {vertex}/{fragment}", recipe.pass);
        }
        // As benches/INSTRUCTIONS.md has them line by line.
        let expected = match recipe.pass.as_str() {
            "paper visibility" => [45, 3],
            "paper accumulate" => [58, 3],
            "botsch visibility" => [36, 8],
            "botsch accumulate" => [37, 12],
            other => panic!("{other}"),
        };
        assert_eq!([vertex, fragment], expected, "{}", recipe.pass);
        checked += 1;
    }
    assert_eq!(checked, 4);
}

/// Each rasterizer with its default filter; tiles by pixels; then each filter with the default rasterizer.
fn pinned() -> Vec<Settings> {
    let rasterizers = Rasterizer::METHODS.iter().map(|(_, rasterizer)| {
        let filter = if *rasterizer == Rasterizer::Raycast { Filter::Max } else { Filter::default() };
        Settings { rasterizer: *rasterizer, filter, ..Settings::default() }
    });
    let filters = Filter::NAMES.iter().skip(1).map(|(_, filter)| Settings {
        filter: *filter,
        rasterizer: Rasterizer::Perspective,
        ..Settings::default()
    });
    let textured = Settings {
        kernel_eval: KernelEval::Texture,
        rasterizer: Rasterizer::Perspective,
        ..Settings::default()
    };
    let tile_invocations = TileInvocations::Pixel;
    let pixels = Settings { rasterizer: Rasterizer::Compute, tile_invocations, ..Settings::default() };
    rasterizers
        .chain([pixels])
        .chain(filters)
        .chain([textured])
        .filter(|settings| settings.validate().is_ok())
        .collect()
}

/// The version of the compiler's optimizer; `None` where its tools are not installed.
fn optimizer() -> Option<String> {
    let said = Command::new("spirv-val").arg("--version").output().ok()?.stdout;
    let said = String::from_utf8(said).unwrap();
    Some(said.split_whitespace().take(2).collect::<Vec<_>>().join(" "))
}

/// Whether two tables have the same rows, with figures within half a percent, rounded up.
fn are_near(a: &str, b: &str) -> bool {
    let numbers = |text: &str| -> Vec<u32> {
        text.split(|c: char| !c.is_ascii_digit()).filter_map(|digits| digits.parse().ok()).collect()
    };
    let words = |text: &str| text.replace(|c: char| c.is_ascii_digit(), "");
    let mut both = numbers(a).into_iter().zip(numbers(b));
    words(a) == words(b) && both.all(|(a, b)| a.abs_diff(b) <= a.div_ceil(200))
}

/// A change of these figures is a change of what every splat or fragment costs: it must be seen, and may then be pinned
/// anew with SURFEL_UPDATE_SNAPSHOTS=1. Other versions of the optimizer may differ by half a percent.
#[test]
fn our_pipelines_have_the_pinned_counts() {
    let version = optimizer();
    let compiler = format!("optimized by {}", version.as_deref().unwrap_or_default());
    let mut text = "pass: vertex/fragment, paper-comparable; scalar\n".to_owned();
    for settings in pinned() {
        let kernel = settings.kernel_eval.name();
        let (rasterizer, filter) = (settings.rasterizer.name(), settings.filter.name());
        let pixels = match settings.tile_invocations {
            TileInvocations::Pixel => ", an invocation a pixel",
            TileInvocations::ShortColumn => ", tiles half as high",
            TileInvocations::Auto | TileInvocations::Column => "",
        };
        writeln!(text, "{rasterizer}, {filter}, {kernel}{pixels}").unwrap();
        for counts in counts_of(&settings, true).unwrap() {
            let scalar = counts.of_stages(|counts| Some(counts.scalar));
            writeln!(text, "  {}: {}; {scalar}", counts.pass, PassCounts::vertex_and_fragment(&counts))
                .unwrap();
        }
    }
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "tests/snapshots/instructions.txt"].iter().collect();
    if std::env::var_os("SURFEL_UPDATE_SNAPSHOTS").is_some() {
        fs::write(&path, format!("{compiler}\n{text}")).unwrap();
    }
    let pinned = fs::read_to_string(&path).unwrap();
    let (pinned_compiler, pinned) = pinned.split_once('\n').unwrap();
    if version.is_none() || pinned_compiler == compiler {
        assert_eq!(pinned, text, "{}", path.display());
    } else {
        assert!(are_near(pinned, &text), "{}: {pinned}\n{compiler}\n{text}", path.display());
    }
}

/// Pinned anew as the counts are.
#[test]
fn the_table_of_functions_is_that_of_the_shaders() {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "benches/INSTRUCTIONS.md"].iter().collect();
    let text = fs::read_to_string(&path).unwrap();
    let (before, rest) = text.split_once("<!-- by function -->\n").unwrap();
    let (_, after) = rest.split_once("<!-- end -->\n").unwrap();
    let table = by_function::table();
    let expected = format!("{before}<!-- by function -->\n{table}<!-- end -->\n{after}");
    if std::env::var_os("SURFEL_UPDATE_SNAPSHOTS").is_some() {
        fs::write(&path, &expected).unwrap();
    }
    assert!(fs::read_to_string(&path).unwrap() == expected, "{}: should be\n{table}", path.display());
}

/// The instructions of the fragment stage of accumulation, with this text in place of another.
fn accumulation_with(old: &str, new: &str) -> Counts {
    let glsl = Path::new(env!("CARGO_MANIFEST_DIR")).join("glsl");
    let folder = temp_dir::TempDir::new().unwrap();
    fs::create_dir(folder.path().join("inc")).unwrap();
    for file in fs::read_dir(glsl.join("inc")).unwrap() {
        let file = file.unwrap();
        fs::copy(file.path(), folder.path().join("inc").join(file.file_name())).unwrap();
    }
    let name = "accumulate.frag.glsl";
    let text = fs::read_to_string(glsl.join(name)).unwrap();
    assert!(text.contains(old), "{old}");
    // One permutation will do.
    let lines = text.lines().filter(|line| !line.starts_with("// Permutations:"));
    let text = lines.collect::<Vec<_>>().join("\n").replace(old, new);
    fs::write(folder.path().join(name), format!("// Permutations: plain\n{text}\n")).unwrap();
    let built = crate::shader_build::build(folder.path(), &[], &[]).unwrap();
    count(&built.modules[0].1, &[(SPEC_TEXTURED, 1)]).unwrap()
}

#[test]
fn one_more_fetch_in_a_fragment_of_ours_shows_in_the_count() {
    let weight = "kernel_from_texture(fragment.uv);";
    let before = accumulation_with(weight, weight);
    let fetch = "textureLod(kernel_texture, fragment.uv, 0.0).r +";
    let after = accumulation_with(weight, &format!("{fetch} {weight}"));
    assert_eq!((before.mnemonics["TEX"], after.mnemonics["TEX"]), (1, 2));
    // The fetch, and its sum.
    assert_eq!(after.arb, before.arb.map(|count| count + 2));
}
