//! The cases of what is transparent, of polygons, of both beside splats, and of a scene's own lights.

use super::{
    case::{Case, Drawing, SIZE_PX, can_draw, slug},
    check::Check,
};
use crate::{
    hard_scenes::Hard,
    scene::{
        Accumulate, Edges, Filter, Layers, Opacity, Rasterizer, Scene, Settings, TileInvocations, Transition,
    },
};

/// The scene that the quick form has with every rasterizer and with every filter: splats and polygons in each layer.
const OF_EVERY_METHOD: &str = "transparent splats and polygons of one surface";

/// Scenes that take a second a method: not with every method, but with every rasterizer and with every filter.
const SLOW: [&str; 2] = ["27 transparent spheres", "camera in transparent things"];

/// One that takes ten times as long as others: the default method alone.
const SLOWEST: &str = "64 layers";

/// Those whose edges cover pixels in part: opaque splats behind a pane, splats beside polygons, layers.
const WITH_EDGES: [&str; 3] =
    ["glass before an opaque model", "splats and polygons of one surface", "interpenetrating shells"];

/// All of them, group after group; `first` is the index of the first of `scenes` in the suite.
pub(super) fn cases(first: usize, scenes: &[Hard]) -> Vec<Case> {
    let scenes = || scenes.iter().enumerate().map(|(i, hard)| (first + i, hard));
    let mut cases = Vec::new();
    for (_, rasterizer) in Rasterizer::METHODS {
        for (_, filter) in Filter::NAMES {
            cases.extend(scenes().filter_map(|(i, hard)| by_method(i, hard, *rasterizer, *filter)));
        }
    }
    cases.extend(scenes().map(|(i, hard)| sums_16(i, hard)));
    cases.extend(scenes().filter_map(|(i, hard)| auto(i, hard)));
    cases.extend(scenes().filter_map(|(i, hard)| by_pixels(i, hard)));
    cases.extend(scenes().filter_map(|(i, hard)| edges(i, hard)));
    cases
}

/// Against the oracle, with 32-bit sums. `None` where the method can't draw the scene, or is not meant to.
fn by_method(scene: usize, hard: &Hard, rasterizer: Rasterizer, filter: Filter) -> Option<Case> {
    let settings = Settings { size_px: SIZE_PX, rasterizer, filter, ..hard.settings.clone() };
    let default_rasterizer = rasterizer == Rasterizer::Perspective;
    let default_filter = filter == Filter::default();
    let is_meant = match hard.name {
        // Polygons know no method.
        _ if hard.scene.objects.is_empty() => default_rasterizer && default_filter,
        SLOWEST => default_rasterizer && default_filter,
        name if SLOW.contains(&name) => default_rasterizer || default_filter,
        _ => true,
    };
    let of_every_method = hard.name == OF_EVERY_METHOD;
    let quick = match (default_rasterizer, default_filter) {
        (true, true) => true,
        (true, false) => of_every_method || filter == hard.settings.filter,
        (false, _) => of_every_method && default_filter,
    };
    let drawing = Drawing { scene, settings, check: Check::Light };
    let allowed = is_meant && can_draw(hard, &drawing.settings);
    allowed.then(|| case("layers", hard, quick, drawing))
}

/// The default method with sums of 16 bits.
fn sums_16(scene: usize, hard: &Hard) -> Case {
    let settings = Settings { accumulate: Accumulate::F16, ..by_default(hard) };
    let drawing = Drawing { scene, settings, check: Check::Light };
    case("layers-16", hard, hard.name != SLOWEST, drawing)
}

/// The default method where the device finds out how many layers there are. `None` where there are none.
fn auto(scene: usize, hard: &Hard) -> Option<Case> {
    let settings = Settings { layers: Layers::Auto(hard.settings.layers.most()), ..by_default(hard) };
    let drawing = Drawing { scene, settings, check: Check::AutoLayers };
    let quick = hard.name != SLOWEST && !SLOW.contains(&hard.name);
    is_transparent(&hard.scene).then(|| case("layers-auto", hard, quick, drawing))
}

/// By tiles, an invocation a pixel, then a column. `None` where there are no splats.
fn by_pixels(scene: usize, hard: &Hard) -> Option<Case> {
    let (rasterizer, tile_invocations) = (Rasterizer::Compute, TileInvocations::Pixel);
    let settings = Settings { rasterizer, tile_invocations, ..by_default(hard) };
    let drawing = Drawing { scene, settings, check: Check::TileInvocations };
    (!hard.scene.objects.is_empty()).then(|| case("tile-invocations", hard, false, drawing))
}

/// Edges that cover pixels in part, by tiles, which alone draw them. `None` of other scenes, and of transitions that have hard ones.
fn edges(scene: usize, hard: &Hard) -> Option<Case> {
    let (rasterizer, edges) = (Rasterizer::Compute, Edges::Coverage);
    let settings = Settings { rasterizer, edges, ..by_default(hard) };
    let covers = WITH_EDGES.contains(&hard.name) && settings.covers_in_part();
    let drawing = Drawing { scene, settings, check: Check::Light };
    covers.then(|| case("edges", hard, true, drawing))
}

fn by_default(hard: &Hard) -> Settings {
    Settings {
        size_px: SIZE_PX,
        rasterizer: Rasterizer::Perspective,
        filter: Filter::default(),
        ..hard.settings.clone()
    }
}

fn case(group: &str, hard: &Hard, quick: bool, drawing: Drawing) -> Case {
    let Settings { rasterizer, filter, transition, .. } = drawing.settings;
    let mut name = [group, rasterizer.name(), filter.name(), &slug(hard.name)].join(".");
    // One scene is there with every transition.
    if transition != Transition::default() {
        name = format!("{name}-{}", transition.name());
    }
    Case { name, quick, drawing: Some(drawing) }
}

/// Whether anything of it is drawn in layers.
fn is_transparent(scene: &Scene) -> bool {
    let splats = scene.objects.iter().map(|object| object.splats.colors.opacity());
    let polygons = scene.meshes.iter().map(|object| object.mesh.colors.opacity());
    splats.chain(polygons).any(|opacity| opacity == Opacity::Transparent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hard_scenes::transparent;

    #[test]
    fn scenes_that_are_named_here_are_there_and_every_rasterizer_and_filter_has_each_that_is_slow() {
        let scenes = transparent::all();
        let cases = cases(0, &scenes);
        let count = |name: &str, group: &str| {
            let end = format!(".{}", slug(name));
            cases.iter().filter(|case| case.group() == group && case.name.ends_with(&end)).count()
        };
        // Some pairs of a rasterizer and a filter are none.
        assert_eq!(count(OF_EVERY_METHOD, "layers"), 39);
        let either = Rasterizer::METHODS.len() + Filter::NAMES.len() - 1;
        assert_eq!(SLOW.map(|name| count(name, "layers")), [either; 2]);
        assert_eq!(["layers", "layers-16", "layers-auto"].map(|group| count(SLOWEST, group)), [1; 3]);
        // Opaque splats and polygons, with four transitions.
        assert_eq!(cases.iter().filter(|case| case.group() == "layers-16").count(), scenes.len());
        assert_eq!(cases.iter().filter(|case| case.group() == "layers-auto").count(), scenes.len() - 4);
    }
}
