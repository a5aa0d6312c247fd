//! Options that were given and that mean nothing for what is drawn: told in a line, for whoever gave them waits for what they do.

mod reasons;

use surfel::{
    load::is_scene_file,
    scene::{Opacity, OptionTable, Scene},
};

use crate::{console, inputs::Inputs, scene::Loaded};
pub use reasons::Asked;
use reasons::REASONS;

/// Options that change splats, and nothing of triangles.
const OF_SPLATS: [&str; 15] = [
    "rasterizer",
    "tile-invocations",
    "tile-memory",
    "filter",
    "filter-weight",
    "kernel-eval",
    "cull",
    "lod",
    "lod-steps",
    "budget",
    "transition",
    "outlines",
    "order",
    "splat-format",
    "budget-memory",
];

/// Options that change splats, and triangles that are transparent.
const OF_SPLATS_AND_GLASS: [&str; 4] = ["accumulate", "epsilon", "layers", "last-layer"];

/// Options of how a device draws what the reference draws, too.
const OF_DEVICES: [&str; 8] =
    ["tile-invocations", "tile-memory", "kernel-eval", "cull", "lod", "lod-steps", "budget", "outlines"];

/// Tells of options without effect where a scene is drawn as triangles alone. `said` are the names of all that the user gave.
pub fn tell(said: impl Iterator<Item = &'static str>, inputs: &Inputs, loaded: &Loaded) {
    let of_splats = of_splats(loaded);
    let unused: Vec<&str> = said.filter(|name| of_splats.contains(name)).collect();
    let splats = match inputs.files.iter().all(|file| is_scene_file(file)) {
        true => "representation = \"splats\" of its objects",
        false => "--representation splats",
    };
    say(&unused, &format!("this scene is drawn as triangles; {splats} draws it as splats"));
}

/// The same of a picture, for every other reason. Of what is given as it is by default anyway nothing is told.
pub fn tell_of_picture(said: &[&'static str], asked: &Asked<'_>) {
    let mut told = of_splats(asked.loaded);
    for (options, why) in REASONS {
        let is_left =
            |name: &&str| options.contains(name) && !told.contains(name) && !asked.has_default(name);
        let left: Vec<&str> = said.iter().copied().filter(is_left).collect();
        let because = if left.is_empty() { None } else { why(asked) };
        if let Some(because) = because {
            say(&left, &because);
            told.extend(*options);
        }
    }
}

/// The same of a picture by the reference, which has no device's ways to draw it.
pub fn tell_of_reference(said: &[&'static str], asked: &Asked<'_>) {
    let is_unused = |name: &&str| OF_DEVICES.contains(name) && !asked.has_default(name);
    let (unused, others): (Vec<&str>, Vec<&str>) = said.iter().partition(|name| is_unused(name));
    say(&unused, "the reference draws each splat by itself, in arithmetic of 64 bits");
    tell_of_picture(&others, asked);
}

/// Tells that options have no effect, and why, if there are any.
pub fn say(options: &[&str], because: &str) {
    if let Some(line) = line(options, because) {
        console::say(&line);
    }
}

/// Whether the option of this name is as it is by default; one that is in no table is not.
pub fn has_default<S: OptionTable>(settings: &S, name: &str) -> bool {
    let setting = S::OPTIONS.iter().find(|setting| setting.name == name);
    setting.is_some_and(|setting| (setting.get)(settings) == (setting.get)(&S::default()))
}

/// The options that mean nothing for a scene because it is drawn as triangles alone.
fn of_splats(loaded: &Loaded) -> Vec<&'static str> {
    if !is_triangles(loaded) {
        return Vec::new();
    }
    let is_glass = |object: &surfel::scene::MeshObject| object.mesh.colors.opacity() != Opacity::Opaque;
    match loaded.scene.meshes.iter().any(is_glass) {
        true => OF_SPLATS.to_vec(),
        false => [&OF_SPLATS[..], &OF_SPLATS_AND_GLASS].concat(),
    }
}

/// Whether a scene is drawn as triangles alone.
pub fn is_triangles(loaded: &Loaded) -> bool {
    let Scene { objects, hybrids, leveled, meshes, .. } = &loaded.scene;
    let has_splats = !objects.is_empty() || !hybrids.is_empty() || !leveled.is_empty();
    !loaded.is_read_by_view() && !has_splats && !meshes.is_empty()
}

fn line(options: &[&str], because: &str) -> Option<String> {
    let have = match options {
        [] => return None,
        [_] => "has",
        _ => "have",
    };
    let options: Vec<String> = options.iter().map(|name| format!("--{name}")).collect();
    Some(format!("{} {have} no effect: {because}", joined(&options)))
}

/// Names in a row, as a sentence has them.
pub fn joined(names: &[impl AsRef<str>]) -> String {
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    match &names[..] {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use surfel::scene::{Encoding, OptionTable as _, Settings, Storage};

    use super::*;

    #[test]
    fn every_name_is_an_option() {
        let settings = Settings::OPTIONS.iter().map(|setting| setting.name);
        let storage = Storage::OPTIONS.iter().map(|setting| setting.name);
        let encoding = Encoding::OPTIONS.iter().map(|setting| setting.name);
        let others = ["budget-memory", "light", "explain"];
        let known: Vec<&str> = settings.chain(storage).chain(encoding).chain(others).collect();
        let of_reasons = REASONS.iter().flat_map(|(names, _)| *names);
        let mut all = OF_SPLATS.iter().chain(&OF_SPLATS_AND_GLASS).chain(of_reasons);
        assert_eq!(all.find(|name| !known.contains(name)), None);
    }

    #[test]
    fn the_line_names_all_and_why() {
        assert_eq!(line(&[], "why"), None);
        assert_eq!(line(&["lod"], "why").as_deref(), Some("--lod has no effect: why"));
        let three = line(&["lod", "cull", "order"], "why");
        assert_eq!(three.as_deref(), Some("--lod, --cull and --order have no effect: why"));
    }
}
