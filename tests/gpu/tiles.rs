//! Splats by tiles in compute against the graphics pipeline's path: the same pixels within rounding, whatever a tile holds.

use crate::common::{
    ALL, PICTURE, assert_same_bits, compare::F32, headless, passes, render, render_as, scenes, shared, with,
    with_limits,
};
use glam::DVec3;
use surfel::{
    hard_scenes::{Hard, sphere, transparent},
    passes::FramePlan,
    renderer::{Frame, Headless, Wanted},
    scene::{
        Accumulate, Camera, Colors, Cull, Epsilon, Filter, FilterWeight, LastLayer, Layers, Light, LightKind,
        Object, Order, Rasterizer, Scene, Settings, Shading, TileInvocations, TileMemory, Transition,
    },
    vk::Limits,
};

fn by_points(headless: &mut Headless, hard: &Hard, wanted: Wanted) -> Frame {
    render_as(headless, &with(hard, |s| s.rasterizer = Rasterizer::Perspective), wanted)
}

fn by_tiles(headless: &mut Headless, hard: &Hard, wanted: Wanted) -> Frame {
    render_as(headless, &with(hard, |s| s.rasterizer = Rasterizer::Compute), wanted)
}

/// The same by tiles, drawn so.
fn by(hard: &Hard, invocations: TileInvocations) -> Hard {
    with(hard, |s| s.tile_invocations = invocations)
}

/// Of all colors, how many differ by more than 1e-3: rounding may turn the coverage of a pixel at a rim, or which of two
/// surfaces is seen.
fn different(a: &Frame, b: &Frame) -> usize {
    let far = |(a, b): (&[f32; 4], &[f32; 4])| {
        a.iter().zip(b).any(|(a, b)| (a - b).abs() > F32.color as f32 || b.is_nan())
    };
    assert_eq!(a.linear.len(), b.linear.len());
    a.linear.iter().zip(&b.linear).filter(|pair| far(*pair)).count()
}

fn hard(objects: Vec<Object>, camera: Camera, size_px: [u32; 2]) -> Hard {
    let settings = Settings { size_px, accumulate: Accumulate::F32, ..Settings::default() };
    Hard { name: "tiles", scene: Scene { objects, ..Scene::default() }, camera, settings }
}

/// A frame of opaque splats alone reads nothing but the tiles that have some, so that its images are never cleared.
#[test]
fn images_of_odd_sizes_and_many_chunks_are_the_same_as_by_points() {
    let mut headless = shared();
    let objects =
        || (0..11).map(|i| sphere(700, DVec3::new(f64::from(i) - 5.0, 0.3 * f64::from(i % 3), 0.0)));
    let camera = scenes::builder::camera([0.0, 0.0, 9.0], [0.0; 3]);
    for size_px in [[1, 1], [7, 9], [131, 67], [64, 257]] {
        let hard = hard(objects().collect(), camera, size_px);
        let tiles = by_tiles(&mut headless, &hard, PICTURE);
        let points = by_points(&mut headless, &hard, PICTURE);
        let pixels = tiles.linear.len();
        assert!(different(&tiles, &points) <= pixels / 1000, "{size_px:?}: {}", different(&tiles, &points));
        let names = passes(&tiles);
        assert!(names.contains(&"see, sum and shade tiles") && !names.contains(&"clear sums"), "{names:?}");
        assert!(!names.contains(&"visibility"), "{names:?}");
    }
}

/// llvmpipe ends a shader's loops after 65 535 iterations of eight splats without a word: here a tile has more.
#[test]
fn a_tile_with_more_splats_than_a_shader_has_iterations_loses_none() {
    let mut headless = shared();
    let camera = scenes::builder::camera([0.0, 0.0, 900.0], [0.0; 3]);
    let hard = hard(vec![sphere(560_000, DVec3::ZERO)], camera, [16, 16]);
    let points = by_points(&mut headless, &hard, ALL);
    let seen = points.weight.iter().filter(|weight| **weight > 0.0).count();
    assert!((4..=64).contains(&seen), "{seen}");
    let tiles = by_tiles(&mut headless, &hard, ALL);
    assert!(passes(&tiles).contains(&"sum overflow tiles"));
    let short = by_tiles(&mut headless, &by(&hard, TileInvocations::ShortColumn), ALL);
    assert_same_bits(&tiles, &short, "tiles half as high");
    // Half a million weights are added in another order: 2^-24 of the sum each, at random.
    for (a, b) in tiles.weight.iter().zip(&points.weight) {
        assert!((a - b).abs() <= 1e-3 * b, "{a} {b}");
    }
    assert_eq!(different(&tiles, &points), 0);
}

