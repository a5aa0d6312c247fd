//! Something transparent, which the engine's triangle cuts: layers behind it are hidden, layers before it lie over it.

use glam::{
    DVec3,
    dcamera::rh::{proj::directx, view::look_at_mat4},
};
use surfel::{
    Settings,
    embed::{HostCamera, Placed, ViewFrame},
    reference,
    scene::{Edges, Mesh, MeshObject, Rasterizer, Scene, Shading},
};

use super::{Beside, FORWARD, RED, REVERSED, SIZE_PX};
use crate::common::scenes;

#[test]
fn an_engines_triangle_lies_between_layers_as_our_own_would() {
    let mut ball = scenes::sphere(3000, DVec3::ZERO);
    ball.splats.colors = surfel::scene::Colors::Uniform([0.0, 0.5, 0.8, 0.4]);
    let mut scene =
        Scene { objects: vec![ball, scenes::sphere(1500, DVec3::new(0.9, 0.0, 0.8))], ..Scene::default() };
    let corners = [DVec3::new(-3.0, -2.0, 0.8), DVec3::new(3.0, -2.0, -0.3), DVec3::new(0.0, 2.5, 0.2)];
    let view_from_world = look_at_mat4(DVec3::new(0.4, 0.9, 4.0), DVec3::ZERO, DVec3::Y);
    let meeting = directx::perspective_infinite_reverse(0.7, 160.0 / 120.0, 0.5);
    let parallel = directx::orthographic(-2.0, 2.0, -1.5, 1.5, 0.5, 20.0);
    let by = |clip_from_view| HostCamera { view_from_world, clip_from_view, flips_y: true };
    for (style, camera, rasterizer) in [
        (REVERSED, by(meeting), Rasterizer::Compute),
        (REVERSED, by(meeting), Rasterizer::Perspective),
        (FORWARD, by(parallel), Rasterizer::Compute),
        (FORWARD, by(parallel), Rasterizer::Perspective),
    ] {
        let settings = Settings {
            size_px: SIZE_PX,
            edges: Edges::Hard,
            rasterizer,
            shading: Shading::Albedo,
            background: None,
            ..Settings::default()
        };
        let mut beside = Beside::new(style);
        let prepared = beside.upload(&scene);
        let scenes = [Placed::at_home(&prepared)];
        let without = ViewFrame::new(&scenes, &camera, &settings);
        // SAFETY: refused before anything is recorded.
        let refused = unsafe { beside.view.prepare(&beside.renderer, beside.engine.commands, &without) };
        assert!(refused.unwrap_err().to_string().contains("transparent"));
        beside.draw(&scenes, &camera, &settings, &corners, true);

        // The same triangle of our own.
        let mesh = Mesh {
            positions: corners.to_vec(),
            triangles: vec![[0, 1, 2]],
            normals: Some(vec![glam::Vec3::Z; 3]),
            colors: surfel::scene::Colors::Uniform(RED),
        };
        scene.meshes = vec![MeshObject { name: "triangle".to_owned(), mesh, closed: false }];
        let (own, _) = camera.camera(SIZE_PX).unwrap();
        let own_settings = Settings { transition: surfel::scene::Transition::None, ..settings.clone() };
        let oracle = reference::render(&scene, &own, &own_settings, &|_, _| {}).unwrap();
        scene.meshes.clear();

        let (mut far, mut mixed) = (0, 0);
        for (pixel, expected) in beside.engine.pixels().iter().zip(&oracle.pixels) {
            let [r, g, b, a] = expected.color;
            let expected = [r * a, g * a, b * a];
            let off = (0..3).map(|i| (f64::from(pixel[i]) - expected[i]).abs()).fold(0.0, f64::max);
            far += u32::from(off > 1e-3);
            mixed += u32::from(pixel[0] > 0.05 && pixel[2] > 0.05);
        }
        println!("{rasterizer:?}: {far} pixels differ, in {mixed} a layer lies over the triangle");
        // Where the ball goes through the triangle a layer is before it or behind it by less than epsilon.
        assert!(mixed > 1000 && far < 60, "{far} {mixed}");
        drop(prepared);
        beside.end();
    }
}
