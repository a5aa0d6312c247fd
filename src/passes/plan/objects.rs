//! What is drawn once more to find whose the visible surface is.

use crate::passes::plan::{
    FramePlan, SplatMethod, SurfacePlan, ahead::Ahead, draws::Draw, mesh_draws::MeshDraw, method,
};
use crate::{
    arena::Arena,
    scene::{Edges, Settings},
    vk::Limits,
};

impl<'a> FramePlan<'a> {
    /// The same frame, of whose opaque surface it is found whose it is.
    pub(crate) fn with_objects(mut self, arena: &'a Arena, limits: &Limits, ahead: Option<Ahead>) -> Self {
        self.objects = (!self.opaque.is_empty()).then(|| self.opaque.for_objects(arena, limits, ahead));
        self
    }
}

impl<'a> SurfacePlan<'a> {
    /// The same things by the graphics pipeline, whatever draws them, as splats and whole polygons. They have numbers from 0 on, splats first.
    fn for_objects(&self, arena: &'a Arena, limits: &Limits, ahead: Option<Ahead>) -> Self {
        let settings = Settings { edges: Edges::Hard, ..self.settings.clone() };
        let (mut splats, mut meshes) = (arena.growing(), arena.growing());
        splats.extend_from_slice_copy(self.splats);
        meshes.extend_from_slice_copy(self.meshes);
        let method = match splats.is_empty() {
            true => SplatMethod::default(),
            false => method::primitives(arena, &mut splats, !meshes.is_empty(), (&settings, limits), ahead),
        };
        splats.iter_mut().for_each(|draw: &mut Draw<'_>| draw.half_sums = false);
        for (draw, number) in meshes.iter_mut().zip(splats.len() as u32..) {
            let draw: &mut MeshDraw<'_> = draw;
            draw.levels = None;
            // Of the splats some may be gone.
            draw.constants.number_chunk(number);
        }
        let (splats, meshes) = (splats.into_bump_slice(), meshes.into_bump_slice());
        Self { splats, meshes, method, settings, ..Self::default() }
    }

    /// The numbers of the scenes, among those of the frame, that its things belong to, in the order of their own numbers.
    pub(crate) fn placed(&self) -> impl Iterator<Item = u32> + '_ {
        self.splats.iter().map(|draw| draw.placed).chain(self.meshes.iter().map(|draw| draw.placed))
    }
}
