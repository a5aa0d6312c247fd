//! `surfel bench counts`: the instructions of every pipeline, by the two rules and as drivers' compilers have them.

mod arguments;
mod isa;

pub use arguments::CountsArguments;

use std::collections::{HashMap, HashSet};

use surfel::shaders::config::{SPEC_KERNEL, SPEC_SHADING, SPEC_SUMMED, SPEC_TEXELS, SUMMED_BESIDE};
use surfel::{
    Error, Progress as _, Result, Settings,
    instruments::{Counter, Traits, frame_pipelines, papers_pipelines},
    passes::{PipelineRecipe, PipelineStages},
    report::{
        bench::{InstructionReport, InstructionRow, PipelineNames},
        compare::WeightedFilter,
    },
    scene::{
        Accumulate, Filter, FilterWeight, Kernel, KernelEval, Rasterizer, Shading, TileInvocations, with_each,
    },
};

use super::arguments::{Bench, BenchArguments};
use crate::{
    console::{self, Bars},
    json::to_json,
};

/// Prints the rows of one chip: the work of a process of our own.
pub fn print_isa_rows(arguments: &BenchArguments) -> Result<()> {
    let rows = isa::rows_here(&pipelines(arguments.counts.all)?, arguments.device.asked.as_deref())?;
    console::print(&to_json(&rows)?)
}

/// Counts every pipeline.
///
/// # Errors
/// A chip that no compiler here knows; options that need a scene.
pub fn gather(arguments: &BenchArguments, bars: &Bars) -> Result<InstructionReport> {
    let counts = &arguments.counts;
    let alone = arguments.table == Bench::Counts;
    if alone && (arguments.model.is_some() || arguments.device.validate) {
        return Err(Error::option("--model, --validate", "bench counts draws nothing"));
    }
    let pipelines = pipelines(counts.all)?;
    let total = pipelines.len() as u64;
    let mut rows = Vec::new();
    let mut counter = Counter::default();
    for ((names, recipe), done) in pipelines.into_iter().zip(1..) {
        rows.push(InstructionRow {
            names,
            counts: counter.pipeline(&recipe)?,
            published: recipe.published(),
            isa: Vec::new(),
        });
        bars.step("count", done, total);
    }
    let mut notes = vec![
        "VP/FP: instructions of ARB programs, an upper bound: see benches/INSTRUCTIONS.md".to_owned(),
        "published: Guennebaud, Barthe, Paulin 2006, table 1".to_owned(),
    ];
    for (chip, done) in counts.isa.iter().zip(1..) {
        let found = isa::rows_of(chip, counts.all, arguments.device.asked.as_deref())?;
        for (row, isa) in rows.iter_mut().zip(found) {
            row.isa.extend(isa);
        }
        bars.step("compile", done, counts.isa.len() as u64);
    }
    if !counts.isa.is_empty() {
        notes.push(
            "chips: as the driver's compiler tells it; latency and throughput are its estimates in cycles"
                .to_owned(),
        );
    }
    Ok(InstructionReport { rows, notes })
}

/// The pipelines of all methods, each once, and those of the papers' own programs.
fn pipelines(all: bool) -> Result<Vec<(PipelineNames, PipelineRecipe)>> {
    let mut found = Vec::new();
    let mut seen = HashSet::new();
    for recipe in papers_pipelines()? {
        let names = PipelineNames {
            pass: recipe.pass.clone(),
            draws: "points".to_owned(),
            rasterizer: "as published".to_owned(),
            shaders: shaders(&recipe),
            ..PipelineNames::default()
        };
        found.push((names, recipe));
    }
    for settings in every_settings(all) {
        if settings.validate().is_err() {
            continue;
        }
        for traits in every_traits(all) {
            if settings.check_object("", traits.ellipses).is_err() || !is_listed(&settings, traits) {
                continue;
            }
            for recipe in frame_pipelines(&settings, traits)? {
                if seen.insert(recipe.clone()) {
                    found.push((names(&settings, traits, &recipe), recipe));
                }
            }
        }
    }
    Ok(told_apart(found))
}