/// Images of odd sizes, sums of 16 bits, data; splats that the graphics pipeline draws before, polygons beside, layers. An
/// invocation a pixel, which takes twenty times as long on a CPU, draws two of them.
#[test]
fn an_invocation_a_pixel_or_a_short_column_draws_the_same_bits_as_one_a_column() {
    let mut headless = shared();
    let near = || sphere(4000, DVec3::ZERO);
    let cloud = scenes::builder::camera([0.0, 0.0, 0.98], [0.3, 0.1, -1.0]);
    let cloud = Hard { name: "large splats", ..hard(vec![near()], cloud, [67, 35]) };
    let stacked = scenes::builder::camera([0.0, 0.0, 3.2], [0.0; 3]);
    let stacked = with(&hard(vec![near(), near()], stacked, [35, 67]), |s| s.accumulate = Accumulate::F16);
    let (own, short, pixel) = (TileInvocations::Column, TileInvocations::ShortColumn, TileInvocations::Pixel);
    let small = |hard: Hard| (with(&hard, |s| s.size_px = [64, 48]), vec![short]);
    // Every other scene is the self-test's.
    let hybrid = transparent::hybrid(Transition::Color);
    let scenes =
        [scenes::random_ellipses(Filter::Adjust), transparent::interpenetrating(), hybrid].map(small);
    for (hard, others) in
        scenes.into_iter().chain([(cloud, vec![short, pixel]), (stacked, vec![short, pixel])])
    {
        let columns = by_tiles(&mut headless, &by(&hard, own), ALL);
        for other in others {
            let drawn = by_tiles(&mut headless, &by(&hard, other), ALL);
            assert_same_bits(&columns, &drawn, &format!("{} {other:?}", hard.name));
        }
    }
}

#[test]
#[ignore = "an invocation a pixel in every pass that has two forms: minutes on a CPU"]
fn an_invocation_a_pixel_draws_the_same_bits_in_every_pass() {
    let mut headless = shared();
    let eye = |x, z| scenes::builder::camera([x, 0.0, z], [0.0; 3]);
    let balls = |x| vec![sphere(8000, DVec3::ZERO), sphere(8000, DVec3::new(x, 0.0, 0.0))];
    let overflow = hard(vec![sphere(560_000, DVec3::ZERO)], eye(0.0, 900.0), [16, 16]);
    let hidden = with(&hard(balls(-2.5), eye(6.0, 0.0), [64, 48]), |s| s.cull = Cull::Hidden);
    let bands = |s: &mut Settings| s.tile_memory = TileMemory::Most(0);
    let bands = with(&hard(vec![sphere(24_000, DVec3::ZERO)], eye(0.0, 3.2), [64, 96]), bands);
    let mut lit = hidden.clone();
    (lit.scene.meshes, lit.scene.lights) = {
        let Scene { meshes, lights, .. } = transparent::meshes_only().scene;
        (meshes, lights)
    };
    let mut layers = hidden.clone();
    layers.settings.layers = Layers::Fixed(5);
    for ball in &mut layers.scene.objects {
        ball.splats.colors = Colors::Uniform([0.9, 0.1, 0.1, 0.4]);
    }
    let all =
        [("overflow", overflow), ("hidden", hidden), ("bands", bands), ("lit", lit), ("layers", layers)];
    for (name, hard) in all {
        for wanted in [ALL, PICTURE] {
            let [columns, pixels] = [TileInvocations::Column, TileInvocations::Pixel]
                .map(|own| by_tiles(&mut headless, &by(&hard, own), wanted));
            assert_same_bits(&columns, &pixels, name);
        }
    }
    let pipelines = headless.renderer.shaders.pipeline_names();
    assert!(pipelines.iter().any(|name| name.ends_with("pixel_hidden.comp")), "{pipelines:?}");
}

