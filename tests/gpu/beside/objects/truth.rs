//! Whose a pixel is and how far what it shows has moved, by the oracle and by the engine's own matrices.

use glam::{DVec3, DVec4};
use surfel::{
    embed::{HostCamera, Placement},
    reference::Candidate,
    scene::{Object, Scene},
};

use crate::beside::SIZE_PX;

/// Within which f32 does not tell depths apart, as a part of them.
pub(super) const TIE: f64 = 1e-5;

/// The same scene as one, for the oracle.
pub(super) fn in_world(own: &Object, places: &[[Placement; 2]]) -> Scene {
    let moved = |at: &Placement| {
        let matrix = glam::DAffine3::from_scale_rotation_translation(
            DVec3::splat(at.scale),
            at.rotation,
            at.translation,
        );
        Object { splats: own.splats.clone().transformed(&matrix), ..own.clone() }
    };
    Scene { objects: places.iter().map(|[now, _]| moved(now)).collect(), ..Scene::default() }
}

/// The object of which a pixel is: that of the splat of its surface whose depth is nearest to the mean; `None` where rounding decides, or another object's is as near.
pub(super) fn owner(all: &[Candidate], mean: f64) -> Option<usize> {
    let surface = all.iter().map(|it| it.z_shifted).fold(f64::INFINITY, f64::min);
    if all.iter().any(|it| (it.z / surface - 1.0).abs() < TIE && it.z_shifted != surface) {
        return None;
    }
    let of_surface = all.iter().filter(|it| it.z <= surface);
    let mut near: Vec<_> = of_surface.map(|it| ((it.z / mean).ln().abs(), it)).collect();
    near.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let object = near.first()?.1.splat?[0];
    let as_near = near.iter().take_while(|(off, _)| *off < near[0].0 + TIE);
    let decided = near.iter().all(|(_, it)| it.certain)
        && as_near.clone().all(|(_, it)| it.splat.is_some_and(|it| it[0] == object));
    decided.then_some(object)
}

/// Where a point is in the picture, in pixels, by the engine's own matrices.
fn place_px(camera: &HostCamera, world: DVec3) -> [f64; 2] {
    let clip = camera.clip_from_view * camera.view_from_world * world.extend(1.0);
    let y = if camera.flips_y { -clip.y } else { clip.y };
    [0.5 * (clip.x / clip.w + 1.0) * f64::from(SIZE_PX[0]), 0.5 * (y / clip.w + 1.0) * f64::from(SIZE_PX[1])]
}

/// The point of a pixel's center that has a depth of the engine's.
fn point(camera: &HostCamera, pixel: usize, depth: f64) -> DVec3 {
    let [x, y] = [pixel % SIZE_PX[0] as usize, pixel / SIZE_PX[0] as usize].map(|at| at as f64 + 0.5);
    let y = 2.0 * y / f64::from(SIZE_PX[1]) - 1.0;
    let clip =
        DVec4::new(2.0 * x / f64::from(SIZE_PX[0]) - 1.0, if camera.flips_y { -y } else { y }, depth, 1.0);
    let world = (camera.clip_from_view * camera.view_from_world).inverse() * clip;
    world.truncate() / world.w
}

/// How far what is seen in a pixel at a depth has moved, in pixels.
pub(super) fn motion(
    [now, before]: [&HostCamera; 2],
    pixel: usize,
    depth: f64,
    [at, stood]: &[Placement; 2],
) -> [f64; 2] {
    let world = point(now, pixel, depth);
    let was = stood.world_from_scene() * at.world_from_scene().inverse() * world.extend(1.0);
    let ([x, y], [old_x, old_y]) = (place_px(now, world), place_px(before, was.truncate()));
    [x - old_x, y - old_y]
}
