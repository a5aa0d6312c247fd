//! What a hybrid's splats let stand out over its polygons: fins at their silhouette, over a sweep of views.

use crate::common::{builder, shared};
use glam::DVec3;
use surfel::{
    geometry::{HybridOptions, hybrid},
    load::builtin::sphere_mesh,
    renderer::{Frame, Wanted},
    scene::{
        Accumulate, Camera, Colors, Filter, Mesh, MeshObject, Object, Scene, Settings, Shading, Transition,
    },
};

const SIZE: i32 = 512;

/// The triangle of a ball that a direction from its middle meets.
fn triangle_at(mesh: &Mesh, direction: DVec3) -> Option<usize> {
    let meets = |[a, b, c]: [DVec3; 3]| {
        [(a, b), (b, c), (c, a)].iter().all(|(from, to)| from.cross(*to).dot(direction) >= 0.0)
    };
    (0..mesh.triangles.len()).find(|&i| mesh.corners(i).is_some_and(meets))
}

/// The place in the world that a pixel shows.
fn place(camera: &Camera, frame: &Frame, x: i32, y: i32) -> DVec3 {
    let forward = (camera.target - camera.eye).normalize();
    let right = forward.cross(camera.up).normalize();
    let down = forward.cross(right);
    let focal = camera.focal_px(SIZE as u32);
    let [dx, dy] = [x, y].map(|at| (f64::from(at) + 0.5 - 0.5 * f64::from(SIZE)) / focal);
    let depth = f64::from(frame.depth[(y * SIZE + x) as usize]);
    camera.eye + depth * (forward + dx * right + dy * down)
}

fn covered(frame: &Frame, x: i32, y: i32) -> bool {
    let inside = (0..SIZE).contains(&x) && (0..SIZE).contains(&y);
    inside && frame.linear[(y * SIZE + x) as usize][..3] != [1.0; 3]
}

/// How far the nearest covered pixel is, up to 16.
fn distance_px(frame: &Frame, x: i32, y: i32) -> f64 {
    let all = (-16..=16).flat_map(|dy| (-16..=16).map(move |dx| (dx, dy)));
    let near = all.filter(|(dx, dy)| covered(frame, x + dx, y + dy));
    near.map(|(dx, dy)| f64::from(dx * dx + dy * dy).sqrt()).fold(16.0, f64::min)
}

/// The ball of `examples/hybrid.toml` from 24 sides. A pixel of a fin shows splats in front of a triangle that stays a polygon
/// and is more than a pixel off all that the whole mesh covers. Without `fins.rs` there are hundreds.
#[test]
fn no_splat_stands_out_over_the_polygons() {
    let mut headless = shared();
    let mesh = sphere_mesh(320);
    let stays =
        |i: usize| mesh.corners(i).is_some_and(|[a, b, c]| (a + b + c).dot(DVec3::new(1.0, 0.2, 0.0)) >= 0.0);
    let options = HybridOptions { samples: 1000, seed: 0, sample_edges: true };
    let paint = Colors::Uniform([0.3, 0.3, 0.3, 1.0]);
    let ball = hybrid(&mesh, &stays, &options, &()).unwrap();
    let all = hybrid(&mesh, &|_| false, &HybridOptions { samples: 2000, ..options }, &()).unwrap();
    let none = hybrid(&mesh, &|_| true, &options, &()).unwrap();
    let scenes = [&ball, &none, &all].map(|ball| {
        let splats = surfel::scene::Splats { colors: paint.clone(), ..ball.splats.clone() };
        let triangles = Mesh { colors: paint.clone(), ..ball.polygons.clone() };
        let object = Object { name: "splats".to_owned(), splats, closed: true };
        let polygons = MeshObject { name: "polygons".to_owned(), mesh: triangles, closed: true };
        Scene {
            objects: if object.splats.is_empty() { Vec::new() } else { vec![object] },
            meshes: if polygons.mesh.triangles.is_empty() { Vec::new() } else { vec![polygons] },
            ..Scene::default()
        }
    });
    let settings = Settings {
        size_px: [SIZE as u32; 2],
        background: Some([1.0; 3]),
        shading: Shading::Albedo,
        transition: Transition::Color,
        filter: Filter::None,
        accumulate: Accumulate::F32,
        ..Settings::default()
    };
    let prepared = scenes.map(|scene| headless.prepare(&scene, &|_, _| {}).unwrap());
    let wanted = Wanted { picture: true, linear: true, surface: true, profile: None };
    let (mut fins, mut farthest, mut neither, mut gaps, mut outline) = (0, 0.0_f64, 0, 0, 0);
    for view in 0..24 {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(view) / 24.0).sin_cos();
        let height = 1.2 * (f64::from(view) * 0.618).fract() - 0.6;
        let camera = builder::camera([3.0 * sin, 3.0 * height, 3.0 * cos], [0.0; 3]);
        let [both, whole, splats] =
            [0, 1, 2].map(|i| headless.render(&prepared[i], &camera, &settings, wanted).unwrap());
        for (x, y) in (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| (x, y))) {
            let of_mesh = covered(&whole, x, y);
            outline += usize::from(of_mesh && !(covered(&whole, x + 1, y) && covered(&whole, x - 1, y)));
            gaps += usize::from(of_mesh && !covered(&both, x, y));
            if of_mesh || !covered(&both, x, y) {
                continue;
            }
            let over = triangle_at(&mesh, place(&camera, &both, x, y)).is_some_and(stays);
            let off = distance_px(&whole, x, y);
            if over {
                farthest = farthest.max(off);
                fins += usize::from(off > 1.5);
            }
            neither += usize::from(!covered(&splats, x, y));
        }
    }
    println!(
        "24 views of {SIZE}²: {fins} pixels of fins, the farthest {farthest:.1} px off; {neither} pixels of neither the \
         mesh nor the splats alone; {gaps} pixels of the mesh not covered, of {outline} of its outline"
    );
    assert_eq!(fins, 0);
}
