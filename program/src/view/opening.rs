//! What is read of files at once, and which of them are read in pages.

use std::sync::Arc;

use surfel::{
    Result,
    levels_file::LevelsFile,
    scene::{Budget, LodSteps, Storage},
};

use super::{
    document::Document,
    extents,
    loading::{LEVELS_FROM, Wants},
};
use crate::{console::Bars, hierarchies::load_scene_with_hierarchies, inputs::Inputs, scene::Loaded, unused};

/// Reads files, but for those of which pages are to come.
///
/// # Errors
/// As [`load_scene_with_hierarchies`] and [`LevelsFile::load`]; a camera without a picture.
pub fn open(files: Inputs, size_px: [u32; 2], wants: &Wants, bars: &Bars) -> Result<Document> {
    let mut loaded = load_scene_with_hierarchies(&files, bars)?;
    let Wants { camera, lights, storage, settings, said } = wants;
    let budget = settings.budget != Budget::Unlimited;
    unused::tell(said.iter().copied(), &files, &loaded);
    let camera = camera.camera(&loaded, size_px)?;
    let in_pages = *storage == Storage::default() && !budget;
    let is_paged = |file: &LevelsFile| in_pages && !file.header().transparent;
    let (paged, at_once): (Vec<_>, Vec<_>) =
        std::mem::take(&mut loaded.hierarchies).into_iter().partition(is_paged);
    for mut file in at_once {
        loaded.scene.leveled.push(file.load(None, u64::MAX, bars)?.object);
    }
    bars.clear();
    if !unused::is_triangles(&loaded) || !paged.is_empty() {
        let has = |name| said.contains(&name).then_some(name);
        if paged.is_empty() {
            let because = "it is for opaque .surfel files, without --budget, --order and --splat-format";
            unused::say(has("budget-memory").as_slice(), because);
        }
        let has_levels = budget || loaded.scene.has_levels() || !paged.is_empty();
        if !has_levels && loaded.scene.splat_count() <= LEVELS_FROM {
            let levels = has("lod").filter(|_| settings.lod.wants_levels());
            let steps = has("lod-steps").filter(|_| settings.lod_steps != LodSteps::Hard);
            let unused: Vec<&str> = levels.into_iter().chain(steps).collect();
            let because = format!(
                "the window makes levels of detail of more than {LEVELS_FROM} splats; --budget makes them of fewer"
            );
            unused::say(&unused, &because);
        }
    }
    let Loaded { mut scene, ball, picture, inputs, .. } = loaded;
    if !lights.is_empty() {
        scene.lights.clone_from(lights);
    }
    scene.storage = *storage;
    (scene.budget, scene.levels) = (budget, budget);
    scene.numbered = true;
    let mut balls = extents::balls(&mut scene);
    balls.extend(paged.iter().map(|file| Some(file.ball())));
    Ok(Document { scene: Arc::new(scene), ball, balls, camera, picture, inputs, files, paged: paged.into() })
}