/// Adds to the shaders of pipelines with equal names the specialization constants by which they differ, as `number=value`, and whether they test depth.
fn told_apart(mut pipelines: Vec<(PipelineNames, PipelineRecipe)>) -> Vec<(PipelineNames, PipelineRecipe)> {
    let mut alike: HashMap<PipelineNames, Vec<usize>> = HashMap::new();
    for (place, (names, _)) in pipelines.iter().enumerate() {
        alike.entry(names.clone()).or_default().push(place);
    }
    for places in alike.into_values().filter(|places| places.len() > 1) {
        let constants: Vec<Vec<(u32, u32)>> =
            places.iter().map(|place| pipelines[*place].1.constants().to_vec()).collect();
        let differs = |constant: &&(u32, u32)| !constants.iter().all(|of| of.contains(constant));
        for (place, own) in places.iter().zip(&constants) {
            let mut own: Vec<String> =
                own.iter().filter(differs).map(|(number, value)| format!("{number}={value}")).collect();
            let tests = |place: &usize| pipelines[*place].1.tests_depth();
            if tests(place) && !places.iter().all(tests) {
                own.push("depth test".to_owned());
            }
            pipelines[*place].0.shaders += &format!(" ({})", own.join(", "));
        }
    }
    pipelines
}

/// The kernel of Pajarola et al. 2003 with its default parameters, which change no instruction.
const PSI_E: Kernel = Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 };

fn every_settings(all: bool) -> Vec<Settings> {
    let every = vec![Settings::default()];
    let every = with_each(every, Rasterizer::METHODS, |settings, (_, value)| settings.rasterizer = value);
    let every = with_each(every, Filter::NAMES, |settings, (_, value)| settings.filter = value);
    let every = with_each(every, KernelEval::NAMES, |settings, (_, value)| settings.kernel_eval = value);
    let weights = if all { FilterWeight::NAMES } else { &FilterWeight::NAMES[..1] };
    let mut every = with_each(every, weights, |settings, (_, value)| settings.filter_weight = value);
    let tile_invocations = TileInvocations::Pixel;
    every.push(Settings { rasterizer: Rasterizer::Compute, tile_invocations, ..Settings::default() });
    if all {
        let shadings = [Shading::Lambert, Shading::Normals, Shading::Albedo];
        // The other kernel is another pipeline of each.
        let with_psi_e = |settings: &Settings| Settings { kernel: PSI_E, ..settings.clone() };
        every.extend(every.iter().map(with_psi_e).collect::<Vec<_>>());
        // So are sums in targets of another format, though their stages are the same.
        let with_f32 = |settings: &Settings| Settings { accumulate: Accumulate::F32, ..settings.clone() };
        every.extend(every.iter().map(with_f32).collect::<Vec<_>>());
        every.extend(shadings.map(|shading| Settings { shading, ..Settings::default() }));
    }
    // Tiles sum what they leave to others in 32 bits, as `--accumulate f32` does with points, after which that is named.
    every.sort_by_key(|settings| settings.rasterizer == Rasterizer::Compute);
    every
}

fn every_traits(all: bool) -> Vec<Traits> {
    if !all {
        return vec![Traits::default()];
    }
    let every = with_each(vec![Traits::default()], &[false, true], |traits, value| traits.ellipses = value);
    let every = with_each(every, &[false, true], |traits, value| traits.may_be_large = value);
    let every = with_each(every, &[false, true], |traits, value| traits.export = value);
    let every = with_each(every, &[true, false], |traits, value| traits.closed = value);
    let with_more = |traits: Traits| {
        let mut all = vec![Traits { floor: traits.export, ..traits }];
        all.extend(beyond_opaque_splats(traits));
        all
    };
    every.into_iter().flat_map(with_more).collect()
}

/// These traits with polygons, transparent things and lights.
fn beyond_opaque_splats(traits: Traits) -> Vec<Traits> {
    let polygons = Traits { polygons: true, ..traits };
    if traits.export {
        return vec![polygons];
    }
    let [splats, both] = [traits, polygons].map(|traits| Traits { transparent: true, ..traits });
    vec![polygons, splats, both, Traits { lit: true, ..both }]
}

/// Layers and polygons are listed for each rasterizer and filter; the other options change them as they change opaque splats.
fn is_listed(settings: &Settings, traits: Traits) -> bool {
    let Settings { rasterizer, filter, tile_invocations, .. } = *settings;
    let beyond = traits.polygons || traits.transparent || traits.lit;
    !beyond || *settings == Settings { rasterizer, filter, tile_invocations, ..Settings::default() }
}

