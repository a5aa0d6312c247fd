//! Parts with sharp edges that half of the light goes through.

use glam::{DAffine3, DVec3};
use surfel::{
    geometry::sharp::{SharpOptions, sharp_splats},
    hard_scenes::parts,
    renderer::Headless,
    scene::{Colors, Edges, LastLayer, Layers, Object, Rasterizer, Scene, Shading},
    selftest::{light::compare_light, tolerance::LIGHT},
};

use crate::common::{PICTURE, bent::bent, builder, oracle_of, render_as, scenes, shared, with};

/// A closed and convex part of which half of the light goes through each surface: a quarter goes through both, wherever one looks. What a pixel has of one surface is one layer, from however
/// flat a side it is seen; on a flat side it was two or more in streaks, whose slivers are narrower than the filter.
#[test]
fn a_transparent_part_has_two_surfaces_and_no_streaks() {
    let mut headless = shared();
    let (mut splats, report) =
        sharp_splats(&parts::cylinder(64, 1, 2.0), &SharpOptions::default(), &()).unwrap();
    splats.colors = Colors::Uniform([1.0, 1.0, 1.0, 0.5]);
    let object = Object { name: String::new(), splats, closed: report.closed };
    for eye in [[0.4, 3.9, 2.0], [2.5, 1.8, 4.3], [0.3, 1.5, 4.5]] {
        let mut hard = with(&scenes::clipped(), |settings| {
            settings.rasterizer = Rasterizer::Compute;
            settings.edges = Edges::Coverage;
            settings.layers = Layers::Fixed(6);
            settings.shading = Shading::Albedo;
            settings.background = None;
        });
        hard.camera = builder::camera(eye, [0.0; 3]);
        hard.scene = Scene { objects: vec![object.clone()], ..Scene::default() };
        let frame = render_as(&mut headless, &hard, PICTURE);
        let alphas = || frame.linear.iter().map(|color| color[3]);
        let (seen, darker) = (alphas().filter(|a| *a > 0.7).count(), alphas().filter(|a| *a > 0.78).count());
        println!("{eye:?}: {darker} of {seen} are darker");
        assert!(seen > 3000 && darker < seen / 100, "{eye:?}: {darker} of {seen}");
    }
}

/// Where a side bends, an ε leaves some of it to another layer of the same surface: together they cover a pixel once, and all of it.
#[test]
fn layers_of_one_bent_surface_cover_it_once() {
    let mut headless = shared();
    for (sides, rows) in [(160, 1), (64, 8)] {
        let hard = bent(sides, rows);
        let frame = render_as(&mut headless, &hard, PICTURE);
        let count = |from: f32, to: f32| {
            frame.linear.iter().filter(|color| from < color[3] && color[3] <= to).count()
        };
        let [clearer, right, darker] = [count(0.6, 0.74), count(0.74, 0.757), count(0.757, 1.0)];
        println!("{sides} sides, {rows} rows: {clearer} clearer, {right} right, {darker} darker");
        assert!(
            right > 40_000 && clearer < right / 8 && darker < right / 3000,
            "{clearer}, {right}, {darker}"
        );
    }
}

/// The second of 40 layers' dispatches begins in the middle of the part, of which it has to know what is covered.
#[test]
fn layers_of_a_bent_surface_go_on_in_the_next_dispatch() {
    let mut headless = shared();
    let picture = |headless: &mut Headless, layers| {
        let mut hard = with(&bent(64, 8), |settings| {
            (settings.layers, settings.last_layer) = (Layers::Fixed(layers), LastLayer::Drop);
        });
        // One in the other: eight surfaces, each of one layer or two.
        let one = hard.scene.objects.remove(0);
        let smaller = |scale| {
            let splats = one.splats.clone().transformed(&DAffine3::from_scale(DVec3::splat(scale)));
            Object { splats, ..one.clone() }
        };
        hard.scene.objects = [1.0, 0.9, 0.8, 0.7].map(smaller).into();
        render_as(headless, &hard, PICTURE).linear
    };
    let [at_once, in_turn] = [13, 40].map(|layers| picture(&mut headless, layers));
    let off = |(a, b): (&[f32; 4], &[f32; 4])| f32::abs(a[3] - b[3]);
    let off = at_once.iter().zip(&in_turn).map(off).fold(0.0, f32::max);
    println!("{off}");
    assert!(off < 1e-5, "{off}");
}

#[test]
fn layers_that_go_on_agree_with_the_oracle() {
    let mut headless = shared();
    for (sides, rows) in [(24, 4), (64, 8)] {
        let hard = with(&bent(sides, rows), |settings| settings.size_px = [200, 200]);
        let errors = compare_light(&render_as(&mut headless, &hard, PICTURE), &oracle_of(&hard));
        println!("{}", errors.row("a bent part"));
        assert!(errors.worst <= LIGHT && errors.not_finite == 0, "{errors:?}");
        assert!(errors.seen >= 10_000 && errors.compared >= 35_000, "{errors:?}");
    }
}
