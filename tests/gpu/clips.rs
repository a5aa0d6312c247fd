//! What clip curves cut off splats: GPU against the oracle, beside what the self-test draws by every rasterizer and filter.

use crate::common::{
    PICTURE, assert_agrees, builder, oracle_of, passes, render_as,
    scenes::{self, Hard},
    shared, with, with_points_up_to,
};
use crate::orthographic::parallel;
use glam::{DAffine3, DVec3};
use surfel::{
    geometry::sharp::{SharpOptions, sharp_splats},
    hard_scenes::parts,
    prepare::Chunk,
    renderer::Headless,
    scene::{
        Clips, Colors, Edges, Filter, Layers, Object, Rasterizer, Scene, Settings, Shading, Splats,
        TileInvocations,
    },
    selftest::{light::compare_light, tolerance::LIGHT},
};

/// Clipped edges that cover pixels in part.
fn agrees_at_edges(headless: &mut Headless, hard: &Hard, change: impl FnOnce(&mut Settings)) {
    let hard = with(hard, |settings| {
        settings.edges = Edges::Coverage;
        settings.rasterizer = Rasterizer::Compute;
        settings.background = None;
        change(settings);
    });
    let frame = render_as(headless, &hard, PICTURE);
    assert!(!passes(&frame).contains(&"accumulate"));
    let errors = compare_light(&frame, &oracle_of(&hard));
    println!("{}", errors.row(hard.name));
    assert!(errors.worst <= LIGHT && errors.not_finite == 0, "{errors:?}");
    assert!(errors.seen >= 1_000 && errors.compared >= 40_000, "{errors:?}");
}

#[test]
fn clipped_edges_cover_pixels_in_part_as_the_oracles_do() {
    let mut headless = shared();
    for filter in [Filter::Adjust, Filter::Ewa] {
        agrees_at_edges(&mut headless, &scenes::clipped(), |settings| settings.filter = filter);
    }
    for invocations in [TileInvocations::Pixel, TileInvocations::Column] {
        agrees_at_edges(&mut headless, &scenes::clipped(), |settings| {
            settings.tile_invocations = invocations
        });
    }
}

/// The clips of a scene, given to the splats of another one, some of which have none.
fn in_alpha(alpha: f32) -> Hard {
    let mut hard = scenes::clipped();
    if let Colors::Each(colors) = &mut hard.scene.objects[0].splats.colors {
        colors.iter_mut().step_by(2).for_each(|color| color[3] = alpha);
    }
    hard
}

#[test]
fn transparent_splats_are_clipped_in_every_layer_by_tiles_and_by_points() {
    let mut headless = shared();
    for rasterizer in
        [Rasterizer::Compute, Rasterizer::Perspective, Rasterizer::Triangle, Rasterizer::Raycast]
    {
        let hard = with(&in_alpha(0.5), |settings| {
            (settings.rasterizer, settings.layers) = (rasterizer, Layers::Fixed(3));
            settings.background = None;
        });
        let frame = render_as(&mut headless, &hard, PICTURE);
        let errors = compare_light(&frame, &oracle_of(&hard));
        println!("{rasterizer:?}: {}", errors.row(hard.name));
        assert!(errors.worst <= LIGHT && errors.seen > 10_000, "{rasterizer:?}: {errors:?}");
    }
    agrees_at_edges(&mut headless, &in_alpha(0.5), |settings| settings.layers = Layers::Fixed(3));
}

#[test]
fn beside_polygons_and_seen_by_parallel_rays_they_are_clipped_alike() {
    let mut headless = shared();
    let mut hybrid = scenes::clipped();
    hybrid.scene.meshes.push(builder::ball_of_polygons(DVec3::ZERO, 0.6, 24, [0.2, 0.7, 0.4, 1.0]));
    let parallel = parallel(&scenes::clipped());
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective, Rasterizer::Quad] {
        for hard in [&hybrid, &parallel] {
            let hard = with(hard, |settings| settings.rasterizer = rasterizer);
            assert_agrees(&mut headless, &hard, 1_000);
        }
    }
    agrees_at_edges(&mut headless, &hybrid, |_| ());
    agrees_at_edges(&mut headless, &parallel, |_| ());
}

/// Large splats are quads beside points and tiles; those around the eye have no center in the image.
#[test]
fn large_splats_and_those_that_reach_the_eye_are_clipped_alike() {
    let mut headless = shared();
    let mut near = scenes::clipped();
    near.camera = builder::camera([0.1, 0.05, 0.4], [0.0, 0.0, -0.3]);
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective, Rasterizer::Raycast] {
        for hard in [&near, &scenes::clipped()] {
            let hard = with(hard, |settings| {
                (settings.rasterizer, settings.size_px) = (rasterizer, [96, 96]);
            });
            with_points_up_to(&mut headless, 8.0, |headless| assert_agrees(headless, &hard, 500));
        }
    }
}

/// What is whole has none of what clips need, in the same object, too.
#[test]
fn splats_without_clips_have_no_buffer_and_no_pipeline_for_them() {
    let headless = shared();
    let mut whole = scenes::clipped();
    whole.scene.objects[0].splats.clips = Clips::default();
    for (hard, clipped) in [(&scenes::clipped(), 438), (&whole, 0)] {
        let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
        let of_clipped = prepared.chunks().iter().filter(|chunk| chunk.clipped).map(|chunk| chunk.count);
        assert_eq!(of_clipped.sum::<u32>(), clipped);
        let bytes = |chunk: &Chunk| u64::from(chunk.count) * (if chunk.fine { 64 } else { 48 } + 8);
        let expected = prepared.chunks().iter().map(bytes).sum::<u64>() + 96 * u64::from(clipped);
        assert_eq!(prepared.bytes(), expected);
    }
}

/// A box of twelve clipped splats, each as large as a face, around a red ball: nothing of it is seen, of one object or of two.
#[test]
fn what_is_behind_large_splats_is_not_seen_through_them() {
    let mut headless = shared();
    let options = SharpOptions::default();
    let (mut cube, _) = sharp_splats(&parts::cube(1), &options, &()).unwrap();
    let (mut ball, _) = sharp_splats(&parts::cube(4), &options, &()).unwrap();
    let half = DAffine3::from_scale(DVec3::splat(0.5));
    ball = ball.transformed(&half);
    ball.colors = Colors::Uniform([1.0, 0.0, 0.0, 1.0]);
    cube.colors = Colors::Uniform([0.0, 0.0, 1.0, 1.0]);
    let object = |splats: &Splats| Object { name: String::new(), splats: splats.clone(), closed: true };
    let two = vec![object(&cube), object(&ball)];
    let mut both = cube.clone();
    both.append(ball);
    for objects in [two, vec![object(&both)]] {
        for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective] {
            let mut hard = with(&scenes::clipped(), |settings| {
                settings.rasterizer = rasterizer;
                settings.edges = Settings::default().edges;
                settings.shading = Shading::Albedo;
                settings.background = None;
            });
            hard.camera = builder::camera([3.0, 2.0, 4.0], [0.0; 3]);
            hard.scene = Scene { objects: objects.clone(), ..Scene::default() };
            let frame = render_as(&mut headless, &hard, PICTURE);
            let red = frame.linear.iter().filter(|color| color[0] > 0.01).count();
            let blue = frame.linear.iter().filter(|color| color[2] > 0.9).count();
            assert!(red == 0 && blue > 2000, "{rasterizer:?}: {red} red pixels, {blue} blue");
        }
    }
}
