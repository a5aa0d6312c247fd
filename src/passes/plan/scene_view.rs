//! A camera as it stands in a scene's own space, and what follows from it alone: found once for all that the scene has, and for all scenes where it is the same, for
//! a frame may show hundreds of small ones.

use glam::{DMat3, DQuat, DVec4};

use crate::{
    arena::Arena,
    inline_vec::InlineVec,
    math::size::{SizeBound, farthest, half_image, sides},
    passes::plan::range::DepthRange,
    prepare::ViewFromLocal,
    scene::{Camera, MOST_PLANES, Placement, Settings, ViewFromWorld},
};

/// A frame's camera in the world.
pub(crate) struct CameraView {
    camera: Camera,
    range: DepthRange,
    view: ViewFromWorld,
    clip: InlineVec<DVec4, MOST_PLANES>,
    /// The image's sides.
    pub size_px: [f64; 2],
    /// Where the view's axis meets it.
    pub middle_px: [f64; 2],
    height_px: u32,
    focal_px: f64,
    /// As [`sides`] has it, of a camera whose rays meet in the eye.
    sides: [[f64; 2]; 2],
    /// From the axis to the farthest of them.
    half_image: f64,
    /// The radius of the low-pass filter in pixels, and in the image plane of such a camera.
    pub filter_radius_px: f64,
    pub filter_radius: f64,
}

/// How a frame sees a scene that stands somewhere.
#[derive(Clone, Copy)]
pub(crate) struct SceneView<'a> {
    /// The camera in the world.
    pub frame: &'a CameraView,
    /// Its depths, in the scene's lengths.
    pub range: DepthRange,
    /// The motion from the scene's own space to view space, in the scene's lengths.
    pub view: ViewFromWorld,
    /// The planes that cut what is seen, in the scene's own space.
    pub clip: &'a [DVec4],
    near: f64,
    focal_px: f64,
}

impl CameraView {
    /// The view of a camera, whose depths begin where it is ([`DepthRange::begin`]).
    pub fn new((camera, range): (&Camera, DepthRange), settings: &Settings) -> Self {
        let [width_px, height_px] = settings.size_px;
        let (size_px, middle_px) = ([width_px.into(), height_px.into()], camera.middle_px(settings.size_px));
        let focal_px = camera.focal_px(height_px);
        let (sides, filter_radius_px) =
            (sides(size_px, middle_px, focal_px), settings.samples.filter_radius_px());
        Self {
            camera: Camera { up: camera.usable_up(), near: Some(camera.near()), ..*camera },
            range,
            view: camera.view_from_world(),
            clip: settings.clip(),
            size_px,
            middle_px,
            height_px,
            focal_px,
            sides,
            half_image: farthest(sides),
            filter_radius_px,
            filter_radius: filter_radius_px / focal_px,
        }
    }

    /// The same of a scene that stands there.
    pub fn of_scene<'a>(&'a self, arena: &'a Arena, at: &Placement) -> SceneView<'a> {
        let Self { camera, view, focal_px, .. } = self;
        let clip = &self.clip[..];
        let clip = if clip.is_empty() { &[] } else { arena.list(clip.iter().map(|plane| at.plane(*plane))) };
        let near = camera.near() / at.scale;
        let (view, focal_px) = match *at == Placement::default() {
            true => (*view, *focal_px),
            false => {
                // Most are moved alone.
                let (rotation, eye) = match at.rotation == DQuat::IDENTITY {
                    true => (view.rotation, (camera.eye - at.translation) / at.scale),
                    false => {
                        let turn = at.rotation.normalize();
                        (view.rotation * DMat3::from_quat(turn), at.eye_turned(camera, turn))
                    }
                };
                // That of parallel rays is a length's.
                let height = camera.orthographic_height.map(|height| height / at.scale);
                let parallel = |height| Camera { orthographic_height: Some(height), ..*camera };
                let focal_px = height.map_or(*focal_px, |height| parallel(height).focal_px(self.height_px));
                (ViewFromWorld { rotation, eye }, focal_px)
            }
        };
        // Of a perspective it means nothing.
        let range = if camera.is_orthographic() { self.range.within(at) } else { self.range };
        SceneView { frame: self, range, view, clip, near, focal_px }
    }
}

