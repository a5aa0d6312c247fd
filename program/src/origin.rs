//! The origin on a device: numbers there have 32 bits, so that places far from (0, 0, 0) count from one among them.

use glam::DVec3;
use surfel::{
    prepare::Rebase,
    scene::{Ball, Scene},
};

use crate::{console, info::number};

/// So many times the scene's radius from (0, 0, 0), 32 bits would leave less than a 100 000th of the radius: 2^-24 of 168 is that.
const FAR: f64 = 168.0;

/// The origin of the first object, where it is so far from (0, 0, 0) that this matters for a scene of this radius.
pub fn shift(scene: &Scene, radius: f64) -> Option<DVec3> {
    let of_splats = |splats: &surfel::scene::Splats| Rebase::of(splats, 0..splats.len()).origin;
    let splats = scene.objects.first().map(|object| of_splats(&object.splats));
    let origin = splats
        .or_else(|| scene.meshes.first().map(|object| Rebase::of_points(&object.mesh.positions).origin))?;
    (origin.length() > FAR * radius).then_some(origin)
}

/// Tells it.
pub fn tell(scene: &Scene, ball: &Ball) {
    if let Some(origin) = shift(scene, ball.radius) {
        let origin = origin.to_array().map(number).join(",");
        console::say(&format!("the origin is moved to {origin} on the device, as its numbers have 32 bits"));
    }
}
