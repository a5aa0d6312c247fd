//! Pictures in bands of the image against the same all at once: the same splats in every pixel, in sums of another order.

use crate::common::{
    ALL, PICTURE, assert_same_bits, compare::F32, oracle_of, passes, render_as, scenes, shared, with_limits,
};
use glam::DVec3;
use surfel::{
    hard_scenes::{Hard, sphere, transparent},
    passes::FramePlan,
    prepare::PreparedScene,
    renderer::{Frame, Headless, Wanted},
    scene::{
        Accumulate, Backfaces, Camera, Cull, Edges, Filter, Object, Order, Rasterizer, Scene, Settings,
        Shapes, SplatFormat, Storage, TileInvocations, TileMemory,
    },
    selftest::{light::compare_light, tolerance::LIGHT},
};

/// A scene by tiles, all at once or in as many bands as there can be, the surface as data or the picture alone.
fn draw(headless: &mut Headless, hard: &Hard, most: u64, wanted: Wanted) -> Frame {
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    draw_prepared(headless, &prepared, hard, most, wanted)
}

fn draw_prepared(
    headless: &mut Headless,
    prepared: &PreparedScene,
    hard: &Hard,
    most: u64,
    wanted: Wanted,
) -> Frame {
    headless.render(prepared, &hard.camera, &by_tiles(hard, most), wanted).unwrap()
}

fn by_tiles(hard: &Hard, most: u64) -> Settings {
    let (rasterizer, tile_memory) = (Rasterizer::Compute, TileMemory::Most(most));
    Settings { rasterizer, tile_memory, ..hard.settings.clone() }
}

/// How many bands a frame has: 0 where all of it is drawn at once.
fn bands(frame: &Frame) -> usize {
    passes(frame).iter().filter(|name| name.starts_with("count ") && name.contains("band-")).count()
}

fn hard(name: &'static str, objects: Vec<Object>, eye: [f64; 3]) -> Hard {
    let settings = Settings { size_px: [131, 203], accumulate: Accumulate::F32, ..Settings::default() };
    let scene = Scene { objects, ..Scene::default() };
    Hard { name, scene, camera: scenes::builder::camera(eye, [0.0; 3]), settings }
}

/// A ball of ellipses twice as long as wide.
fn ellipses(mut object: Object) -> Object {
    let Shapes::Disks { normals, radii } = &object.splats.shapes else { unreachable!() };
    let s: Vec<_> = normals.iter().zip(radii).map(|(n, r)| *r * n.any_orthonormal_vector()).collect();
    let t = normals.iter().zip(&s).map(|(n, s)| 0.5 * n.cross(*s)).collect();
    object.splats.shapes = Shapes::Ellipses { s, t };
    object
}