/// Whether tiles are shaded at once; then they are as they are by their sums.
fn is_shaded_as_by_sums(headless: &mut Headless, hard: &Hard) -> bool {
    let at_once = by_tiles(headless, hard, PICTURE);
    if !passes(&at_once).contains(&"see, sum and shade tiles") {
        return false;
    }
    assert!(hard.scene.meshes.is_empty() || hard.settings.transition != Transition::Attributes);
    let by_sums = by_tiles(headless, hard, ALL);
    assert!(!passes(&by_sums).contains(&"see, sum and shade tiles"));
    // Some ten operations, whose order each stage's compiler decides. By their sums, normals of polygons are normalized twice: of what
    // that rounds a highlight, the 32nd power of a cosine of twice the angle, makes 64 times as much, of which 0.2 is seen.
    let roundings = if hard.scene.meshes.is_empty() { 16.0 } else { 16.0 + 2.0 * 0.2 * 64.0 };
    for (pixel, (a, b)) in at_once.linear.iter().zip(&by_sums.linear).enumerate() {
        let far = a.iter().zip(b).any(|(a, b)| (a - b).abs() > roundings * f32::EPSILON * b.abs().max(1.0));
        assert!(!far, "{}, pixel {pixel}: {a:?}, by sums {b:?}", hard.name);
    }
    true
}

/// Opaque splats, alone or beside polygons, are shaded in the dispatch that sums them, unless someone else reads the sums, as what
/// exports the surface does: the same formulas of the same sums, in two stages of the device. Each shading, under the scene's own
/// lights and without.
#[test]
fn tiles_that_are_shaded_at_once_are_the_same_picture_as_by_their_sums() {
    let mut headless = shared();
    let directional = |direction, color| Light { kind: LightKind::Directional(direction), color };
    let lights = vec![
        directional(DVec3::new(-0.4, -1.0, -0.7), [0.9, 0.5, 0.2]),
        Light { kind: LightKind::Eye, color: [0.1, 0.3, 0.4] },
    ];
    let shadings = [Shading::Phong, Shading::Lambert, Shading::Normals, Shading::Albedo];
    let polygons = transparent::meshes_only().scene.meshes.swap_remove(0);
    let halves = [Transition::Color, Transition::Attributes, Transition::None, Transition::Paper]
        .map(transparent::hybrid);
    let (mut shaded, mut shaded_beside) = (0, 0);
    for (i, mut hard) in scenes::all().into_iter().chain(halves).enumerate() {
        hard.settings.size_px = [96, 64];
        hard.settings.shading = shadings[i % 4];
        hard.settings.accumulate = Accumulate::F32;
        hard.settings.cull = if i % 3 == 2 { Cull::Hidden } else { Cull::Auto };
        hard.settings.background = (i % 2 == 0).then_some([0.2, 0.4, 0.7]);
        let mut cut = hard.clone();
        cut.scene.meshes.push(polygons.clone());
        let lit = |hard: &Hard| {
            let scene = Scene { lights: lights.clone(), ..hard.scene.clone() };
            Hard { scene, ..hard.clone() }
        };
        for hard in [lit(&hard), lit(&cut), hard, cut] {
            let is_shaded = is_shaded_as_by_sums(&mut headless, &hard);
            shaded += usize::from(is_shaded);
            shaded_beside += usize::from(is_shaded && !hard.scene.meshes.is_empty());
        }
    }
    assert!(
        shaded >= 34 && shaded_beside >= 18,
        "{shaded} pictures, {shaded_beside} of them beside polygons"
    );
}

