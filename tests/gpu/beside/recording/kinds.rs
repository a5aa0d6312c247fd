//! Frames of what scenes may hold beside opaque disks, which take as little.

use glam::{DVec3, Vec3};
use surfel::{
    Settings,
    embed::{Placed, Placement},
    scene::{
        Colors, Light, LightKind, Mesh, MeshObject, Object, Rasterizer, Scene, Shapes, SplatFormat, Storage,
    },
};

use super::{
    super::{Beside, REVERSED, engine::Style},
    Cost, FEW_FRAMES, SPLATS, cost,
};
use crate::{
    common::scenes,
    hybrid_levels::{hard, waves},
};

fn disks() -> Object {
    scenes::sphere(SPLATS, DVec3::ZERO)
}

fn of(object: Object) -> Scene {
    Scene { objects: vec![object], ..Scene::default() }
}

fn ellipses() -> Object {
    let mut object = disks();
    if let Shapes::Disks { normals, radii } = &object.splats.shapes {
        let tangents = normals.iter().zip(radii).map(|(normal, radius)| {
            let s: Vec3 = *radius * normal.any_orthonormal_vector();
            (s, 0.7 * normal.cross(s))
        });
        let (s, t) = tangents.unzip();
        object.splats.shapes = Shapes::Ellipses { s, t };
    }
    object
}

fn triangle() -> MeshObject {
    let positions = vec![DVec3::new(-3.0, -2.0, 0.1), DVec3::new(3.0, -2.0, 0.0), DVec3::new(0.0, 3.0, 0.0)];
    let colors = Colors::Uniform([0.9, 0.2, 0.1, 1.0]);
    let mesh = Mesh { positions, normals: None, colors, triangles: vec![[0, 1, 2]] };
    MeshObject { name: "triangle".to_owned(), mesh, closed: false }
}

#[test]
fn frames_of_whatever_a_scene_holds_take_nothing_from_the_heap() {
    let sun = Light { kind: LightKind::Directional(DVec3::NEG_Y), color: [1.0; 3] };
    let packed = Storage { format: SplatFormat::Packed, ..Storage::default() };
    let kinds = [
        ("ellipses", of(ellipses())),
        ("packed", Scene { storage: packed, ..of(disks()) }),
        ("polygons and lights", Scene { meshes: vec![triangle()], lights: vec![sun; 3], ..of(disks()) }),
        ("levels", Scene { levels: true, ..of(disks()) }),
        ("cells", hard(&waves(2500, 2500), 1.0).scene),
        ("numbers, motion and tints", of(disks())),
    ];
    let mut found = Vec::new();
    let mut besides =
        [false, true].map(|tells_objects| Beside::new(Style { validates: false, tells_objects, ..REVERSED }));
    for (name, scene) in kinds {
        let tells_objects = name.starts_with("numbers");
        let beside = &mut besides[usize::from(tells_objects)];
        let prepared = beside.upload(&scene);
        for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
            let settings = Settings { size_px: [160, 120], rasterizer, ..Settings::default() };
            let at = Placement { translation: DVec3::new(0.1, 0.3, -0.2), ..Placement::default() };
            let mut placed = [Placed::at_home(&prepared), Placed::new(&prepared, at)];
            if tells_objects {
                (placed[0].id, placed[0].before) = (17, Some(at));
                placed[1].tint = [0.5, 1.0, 1.0, 1.0];
            }
            for moves in [false, true] {
                let Cost { allocations, .. } = cost(beside, &placed, &settings, (moves, FEW_FRAMES), None);
                found.push((name, rasterizer, moves, allocations));
            }
        }
    }
    besides.into_iter().for_each(Beside::end);
    println!("{found:?}");
    assert!(found.iter().all(|(.., allocations)| *allocations == 0), "{found:#?}");
}