/// Scenes large enough for bands: each in its own way hard for what is known of a block without looking at its splats.
fn scenes_of_blocks() -> Vec<Hard> {
    let ball = || sphere(100_000, DVec3::ZERO);
    let three =
        || (0..3).map(|i| sphere(35_001 + 7 * i, DVec3::new(0.0, 1.5 * (i as f64 - 1.0), 0.0))).collect();
    let mut all = vec![
        hard("a ball", vec![ball()], [0.0, 0.0, 3.2]),
        hard("seen askew", vec![ball()], [1.9, 2.1, 1.7]),
        hard("cut by every side of the view", vec![ball()], [0.0, 0.0, 2.3]),
        hard("three, two of them cut", three(), [0.0, 0.0, 4.0]),
        hard("one behind the other", three(), [0.0, 6.0, 0.1]),
        hard("ellipses", vec![ellipses(ball())], [0.3, -0.2, 2.8]),
    ];
    let with = |name, change: &dyn Fn(&mut Hard)| {
        let mut hard = hard(name, three(), [0.4, 0.3, 4.5]);
        change(&mut hard);
        hard
    };
    all.extend([
        with("the inside, too", &|hard| hard.settings.backfaces = Backfaces::Flip),
        with("open, all in view", &|hard| {
            hard.scene.objects.iter_mut().for_each(|object| object.closed = false);
            hard.camera = scenes::builder::camera([0.4, 0.3, 8.0], [0.0; 3]);
        }),
        with("some of them large", &|hard| {
            let Shapes::Disks { radii, .. } = &mut hard.scene.objects[1].splats.shapes else {
                unreachable!()
            };
            radii.iter_mut().step_by(9000).for_each(|radius| *radius = 0.7);
            // What is too large for tiles of the whole image, which then has hard edges, may not be so for a band's.
            hard.settings.edges = Edges::Hard;
        }),
        with("unfiltered", &|hard| hard.settings.filter = Filter::None),
        with("ewa", &|hard| hard.settings.filter = Filter::Ewa),
        with("without what is hidden", &|hard| hard.settings.cull = Cull::Hidden),
        with("tiles half as high", &|hard| {
            hard.settings.tile_invocations = TileInvocations::ShortColumn;
        }),
        with("packed", &|hard| {
            hard.scene.storage = Storage { format: SplatFormat::Packed, ..Storage::default() };
        }),
        with("far from the origin", &|hard| {
            let far = DVec3::new(4e6, -7e6, 1e7);
            for object in &mut hard.scene.objects {
                object.splats.positions.iter_mut().for_each(|position| *position += far);
            }
            let eye = far + DVec3::new(0.4, 0.3, 4.5);
            hard.camera = scenes::builder::camera(eye.into(), far.into());
        }),
        with("transparent", &|hard| {
            let objects = hard.scene.objects.drain(..);
            hard.scene.objects =
                objects.map(|ball| transparent::tinted(ball, [0.8, 0.5, 0.3, 0.4])).collect();
        }),
        with("transparent and opaque", &|hard| {
            let last = hard.scene.objects.pop().unwrap();
            hard.scene.objects.push(transparent::tinted(last, [0.8, 0.5, 0.3, 0.4]));
        }),
    ]);
    all
}

/// Of each sum's f32 additions 2⁻²⁴ each, at random: of some tens of splats a pixel.
const WEIGHT_TOLERANCE: f32 = 1e-5;

fn assert_same_surface(bands: &Frame, whole: &Frame, name: &str) {
    assert_same_within(WEIGHT_TOLERANCE, bands, whole, name);
}

fn assert_same_within(weight_tolerance: f32, bands: &Frame, whole: &Frame, name: &str) {
    for (i, (a, b)) in bands.weight.iter().zip(&whole.weight).enumerate() {
        assert!((a - b).abs() <= weight_tolerance * b, "{name}, pixel {i}: {a}, all at once {b}");
    }
    for (i, (a, b)) in bands.linear.iter().zip(&whole.linear).enumerate() {
        let far = a.iter().zip(b).any(|(a, b)| (a - b).abs() > F32.color as f32 || a.is_nan() != b.is_nan());
        assert!(!far, "{name}, pixel {i}: {a:?}, all at once {b:?}");
    }
}

/// The surface as data, and the picture alone, which tiles of the opaque scenes shade themselves, each band its own into one
/// image.
#[test]
fn bands_draw_the_same_splats_in_every_pixel() {
    let mut headless = shared();
    let mut shaded = 0;
    for hard in scenes_of_blocks() {
        let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
        for wanted in [ALL, PICTURE] {
            let [whole, cut] =
                [u64::MAX, 0].map(|most| draw_prepared(&mut headless, &prepared, &hard, most, wanted));
            println!("{}: {} bands", hard.name, bands(&cut));
            assert_eq!(bands(&whole), 0, "{}", hard.name);
            assert!((2..=2 * 16).contains(&bands(&cut)), "{}", hard.name);
            assert_same_surface(&cut, &whole, hard.name);
            let is_shaded = |name: &&&str| name.starts_with("see, sum and shade band-");
            let count = passes(&cut).iter().filter(is_shaded).count();
            // Of what is opaque; beside it there may be bands of layers.
            let opaque = passes(&cut).iter().filter(|name| name.starts_with("count band-")).count();
            assert!([0, opaque].contains(&count), "{}: {count}", hard.name);
            shaded += usize::from(count > 0);
        }
    }
    assert!(shaded >= 10, "{shaded}");
}

