//! A frame of a view before anything is made for it: checked, planned, and declared.

use ash::vk;

use super::{
    View,
    depth::host_depth,
    frame::{DepthImage, ViewFrame},
    images::{AFTER, BEFORE, OfFrame},
    to::To,
};
use crate::{
    arena::{Arena, ArenaVec},
    error::{Error, Result},
    graph::{
        Graph, ImageDesc, ResourceId,
        execute::{Body, Physical},
    },
    passes::{
        self, FramePlan, HostDepth, Inputs, SurfacePlan,
        host::{BesideHost, OBJECTS_FORMAT, SURFACE_DEPTH_FORMAT},
    },
    renderer::Renderer,
    scene::{Camera, Settings},
};

/// What is known of a frame that can be drawn.
pub(super) struct Planned<'a> {
    pub settings: Settings,
    pub camera: Camera,
    /// That of the frame before.
    pub camera_before: Camera,
    pub depth: HostDepth,
    pub plan: FramePlan<'a>,
    /// Something of it is transparent.
    pub layered: bool,
    /// It finds whose each pixel is.
    pub finds_objects: bool,
    /// Of what the host is given.
    pub format: vk::Format,
}

impl View {
    /// Checks and plans a frame, in a frame's memory.
    ///
    /// # Errors
    /// As [`Self::prepare`], but for those of driver and allocator.
    pub(super) fn planned<'a>(
        &self,
        arena: &'a Arena,
        renderer: &Renderer,
        to: &To,
        frame: &ViewFrame<'a>,
    ) -> Result<Planned<'a>> {
        self.check_renderer(renderer)?;
        let settings = self.settings_of(frame);
        if settings.samples.0 > 1 {
            let problem = "expected 1: a host takes more itself, by jittered cameras";
            return Err(Error::option("samples", problem));
        }
        renderer.check_settings(&settings)?;
        let (camera, depth) = Self::camera_of(frame, frame.camera)?;
        self.check_order(depth)?;
        if to.is_recorded() {
            frame.scenes.iter().try_for_each(|placed| placed.scene.check_is_somewhere())?;
        }
        renderer.check_frame(frame.scenes, &camera, &settings)?;
        let settings = to.settings(settings);
        let (limits, ahead) = (&renderer.limits, to.ahead());
        let mut plan = FramePlan::of(arena, frame.scenes, &camera, (&settings, limits), ahead);
        if !self.rendering.has_color() {
            plan.transparent = SurfacePlan::default();
        }
        let layered = !plan.transparent.is_empty();
        self.check_frame(frame, layered)?;
        let camera_before = Self::camera_before(frame)?.unwrap_or(camera);
        let plan =
            if self.rendering.wants_objects() { plan.with_objects(arena, limits, ahead) } else { plan };
        let columns = if frame.mirrored { settings.size_px[0] as i32 } else { 0 };
        let depth =
            HostDepth { corner_px: frame.corner_px, columns, ..host_depth(depth, &camera, plan.range) };
        let (finds_objects, format) = (plan.objects.is_some(), self.rendering.surface_format());
        Ok(Planned { settings, camera, camera_before, depth, plan, layered, finds_objects, format })
    }
}

type Declared<'a> = (Graph<'a, Body<'a>>, ArenaVec<'a, (ResourceId, Physical)>);

/// Declares the passes of a frame, and what of the host's and the view's they see; the images, where there are some.
pub(super) fn declare<'a>(
    arena: &'a Arena,
    inputs: Inputs<'a>,
    planned: &'a Planned<'a>,
    hides: Option<DepthImage>,
    images: Option<&OfFrame<'_>>,
) -> Result<Declared<'a>> {
    let (mut graph, mut imports): Declared<'a> = (Graph::new(arena), arena.growing());
    let [width, height] = planned.settings.size_px;
    let extent = vk::Extent2D { width, height };
    let mut import = |name: &str, format, image: Option<&crate::vk::Image>| {
        let handle = graph.import_image(name, ImageDesc { format, extent }, BEFORE, Some(AFTER));
        imports.extend(image.map(|image| (handle.id(), Physical::Image(image.raw(), image.view()))));
        handle
    };
    let (format, layered, finds_objects) = (planned.format, planned.layered, planned.finds_objects);
    let mut surface = import("surface for a host", format, images.map(|images| images.surface));
    let mut depth = import("its depth", SURFACE_DEPTH_FORMAT, images.map(|images| images.depth));
    let mut layers =
        layered.then(|| import("layers for a host", format, images.and_then(|images| images.layers)));
    let of_objects = images.and_then(|images| images.objects);
    let mut objects = finds_objects.then(|| import("objects for a host", OBJECTS_FORMAT, of_objects));
    let hides = hides.filter(|_| layered).map(|hides| {
        let DepthImage { image, view, format, extent, layer, before, after } = hides;
        let handle =
            graph.import_image("depth of the host", ImageDesc { format, extent }, before, Some(after));
        imports.push((handle.id(), Physical::Layer(image, view, layer)));
        handle
    });
    let beside = BesideHost {
        hides: hides.as_ref().map(|hides| (hides, planned.depth)),
        depth: &mut depth,
        objects: objects.as_mut(),
        layers: layers.as_mut(),
    };
    passes::frame(&mut graph, inputs, &planned.plan, &mut surface, format, (false, Some(beside)))?;
    Ok((graph, imports))
}
