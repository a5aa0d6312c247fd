//! What is drawn once more to find whose the visible surface is.

use crate::passes::plan::{FramePlan, SplatMethod, SurfacePlan, method};
use crate::{
    scene::{Edges, Settings},
    vk::Limits,
};

impl<'a> FramePlan<'a> {
    /// The same frame, of whose opaque surface it is found whose it is.
    pub(crate) fn with_objects(mut self, limits: &Limits) -> Self {
        self.objects = (!self.opaque.is_empty()).then(|| self.opaque.for_objects(limits));
        self
    }
}

impl<'a> SurfacePlan<'a> {
    /// The same things by the graphics pipeline, whatever draws them, as splats and whole polygons. They have numbers from 0 on, splats first.
    fn for_objects(&self, limits: &Limits) -> Self {
        let settings = Settings { edges: Edges::Hard, ..self.settings.clone() };
        let (mut splats, mut meshes) = (self.splats.clone(), self.meshes.clone());
        let method = match splats.is_empty() {
            true => SplatMethod::default(),
            false => method::primitives(&mut splats, !meshes.is_empty(), &settings, limits),
        };
        splats.iter_mut().for_each(|draw| draw.half_sums = false);
        for (draw, number) in meshes.iter_mut().zip(splats.len() as u32..) {
            draw.levels = None;
            // Of the splats some may be gone.
            draw.constants.number_chunk(number);
        }
        Self { splats, meshes, method, settings, ..Self::default() }
    }

    /// The numbers of the scenes, among those of the frame, that its things belong to, in the order of their own numbers.
    pub(crate) fn placed(&self) -> impl Iterator<Item = u32> + '_ {
        self.splats.iter().map(|draw| draw.placed).chain(self.meshes.iter().map(|draw| draw.placed))
    }
}
