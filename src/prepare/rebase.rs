//! The local space of a scene.

use glam::DVec3;

use crate::scene::{Camera, Scene};

/// `local = (world − origin) · scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebase {
    /// A world point near the scene's middle.
    pub origin: DVec3,
    /// A power of two, such that the scene's radius is 0.5 to 1 in local space; less for a scene that is smaller than
    /// 2⁻⁴⁰ of its distance from the world's origin. Products of lengths stay within f32 while the eye is less than about
    /// 1e11 of the scene's radii away.
    pub scale: f64,
}

/// The origin is a multiple of this part of the scene's radius, so that a scene and its copy at a representable offset
/// have the same local coordinates, bit by bit.
const ORIGIN_STEP: f64 = 1.0 / 1024.0;

impl Rebase {
    /// The local space of a scene; the world itself for one without splats or extent.
    pub fn of(scene: &Scene) -> Self {
        let Some(bounds) = scene.bounds() else { return Self { origin: DVec3::ZERO, scale: 1.0 } };
        // Splats closer together than that are hardly told apart by f64 at their place. Without this bound a camera that
        // was fitted to what it can see would be beyond f32's squares away, in units of the scene's radius.
        let smallest = bounds.center().abs().max_element() * 2.0_f64.powi(-40);
        let radius = bounds.radius().max(smallest);
        let exponent = if radius > 0.0 { radius.log2().ceil() } else { 0.0 };
        // Within f64's own exponents, also for the reciprocal.
        let unit = exponent.clamp(-1000.0, 1000.0).exp2();
        let step = unit * ORIGIN_STEP;
        let origin = (bounds.center() / step).round() * step;
        let origin = if origin.is_finite() { origin } else { bounds.center() };
        Self { origin, scale: unit.recip() }
    }

    /// A world point in local space.
    pub fn point(&self, world: DVec3) -> DVec3 {
        (world - self.origin) * self.scale
    }

    /// The rows of view-from-local: rotation and translation.
    pub fn view_from_local(&self, camera: &Camera) -> [[f32; 4]; 3] {
        let view = camera.view_from_world();
        let translation = view.point(self.origin) * self.scale;
        let row = |i: usize| {
            let axis = view.rotation.row(i).as_vec3();
            [axis.x, axis.y, axis.z, translation[i] as f32]
        };
        [row(0), row(1), row(2)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Colors, Object, Shapes, Splats};

    fn scene_at(offset: DVec3, size: f64) -> Scene {
        let positions = [DVec3::ZERO, DVec3::new(0.75, 0.125, -0.5)].map(|p| p * size + offset).to_vec();
        let shapes = Shapes::Disks { normals: vec![glam::Vec3::Z; 2], radii: vec![0.25 * size as f32; 2] };
        let splats = Splats { positions, shapes, colors: Colors::Uniform([1.0; 4]) };
        Scene { objects: vec![Object { name: String::new(), splats, closed: false }] }
    }

    #[test]
    fn far_from_the_origin_local_coordinates_are_the_same_bit_by_bit() {
        let local = |offset: DVec3| {
            let scene = scene_at(offset, 1.0);
            let rebase = Rebase::of(&scene);
            scene.objects[0].splats.positions.iter().map(|p| rebase.point(*p).as_vec3()).collect::<Vec<_>>()
        };
        assert_eq!(local(DVec3::ZERO), local(DVec3::new(500_000.0, 4_600_000.0, 300.0)));
    }

    #[test]
    fn the_radius_is_about_one_in_every_unit() {
        for size in [1e-30, 1e-3, 1.0, 1e6, 1e30] {
            let scene = scene_at(DVec3::ZERO, size);
            let rebase = Rebase::of(&scene);
            let radius = scene.bounds().unwrap().radius() * rebase.scale;
            assert!((0.5..=1.0).contains(&radius), "{size}: {radius}");
        }
    }
}