/// Tiles in the corners of a splat's box are left out where it covers nothing there, but nowhere else: ellipses up to 40 times as long
/// as wide, turned every way and tilted, from a pixel to sixty long, on tiles of both heights, exact and with affine maps.
#[test]
fn splats_lose_no_pixel_in_the_corners_of_their_boxes() {
    let mut headless = shared();
    let mut random = scenes::builder::Random(7);
    let mut builder = scenes::builder::Builder::default();
    for _ in 0..900 {
        let axis = random.direction();
        let s = axis * random.between(0.1, 1.0).powi(2) * 0.3;
        let t = axis.cross(random.direction()).normalize() * s.length() / random.between(1.0, 40.0);
        let at = DVec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-0.2, 0.2));
        builder.ellipse(at, s, t, random.color());
    }
    let mut hard =
        hard(vec![builder.object(false)], scenes::builder::camera([0.0, 0.0, 2.6], [0.0; 3]), [203, 157]);
    for filter in [Filter::None, Filter::Adjust, Filter::Ewa] {
        hard.settings.filter = filter;
        let points = by_points(&mut headless, &hard, ALL);
        for tile_invocations in [TileInvocations::Column, TileInvocations::ShortColumn] {
            let tiles = by_tiles(&mut headless, &by(&hard, tile_invocations), ALL);
            let lost =
                tiles.weight.iter().zip(&points.weight).filter(|(a, b)| (**a > 0.0) != (**b > 0.0)).count();
            let covered = points.weight.iter().filter(|weight| **weight > 0.0).count();
            println!(
                "{filter:?}, {tile_invocations:?}: {lost} of {covered}, {} colors",
                different(&tiles, &points)
            );
            // Rounding turns the coverage of a pixel at a rim: of some 20 000 such pixels 2^-22 of their size each.
            assert!(
                covered > 10_000 && lost <= 1 && different(&tiles, &points) <= 2,
                "{filter:?}, {tile_invocations:?}"
            );
        }
    }
}

/// Tiles with more splats than one dispatch takes are shaded after the others: here a ball in the middle of one, beside a tile
/// with few, and another ball where four tiles meet.
#[test]
fn overfull_tiles_are_shaded_as_by_their_sums() {
    let mut headless = shared();
    let camera = scenes::builder::camera([0.0, 0.0, 900.0], [0.0; 3]);
    // A pixel of 24 along a side is 31 units wide there.
    let colored = |count, x, y, color| {
        let mut ball = sphere(count, DVec3::new(31.0 * x, 31.0 * y, 0.0));
        ball.splats.colors = Colors::Uniform(color);
        ball
    };
    for (invocations, color) in
        [(TileInvocations::Column, None), (TileInvocations::ShortColumn, Some([0.5, 0.3, 0.4]))]
    {
        let balls = vec![
            colored(260_000, -8.0, 8.0, [0.8, 0.1, 0.1, 1.0]),
            colored(1000, 8.0, -8.0, [0.1, 0.8, 0.1, 1.0]),
            colored(260_000, 4.0, 4.0, [0.1, 0.1, 0.8, 1.0]),
        ];
        let mut hard = by(&hard(balls, camera, [24, 24]), invocations);
        hard.scene.lights = color.map(|color| Light { kind: LightKind::Eye, color }).into_iter().collect();
        assert!(is_shaded_as_by_sums(&mut headless, &hard), "{invocations:?}");
        let frame = by_tiles(&mut headless, &hard, PICTURE);
        assert!(passes(&frame).contains(&"shade overflow tiles"), "{invocations:?}");
        assert_eq!(different(&frame, &by_points(&mut headless, &hard, PICTURE)), 0, "{invocations:?}");
        assert!(frame.linear.iter().filter(|color| **color != frame.linear[0]).count() >= 3);
    }
}

