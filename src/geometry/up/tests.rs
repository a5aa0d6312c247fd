use super::*;
use crate::{
    geometry::seams::sphere,
    scene::{Colors, MeshObject, Object},
};

/// Disks of radius 0.1 with these centers and normals.
fn scene(closed: bool, disks: impl Iterator<Item = (DVec3, Vec3)>) -> Scene {
    let (positions, normals): (Vec<DVec3>, Vec<Vec3>) = disks.unzip();
    let radii = vec![0.1; normals.len()];
    let shapes = Shapes::Disks { normals, radii };
    let splats = Splats::new(positions, shapes, Colors::unknown());
    let object = Object { name: String::new(), splats, closed };
    Scene { objects: vec![object], ..Scene::default() }
}

fn because(scene: &Scene) -> Option<String> {
    up_of_shape(scene).map(|up| {
        assert_eq!(up.direction, DVec3::Z);
        up.because
    })
}

/// What tells that +y is up, of disks turned so that it is.
fn because_turned(disks: impl Iterator<Item = (DVec3, Vec3)>) -> Option<String> {
    let turned = disks.map(|(p, n)| (DVec3::new(p.x, p.z, -p.y), Vec3::new(n.x, n.z, -n.y)));
    up_of_shape(&scene(false, turned)).map(|up| {
        assert_eq!(up.direction, DVec3::Y);
        up.because
    })
}

fn square(side: u32) -> impl Iterator<Item = (f64, f64)> {
    (0..side).flat_map(move |y| (0..side).map(move |x| (f64::from(x), f64::from(y))))
}

/// Hills of this height on a square of 40.
fn hills(height: f64) -> impl Iterator<Item = (DVec3, Vec3)> {
    square(40).map(move |(x, y)| {
        let z = height * (0.3 * x).sin() * (0.2 * y).cos();
        (DVec3::new(x, y, z), Vec3::new(0.2, 0.1, 1.0))
    })
}

#[test]
fn terrain_is_flat_and_open() {
    assert_eq!(because(&scene(false, hills(2.0))).unwrap(), "it lies flat as ground does");
    assert_eq!(because(&scene(true, hills(2.0))), None, "a closed thing");
    assert_eq!(because(&scene(false, hills(0.0))), None, "a plane");
    assert_eq!(because(&scene(false, hills(9.0))), None, "a head's half");
    assert_eq!(because(&scene(false, hills(2.0).take(900))), None, "too few");
    assert_eq!(because_turned(hills(2.0)).unwrap(), "it lies flat as ground does");
    assert_eq!(because_turned(hills(0.0)), None, "a plane");
}

#[test]
fn a_map_has_large_coordinates_and_low_heights() {
    let moved = |by: DVec3| because(&scene(false, hills(30.0).map(move |(p, n)| (p + by, n))));
    assert_eq!(moved(DVec3::new(450_000.0, 5_400_000.0, 300.0)).unwrap(), "its x and y are those of a map");
    assert_eq!(moved(DVec3::new(450_000.0, 300.0, 5_400_000.0)), None);
    assert_eq!(moved(DVec3::splat(450_000.0)), None);
}

/// A house of 12 by 12 by 10 on a floor of 40 by 40, which lies `wide` times as far.
fn house(wide: f64) -> Vec<(DVec3, Vec3)> {
    let floor = square(40).map(|(x, y)| (DVec3::new(wide * (x - 20.0), wide * (y - 20.0), 0.0), Vec3::Z));
    let walls = square(24).flat_map(|(along, z)| {
        let (along, z) = (0.5 * along - 6.0, 0.5 * z.min(20.0));
        [
            (DVec3::new(along, 6.0, z), Vec3::Y),
            (DVec3::new(along, -6.0, z), Vec3::NEG_Y),
            (DVec3::new(6.0, along, z), Vec3::X),
            (DVec3::new(-6.0, along, z), Vec3::NEG_X),
        ]
    });
    floor.chain(walls).collect()
}

#[test]
fn a_house_stands_on_its_ground_and_a_box_on_nothing() {
    let up = because(&scene(false, house(1.0).into_iter()));
    assert_eq!(up.unwrap(), "it stands on a floor");
    assert_eq!(
        because(&scene(false, house(0.3).into_iter())),
        None,
        "a room, or a stage seen from the front"
    );
    assert_eq!(because_turned(house(1.0).into_iter()).unwrap(), "it stands on a floor");
    let medal = house(1.0).into_iter().filter(|(_, n)| *n == Vec3::Z);
    assert_eq!(because(&scene(false, medal)), None, "no walls");
}

#[test]
fn a_street_has_walls_at_its_rim_and_a_stage_is_none() {
    // A ground of 60 by 20 with a wall of this height along each of its long sides.
    let street = |height: f64, wide: f64| {
        let ground = square(60).map(move |(x, y)| (DVec3::new(x, wide / 60.0 * y, 0.0), Vec3::Z));
        let wall =
            move |y: f64| square(40).map(move |(x, z)| (DVec3::new(1.5 * x, y, height / 40.0 * z), Vec3::Y));
        ground.chain(wall(0.0)).chain(wall(wide)).collect::<Vec<_>>()
    };
    assert_eq!(because(&scene(false, street(10.0, 20.0).into_iter())).unwrap(), "it stands on a floor");
    assert_eq!(because_turned(street(10.0, 20.0).into_iter()).unwrap(), "it stands on a floor");
    assert_eq!(because(&scene(false, street(20.0, 20.0).into_iter())), None, "as high as wide");
}

#[test]
fn a_bust_stands_along_z_or_along_y() {
    // A ball on a plinth.
    let ball = square(60).map(|(i, j)| {
        let (longitude, z) = (0.105 * i, (2.0 * j + 1.0) / 60.0 - 1.0);
        let flat = (1.0 - z * z).sqrt();
        let normal = DVec3::new(flat * longitude.cos(), flat * longitude.sin(), z);
        (normal + 1.9 * DVec3::Z, normal.as_vec3())
    });
    let base = square(40).flat_map(|(x, y)| {
        let at = DVec3::new(0.04 * x - 0.8, 0.04 * y - 0.8, 0.0);
        [
            (at, Vec3::NEG_Z),
            (DVec3::new(at.x, 0.8, 0.025 * y), Vec3::Y),
            (DVec3::new(at.x, -0.8, 0.025 * y), Vec3::NEG_Y),
        ]
    });
    let bust: Vec<_> = ball.chain(base).collect();
    assert_eq!(because(&scene(false, bust.clone().into_iter())).unwrap(), "it stands on what is lowest");
    assert_eq!(because_turned(bust.clone().into_iter()).unwrap(), "it stands on what is lowest");
    assert_eq!(because(&scene(true, bust.into_iter())), None, "a closed thing");
}

#[test]
fn a_ball_has_no_up() {
    for closed in [false, true] {
        let mesh = MeshObject { name: String::new(), mesh: sphere(5), closed };
        assert_eq!(because(&Scene { meshes: vec![mesh], ..Scene::default() }), None);
    }
}

#[test]
fn a_few_triangles_on_a_map_are_enough() {
    let mut mesh = sphere(3);
    mesh.positions.iter_mut().for_each(|place| *place += DVec3::new(500_000.0, 4_600_000.0, 300.0));
    let on_map = MeshObject { name: String::new(), mesh, closed: true };
    let up = because(&Scene { meshes: vec![on_map], ..Scene::default() });
    assert_eq!(up.unwrap(), "its x and y are those of a map");
}
