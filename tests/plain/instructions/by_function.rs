//! Where the instructions of our vertex stages are: by function of `glsl/`, from the lines that the compiler keeps. The table
//! is part of `benches/INSTRUCTIONS.md`.

use std::{
    collections::{BTreeMap, BTreeSet},
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

use surfel::{
    count::count_by_line,
    instruments::{Counter, Traits, frame_pipelines},
    passes::PipelineRecipe,
    scene::{Filter, Rasterizer, Settings},
};

/// By file and function.
type Counts = BTreeMap<(String, String), u32>;

/// What the functions are for, in the order in which a splat goes through them. Others come last.
const BUYS: &[(&str, &str)] = &[
    ("load_splat", "view space; tangent frame without a normal for which it fails"),
    ("load_color", "the color, unpacked"),
    ("rotated", "into view space"),
    ("upper_half", "with the next two: the determinant rounded once, for the depth of edge-on disks"),
    ("exact_dot", "products in halves, and what sums lose"),
    ("normal_dot_ray", "n · p with the low digits of the place"),
    ("precise_dot", "dot products in one order, for equal bits in both passes"),
    ("precise_cross", "the adjugate"),
    ("principal_axes", "the filter: rotation to principal axes, for ellipses too"),
    ("widened_axis", "the filter: no axis thinner than a pixel"),
    ("flat_cross", "the filter: the adjugate of what is widened"),
    ("adjust_tangents", "the filter: axes, their depth, determinant"),
    ("map_splat", "faces away, regular, behind, edge-on; scale; ε"),
    ("regular_box", "the box of the ellipse that a regular splat is"),
    ("near_box", "the box of splats that reach the near plane, with the next two: the ground under the eye"),
    ("include_rim", "the extreme points of its rim"),
    ("include_point", "the points where the near plane cuts it"),
    ("pixel_box", "ends on pixel borders, clamped: no lost rim pixel, nothing where no center is covered"),
    ("point_of", "the point's place and size; none without pixels"),
    ("square_side_px", "the smallest square about the center"),
    ("projected_center_px", "the center's pixel"),
    ("projective_map_about_center", "depth at the center: half the error of equation 4"),
    ("projective_map", "equation 4 per pixel"),
    ("handed_over_px", "places from the corner or the middle"),
    ("emit", "clip position"),
];

/// The table: each splat pass without and with the default filter.
pub fn table() -> String {
    let mut columns: Vec<(String, Counts)> = Vec::new();
    for filter in [Filter::None, Filter::Adjust] {
        let settings = Settings { filter, rasterizer: Rasterizer::Perspective, ..Settings::default() };
        for recipe in frame_pipelines(&settings, Traits::default()).unwrap() {
            if recipe.projects_splats() {
                let counts = by_function(&recipe);
                let whole = Counter::default().pipeline(&recipe).unwrap().vertex.unwrap().arb.unwrap();
                assert_eq!(counts.values().sum::<u32>(), whole, "{}", recipe.pass);
                columns.push((format!("{}, `{}`", recipe.pass, filter.name()), counts));
            }
        }
    }
    columns.sort_by(|(a, _), (b, _)| b.split(',').next().cmp(&a.split(',').next()));
    let place = |function: &str| BUYS.iter().position(|(name, _)| *name == function).unwrap_or(BUYS.len());
    let functions: BTreeSet<(usize, &(String, String))> =
        columns.iter().flat_map(|(_, counts)| counts.keys()).map(|key| (place(&key.1), key)).collect();
    let mut text = "| function |".to_owned();
    for (name, _) in &columns {
        write!(text, " {name} |").unwrap();
    }
    writeln!(text, " for |\n|---|{}---|", "---|".repeat(columns.len())).unwrap();
    for (place, key) in functions {
        write!(text, "| `{}`, `{}` |", key.0, key.1).unwrap();
        for (_, counts) in &columns {
            write!(text, " {} |", counts.get(key).map_or_else(String::new, u32::to_string)).unwrap();
        }
        writeln!(text, " {} |", BUYS.get(place).map_or("", |(_, buys)| buys)).unwrap();
    }
    write!(text, "| all |").unwrap();
    for (_, counts) in &columns {
        write!(text, " {} |", counts.values().sum::<u32>()).unwrap();
    }
    text + " |\n"
}

fn glsl() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("glsl")
}

/// The instructions of the vertex stage of a splat pass that draws points.
fn by_function(recipe: &PipelineRecipe) -> Counts {
    let file = format!("{}.vert.glsl", recipe.pass);
    let spirv = with_lines(&glsl().join(file), &["POINTS", "PLAIN"]);
    let mut all = Counts::new();
    for (line, count) in count_by_line(&spirv, recipe.constants()).unwrap() {
        let (path, line) = line.unwrap_or_else(|| panic!("{count} of {} have no line", recipe.pass));
        let path = Path::new(&path);
        let shown = path.strip_prefix(glsl()).unwrap().display().to_string();
        *all.entry((shown, function_at(path, line as usize))).or_insert(0) += count;
    }
    all
}

/// As `src/shaders/build/compile.rs` compiles it, but with debug information.
fn with_lines(path: &Path, words: &[&str]) -> Vec<u32> {
    let compiler = shaderc::Compiler::new().unwrap();
    let mut options = shaderc::CompileOptions::new().unwrap();
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_3 as u32);
    options.set_target_spirv(shaderc::SpirvVersion::V1_6);
    options.set_generate_debug_info();
    options.set_optimization_level(shaderc::OptimizationLevel::Performance);
    for word in words {
        options.add_macro_definition(word, None);
    }
    options.set_include_callback(|requested, _, _, _| {
        let path = glsl().join(requested);
        let content = fs::read_to_string(&path).map_err(|e| e.to_string())?;
        Ok(shaderc::ResolvedInclude { resolved_name: path.display().to_string(), content })
    });
    let source = fs::read_to_string(path).unwrap();
    let kind = shaderc::ShaderKind::Vertex;
    let compiled =
        compiler.compile_into_spirv(&source, kind, &path.display().to_string(), "main", Some(&options));
    compiled.unwrap().as_binary().to_vec()
}

/// The function around a line. Ours begin at the margin, as `vec3 name(`, and nothing within them does.
fn function_at(path: &Path, line: usize) -> String {
    let source = fs::read_to_string(path).unwrap();
    let heads = source.lines().take(line).filter_map(|line| {
        let (head, _) = line.split_once('(')?;
        let (type_, name) = head.rsplit_once(' ')?;
        let is_word = |text: &str| text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        (is_word(type_) && is_word(name) && !type_.is_empty() && type_ != "layout").then(|| name.to_owned())
    });
    heads.last().unwrap()
}
