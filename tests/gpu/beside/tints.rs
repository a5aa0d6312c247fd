//! Scenes that are tinted in a frame are seen as if their colors were others.

use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, Placed, Placement},
    reference,
    scene::{Colors, Edges, Mesh, MeshObject, Object, Opacity, Rasterizer, Scene, Shading, Transition},
};

use super::{Beside, REVERSED, SIZE_PX};
use crate::common::scenes;

const BEHIND: [DVec3; 3] =
    [DVec3::new(-90.0, -60.0, -30.0), DVec3::new(90.0, -60.0, -30.0), DVec3::new(0.0, 90.0, -30.0)];

const TINTS: [[f32; 4]; 3] = [[0.9, 0.3, 0.1, 1.0], [1.0; 4], [0.2, 1.0, 0.6, 0.4]];

fn camera() -> HostCamera {
    HostCamera {
        view_from_world: look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y),
        clip_from_view: directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5),
        flips_y: true,
    }
}

fn at(x: f64, z: f64, scale: f64) -> Placement {
    Placement { translation: DVec3::new(x, 0.1, z), scale, ..Placement::default() }
}

/// A ball of many colors, the same transparent, and a triangle.
fn parts() -> [Scene; 3] {
    let colored = |alpha: f32| {
        let mut ball = scenes::sphere(2500, DVec3::ZERO);
        let of = |at: &DVec3| {
            let [r, g, b] = (0.5 * at.as_vec3() + 0.5).clamp(glam::Vec3::ZERO, glam::Vec3::ONE).to_array();
            [r, g, b, alpha]
        };
        ball.splats.colors = Colors::Each(ball.splats.positions.iter().map(of).collect());
        ball
    };
    let mesh = Mesh {
        positions: vec![DVec3::new(-1.6, -1.2, -0.6), DVec3::new(1.6, -1.1, 0.1), DVec3::new(0.1, 1.4, -0.4)],
        triangles: vec![[0, 1, 2]],
        normals: Some(vec![glam::Vec3::Z; 3]),
        colors: Colors::Uniform([0.8, 0.7, 0.6, 1.0]),
    };
    let mesh = MeshObject { name: "triangle".to_owned(), mesh, closed: false };
    let of = |objects, meshes| Scene { objects, meshes, ..Scene::default() };
    [of(vec![colored(1.0)], Vec::new()), of(Vec::new(), vec![mesh]), of(vec![colored(0.5)], Vec::new())]
}

fn placements() -> [Placement; 3] {
    [at(-0.5, 0.0, 0.8), at(0.0, 0.0, 1.0), at(0.6, 0.7, 0.5)]
}

fn tinted(colors: &Colors, tint: [f32; 4]) -> Colors {
    let of = |color: [f32; 4]| std::array::from_fn(|i| color[i] * tint[i]);
    match colors {
        Colors::Uniform(color) => Colors::Uniform(of(*color)),
        Colors::Each(all) => Colors::Each(all.iter().map(|color| of(*color)).collect()),
    }
}

/// The same as one scene, moved and colored, for the oracle.
fn whole(parts: &[Scene; 3], tints: [[f32; 4]; 3]) -> Scene {
    let mut all = Scene::default();
    for ((scene, at), tint) in parts.iter().zip(placements()).zip(tints) {
        let matrix = glam::DAffine3::from_scale_rotation_translation(
            DVec3::splat(at.scale),
            at.rotation,
            at.translation,
        );
        for own in &scene.objects {
            let mut splats = own.splats.clone().transformed(&matrix);
            splats.colors = tinted(&own.splats.colors, tint);
            all.objects.push(Object { splats, ..own.clone() });
        }
        for own in &scene.meshes {
            let mut own = own.clone();
            own.mesh.positions.iter_mut().for_each(|place| *place = matrix.transform_point3(*place));
            own.mesh.colors = tinted(&own.mesh.colors, tint);
            all.meshes.push(own);
        }
    }
    all
}

