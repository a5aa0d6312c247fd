//! Triangles seen exactly edge-on. They have no area, but after their corners are rounded to parts of a pixel some have fragments,
//! and what a driver finds between such corners may be NaN, which would spread to whatever reads the picture.

use glam::DVec3;

use crate::common::{
    builder::{self, Random},
    shared,
};
use surfel::{
    renderer::Wanted,
    scene::{Colors, Mesh, MeshObject, Scene, Settings, Shading},
};

const EYE: DVec3 = DVec3::new(0.0, 0.0, 3.0);

/// Triangles whose planes have the eye in them, but for the rounding of their corners to f32: the third corner is a sum of the
/// directions to the others.
fn edge_on(count: u32, random: &mut Random) -> Mesh {
    let mut positions = Vec::new();
    for _ in 0..count {
        let mut signed = || random.between(-1.0, 1.0);
        let [a, b] = [(); 2].map(|()| DVec3::new(signed(), signed(), signed()));
        let c = EYE + signed() * (a - EYE) + (1.0 + signed()) * (b - EYE);
        positions.extend([a, b, c].map(|p| p.as_vec3().as_dvec3()));
    }
    let colors = (0..positions.len()).map(|_| random.color()).collect();
    Mesh {
        triangles: (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        positions,
        colors: Colors::Each(colors),
        ..Mesh::default()
    }
}

#[test]
fn triangles_seen_edge_on_leave_no_pixel_that_is_not_a_number() {
    let mut headless = shared();
    let mut random = Random(5);
    for side_px in 16..28 {
        let mesh = edge_on(2000, &mut random);
        let object = MeshObject { name: "edge-on".to_owned(), mesh, closed: false };
        let scene = Scene { meshes: vec![object], ..Scene::default() };
        let prepared = headless.prepare(&scene, &|_, _| {}).unwrap();
        let camera = builder::camera(EYE.to_array(), [0.0; 3]);
        for shading in [Shading::Albedo, Shading::Normals] {
            let settings = Settings { size_px: [side_px, 20], shading, ..builder::settings() };
            let wanted = Wanted { picture: true, linear: true, ..Wanted::default() };
            let frame = headless.render(&prepared, &camera, &settings, wanted).unwrap();
            let wrong = frame.linear.iter().flatten().filter(|value| !value.is_finite()).count();
            assert_eq!(wrong, 0, "{side_px} pixels wide, {shading:?}");
        }
    }
}
