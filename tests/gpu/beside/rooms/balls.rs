//! Balls, parts of them, and scenes with room for more.

use glam::DVec3;
use surfel::scene::{Colors, Room, Scene, Shapes, Splats};

use crate::{beside::updates::COUNT, common::scenes};

/// A ball of many colors, all of this alpha.
pub(super) fn ball(center: DVec3, alpha: f32, ellipses: bool) -> Splats {
    let mut splats = scenes::sphere(COUNT, center).splats;
    let of = |at: &DVec3| {
        let [r, g, b] =
            (0.5 * (*at - center).as_vec3() + 0.5).clamp(glam::Vec3::ZERO, glam::Vec3::ONE).to_array();
        [r, g, b, alpha]
    };
    splats.colors = Colors::Each(splats.positions.iter().map(of).collect());
    if let (true, Shapes::Disks { normals, radii }) = (ellipses, &splats.shapes) {
        let axes = |number: usize| {
            let across = normals[number].any_orthonormal_vector();
            [across, normals[number].cross(across)].map(|axis| radii[number] * axis)
        };
        let [s, t] = [0, 1].map(|axis| (0..COUNT).map(|number| axes(number)[axis]).collect());
        splats.shapes = Shapes::Ellipses { s, t };
    }
    splats
}

/// Those for which this holds.
pub(super) fn some(splats: &Splats, keeps: impl Fn(usize) -> bool) -> Splats {
    let keep: Vec<_> = (0..splats.len()).map(keeps).collect();
    let mut some = splats.clone();
    some.keep(&keep);
    some
}

/// Both, the one behind the other.
pub(super) fn joined(mut one: Splats, other: &Splats) -> Splats {
    one.append(other.clone());
    one
}

pub(super) fn scene(splats: Splats, room: Option<Room>, closed: bool) -> Scene {
    let mut object = scenes::sphere(3, DVec3::ZERO);
    (object.splats, object.closed) = (splats, closed);
    let rooms = room.map_or(Vec::new(), |room| vec![Some(room)]);
    Scene { objects: vec![object], updatable: true, rooms, ..Scene::default() }
}

pub(super) fn room(splats: usize) -> Option<Room> {
    Some(Room { splats: splats as u32, ..Room::default() })
}
