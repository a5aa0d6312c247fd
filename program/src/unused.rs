//! Options that were given and that mean nothing for what is drawn: told in a line, for whoever gave them waits for what they do.

use std::path::PathBuf;

use surfel::{
    load::is_scene_file,
    scene::{Opacity, Scene},
};

use crate::{console, inputs::Inputs, scene::Loaded};

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

/// Tells of options without effect where a scene is drawn as triangles alone. `said` are the names of all that the user gave.
pub fn tell(said: impl Iterator<Item = &'static str>, inputs: &Inputs, loaded: &Loaded) {
    if loaded.is_read_by_view() || !is_triangles(&loaded.scene) {
        return;
    }
    let is_glass = |object: &surfel::scene::MeshObject| object.mesh.colors.opacity() != Opacity::Opaque;
    let has_glass = loaded.scene.meshes.iter().any(is_glass);
    let is_unused =
        |name: &&str| OF_SPLATS.contains(name) || !has_glass && OF_SPLATS_AND_GLASS.contains(name);
    let unused: Vec<String> = said.filter(is_unused).map(|name| format!("--{name}")).collect();
    if let Some(line) = line(&unused, &inputs.files) {
        console::say(&line);
    }
}

fn is_triangles(scene: &Scene) -> bool {
    let has_splats = !scene.objects.is_empty() || !scene.hybrids.is_empty() || !scene.leveled.is_empty();
    !has_splats && !scene.meshes.is_empty()
}

fn line(unused: &[String], files: &[PathBuf]) -> Option<String> {
    let have = match unused {
        [] => return None,
        [_] => "has",
        _ => "have",
    };
    let splats = match files.iter().all(|file| is_scene_file(file)) {
        true => "representation = \"splats\" of its objects",
        false => "--representation splats",
    };
    let options = joined(unused);
    Some(format!("{options} {have} no effect: this scene is drawn as triangles; {splats} draws it as splats"))
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
    use surfel::scene::{OptionTable as _, Settings, Storage};

    use super::*;

    #[test]
    fn every_name_is_an_option() {
        let settings = Settings::OPTIONS.iter().map(|setting| setting.name);
        let storage = Storage::OPTIONS.iter().map(|setting| setting.name);
        let known: Vec<&str> = settings.chain(storage).chain(["budget-memory"]).collect();
        let unknown = OF_SPLATS.iter().chain(&OF_SPLATS_AND_GLASS).find(|name| !known.contains(name));
        assert_eq!(unknown, None);
    }

    #[test]
    fn the_line_names_all_and_what_to_type() {
        let of = |names: &[&str], file: &str| {
            let names: Vec<String> = names.iter().map(|name| format!("--{name}")).collect();
            line(&names, &[file.into()])
        };
        let because = "no effect: this scene is drawn as triangles";
        assert_eq!(of(&[], "a.obj"), None);
        let one = format!("--lod has {because}; --representation splats draws it as splats");
        assert_eq!(of(&["lod"], "a.obj"), Some(one));
        let three = format!(
            "--lod, --cull and --order have {because}; representation = \"splats\" of its objects draws it as splats"
        );
        assert_eq!(of(&["lod", "cull", "order"], "a.toml"), Some(three));
    }
}