/// What tiles show is rounded to 16 bits where the target has fewer, and light ends with half floats: neither is seen there. A target
/// of 32 bits loses nothing.
#[test]
fn tiles_show_as_many_bits_as_the_target_has() {
    let mut headless = shared();
    let mut hard =
        hard(vec![sphere(4000, DVec3::ZERO)], scenes::builder::camera([0.0, 0.0, 3.2], [0.0; 3]), [97, 83]);
    let srgb = Wanted { linear: false, ..PICTURE };
    for intensity in [1.0, 1e6] {
        hard.scene.lights = vec![Light { kind: LightKind::Eye, color: [intensity, 0.5, 0.25] }];
        let [half, single] = [Accumulate::F16, Accumulate::F32].map(|accumulate| {
            hard.settings.accumulate = accumulate;
            [srgb, PICTURE].map(|wanted| {
                let frame = by_tiles(&mut headless, &hard, wanted);
                assert!(passes(&frame).contains(&"see, sum and shade tiles"));
                frame
            })
        });
        assert_eq!(half[1].linear, single[1].linear);
        let brightest = half[1].linear.iter().map(|color| color[0]).fold(0.0, f32::max);
        assert!(if intensity > 1.0 { brightest > 65_504.0 } else { brightest < 2.0 }, "{brightest}");
        // Half floats round by 2^-12 of a color: a 36th of an 8-bit step at most, at white, so that few turn over.
        let farthest = |(a, b): (&[u8; 4], &[u8; 4])| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max();
        let steps: Vec<_> = half[0].srgb.iter().zip(&single[0].srgb).filter_map(farthest).collect();
        assert!(steps.iter().all(|step| *step <= 1));
        assert!(steps.iter().filter(|step| **step > 0).count() * 10 < steps.len());
        assert!(half[0].srgb.iter().any(|color| color[0] > 200 && color[3] == 255));
    }
}

/// A frame has the pipelines of one way.
#[test]
fn what_draws_columns_has_no_pipeline_of_pixels() {
    let mut headless = headless();
    let camera = scenes::builder::camera([0.0, 0.0, 3.2], [0.0; 3]);
    let hard = hard(vec![sphere(500, DVec3::ZERO)], camera, [64, 64]);
    for (invocations, has_pixels) in [(TileInvocations::Column, false), (TileInvocations::Pixel, true)] {
        by_tiles(&mut headless, &by(&hard, invocations), PICTURE);
        let names = headless.renderer.shaders.pipeline_names();
        assert_eq!(names.iter().any(|name| name.contains("_pixel")), has_pixels, "{names:?}");
    }
}

/// Counts of twice as many tiles take twice the room.
#[test]
fn images_without_room_for_tiles_half_as_high_have_full_ones() {
    let mut headless = shared();
    let camera = scenes::builder::camera([0.0, 0.0, 3.2], [0.0; 3]);
    let hard = by(&hard(vec![sphere(1000, DVec3::ZERO)], camera, [512, 512]), TileInvocations::ShortColumn);
    let hard = with(&hard, |s| s.rasterizer = Rasterizer::Compute);
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let own = headless.device().facts().limits;
    let little = Limits { max_storage_buffer_range: 200_000, ..own };
    let tile_heights = [little, own].map(|limits| {
        let plan = FramePlan::new(&prepared, &hard.camera, &hard.settings, &limits);
        plan.opaque.bands()[0].plan.invocations.tile_height()
    });
    assert_eq!(tile_heights, [8, 4]);
    let full = with_limits(&mut headless, |limits| *limits = little, |headless| render(headless, &hard));
    assert!(passes(&full).contains(&"see and sum tiles"), "{:?}", passes(&full));
    // There is room for fewer segments then, so that lists have another order.
    assert_eq!(different(&full, &render(&mut headless, &hard)), 0);
}

/// Lists are in input order, whichever core walks over a segment first.
#[test]
fn ten_frames_are_the_same_bits() {
    let mut headless = shared();
    let objects = vec![sphere(30_000, DVec3::ZERO), sphere(10_000, DVec3::new(0.5, 0.0, 0.4))];
    let hard = hard(objects, scenes::builder::camera([0.0, 0.0, 3.2], [0.0; 3]), [200, 200]);
    let first = by_tiles(&mut headless, &hard, ALL);
    for run in 1..10 {
        assert_same_bits(&first, &by_tiles(&mut headless, &hard, ALL), &format!("run {run}"));
    }
}

