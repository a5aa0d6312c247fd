//! Transparent things, polygons, and both beside splats.

use glam::{DVec3, Vec3};

use super::{
    Hard,
    builder::{Builder, ball_of_polygons, camera, rectangle, settings},
    shapes::sphere,
};
use crate::scene::{
    Backfaces, Colors, Epsilon, Filter, LastLayer, Layers, Light, LightKind, Mesh, MeshObject, Object, Scene,
    Settings, Transition,
};

/// Layers enough for every pixel of these scenes: then the picture has no error of the method.
pub const ALL_LAYERS: Layers = Layers::Fixed(24);

/// All the layers, none blended with others.
pub fn all_layers() -> Settings {
    Settings { layers: ALL_LAYERS, last_layer: LastLayer::Drop, ..settings() }
}

/// These splats in one color with an alpha.
pub fn tinted(mut object: Object, color: [f32; 4]) -> Object {
    object.splats.colors = Colors::Uniform(color);
    object
}

/// A square of disks, all of one normal.
fn sheet(center: DVec3, normal: DVec3, half: f64, across: u32, color: [f32; 4]) -> Object {
    let u = normal.any_orthonormal_vector();
    let v = normal.cross(u);
    let step = 2.0 * half / f64::from(across);
    let mut builder = Builder::default();
    for i in 0..across {
        for j in 0..across {
            let place = |k: u32| (f64::from(k) + 0.5) * step - half;
            builder.disk(center + place(i) * u + place(j) * v, normal, 1.3 * step, color);
        }
    }
    builder.object(false)
}

fn hard(name: &'static str, scene: Scene, settings: Settings) -> Hard {
    Hard { settings, ..Hard::seen_from([0.4, 0.3, 4.0], name, scene) }
}

/// 27 balls, as in figure 6 of Guennebaud et al. 2006.
pub fn spheres() -> Hard {
    let mut objects = Vec::new();
    for i in 0..27_u8 {
        let [x, y, z] = [i % 3, i / 3 % 3, i / 9].map(f64::from);
        let center = 0.62 * DVec3::new(x - 1.0, y - 1.0, z - 1.0);
        let mut ball = tinted(
            sphere(600, DVec3::ZERO),
            [0.2 + 0.3 * x as f32, 0.2 + 0.3 * y as f32, 0.2 + 0.3 * z as f32, 0.4],
        );
        for position in &mut ball.splats.positions {
            *position = center + 0.26 * *position;
        }
        if let crate::scene::Shapes::Disks { radii, .. } = &mut ball.splats.shapes {
            radii.iter_mut().for_each(|radius| *radius *= 0.26);
        }
        objects.push(ball);
    }
    hard("27 transparent spheres", Scene { objects, ..Scene::default() }, all_layers())
}

/// Two balls that cross each other, one of them around the other's middle.
pub fn interpenetrating() -> Hard {
    let objects = vec![
        tinted(sphere(2000, DVec3::new(-0.35, 0.0, 0.0)), [0.8, 0.2, 0.1, 0.5]),
        tinted(sphere(2000, DVec3::new(0.35, 0.1, 0.0)), [0.1, 0.3, 0.8, 0.35]),
    ];
    hard("interpenetrating shells", Scene { objects, ..Scene::default() }, all_layers())
}

/// A pane in front of something opaque, and one behind it, which is hidden.
pub fn glass() -> Hard {
    let mut scene = sphere_and_sheets(&[(1.3, [0.1, 0.6, 0.3, 0.3]), (-0.2, [0.9, 0.1, 0.1, 0.5])]);
    scene.objects.push(tinted(sphere(3000, DVec3::ZERO), [0.6, 0.5, 0.3, 1.0]));
    hard("glass before an opaque model", scene, all_layers())
}

/// Sheets at one place, exactly and within ε, beside one that is farther.
pub fn coincident_sheets() -> Hard {
    let places = [(0.0, [0.9, 0.1, 0.1, 0.5]), (0.0, [0.1, 0.9, 0.1, 0.5]), (0.002, [0.1, 0.1, 0.9, 0.25])];
    let scene = sphere_and_sheets(&[places[0], places[1], places[2], (-0.5, [0.5, 0.5, 0.5, 0.8])]);
    hard("coincident transparent sheets", scene, all_layers())
}

fn sphere_and_sheets(sheets: &[(f64, [f32; 4])]) -> Scene {
    let normal = DVec3::new(0.1, 0.2, 1.0).normalize();
    let of = |(z, color): &(f64, [f32; 4])| sheet(*z * DVec3::Z, normal, 1.2, 24, *color);
    Scene { objects: sheets.iter().map(of).collect(), ..Scene::default() }
}

