use super::*;
use crate::scene::Backfaces;

/// Random directions that no lattice follows.
fn directions(count: usize) -> impl Iterator<Item = DVec3> {
    let golden = [0.754_877_666_246_693, 0.569_840_290_998_053];
    (0..count).map(move |i| {
        let [u, v] = golden.map(|g: f64| (0.5 + g * i as f64).fract());
        let (sin, cos) = (std::f64::consts::TAU * v).sin_cos();
        let z = 2.0 * u - 1.0;
        let ring = (1.0 - z * z).sqrt();
        DVec3::new(ring * cos, z, ring * sin)
    })
}

/// The splats whose direction is within `angle` of `direction`: a lattice of falling height has them in one range.
fn near(direction: DVec3, angle: f64, count: usize) -> std::ops::Range<usize> {
    let index = |height: f64| 0.5 * (count as f64 * (1.0 - height) - 1.0);
    let polar = direction.y.clamp(-1.0, 1.0).acos();
    let first = index((polar - angle).max(0.0).cos()).floor().max(0.0) as usize;
    let last = index((polar + angle).min(std::f64::consts::PI).cos()).ceil() as usize;
    first..(last + 1).min(count)
}

#[test]
fn it_is_closed_and_faces_outward_and_every_splat_can_be_drawn() {
    let mut object = relief(DEFAULT_RELIEF_SPLATS);
    assert!(object.closed, "{:?} culls it", Backfaces::Auto);
    assert_eq!(object.splats.len(), DEFAULT_RELIEF_SPLATS);
    assert_eq!(object.splats.drop_defective().total(), 0);
    let Shapes::Disks { normals, .. } = &object.splats.shapes else { panic!("disks") };
    for (position, normal) in object.splats.positions.iter().zip(normals) {
        assert!(normal.as_dvec3().dot(*position) > 0.2, "a star-shaped surface, seen from outside");
    }
}

/// A point of the surface must lie within a splat when seen along the surface's own normal there, and the splat's plane
/// must pass close by.
#[test]
fn no_point_of_the_surface_is_in_a_hole() {
    let count = DEFAULT_RELIEF_SPLATS;
    let (object, surface) = (relief(count), Relief::new());
    let Shapes::Disks { normals, radii } = &object.splats.shapes else { panic!("disks") };
    let spacing = (4.0 * std::f64::consts::PI / count as f64).sqrt();
    let (mut overlap, mut smallest_share, samples) = (0_usize, 1.0_f64, 20_000);
    let poles = [DVec3::Y, DVec3::NEG_Y];
    for direction in directions(samples).chain(poles) {
        let point = surface.point(direction);
        let mut nearest = f64::INFINITY;
        for i in near(direction, 4.0 * spacing, count) {
            let (normal, radius) = (normals[i].as_dvec3(), f64::from(radii[i]));
            let away = point.position - object.splats.positions[i];
            if away.length() > 3.0 * radius || normal.dot(point.normal) <= 0.0 {
                continue;
            }
            let along = away.dot(normal) / point.normal.dot(normal);
            let share = (away - along * point.normal).length() / radius;
            overlap += usize::from(share <= 1.0);
            nearest = nearest.min(share);
        }
        assert!(nearest <= 1.0, "a hole at {direction}: {nearest}");
        smallest_share = smallest_share.min(1.0 - nearest);
    }
    let overlap = overlap as f64 / samples as f64;
    println!(
        "built-in relief: mean overlap {overlap:.2}, the loosest point keeps {smallest_share:.2} of a radius"
    );
    assert!((3.0..4.5).contains(&overlap), "{overlap}");
}

#[test]
fn the_mesh_is_the_same_surface() {
    let (mesh, surface) = (relief_mesh(2000), Relief::new());
    assert_eq!(mesh.triangles, sphere_mesh(2000).triangles);
    let (normals, Colors::Each(colors)) = (mesh.normals.unwrap(), mesh.colors) else { panic!("one color") };
    for (i, position) in mesh.positions.iter().enumerate() {
        let point = surface.point(position.normalize());
        assert!(point.position.distance(*position) < 1e-12);
        assert!(point.normal.distance(normals[i].as_dvec3()) < 1e-6);
        assert!((point.color[0] - colors[i][0]).abs() < 1e-6);
    }
}

#[test]
fn it_is_the_same_every_time_whatever_the_count_of_threads() {
    let (a, b) = (relief(5000), relief(5000));
    assert_eq!(a.splats.positions, b.splats.positions);
    let directly = Relief::new().point(fibonacci_direction(4321, 5000));
    assert_eq!(a.splats.positions[4321], directly.position);
    for count in [0, 1, 2] {
        let mut few = relief(count).splats;
        assert_eq!((few.len(), few.drop_defective().total()), (count, 0));
    }
}