/// From within a cloud, some splats fill the image, some are cut by the near plane and most are small.
#[test]
fn large_splats_and_small_ones_are_one_picture() {
    let mut headless = shared();
    let mut near = sphere(4000, DVec3::ZERO);
    near.closed = false;
    let camera = scenes::builder::camera([0.0, 0.0, 0.98], [0.3, 0.1, -1.0]);
    let hard = hard(vec![near, sphere(3000, DVec3::new(0.0, 0.0, -3.0))], camera, [256, 256]);
    let tiles = by_tiles(&mut headless, &hard, PICTURE);
    let points = by_points(&mut headless, &hard, PICTURE);
    assert!(passes(&tiles).contains(&"sum large splats"), "{:?}", passes(&tiles));
    assert!(different(&tiles, &points) <= 10, "{}", different(&tiles, &points));
}

#[test]
fn what_else_a_scene_has_is_drawn_around_it() {
    let mut headless = shared();
    for hard in transparent::all() {
        let hard = with(&hard, |s| s.size_px = [128, 96]);
        let [tiles, points] = [by_tiles, by_points].map(|draw| draw(&mut headless, &hard, PICTURE));
        // Where surfaces are peeled off each other, rounding may turn which of them a pixel's last layer has.
        let off = different(&tiles, &points);
        assert!(off <= tiles.linear.len() / 200, "{}: {off}", hard.name);
    }
}

/// In layers the first tiles do all of them at once, others go on from dispatch to dispatch, and what has too many splats for that
/// goes step by step and part by part. Lights are a loop within a loop.
#[test]
fn layers_of_overfull_tiles_lose_none() {
    let mut headless = shared();
    // Means don't tell how many splats there are: those at the end of a tile's list have another color.
    let clear = |count| {
        let mut object = sphere(count, DVec3::ZERO);
        let color = |i: usize| if i / 32 % 32 < 20 { [0.9, 0.1, 0.1, 0.4] } else { [0.1, 0.9, 0.2, 0.4] };
        object.splats.colors = Colors::Each((0..count).map(color).collect());
        object
    };
    let near = scenes::builder::camera([0.0, 0.0, 4.0], [0.0; 3]);
    let far = scenes::builder::camera([0.0, 0.0, 600.0], [0.0; 3]);
    for (name, count, camera, size_px, layers, lights, last_layer) in [
        ("one dispatch", 3000, near, [96, 96], 5, 0, LastLayer::Stack),
        ("several dispatches", 3000, near, [64, 64], 40, 2, LastLayer::Drop),
        ("parts", 560_000, far, [16, 16], 3, 0, LastLayer::Drop),
        ("parts under lights", 100_000, far, [16, 16], 2, 16, LastLayer::Stack),
    ] {
        let mut hard = hard(vec![clear(count)], camera, size_px);
        hard.scene.storage.order = Order::Input;
        let direction = |i| LightKind::Directional(DVec3::new(f64::from(i), 1.0, -2.0));
        let light = |i| Light { kind: direction(i), color: [0.1, 0.1, 0.1] };
        hard.scene.lights = (0..lights).map(light).collect();
        (hard.settings.layers, hard.settings.last_layer) = (Layers::Fixed(layers), last_layer);
        let [tiles, points] = [by_tiles, by_points].map(|draw| draw(&mut headless, &hard, PICTURE));
        assert!(passes(&tiles).contains(&"layers of tiles"), "{:?}", passes(&tiles));
        let may_be_off = if count == 3000 { tiles.linear.len() / 200 } else { 0 };
        assert!(different(&tiles, &points) <= may_be_off, "{name}: {}", different(&tiles, &points));
    }
}

