//! A camera as it stands in a scene's own space, and what follows from it alone: found once for all that the scene has, for a frame may show hundreds of small scenes.

use glam::DVec4;

use crate::{
    arena::Arena,
    passes::plan::range::DepthRange,
    prepare::ViewFromLocal,
    scene::{Camera, Placement, Settings, ViewFromWorld},
};

/// How a frame sees a scene that stands somewhere.
#[derive(Clone, Copy)]
pub(crate) struct SceneView<'a> {
    /// The camera in the scene's own space.
    pub camera: Camera,
    /// Its depths, in the scene's lengths.
    pub range: DepthRange,
    /// The motion to view space.
    pub view: ViewFromWorld,
    /// The planes that cut what is seen, in the scene's own space.
    pub clip: &'a [DVec4],
    near: f64,
    focal_px: f64,
}

impl<'a> SceneView<'a> {
    /// The view of a camera, whose depths begin where it is ([`DepthRange::begin`]).
    pub fn new(
        arena: &'a Arena,
        at: &Placement,
        (camera, range): (&Camera, DepthRange),
        settings: &Settings,
    ) -> Self {
        let (camera, range) = (at.camera(camera), range.within(at));
        let clip = settings.clip();
        let clip = if clip.is_empty() { &[] } else { arena.list(clip.iter().map(|plane| at.plane(*plane))) };
        let (view, near) = (camera.view_from_world(), camera.near());
        Self { camera, range, view, clip, near, focal_px: camera.focal_px(settings.size_px[1]) }
    }

    /// The depth of the near plane in view space. `digits.rs` refuses one that f32 does not have, but for stray splats.
    pub fn near(&self, view: &ViewFromLocal) -> f64 {
        (self.near * view.view_from_world_scale).max(1e-37)
    }

    /// Pixels of a unit of the image plane, which of an orthographic camera is the view's.
    pub fn focal_px(&self, view: &ViewFromLocal) -> f64 {
        let unit = if self.camera.is_orthographic() { view.view_from_world_scale } else { 1.0 };
        self.focal_px / unit
    }
}
