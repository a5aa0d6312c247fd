//! What clip curves cut off splats: GPU against the oracle, beside what the self-test draws by every rasterizer and filter.

use crate::common::{
    PICTURE, assert_agrees, builder, oracle_of, passes, render_as,
    scenes::{self, Hard},
    shared, with, with_points_up_to,
};
use crate::orthographic::parallel;
use glam::{DAffine3, DVec3, Vec2};
use surfel::{
    geometry::sharp::{SharpOptions, sharp_splats},
    hard_scenes::{builder::Builder, parts},
    prepare::Chunk,
    renderer::Headless,
    scene::{
        Clip, ClipCurve, Clips, Colors, Edges, Filter, Layers, MeshObject, Object, Rasterizer, Scene,
        Settings, Shading, Splats, TileInvocations,
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

/// What is flat, what bulges and what is hollow, seen at a slant: sums count more where a surface can't end by turning away.
#[test]
fn parts_seen_at_a_slant_cover_pixels_in_part_as_the_oracles_do() {
    let mut headless = shared();
    let flat = (parts::cube(5), [0.3, 0.8, 4.0]);
    let bulging = (parts::cylinder(24, 4, 2.0), [1.5, 1.0, 2.5]);
    let hollow = (parts::bored_block(24, 2), [0.2, 0.5, 2.4]);
    for (mesh, eye) in [flat, bulging, hollow] {
        let (splats, report) = sharp_splats(&mesh, &SharpOptions::default(), &()).unwrap();
        let object = Object { name: String::new(), splats, closed: report.closed };
        let mut hard = scenes::clipped();
        hard.camera = builder::camera(eye, [0.0; 3]);
        hard.scene = Scene { objects: vec![object], ..Scene::default() };
        agrees_at_edges(&mut headless, &hard, |_| {});
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

/// A box of twelve clipped splats, each as large as a face, around a red ball: nothing of it is seen, of one object or of two. Where edges cover pixels in
/// part, two sides of a corner may keep toward the same quarter, and count once: a pixel or two there lack a tenth.
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
        for (rasterizer, edges) in [
            (Rasterizer::Compute, Edges::Hard),
            (Rasterizer::Compute, Edges::Coverage),
            (Rasterizer::Perspective, Edges::Hard),
        ] {
            let mut hard = with(&scenes::clipped(), |settings| {
                settings.rasterizer = rasterizer;
                settings.edges = edges;
                settings.shading = Shading::Albedo;
                settings.background = None;
            });
            hard.camera = builder::camera([3.0, 2.0, 4.0], [0.0; 3]);
            hard.scene = Scene { objects: objects.clone(), ..Scene::default() };
            let frame = render_as(&mut headless, &hard, PICTURE);
            assert_eq!(
                passes(&frame).contains(&"see, sum and shade tiles"),
                rasterizer == Rasterizer::Compute
            );
            let of_red = frame.linear.iter().map(|color| color[0]).filter(|red| *red > 0.01);
            let red: Vec<f32> = of_red.collect();
            let blue = frame.linear.iter().filter(|color| color[2] > 0.88).count();
            let most = if edges == Edges::Hard { 0 } else { 2 };
            assert!(
                red.len() <= most && blue > 2000,
                "{rasterizer:?} {edges:?}: red pixels {red:?}, {blue} blue"
            );
            assert!(red.iter().sum::<f32>() < 0.15, "{rasterizer:?} {edges:?}: {red:?}");
        }
    }
}

/// Far more of them in one tile than one dispatch has iterations for, of which llvmpipe ends the rest without a word.
#[test]
fn of_very_many_clipped_splats_in_one_tile_none_is_left_out() {
    const ALONG: u32 = 200;
    let mut splats = Builder::default();
    let radius = 1.0 / f64::from(ALONG);
    for i in 0..ALONG * ALONG {
        let [x, y] = [i % ALONG, i / ALONG].map(|at| (f64::from(at) + 0.5) * radius - 0.5);
        splats.ellipse(DVec3::new(x, y, 0.0), DVec3::X * radius, DVec3::Y * radius, [1.0; 4]);
    }
    let mut scene = splats.scene(false);
    let line =
        |start_rad: f32| ClipCurve { start_rad, end_rad: start_rad + 3.0, middle: Vec2::ZERO, weight: 0.0 };
    let clip = Clip::Either(line(0.3), line(0.5));
    scene.objects[0].splats.clips = Clips::of(vec![clip; (ALONG * ALONG) as usize]);
    let mut headless = shared();
    for invocations in [TileInvocations::Column, TileInvocations::Pixel] {
        for edges in [Edges::Hard, Edges::Coverage] {
            let mut hard = with(&scenes::clipped(), |settings| {
                settings.rasterizer = Rasterizer::Compute;
                settings.tile_invocations = invocations;
                settings.edges = edges;
                settings.size_px = [8, 8];
                settings.background = None;
            });
            hard.scene = scene.clone();
            hard.camera = builder::camera([0.0, 0.0, 2.0], [0.0; 3]);
            let frame = render_as(&mut headless, &hard, PICTURE);
            let whole = frame.linear.iter().filter(|color| color[3] == 1.0).count();
            assert!(whole >= 12, "{invocations:?} {edges:?}: {whole}");
        }
    }
}

/// A cylinder of clipped ellipses, which stick out of it by a third before curves end them, from sides from which some are seen edge-on: nothing is seen
/// outside of its triangles, and nothing behind them, but for two pixels along their outline. Ends are slivers that fan out from a corner.
#[test]
fn nothing_sticks_out_of_a_part_and_nothing_is_seen_through_it() {
    let mut headless = shared();
    let mesh = parts::cylinder(64, 1, 2.0);
    let (splats, report) = sharp_splats(&mesh, &SharpOptions::default(), &()).unwrap();
    let object = Object { name: String::new(), splats, closed: report.closed };
    let splats = Scene { objects: vec![object], ..Scene::default() };
    let mesh = MeshObject { name: String::new(), mesh, closed: true };
    let triangles = Scene { meshes: vec![mesh], ..Scene::default() };
    for eye in [[2.5, 1.8, 4.3], [0.4, 3.9, 2.0], [-3.0, 0.1, 3.0], [0.0, 4.5, 0.3]] {
        let alpha = |headless: &mut Headless, scene: &Scene| {
            let mut hard = with(&scenes::clipped(), |settings| {
                settings.rasterizer = Rasterizer::Compute;
                settings.edges = Edges::Coverage;
                settings.background = None;
            });
            hard.camera = builder::camera(eye, [0.0; 3]);
            hard.scene = scene.clone();
            let frame = render_as(headless, &hard, PICTURE);
            (frame.linear.iter().map(|color| color[3]).collect::<Vec<f32>>(), hard.settings.size_px)
        };
        let (seen, [width, height]) = alpha(&mut headless, &splats);
        let (mask, _) = alpha(&mut headless, &triangles);
        let around = |x: i64, y: i64| {
            let near = (-2..=2).flat_map(move |dy| (-2..=2).map(move |dx| (x + dx, y + dy)));
            near.filter(|(x, y)| (0..i64::from(width)).contains(x) && (0..i64::from(height)).contains(y))
                .map(|(x, y)| mask[(y * i64::from(width) + x) as usize])
        };
        let [mut outside, mut holes, mut inside] = [0; 3];
        for (i, seen) in seen.iter().enumerate() {
            let (x, y) = (i as i64 % i64::from(width), i as i64 / i64::from(width));
            outside += usize::from(*seen > 0.02 && around(x, y).all(|mask| mask == 0.0));
            let is_inside = around(x, y).all(|mask| mask == 1.0);
            holes += usize::from(is_inside && *seen < 0.7);
            inside += usize::from(is_inside);
        }
        println!("{eye:?}: {outside} outside, {holes} of {inside} holes");
        assert!(outside == 0 && inside > 3000, "{eye:?}: {outside} outside of {inside}");
        assert!(holes <= inside / 400, "{eye:?}: {holes} of {inside}");
    }
}