/// Half floats end at 65504: more than that many splats of weight 1 in a pixel, in one dispatch, in parts, and beside large splats.
#[test]
fn sums_beyond_half_floats_keep_their_ratios() {
    let mut headless = shared();
    for (count, large) in [(560_000, false), (150_000, false), (150_000, true)] {
        let mut objects = vec![sphere(count, DVec3::ZERO)];
        if large {
            // Cut by the near plane, far beside what is seen.
            objects.push(sphere(500, DVec3::new(0.0, 0.0, 900.0)));
        }
        let mut hard = hard(objects, scenes::builder::camera([0.0, 0.0, 900.0], [0.0; 3]), [16, 16]);
        (hard.settings.filter_weight, hard.settings.epsilon) = (FilterWeight::Unit, Epsilon::Radii(1e6));
        let [exact, half] = [Accumulate::F32, Accumulate::F16]
            .map(|sums| by_tiles(&mut headless, &with(&hard, |s| s.accumulate = sums), PICTURE));
        for (a, b) in exact.linear.iter().flatten().zip(half.linear.iter().flatten()) {
            assert!(b.is_finite() && (a - b).abs() <= 0.01, "{count}, {large}: {a} {b}");
        }
    }
}

/// A device need not take more than 65535 workgroups in a row.
#[test]
fn an_image_of_more_tiles_than_a_row_of_workgroups_is_valid() {
    let mut headless = shared();
    let camera = scenes::builder::camera([0.0, 0.0, 3.2], [0.0; 3]);
    let hard = hard(vec![sphere(2000, DVec3::ZERO)], camera, [2060, 2060]);
    let [tiles, points] = [by_tiles, by_points].map(|draw| draw(&mut headless, &hard, PICTURE));
    assert!(different(&tiles, &points) <= 50, "{}", different(&tiles, &points));
}

/// Spans of images above 16128 pixels have more bits for places, and fewer for how many tiles a splat touches.
#[test]
fn images_too_wide_for_the_spans_of_others_are_the_same_as_by_points() {
    let mut headless = shared();
    let wide = [16_200, 24];
    let mut splats = scenes::builder::Builder::default();
    let mut random = scenes::builder::Random(77);
    for i in 0..2000 {
        let x = -1.0 + f64::from(i) / 1000.0;
        let radius = random.between(0.0003, 0.009); // up to 72 pixels: 10 tiles
        splats.disk(DVec3::new(x, random.between(-0.001, 0.001), 0.0), DVec3::Z, radius, random.color());
    }
    let mut camera = scenes::builder::camera([0.0, 0.0, 1.0], [0.0; 3]);
    camera.fov_y_rad = 2.0 * (12.0 / 8000.0_f64).atan();
    let hard = hard(splats.scene(false).objects, camera, wide);
    let points = by_points(&mut headless, &hard, PICTURE);
    let tiles = by_tiles(&mut headless, &hard, PICTURE);
    assert!(passes(&tiles).contains(&"fill tiles"), "{:?}", passes(&tiles));
    let covered = points.linear.iter().filter(|color| color[..3] != [1.0; 3]).count();
    assert!(covered > 200_000, "{covered}");
    assert!(different(&points, &tiles) <= 20, "{} of {covered}", different(&points, &tiles));
}

/// The few opaque splats that keep their passes are tiles' where they are beside polygons, or in layers.
#[test]
fn auto_keeps_few_splats_to_points_only_where_they_are_opaque_and_alone() {
    let mut headless = shared();
    let ball = || sphere(300, DVec3::ZERO);
    let camera = scenes::builder::camera([0.0, 0.0, 4.0], [0.0; 3]);
    let alone = hard(vec![ball()], camera, [640, 640]);
    let mut beside = alone.clone();
    beside.scene.meshes = transparent::all()
        .into_iter()
        .find_map(|hard| hard.scene.meshes.into_iter().next())
        .into_iter()
        .collect();
    let mut layered = alone.clone();
    layered.scene.objects[0].splats.colors = Colors::Uniform([0.5, 0.5, 0.5, 0.5]);
    for (hard, by_tiles) in [(alone, false), (beside, true), (layered, true)] {
        let frame = render_as(&mut headless, &with(&hard, |s| s.rasterizer = Rasterizer::Auto), PICTURE);
        let fills = passes(&frame).iter().any(|pass| pass.starts_with("fill"));
        assert_eq!(fills, by_tiles, "{:?}", passes(&frame));
    }
}
