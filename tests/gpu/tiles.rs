//! Splats by tiles in compute against the graphics pipeline's path: the same pixels within rounding, whatever a tile holds.

mod invocations;
mod overflow;
mod shaded;

use crate::common::{
    ALL, PICTURE, assert_same_bits, compare::F32, passes, render, render_as, scenes, shared, with,
    with_limits,
};
use glam::{DVec3, Vec3};
use surfel::{
    hard_scenes::{Hard, sphere, transparent},
    passes::FramePlan,
    renderer::{Frame, Headless, Wanted},
    scene::{
        Accumulate, Camera, Clips, Colors, Edges, Filter, Object, Rasterizer, Scene, Settings, Shapes,
        Splats, TileInvocations, Window,
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

/// How many colors differ by more than 1e-3: rounding may turn the coverage of a pixel at a rim, or which of two surfaces is seen.
fn different(a: &Frame, b: &Frame) -> usize {
    let far = |(a, b): (&[f32; 4], &[f32; 4])| {
        a.iter().zip(b).any(|(a, b)| (a - b).abs() > F32.color as f32 || b.is_nan())
    };
    assert_eq!(a.linear.len(), b.linear.len());
    a.linear.iter().zip(&b.linear).filter(|pair| far(*pair)).count()
}

fn hard(objects: Vec<Object>, camera: Camera, size_px: [u32; 2]) -> Hard {
    // What nothing but tiles draws has tests of its own (`edges`).
    let edges = Edges::Hard;
    let settings = Settings { size_px, edges, accumulate: Accumulate::F32, ..Settings::default() };
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
        let arena = surfel::arena::Arena::new();
        let plan = FramePlan::new(
            &arena,
            &[surfel::prepare::Placed::at_home(&prepared)],
            &hard.camera,
            &hard.settings,
            &limits,
        );
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

/// A disk whose box has 32 by 32 tiles at the end of an image of 256 by 256, none of which it touches in the corners: the rect that means something else if
/// all of them are left out.
#[test]
fn the_last_of_small_rects_is_a_rect() {
    let mut headless = shared();
    let mut disk = sphere(1, DVec3::ZERO);
    disk.closed = false;
    disk.splats = Splats {
        positions: vec![DVec3::ZERO],
        shapes: Shapes::Disks { normals: vec![Vec3::Z], radii: vec![127.0] },
        colors: Colors::Uniform([1.0; 4]),
        clips: Clips::default(),
    };
    let camera = Camera {
        orthographic_height: Some(2048.0),
        window: Window { whole_px: None, corner_px: [-896.0; 2] },
        ..scenes::builder::camera([0.0, 0.0, 500.0], [0.0; 3])
    };
    let hard = with(&hard(vec![disk], camera, [2048, 2048]), |s| {
        s.filter = Filter::None;
        s.background = None;
    });
    let frame = by_tiles(&mut headless, &hard, PICTURE);
    let seen: Vec<usize> = (0..2048 * 2048).filter(|i| frame.linear[*i][3] > 0.5).collect();
    let rows = [seen.first(), seen.last()].map(|i| i.map(|i| i / 2048));
    assert_eq!(rows, [Some(1793), Some(2046)], "of {}", seen.len());
    let area = std::f64::consts::PI * 127.0 * 127.0;
    assert!((seen.len() as f64 / area - 1.0).abs() < 0.01, "{} of {area}", seen.len());
}

/// Most splats of these are large, so that their list has several of those that a workgroup looks at together.
#[test]
fn large_splats_that_workgroups_list_are_whole_and_in_order() {
    let mut headless = shared();
    let camera = scenes::builder::camera([0.0, 0.0, 1.7], [0.0; 3]);
    // Wider than 2048 pixels, rects of tiles have room for no more than 96 along a side.
    let hard = hard(vec![sphere(60, DVec3::ZERO)], camera, [2560, 700]);
    let [columns, pixels] = [TileInvocations::Column, TileInvocations::Pixel]
        .map(|own| by_tiles(&mut headless, &by(&hard, own), PICTURE));
    assert!(passes(&pixels).contains(&"sum large splats"), "{:?}", passes(&pixels));
    assert_same_bits(&columns, &pixels, "large splats");
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

/// The few opaque splats that keep their passes on a CPU are tiles' where they are beside polygons, or in layers; on a GPU all are.
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
    let is_cpu = headless.device().facts().limits.is_cpu;
    for (hard, by_tiles) in [(alone, !is_cpu), (beside, true), (layered, true)] {
        let frame = render_as(&mut headless, &with(&hard, |s| s.rasterizer = Rasterizer::Auto), PICTURE);
        let fills = passes(&frame).iter().any(|pass| pass.starts_with("fill"));
        assert_eq!(fills, by_tiles, "{:?}", passes(&frame));
    }
}