/// Alphas of 0 and 1 among others, in one object and in whole ones.
pub fn alpha_0_and_1() -> Hard {
    let mut mixed = sheet(0.4 * DVec3::Z, DVec3::Z, 1.0, 24, [1.0; 4]);
    mixed.splats.colors =
        Colors::Each((0..mixed.splats.len()).map(|i| [0.8, 0.3, 0.2, [0.0, 1.0, 0.5][i / 96 % 3]]).collect());
    let invisible = sheet(0.8 * DVec3::Z, DVec3::Z, 1.2, 16, [0.0, 1.0, 0.0, 0.0]);
    let full = sheet(-0.4 * DVec3::Z, DVec3::Z, 1.3, 24, [0.1, 0.3, 0.9, 1.0]);
    let scene = Scene { objects: vec![mixed, invisible, full], ..Scene::default() };
    hard("alphas of 0 and 1", scene, all_layers())
}

/// 64 sheets one behind the other.
pub fn sixty_four_layers() -> Hard {
    let color = |i: u32| [(i % 3) as f32 / 3.0, (i % 5) as f32 / 5.0, (i % 7) as f32 / 7.0, 0.06];
    let objects = (0..64).map(|i| sheet(f64::from(i) / 32.0 * DVec3::NEG_Z, DVec3::Z, 0.8, 8, color(i)));
    let scene = Scene { objects: objects.collect(), ..Scene::default() };
    let settings = Settings { layers: Layers::Fixed(64), epsilon: Epsilon::Length(0.004), ..all_layers() };
    hard("64 layers", scene, settings)
}

/// Transparent splats and polygons at the very places of opaque ones, and behind them.
pub fn upon_the_opaque() -> Hard {
    let corners = [-1.0, 1.0].map(|x| [-0.9, 0.9].map(|y| DVec3::new(x, y, 0.0)));
    let corners = [corners[0][0], corners[1][0], corners[1][1], corners[0][1]];
    let moved = |by: DVec3| corners.map(|corner| 0.8 * corner + by);
    let left = DVec3::new(-0.7, 0.0, 0.0);
    let objects = vec![
        sheet(left, DVec3::Z, 0.5, 20, [0.7, 0.7, 0.2, 1.0]),
        sheet(left, DVec3::Z, 0.5, 20, [0.1, 0.2, 0.9, 0.5]),
        sheet(left - 0.5 * DVec3::Z, DVec3::Z, 0.6, 20, [0.9, 0.1, 0.1, 0.5]),
    ];
    let right = DVec3::new(1.2, 0.0, 0.0);
    let meshes = vec![
        rectangle(moved(right), [0.2, 0.7, 0.3, 1.0]),
        rectangle(moved(right), [0.9, 0.2, 0.5, 0.4]),
        rectangle(moved(right - 0.3 * DVec3::Z), [0.1, 0.1, 0.1, 0.6]),
    ];
    hard(
        "transparent at an opaque thing's depth",
        Scene { objects, meshes, ..Scene::default() },
        all_layers(),
    )
}

/// The camera is within a transparent ball, and that in another one of polygons.
pub fn camera_inside() -> Hard {
    let objects = vec![tinted(sphere(3000, DVec3::ZERO), [0.3, 0.6, 0.9, 0.4])];
    let mut ball = ball_of_polygons(DVec3::ZERO, 1.7, 24, [0.9, 0.4, 0.2, 0.5]);
    ball.mesh.colors =
        Colors::Each(ball.mesh.positions.iter().map(|p| [0.5 + 0.2 * p.x as f32, 0.4, 0.3, 0.5]).collect());
    let scene = Scene { objects, meshes: vec![ball], ..Scene::default() };
    Hard {
        camera: camera([0.2, 0.1, 0.3], [0.9, 0.4, -0.8]),
        ..hard("camera in transparent things", scene, all_layers())
    }
}

/// Polygons without area, with NaN in them, and one that crosses the near plane and the eye's.
pub fn broken_polygons() -> Hard {
    let mut mesh = Mesh {
        positions: vec![
            DVec3::new(-1.0, -0.8, 0.0),
            DVec3::new(1.0, -0.8, 0.2),
            DVec3::new(0.0, 0.9, -0.3),
            DVec3::new(f64::NAN, 0.0, 0.0),
            DVec3::new(f64::INFINITY, 0.0, 0.0),
        ],
        triangles: vec![[0, 1, 2], [0, 0, 1], [0, 1, 3], [1, 2, 4], [1, 1, 1]],
        ..Mesh::default()
    };
    mesh.normals = Some(vec![Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::ZERO, Vec3::Z, Vec3::Z]);
    let broken = MeshObject { name: "broken".to_owned(), mesh, closed: false };
    let floor = rectangle(
        [[-3.0, -1.0, 6.0], [3.0, -1.0, 6.0], [3.0, -1.0, -4.0], [-3.0, -1.0, -4.0]].map(DVec3::from),
        [0.3, 0.5, 0.2, 1.0],
    );
    let clear = rectangle(
        [[0.5, -2.0, 5.0], [0.5, -2.0, -3.0], [0.5, 2.0, -3.0], [0.5, 2.0, 5.0]].map(DVec3::from),
        [0.2, 0.3, 0.9, 0.5],
    );
    let scene = Scene { meshes: vec![broken, floor, clear], ..Scene::default() };
    hard("broken polygons, polygons across the near plane", scene, all_layers())
}

