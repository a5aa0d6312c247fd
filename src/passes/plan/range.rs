//! How deep a scene reaches under an orthographic camera, whose depth is linear and so has to end.

use crate::{
    prepare::Placed,
    scene::{Camera, Placement},
};

/// Depth under an orthographic camera: w = 1 − z / end, with z from a plane in front of all that is seen. Of a perspective it means nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DepthRange {
    /// So far in front of the eye the plane is, world units: the near plane, or where the scene begins behind it.
    pub from_eye: f64,
    /// Where w is 0, world units from that plane: twice as far as the scene reaches, so that w is above one half in all of it.
    pub end: f64,
}

impl DepthRange {
    /// That of all that a frame shows.
    pub fn of(scenes: &[Placed<'_>], camera: &Camera) -> Self {
        if !camera.is_orthographic() {
            return Self::default();
        }
        let ends = scenes.iter().flat_map(|Placed { scene, at, .. }| {
            let (camera, scale) = (at.camera(camera), at.scale);
            let splats = scene.chunks.iter().filter(|chunk| chunk.count > 0).map(move |chunk| {
                let view = chunk.rebase.view_from_local(&camera);
                (view, chunk.bounds, chunk.largest_radius)
            });
            let meshes = scene.meshes.iter().map(move |mesh| {
                let farthest = glam::DVec3::splat(mesh.farthest);
                (mesh.rebase.view_from_local(&camera), [-farthest, farthest], 0.0)
            });
            splats.chain(meshes).map(move |(view, [lo, hi], radius)| {
                let row = view.rotation.row(2);
                let middle = row.dot(0.5 * (lo + hi)) * view.view_from_local_scale + view.translation.z;
                let half = (row.abs().dot(0.5 * (hi - lo)) + radius) * view.view_from_local_scale;
                [middle - half, middle + half].map(|z| z / view.view_from_world_scale * scale)
            })
        });
        let [first, last] = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[first, last], [near, far]| {
            [first.min(near), last.max(far)]
        });
        // A step of f32 in front of what is nearest: at the plane itself a depth may be rounded above 1.
        let margin = 1e-5 * (last - first).abs();
        let from_eye = (first - margin).max(camera.near());
        let end = 2.0 * (last + margin - from_eye);
        if end > 0.0 && end.is_finite() {
            Self { from_eye, end }
        } else {
            Self { from_eye: camera.near(), end: 1.0 }
        }
    }

    /// The same in the lengths of a scene that stands so in the world.
    #[must_use]
    pub fn within(&self, at: &Placement) -> Self {
        Self { from_eye: self.from_eye / at.scale, end: self.end / at.scale }
    }

    /// The camera with its eye on that plane, where depth begins; a perspective as it is.
    #[must_use]
    pub fn begin(&self, camera: &Camera) -> Camera {
        let step = self.from_eye * camera.forward();
        if camera.is_orthographic() {
            Camera { eye: camera.eye + step, target: camera.target + step, near: None, ..*camera }
        } else {
            *camera
        }
    }
}
