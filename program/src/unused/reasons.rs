//! Why options of a picture do nothing for it, beside its being one of triangles.

use surfel::scene::{
    Budget, Cull, LodSteps, Opacity, Rasterizer, Scene, Settings, Shading, Shapes, SplatFormat, Storage,
    Transition,
};

use super::has_default;
use crate::scene::Loaded;

/// A picture that is asked for.
pub struct Asked<'a> {
    pub settings: &'a Settings,
    pub storage: Storage,
    /// Before views have read anything of their own.
    pub loaded: &'a Loaded,
    /// Whether a picture is drawn: pixels may be looked at, and that is all.
    pub is_drawn: bool,
    /// Whether it is written, not only timed.
    pub is_written: bool,
}

/// Options, and why they have no effect, if they have none.
type Reason = (&'static [&'static str], fn(&Asked<'_>) -> Option<String>);

/// The first that holds for an option is told.
pub const REASONS: &[Reason] = &[
    (&["explain"], |asked| {
        because(!asked.is_written, "no picture is written beside --pick; --output writes one")
    }),
    (&["shading", "light", "background", "outlines", "samples", "exposure", "tonemap"], |asked| {
        because(!asked.is_drawn, "no picture is drawn beside --pick; --output draws one")
    }),
    (&["budget-memory"], |asked| {
        let is_read_at_once = !asked.loaded.is_read_by_view();
        because(is_read_at_once, "it is for .surfel files, COPC and Potree, and there is none")
    }),
    (&["lod-steps"], |asked| asked.why_no_steps()),
    (&["layers", "last-layer"], |asked| {
        because(!asked.is_transparent(), "nothing of this scene is transparent")
    }),
    (&["transition"], |asked| {
        // Without edges that pixels are covered by in part it would be another picture.
        let by_color = Settings { transition: Transition::Color, ..asked.settings.clone() };
        let same_edges = by_color.covers_in_part() == asked.settings.covers_in_part();
        because(same_edges && asked.loaded.scene.meshes.is_empty(), "this scene has no triangles")
    }),
    (&["filter-weight"], |asked| {
        let has_weights = asked.settings.filter.adjusts();
        because(!has_weights, "only --filter adjust and adjust-paper give splats such weights")
    }),
    (&["tile-invocations", "tile-memory"], |asked| match asked.settings.rasterizer {
        Rasterizer::Auto | Rasterizer::Compute => {
            asked.settings.why_not_tiles().map(|(option, why)| format!("{option} rules out tiles: {why}"))
        }
        other => Some(format!("--rasterizer {} draws no tiles", other.name())),
    }),
    (&["cull"], |asked| match (asked.settings.cull, asked.settings.rasterizer) {
        (Cull::List | Cull::Hidden, quads @ (Rasterizer::Quad | Rasterizer::Triangle)) => {
            Some(format!("lists are for points and tiles, not for --rasterizer {}", quads.name()))
        }
        _ => None,
    }),
    (&["light"], |asked| match asked.settings.shading {
        Shading::Phong | Shading::Lambert => None,
        unlit => Some(format!("--shading {} takes no light", unlit.name())),
    }),
    (&["splat-format"], |asked| {
        let is_packed = asked.storage.format == SplatFormat::Packed;
        because(is_packed && !asked.has_disks(), "this scene is made of ellipses, which stay exact")
    }),
];

fn because(holds: bool, why: &str) -> Option<String> {
    holds.then(|| why.to_owned())
}

impl Asked<'_> {
    /// Whether the option of this name is as it is by default.
    pub fn has_default(&self, name: &str) -> bool {
        has_default(self.settings, name) || has_default(&self.storage, name)
    }

    /// Why no node takes the place of others step by step.
    fn why_no_steps(&self) -> Option<String> {
        let Self { settings, loaded, .. } = self;
        let has_levels = settings.wants_levels() || !loaded.hierarchies.is_empty();
        let why = match settings.lod_steps {
            LodSteps::Hard => return None,
            LodSteps::Blend if !has_levels => "this scene has no levels of detail; --lod 1px makes them",
            LodSteps::Blend if settings.tau_px() == 0.0 && settings.budget == Budget::Unlimited => {
                "--lod 0 draws the scene itself"
            }
            LodSteps::Blend if settings.blended_size() == 1.0 => {
                "levels blend by tiles alone, with --edges coverage and a filter that weighs splats"
            }
            LodSteps::Blend => return None,
        };
        Some(why.to_owned())
    }

    fn is_transparent(&self) -> bool {
        let Scene { objects, meshes, .. } = &self.loaded.scene;
        let splats = objects.iter().map(|object| &object.splats.colors);
        let mut all = splats.chain(meshes.iter().map(|object| &object.mesh.colors));
        all.any(|colors| colors.opacity() == Opacity::Transparent)
            || self.loaded.hierarchies.iter().any(|file| file.header().transparent)
    }

    fn has_disks(&self) -> bool {
        let Loaded { scene, hierarchies, octrees, .. } = self.loaded;
        let is_disks = |shapes: &Shapes| matches!(shapes, Shapes::Disks { .. });
        scene.objects.iter().any(|object| is_disks(&object.splats.shapes))
            || scene.hybrids.iter().any(|hybrid| is_disks(&hybrid.splats.leaves.shapes))
            || hierarchies.iter().any(|file| !file.header().ellipses)
            || !octrees.files.is_empty()
    }
}