#[test]
fn tints_multiply_linear_colors_and_alphas_as_the_oracle_does() {
    let parts = parts();
    let camera = camera();
    let (own_camera, _) = camera.camera(SIZE_PX).unwrap();
    let mut beside = Beside::new(REVERSED);
    let uploaded = [0, 1, 2].map(|i| beside.upload(&parts[i]));
    let tints = [TINTS[0], [0.5, 0.9, 0.3, 1.0], TINTS[2]];
    let scenes: Vec<_> =
        (0..3).map(|i| Placed { tint: tints[i], ..Placed::new(&uploaded[i], placements()[i]) }).collect();
    let all = whole(&parts, tints);
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective, Rasterizer::Quad, Rasterizer::Triangle] {
        // With splats alone, with polygons, with layers, and with all of them; `tinted` tells that untinted pictures are others.
        for which in [vec![0], vec![1], vec![2], vec![0, 1], vec![0, 2], vec![0, 1, 2]] {
            let settings = Settings {
                size_px: SIZE_PX,
                edges: Edges::Hard,
                rasterizer,
                shading: Shading::Albedo,
                transition: Transition::None,
                background: None,
                ..Settings::default()
            };
            let shown: Vec<_> = which.iter().map(|i| scenes[*i]).collect();
            let mut seen = Scene { ..Scene::default() };
            for i in &which {
                let own = whole(&parts, tints);
                match i {
                    0 => seen.objects.push(own.objects[0].clone()),
                    1 => seen.meshes = own.meshes,
                    _ => seen.objects.push(own.objects[1].clone()),
                }
            }
            let oracle = reference::render(&seen, &own_camera, &settings, &|_, _| {}).unwrap();
            // Nothing of the engine's is seen.
            let far = BEHIND.map(|corner| corner + DVec3::new(0.0, 0.0, -5.0));
            beside.draw(&shown, &camera, &settings, &far, true);
            let pixels = beside.engine.pixels();
            let (mut off, mut covered, mut ties) = (0, 0, 0);
            for (pixel, expected) in pixels.iter().zip(&oracle.pixels) {
                let [r, g, b, a] = expected.color;
                // Over red, as the engine's triangle is.
                let expected_over = [r * a + (1.0 - a), g * a, b * a];
                let far = (0..3).map(|i| (f64::from(pixel[i]) - expected_over[i]).abs()).fold(0.0, f64::max);
                if expected.rim || expected.epsilon_margin < 1e-5 {
                    ties += 1;
                    continue;
                }
                covered += u32::from(a > 0.0);
                off += u32::from(far > 2e-3);
            }
            println!("{rasterizer:?}, {which:?}: {covered} pixels, {off} differ, {ties} exempt");
            assert!(
                covered > 900 && off <= 6 && ties < 600,
                "{rasterizer:?}, {which:?}: {covered} {off} {ties}"
            );
            let plain: Vec<_> = shown.iter().map(|it| Placed::new(it.scene, it.at)).collect();
            beside.draw(&plain, &camera, &settings, &far, true);
            let changed =
                beside.engine.pixels().iter().zip(&pixels).filter(|(one, other)| one != other).count();
            assert!(changed > 500, "{rasterizer:?}, {which:?}: {changed}");
        }
    }
    assert!(all.objects[1].splats.colors.opacity() == Opacity::Transparent);
    drop(uploaded);
    beside.end();
}

/// Visibility is the list; what is no tint is refused, with the number of the scene.
#[test]
fn what_is_no_tint_is_refused_and_what_is_not_listed_is_not_seen() {
    let parts = parts();
    let camera = camera();
    let settings = Settings { size_px: SIZE_PX, shading: Shading::Albedo, ..Settings::default() };
    let mut beside = Beside::new(REVERSED);
    let uploaded = [0, 1, 2].map(|i| beside.upload(&parts[i]));
    let placed = |i: usize, tint| Placed { tint, ..Placed::new(&uploaded[i], placements()[i]) };
    let white = [1.0; 4];
    let mut refused = |scenes: &[Placed<'_>]| {
        let frame = surfel::embed::ViewFrame::new(scenes, &camera, &settings);
        // SAFETY: refused before anything is recorded.
        unsafe { beside.view.prepare(&beside.renderer, beside.engine.commands, &frame) }
            .unwrap_err()
            .to_string()
    };
    assert!(refused(&[placed(0, white), placed(0, [1.0, 1.0, 1.1, 1.0])]).contains("scene 1"));
    assert!(refused(&[placed(0, [f32::NAN, 1.0, 1.0, 1.0])]).contains("expected 0 to 1"));
    for opaque in [0, 1] {
        let told = refused(&[placed(opaque, [1.0, 1.0, 1.0, 0.5])]);
        assert!(told.contains("tint") && told.contains("opaque"), "{told}");
    }
    let mut picture = |scenes: &[Placed<'_>]| {
        beside.draw(scenes, &camera, &settings, &BEHIND, true);
        beside.engine.pixels()
    };
    let [one, both] = [&[placed(0, white)][..], &[placed(0, white), placed(1, white)]].map(&mut picture);
    let again = picture(&[placed(0, white)]);
    assert!(one != both && one == again, "what is not in the list is not seen");
    drop(uploaded);
    beside.end();
}
