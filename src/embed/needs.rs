//! What memory scenes and views will ask for, told before anything is taken.

use std::cell::RefCell;

use ash::vk;

use super::{
    Rendering, View, ViewFrame, fields::as_fields, images::Images, planned::declare, table::Table, to::To,
};
use crate::{
    arena::Arena,
    error::Result,
    frame::planes_desc,
    graph::execute::Kept,
    passes::{HostObject, Inputs, Place, Planes, Tints},
    prepare::{NO_TINT, PreparedScene, needs},
    renderer::Renderer,
    scene::Scene,
    vk::{MemoryNeeds, MemoryUse},
};

impl Renderer {
    /// Tells what memory [`Self::upload`] of a scene will ask for, piece by piece and in its order: what the scene keeps, and what is copied from ([`MemoryUse::Upload`]), which goes once the copies have run. Takes none of the
    /// device's, but as long as the upload on the host. With it the scene as it would be uploaded, but on no device: for frames of which [`Self::view_needs`] is asked; others refuse it.
    ///
    /// # Errors
    /// As [`Self::prepare`], but for those of driver and allocator.
    pub fn scene_needs(&self, scene: &Scene) -> Result<(MemoryNeeds, PreparedScene)> {
        let (prepared, needs) = needs(self.device(), &self.limits, &self.shaders.splat_set, scene)?;
        Ok((needs, prepared))
    }

    /// Tells what memory the first [`View::prepare`] of a new view will ask for, for a frame like this, piece by piece and in its order; of the first frame of a renderer with what that has of its own.
    /// Takes none of the device's, and makes no pipeline. Its scenes are on the device, or of [`Self::scene_needs`].
    ///
    /// Frames of the view that need no more of any piece ask for nothing. How much a frame needs follows from which splats may be seen, and so from its camera: a host asks for those
    /// that it knows to see most.
    ///
    /// # Errors
    /// As [`View::new`] and [`View::prepare`], but for those of driver and allocator.
    pub fn view_needs(&self, rendering: &Rendering, frame: &ViewFrame<'_>) -> Result<MemoryNeeds> {
        let view = View::without_pipelines(self, rendering)?;
        view.needs(self, frame).map_err(as_fields)
    }
}

impl View {
    fn needs(&self, renderer: &Renderer, frame: &ViewFrame<'_>) -> Result<MemoryNeeds> {
        let (arena, mut needs) = (Arena::new(), MemoryNeeds::default());
        let planned = self.planned(&arena, renderer, &To::Needs, frame)?;
        let (plan, settings) = (&planned.plan, &planned.settings);
        let of = (planned.layered, planned.finds_objects);
        Images::tell(&self.device, (planned.format, settings.size_px), of, &mut needs)?;
        let planes = Planes { count: plan.planes.len() as u32, buffer: vk::Buffer::null() };
        if planes.count > 0 {
            needs.buffer(&self.device, planes_desc(), MemoryUse::Upload)?;
        }
        let mut tints = [None; 2];
        if frame.scenes.iter().any(|placed| placed.tint != NO_TINT) {
            for (tints, part) in tints.iter_mut().zip([&plan.opaque, &plan.transparent]) {
                let bytes = (part.placed().count() * size_of_val(&NO_TINT)) as u64;
                if bytes > 0 {
                    Table::tell(&self.device, "tints", bytes, &mut needs)?;
                    *tints = Some(Tints { buffer: vk::Buffer::null(), bytes });
                }
            }
        }
        renderer.shaders.tell(&mut needs)?;
        let pipelines = RefCell::default();
        let inputs = Inputs::new(&planned.camera, settings, Place::List(&pipelines));
        let source = inputs.source.cut_by(planes);
        // Where layers are counted, no query is needed to declare it.
        let inputs = Inputs { range: plan.range, source, tints, ..inputs };
        let (graph, _) = declare(&arena, inputs, &planned, frame.hides, None)?;
        Kept::tell(&self.device, &graph, &mut needs)?;
        if let Some(drawn) = &plan.objects {
            let bytes = (drawn.placed().count() * size_of::<HostObject>()) as u64;
            Table::tell(&self.device, "objects of a host", bytes, &mut needs)?;
        }
        Ok(needs)
    }
}