/// The names that tell a pipeline from others.
fn names(settings: &Settings, traits: Traits, recipe: &PipelineRecipe) -> PipelineNames {
    let splats = match (traits.ellipses, traits.closed) {
        (false, true) => "disks",
        (true, true) => "ellipses",
        (false, false) => "open disks",
        (true, false) => "open ellipses",
    };
    let mut names = PipelineNames {
        pass: recipe.pass.clone(),
        draws: recipe.draws().to_owned(),
        shaders: shaders(recipe),
        ..PipelineNames::default()
    };
    let kernel_eval = settings.kernel_eval.name();
    let kernel_eval = match settings.kernel {
        Kernel::Gaussian { .. } => kernel_eval.to_owned(),
        Kernel::PsiE { .. } => format!("psi_e {kernel_eval}"),
    };
    if recipe.has(SPEC_KERNEL) && !recipe.projects_splats() && settings.kernel == PSI_E {
        names.kernel_eval = kernel_eval.clone();
    }
    if recipe.projects_splats() {
        names.rasterizer = settings.rasterizer.name().to_owned();
        let (filter, filter_weight) = (settings.filter, settings.filter_weight);
        names.filter = WeightedFilter { filter, filter_weight }.to_string();
        names.kernel_eval = kernel_eval;
        names.splats = splats.to_owned();
    }
    if recipe.constants().contains(&(SPEC_SUMMED, SUMMED_BESIDE)) {
        names.draws += " beside polygons";
    }
    if recipe.constants().contains(&(SPEC_TEXELS, 0)) {
        names.draws = format!("{} as words", names.draws).trim_start().to_owned();
    }
    if recipe.draws() == "triangles" && !recipe.projects_splats() {
        names.splats = if traits.closed { "closed" } else { "open" }.to_owned();
    }
    // Each pipeline is named where it is found first: another precision finds those alone that depend on it.
    let beside_tiles = settings.rasterizer == Rasterizer::Compute && recipe.draws_into_f32();
    if settings.accumulate == Accumulate::F32 || beside_tiles {
        names.accumulate = Accumulate::F32.name().to_owned();
    }
    if recipe.has(SPEC_SHADING) {
        names.shading = settings.shading.name().to_owned();
    }
    names
}

fn shaders(recipe: &PipelineRecipe) -> String {
    match recipe.stages() {
        PipelineStages::Graphics(vertex, fragment) => format!("{} + {}", vertex.name, fragment.name),
        PipelineStages::Compute(shader) => shader.name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A gate finds a figure by its name.
    #[test]
    fn every_pipeline_has_a_name_of_its_own() {
        for (all, at_least) in [(false, 100), (true, 9000)] {
            let pipelines = pipelines(all).unwrap();
            let names: HashSet<_> = pipelines.iter().map(|(names, _)| names).collect();
            let mut seen = HashSet::new();
            let twice: Vec<_> = pipelines.iter().filter(|(names, _)| !seen.insert(names)).collect();
            assert!(twice.is_empty(), "{:#?}", twice.iter().map(|(names, _)| names).collect::<Vec<_>>());
            assert!(names.len() > at_least, "{}", names.len());
        }
    }

    #[test]
    fn sums_of_either_width_have_rows() {
        let all = pipelines(true).unwrap();
        let rows = |pass: &str, accumulate: &str| -> HashSet<PipelineNames> {
            // Beside polygons it is listed for the default settings alone.
            let alone = |names: &PipelineNames| !names.draws.ends_with("beside polygons");
            let of = all
                .iter()
                .filter(|(names, _)| names.pass == pass && names.accumulate == accumulate && alone(names));
            of.map(|(names, _)| PipelineNames { accumulate: String::new(), ..names.clone() }).collect()
        };
        for pass in ["accumulate", "floor add"] {
            assert_eq!(rows(pass, ""), rows(pass, "f32"), "{pass}");
            assert!(!rows(pass, "").is_empty(), "{pass}");
        }
        for pass in ["visibility", "finalize", "export", "kernel texture", "floor depth"] {
            assert!(!rows(pass, "").is_empty() && rows(pass, "f32").is_empty(), "{pass}");
        }
    }
}