/// A scene of polygons only, opaque and transparent, with lights of its own.
pub fn meshes_only() -> Hard {
    let lights = vec![
        Light { kind: LightKind::Directional(DVec3::new(-1.0, -2.0, -0.5)), color: [0.9, 0.8, 0.6] },
        Light { kind: LightKind::Eye, color: [0.2, 0.2, 0.4] },
    ];
    let meshes = vec![
        ball_of_polygons(DVec3::new(-0.3, 0.0, 0.0), 0.8, 32, [0.7, 0.4, 0.2, 1.0]),
        ball_of_polygons(DVec3::new(0.3, 0.2, 0.5), 0.7, 32, [0.2, 0.5, 0.9, 0.45]),
    ];
    hard("polygons only, lit", Scene { meshes, lights, ..Scene::default() }, all_layers())
}

/// Opaque splats and polygons of one surface, overlapping: each ball is half the one and half the other.
pub fn hybrid(transition: Transition) -> Hard {
    half_and_half("splats and polygons of one surface", [1.0, 1.0], transition)
}

/// The hybrid, transparent.
pub fn transparent_hybrid(transition: Transition) -> Hard {
    half_and_half("transparent splats and polygons of one surface", [0.5, 0.6], transition)
}

fn half_and_half(name: &'static str, alphas: [f32; 2], transition: Transition) -> Hard {
    let mut splats = tinted(sphere(4000, DVec3::ZERO), [0.8, 0.5, 0.2, alphas[0]]);
    let right: Vec<bool> = splats.splats.positions.iter().map(|p| p.x >= -0.02).collect();
    splats.splats.keep(&right);
    let mut polygons = ball_of_polygons(DVec3::ZERO, 1.0, 40, [0.2, 0.5, 0.8, alphas[1]]);
    let Mesh { positions, triangles, .. } = &mut polygons.mesh;
    triangles.retain(|triangle| triangle.iter().all(|vertex| positions[*vertex as usize].x <= 0.02));
    (splats.closed, polygons.closed) = (true, true);
    let scene = Scene { objects: vec![splats], meshes: vec![polygons], ..Scene::default() };
    hard(name, scene, Settings { transition, backfaces: Backfaces::Auto, ..all_layers() })
}

/// A transparent polygon through a transparent sheet of splats: one surface where they are within ε of each other.
pub fn crossing() -> Hard {
    let tilted = DVec3::new(0.5, 0.1, 1.0).normalize();
    let corners = [[-1.2, -1.0, 0.0], [1.2, -1.0, 0.0], [1.2, 1.0, 0.0], [-1.2, 1.0, 0.0]].map(DVec3::from);
    let scene = Scene {
        objects: vec![sheet(DVec3::ZERO, tilted, 1.2, 24, [0.9, 0.5, 0.1, 0.6])],
        meshes: vec![rectangle(corners, [0.1, 0.3, 0.9, 0.5])],
        ..Scene::default()
    };
    hard("polygon through splats", scene, Settings { epsilon: Epsilon::Length(0.3), ..all_layers() })
}

/// The last layer blends what is behind the first two, with lights of the scene's own; splats without a filter.
pub fn blended() -> Hard {
    let Hard { mut scene, camera, .. } = interpenetrating();
    scene.meshes.push(ball_of_polygons(DVec3::new(0.0, -0.4, -0.3), 0.9, 24, [0.3, 0.8, 0.3, 0.5]));
    scene
        .lights
        .push(Light { kind: LightKind::Directional(DVec3::new(1.0, -1.0, -1.0)), color: [1.0, 0.9, 0.8] });
    let settings = Settings {
        layers: Layers::Fixed(3),
        last_layer: LastLayer::Blend,
        filter: Filter::None,
        ..settings()
    };
    Hard { name: "last layer blended", scene, camera, settings }
}

/// The blended scene with the alpha of as many surfaces as the weights tell.
pub fn stacked(transition: Transition) -> Hard {
    let mut hard = blended();
    hard.name = "last layer stacked";
    hard.settings.last_layer = LastLayer::Stack;
    hard.settings.transition = transition;
    hard
}

/// All of them.
pub fn all() -> Vec<Hard> {
    vec![
        spheres(),
        interpenetrating(),
        glass(),
        coincident_sheets(),
        alpha_0_and_1(),
        sixty_four_layers(),
        upon_the_opaque(),
        camera_inside(),
        broken_polygons(),
        meshes_only(),
        hybrid(Transition::Color),
        hybrid(Transition::Attributes),
        hybrid(Transition::None),
        hybrid(Transition::Paper),
        transparent_hybrid(Transition::Color),
        crossing(),
        blended(),
        stacked(Transition::Color),
    ]
}
