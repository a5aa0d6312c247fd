//! A prepared scene as a frame draws it: all that is opaque, all that is transparent.

use super::{
    Draw, MeshDraw, TilePlan, choice, cull, draws, lights,
    listed::Listed,
    mesh_draws,
    seen::SeenSplats,
    tiles::{self, Band},
};
use crate::{
    prepare::PreparedScene,
    scene::{Camera, Cull, Light, Settings, Transition},
    vk::Limits,
};

/// What is drawn alike: all that is opaque, or all that is transparent.
#[derive(Default)]
pub struct Part<'a> {
    /// As splats.
    pub splats: Vec<Draw<'a>>,
    /// As polygons.
    pub meshes: Vec<MeshDraw<'a>>,
    /// How splats are drawn by tiles, where they are.
    pub tiles: Option<TilePlan>,
    /// Bands of the image, where lists of all of it would take more memory than they are meant to.
    pub bands: Vec<Band<'a>>,
    /// Where those that may be seen are looked for, which are listed first, and only they are set up.
    pub kept: Option<Listed>,
}

/// A prepared scene as seen from a camera.
#[derive(Default)]
pub struct Parts<'a> {
    /// What hides all that is behind it.
    pub opaque: Part<'a>,
    /// What is drawn in layers.
    pub transparent: Part<'a>,
    /// What shines on both, where the scene has lights of its own.
    pub lights: Vec<lights::ShaderLight>,
}

impl<'a> Parts<'a> {
    /// The parts of a scene.
    pub fn of(scene: &'a PreparedScene, camera: &Camera, settings: &Settings, limits: &Limits) -> Self {
        let all = draws(scene, camera, settings, limits).into_iter();
        let (clear_splats, splats) = all.partition(|draw| draw.chunk.transparent);
        let all = mesh_draws(scene, camera, settings, limits).into_iter();
        let (clear_meshes, meshes) = all.partition(|draw| draw.chunk.transparent);
        Self {
            opaque: Part::new(splats, meshes, settings, limits),
            transparent: Part::new(clear_splats, clear_meshes, settings, limits)
                .with_layers(settings, &scene.lights),
            lights: lights::shader_lights(&scene.lights, camera),
        }
    }
}

impl<'a> Part<'a> {
    /// A part whose splats are drawn by tiles, where the settings want that and the device has room.
    fn new(
        mut splats: Vec<Draw<'a>>,
        meshes: Vec<MeshDraw<'a>>,
        settings: &Settings,
        limits: &Limits,
    ) -> Self {
        let by_tiles = choice::by_tiles(&splats, !meshes.is_empty(), settings, limits).is_ok();
        let tiles = by_tiles.then(|| TilePlan::of(&splats, settings, limits)).flatten();
        let may_list = !splats.is_empty()
            && choice::lists_kept(&splats, tiles.is_some(), settings, limits)
            && cull::has_room(&splats, tiles.is_some(), limits);
        let leaves_out = cull::may_leave_out(&splats) || tiles.is_none() && settings.cull == Cull::Hidden;
        // Bands have lists, too.
        let most_bytes = tiles::most_bytes(&splats, settings.tile_memory);
        let is_long = tiles.as_ref().is_some_and(|plan| plan.bytes() > most_bytes);
        if !may_list || !(leaves_out || is_long) {
            cull::number_splats(&mut splats);
            return Self { splats, meshes, tiles, ..Self::default() };
        }
        let rows = tiles::rows_of_image(settings);
        let seen = SeenSplats::new(splats.iter().map(Draw::seen_blocks).collect(), rows.end);
        let tiles = tiles.map(|whole| whole.or_of_blocks(&splats, &seen, settings, limits));
        // Polygons may be drawn between two passes over the whole image.
        let bands = match &tiles {
            Some(whole) if meshes.is_empty() => tiles::bands(&splats, &seen, whole, settings, limits),
            _ => Vec::new(),
        };
        let kept = Some(Listed::of(&mut splats, &seen.chunks, rows));
        Self { splats, meshes, tiles, bands, kept }
    }

    /// The same for layers, which the graphics pipeline draws where it draws some of a layer.
    fn with_layers(mut self, settings: &Settings, lights: &[Light]) -> Self {
        let all = self.tiles.filter(|plan| self.meshes.is_empty() && !plan.may_be_large);
        let with_layers = |plan: TilePlan| plan.with_layers(settings.layers.most(), lights.len() as u32);
        self.tiles = all.map(with_layers);
        self.kept = self.kept.filter(|_| self.tiles.is_some());
        if self.kept.is_none() {
            cull::number_splats(&mut self.splats);
        }
        // A large splat is the graphics pipeline's also where it is large for the lists of a band alone.
        if self.tiles.is_none() || self.bands.iter().any(|band| band.plan.may_be_large) {
            self.bands.clear();
        }
        for band in &mut self.bands {
            band.plan = with_layers(band.plan.clone());
        }
        self
    }

    /// How its tiles are drawn: all at once, or in bands.
    pub(super) fn plans(&self) -> impl Iterator<Item = &TilePlan> {
        let whole = self.tiles.iter().filter(|_| self.bands.is_empty());
        whole.chain(self.bands.iter().map(|band| &band.plan))
    }

    /// What visible splats hide is left out before sums. Not where fragments farther behind count, too: there the paper's transition
    /// shifts toward the viewer what visibility has shifted away.
    pub fn leaves_hidden_out(&self, settings: &Settings) -> bool {
        match &self.tiles {
            Some(plan) => plan.hidden && self.meshes.is_empty(),
            None => {
                let twice = settings.transition == Transition::Paper && !self.meshes.is_empty();
                self.kept.is_some() && settings.cull == Cull::Hidden && !twice
            }
        }
    }

    /// In words, how its splats are drawn, and why so; `None` where there are none.
    pub fn drawn(&self, settings: &Settings, limits: &Limits) -> Option<String> {
        choice::words(self, settings, limits)
    }

    /// Nothing at all.
    pub fn is_empty(&self) -> bool {
        self.splats.is_empty() && self.meshes.is_empty()
    }
}