/// Where a tile of one band may have more splats than a dispatch takes, sums of all bands have 32 bits, which lie in one image.
#[test]
fn bands_with_and_without_overflow_tiles_are_one_image() {
    let mut headless = shared();
    // Within one tile at the lower border, beside a ball in other bands.
    let mut speck = sphere(170_000, DVec3::ZERO);
    let Shapes::Disks { radii, .. } = &mut speck.splats.shapes else { unreachable!() };
    radii.iter_mut().for_each(|radius| *radius *= 0.02);
    let position = |p: &mut DVec3| *p = 0.02 * *p + DVec3::new(0.03, -1.2, 0.0);
    speck.splats.positions.iter_mut().for_each(position);
    let objects = [sphere(120_000, DVec3::ZERO), speck];
    let objects = objects.map(|object| Object { closed: false, ..object });
    let mut hard = hard("a ball and a speck", objects.into(), [0.0, 0.0, 3.6]);
    (hard.settings.accumulate, hard.settings.cull) = (Accumulate::F16, Cull::Hidden);
    for wanted in [ALL, PICTURE] {
        let [whole, cut] = [u64::MAX, 0].map(|most| draw(&mut headless, &hard, most, wanted));
        let overflow = passes(&cut).iter().filter(|name| name.contains("overflow")).count();
        println!("{} bands, {overflow} passes of overflow tiles", bands(&cut));
        assert!(bands(&cut) > 1 && overflow >= bands(&cut), "{:?}", passes(&cut));
        // A hundred thousand additions in another order.
        assert_same_within(1e-3, &cut, &whole, hard.name);
    }
}

/// Layers with large splats are the graphics pipeline's, in one piece: here the lists of all have room for large ones, but those of
/// bands, which know only of blocks that have one, do not.
#[test]
fn layers_with_large_splats_have_no_bands() {
    let mut headless = shared();
    let mut ball = transparent::tinted(sphere(100_000, DVec3::ZERO), [0.8, 0.5, 0.3, 0.4]);
    let Shapes::Disks { radii, .. } = &mut ball.splats.shapes else { unreachable!() };
    radii.iter_mut().step_by(1500).for_each(|radius| *radius = 0.12);
    let mut hard = hard("a ball", vec![ball], [0.0, 0.0, 3.2]);
    hard.settings.layers = surfel::scene::Layers::Fixed(2);
    let draw_both = |headless: &mut Headless| {
        let whole = draw(headless, &hard, u64::MAX, ALL);
        let cut = draw(headless, &hard, 0, ALL);
        assert!(passes(&whole).contains(&"layers of tiles"));
        assert_same_surface(&cut, &whole, hard.name);
        bands(&cut)
    };
    assert!(draw_both(&mut headless) > 1);
    let few_entries = |limits: &mut surfel::vk::Limits| limits.max_storage_buffer_range = 1_800_000;
    with_limits(&mut headless, few_entries, |headless| assert_eq!(draw_both(headless), 0));
}

/// Most of them are not cut: they have too few splats, large ones, or polygons. Their plans are the same.
#[test]
fn no_hard_scene_is_another_where_memory_is_short() {
    let mut headless = shared();
    let limits = headless.device().facts().limits;
    for mut hard in scenes::all().into_iter().chain(transparent::all()) {
        hard.settings.accumulate = Accumulate::F32;
        let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
        let [whole, cut] = [u64::MAX, 0].map(|most| {
            let arena = surfel::arena::Arena::new();
            let plan = FramePlan::new(
                &arena,
                &[surfel::prepare::Placed::at_home(&prepared)],
                &hard.camera,
                &by_tiles(&hard, most),
                &limits,
            );
            [plan.opaque, plan.transparent].map(|part| {
                let bands = part.bands().iter().map(|band| band.plan.clone());
                bands.collect::<Vec<_>>()
            })
        });
        if cut != whole {
            println!("{}: {} and {} bands", hard.name, cut[0].len(), cut[1].len());
            let [whole, cut] =
                [u64::MAX, 0].map(|most| draw_prepared(&mut headless, &prepared, &hard, most, ALL));
            assert_same_surface(&cut, &whole, hard.name);
        }
    }
}

