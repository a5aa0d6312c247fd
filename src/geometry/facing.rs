//! How a thing's surface faces who looks at it: one flat side shows nothing of its depth, and of what is seen edge-on nothing is seen.

use glam::{DVec3, Vec3};

use crate::scene::{Mesh, Scene, Shapes, Splats};

/// The share of what is seen that is flat, from which on it is all that the picture shows.
const SHARE: f64 = 0.5;

/// The cosine of the angle to the view up to which a side is flat: 5°.
const FACING: f64 = 0.9962;

/// Whether half or more of a closed thing's area, as an eye far away in a direction sees it, faces that eye within 5°. False of what is open:
/// a wall, a relief or a terrain is what its owner wants to see.
pub fn is_flat_in_front(scene: &Scene, toward_eye: DVec3) -> bool {
    let closed = scene.objects.iter().map(|object| object.closed);
    if !closed.chain(scene.meshes.iter().map(|object| object.closed)).all(|closed| closed) {
        return false;
    }
    let [mut flat, mut all] = [0.0; 2];
    let mut add = |normal: DVec3, area: f64| {
        let facing = normal.dot(toward_eye);
        let seen = area * facing;
        // Normals of what is closed are outside.
        if seen > 0.0 && seen.is_finite() {
            flat += if facing >= FACING { seen } else { 0.0 };
            all += seen;
        }
    };
    add_all(scene, &mut add);
    all > 0.0 && flat >= SHARE * all
}

/// The share of a scene's area that an eye far away in a direction would see if nothing hid anything: 1 where all faces it or faces away,
/// 0 where all is edge-on, and of a scene without area.
pub fn share_facing(scene: &Scene, toward_eye: DVec3) -> f64 {
    let [mut seen, mut all] = [0.0; 2];
    add_all(scene, &mut |normal, area| {
        if area.is_finite() {
            seen += area * normal.dot(toward_eye).abs();
            all += area * normal.length();
        }
    });
    if all > 0.0 { seen / all } else { 0.0 }
}

fn add_all(scene: &Scene, add: &mut impl FnMut(DVec3, f64)) {
    scene.objects.iter().for_each(|object| add_splats(&object.splats, add));
    scene.meshes.iter().for_each(|object| add_triangles(&object.mesh, add));
}

/// Unit normals, and areas in proportion.
fn add_splats(splats: &Splats, add: &mut impl FnMut(DVec3, f64)) {
    for i in 0..splats.len() {
        let (normal, area) = match &splats.shapes {
            Shapes::Disks { normals, radii } => match (normals.get(i), radii.get(i)) {
                (Some(normal), Some(radius)) => (*normal, radius * radius),
                _ => continue,
            },
            Shapes::Ellipses { s, t } => match (s.get(i), t.get(i)) {
                (Some(s), Some(t)) => (s.cross(*t), s.cross(*t).length()),
                _ => continue,
            },
        };
        add(normal.try_normalize().unwrap_or(Vec3::ZERO).as_dvec3(), f64::from(area));
    }
}

fn add_triangles(mesh: &Mesh, add: &mut impl FnMut(DVec3, f64)) {
    for [a, b, c] in (0..mesh.triangles.len()).filter_map(|i| mesh.corners(i)) {
        let normal = (b - a).cross(c - a);
        add(normal.normalize_or_zero(), normal.length());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        geometry::seams::sphere,
        scene::{Colors, MeshObject, Object},
    };

    /// A box of this size about the origin.
    fn cuboid(size: DVec3, closed: bool) -> Scene {
        let corner = |i: u32| size * (DVec3::new((i & 1).into(), (i >> 1 & 1).into(), (i >> 2).into()) - 0.5);
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let mesh = Mesh {
            positions: (0..8).map(corner).collect(),
            normals: None,
            colors: Colors::unknown(),
            triangles: sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect(),
        };
        Scene { meshes: vec![MeshObject { name: String::new(), mesh, closed }], ..Scene::default() }
    }

    #[test]
    fn a_box_is_flat_in_front_and_from_no_corner() {
        let [flat, deep] = [DVec3::new(1.0, 1.0, 0.1), DVec3::new(0.1, 0.1, 9.0)];
        for size in [flat, deep] {
            assert!(is_flat_in_front(&cuboid(size, true), DVec3::Z));
            assert!(!is_flat_in_front(&cuboid(size, true), DVec3::new(0.5, 0.3, 0.8).normalize()));
            assert!(!is_flat_in_front(&cuboid(size, false), DVec3::Z), "open");
        }
        let turned = DVec3::new(0.1, 0.0, 1.0).normalize();
        assert!(!is_flat_in_front(&cuboid(flat, true), turned), "by 5.7 degrees");
    }

    #[test]
    fn a_plate_has_no_area_for_who_sees_it_edge_on() {
        let plate = cuboid(DVec3::new(1.0, 1.0, 0.0), false);
        for (eye, share) in
            [(DVec3::Z, 1.0), (DVec3::NEG_Z, 1.0), (DVec3::X, 0.0), (DVec3::new(0.8, 0.0, 0.6), 0.6)]
        {
            assert!((share_facing(&plate, eye) - share).abs() < 1e-12, "{eye}");
        }
        let ball = MeshObject { name: String::new(), mesh: sphere(5), closed: true };
        let share = share_facing(&Scene { meshes: vec![ball], ..Scene::default() }, DVec3::Z);
        assert!((share - 0.5).abs() < 0.02, "{share}");
        assert_eq!(share_facing(&Scene::default(), DVec3::Z), 0.0);
    }

    #[test]
    fn splats_are_as_the_surface_and_what_is_round_or_nothing_is_not_flat() {
        let ball = MeshObject { name: String::new(), mesh: sphere(5), closed: true };
        assert!(!is_flat_in_front(&Scene { meshes: vec![ball], ..Scene::default() }, DVec3::Z));
        assert!(!is_flat_in_front(&Scene::default(), DVec3::Z));
        // Two sides, of which the larger disks decide.
        let of = |shapes: Shapes| {
            let splats = Splats::new(vec![DVec3::ZERO, DVec3::X], shapes, Colors::unknown());
            let object = Object { name: String::new(), splats, closed: true };
            is_flat_in_front(&Scene { objects: vec![object], ..Scene::default() }, DVec3::Z)
        };
        let slanted = Vec3::new(0.6, 0.0, 0.8);
        let disks =
            |radii: [f32; 2]| of(Shapes::Disks { normals: vec![Vec3::Z, slanted], radii: radii.into() });
        assert!(disks([1.0, 1.0]) && !disks([0.8, 1.0]) && !disks([f32::NAN, 1.0]));
        // What faces away is not seen.
        assert!(!of(Shapes::Disks { normals: vec![Vec3::NEG_Z, slanted], radii: vec![9.0, 1.0] }));
        let ellipses = |length: f32| {
            let t = [length * Vec3::Y, Vec3::Y].to_vec();
            of(Shapes::Ellipses { s: vec![Vec3::X, Vec3::new(0.8, 0.0, -0.6)], t })
        };
        assert!(ellipses(1.0) && !ellipses(0.7));
    }
}