impl SceneView<'_> {
    /// Whether rays are parallel.
    pub fn is_orthographic(&self) -> bool {
        self.frame.camera.is_orthographic()
    }

    /// The camera in the space of the scene that stands there.
    pub fn camera(&self, at: &Placement) -> Camera {
        at.camera_of_usable_up(&self.frame.camera)
    }

    /// As [`Camera::corner_px`].
    pub fn corner_px(&self) -> [u32; 2] {
        self.frame.camera.corner_px()
    }

    /// The sides of the whole picture, of which the image is a part.
    pub fn whole_px(&self) -> Option<[u32; 2]> {
        self.frame.camera.window.whole_px
    }

    /// The depth of the near plane in view space. `digits.rs` refuses one that f32 does not have, but for stray splats.
    pub fn near(&self, view: &ViewFromLocal) -> f64 {
        (self.near * view.view_from_world_scale).max(1e-37)
    }

    /// Pixels of a unit of the image plane, which of an orthographic camera is the view's.
    pub fn focal_px(&self, view: &ViewFromLocal) -> f64 {
        match self.is_orthographic() {
            true => self.focal_px / view.view_from_world_scale,
            false => self.focal_px,
        }
    }

    /// How far the image reaches from the view's axis, as [`sides`] has it.
    pub fn sides(&self, view: &ViewFromLocal) -> [[f64; 2]; 2] {
        match self.is_orthographic() {
            true => sides(self.frame.size_px, self.frame.middle_px, self.focal_px(view)),
            false => self.frame.sides,
        }
    }

    /// From the view's axis to the farthest side of a bound's image, in the image plane.
    pub fn half_image(&self, bound: &SizeBound) -> f64 {
        if self.is_orthographic() { half_image(bound) } else { self.frame.half_image }
    }

    /// The radius of the low-pass filter in the image plane.
    pub fn filter_radius(&self, focal_px: f64) -> f64 {
        match self.is_orthographic() {
            true => self.frame.filter_radius_px / focal_px,
            false => self.frame.filter_radius,
        }
    }
}

#[cfg(test)]
mod tests {
    /// Of one that is moved and scaled, and not turned, the same is found in fewer steps.
    #[test]
    fn a_scene_that_is_not_turned_is_seen_as_by_the_camera_that_is_moved_to_it() {
        let (arena, settings) = (Arena::new(), Settings::default());
        let translation = DVec3::new(0.3, 7.0, -2.0);
        let camera = Camera { eye: DVec3::new(0.4, 3.0, 5.0), near: Some(0.1), ..Camera::default() };
        for scale in [1.0, 0.3] {
            let at = Placement { scale, translation, ..Placement::default() };
            for orthographic_height in [None, Some(2.0)] {
                let camera = Camera { orthographic_height, ..camera };
                let range = DepthRange { from_eye: 3.0, end: 5.0 };
                let view = CameraView::new((&camera, range), &settings);
                let (found, expected) = (view.of_scene(&arena, &at), at.camera(&camera));
                let motion = expected.view_from_world();
                assert!(found.view.rotation.abs_diff_eq(motion.rotation, 1e-14));
                assert!(found.view.eye.abs_diff_eq(motion.eye, 1e-13), "{scale}");
                assert_eq!(found.near, expected.near());
                if orthographic_height.is_some() {
                    assert_eq!(found.range, range.within(&at));
                }
                let local = ViewFromLocal {
                    rotation: motion.rotation,
                    translation: DVec3::ZERO,
                    view_from_local_scale: 1.0,
                    view_from_world_scale: 0.5,
                    origin_from_eye: DVec3::ZERO,
                };
                let focal_px = found.focal_px(&local);
                let filter_radius = settings.samples.filter_radius_px() / focal_px;
                assert!((found.filter_radius(focal_px) / filter_radius - 1.0).abs() < 1e-15);
                let reach = farthest(found.sides(&local));
                assert!(found.frame.half_image > 0.0 && reach > 0.0);
                assert!(orthographic_height.is_some() || found.frame.half_image == reach);
            }
        }
    }

    use glam::{DQuat, DVec3};

    use super::*;

    /// Also of a camera that looks along its own up, and of one of parallel rays.
    #[test]
    fn a_scene_is_seen_as_by_the_camera_that_is_moved_to_it() {
        let (arena, settings) = (Arena::new(), Settings::default());
        let at = Placement {
            rotation: DQuat::from_axis_angle(DVec3::new(0.3, -1.0, 0.4).normalize(), 2.1),
            scale: 0.25,
            translation: DVec3::new(3.0, -2.0, 0.5),
        };
        let camera = Camera { eye: DVec3::new(0.4, 3.0, 5.0), near: Some(0.1), ..Camera::default() };
        let along_up = Camera { eye: camera.target + DVec3::Y, ..camera };
        let parallel = Camera { orthographic_height: Some(2.0), ..camera };
        for camera in [camera, along_up, parallel] {
            let view = CameraView::new((&camera, DepthRange::default()), &settings);
            for at in [at, Placement::default()] {
                let (found, expected) = (view.of_scene(&arena, &at), at.camera(&camera));
                let motion = expected.view_from_world();
                assert!(found.view.rotation.abs_diff_eq(motion.rotation, 1e-14), "{camera:?}");
                assert!(found.view.eye.abs_diff_eq(motion.eye, 1e-14), "{camera:?}");
                let focal_px = expected.focal_px(settings.size_px[1]);
                assert!((found.focal_px / focal_px - 1.0).abs() < 1e-14, "{camera:?}");
                assert_eq!(found.near, expected.near(), "{camera:?}");
            }
        }
    }
}