/// What bands can't help is drawn all at once: no order in space, all of it in one row, or a filter without a bound.
#[test]
fn what_bands_do_not_help_has_none() {
    let mut headless = shared();
    let ball = || vec![sphere(20_000, DVec3::ZERO)];
    let mut shuffled = hard("in the order of input", ball(), [0.0, 0.0, 3.2]);
    shuffled.scene.storage = Storage { order: Order::Input, ..Storage::default() };
    // Neighbors of the spiral that the ball is made of are on one parallel, which is no order in space.
    let Shapes::Disks { normals, radii } = &mut shuffled.scene.objects[0].splats.shapes else {
        unreachable!()
    };
    let from: Vec<usize> = (0..20_000).map(|i| i * 7919 % 20_000).collect();
    *normals = from.iter().map(|&i| normals[i]).collect();
    *radii = from.iter().map(|&i| radii[i]).collect();
    let positions = &mut shuffled.scene.objects[0].splats.positions;
    *positions = from.iter().map(|&i| positions[i]).collect();
    let mut paper = hard("the paper's filter", ball(), [0.0, 0.0, 3.2]);
    paper.settings.filter = Filter::AdjustPaper;
    for hard in [shuffled, hard("far away", ball(), [0.0, 0.0, 900.0]), paper] {
        let whole = draw(&mut headless, &hard, u64::MAX, ALL);
        let cut = draw(&mut headless, &hard, 0, ALL);
        assert_eq!(bands(&cut), 0, "{}", hard.name);
        assert_same_bits(&cut, &whole, hard.name);
    }
}

/// Disks as large as the picture, of which lists of all of it have no room: bands have, so that all of them cover pixels in part.
#[test]
fn splats_too_large_for_lists_of_the_image_cover_pixels_in_part_in_bands() {
    let mut headless = shared();
    let mut hard = hard("from near", vec![sphere(1500, DVec3::ZERO)], [0.0, 0.0, 6.0]);
    hard.camera = Camera { target: DVec3::new(0.98, 0.0, 0.0), fov_y_rad: 0.02, ..hard.camera };
    hard.settings.background = None;
    hard.settings.rasterizer = Rasterizer::Compute;
    let of_hard = Hard { settings: Settings { edges: Edges::Hard, ..hard.settings.clone() }, ..hard.clone() };
    with_limits(
        &mut headless,
        |limits| limits.max_storage_buffer_range = 1 << 18,
        |headless| {
            let frame = render_as(headless, &hard, PICTURE);
            assert!(bands(&frame) > 1 && !passes(&frame).contains(&"accumulate"), "{:?}", passes(&frame));
            let errors = compare_light(&frame, &oracle_of(&hard));
            println!("{} in {} bands", errors.row(hard.name), bands(&frame));
            assert!(errors.worst <= LIGHT && errors.seen > 10_000 && errors.not_finite == 0, "{errors:?}");
            let in_part = frame.linear.iter().filter(|pixel| pixel[3] > 0.05 && pixel[3] < 0.95).count();
            assert!(in_part > 100, "{in_part}");
            assert_eq!(bands(&render_as(headless, &of_hard, PICTURE)), 0);
            // What reaches into several bands is counted once.
            let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
            let [listed, at_once] = [&hard, &of_hard]
                .map(|hard| headless.count_listed(&prepared, &hard.camera, &hard.settings).unwrap());
            assert!(listed == at_once && listed > 0, "{listed} {at_once}");
        },
    );
}
