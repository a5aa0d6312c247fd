//! Which cells of a mesh in levels of detail are outside of the view.

use surfel::{
    math::random::SplitMix,
    scene::{Camera, Edges, Lod, Settings},
};

use crate::{
    common::{PICTURE, builder, passes, shared, with},
    hybrid_levels::{direction, hard, waves},
};

/// So near that a cell is as large as the picture, whose middle is often outside of it: all of the mesh that is seen is drawn.
#[test]
fn cells_that_reach_into_the_view_are_drawn() {
    let mut headless = shared();
    let made = waves(5000, 2500);
    let hybrid = with(&hard(&made, 1e-6), |settings| settings.edges = Edges::Hard);
    let prepared = headless.prepare(&hybrid.scene, &|_, _| {}).unwrap();
    let mut random = SplitMix(12);
    let [mut covered, mut apart] = [0; 2];
    for _ in 0..60 {
        let (eye, beside) = (1.35 * direction(&mut random), direction(&mut random));
        let target = 0.9 * (eye + 0.5 * beside).normalize();
        let view = Camera { near: Some(1e-3), ..builder::camera(eye.to_array(), target.to_array()) };
        let mut alphas = |lod: f64| -> Vec<f32> {
            let settings = Settings { lod: Lod::Px(lod), ..hybrid.settings.clone() };
            let frame = headless.render(&prepared, &view, &settings, PICTURE).unwrap();
            assert_eq!(passes(&frame).contains(&"choose polygons"), lod > 0.0);
            frame.linear.iter().map(|pixel| pixel[3]).collect()
        };
        let (mesh, found) = (alphas(0.0), alphas(1e-6));
        covered += mesh.iter().filter(|alpha| **alpha > 0.5).count();
        apart += mesh.iter().zip(&found).filter(|(a, b)| (**a - **b).abs() > 0.5).count();
    }
    assert!(covered > 100_000 && apart == 0, "{apart} pixels of {covered}");
}
