//! `--set-up once`: points drawn from records are those that each pass's vertex stage sets up by itself.

mod common;

use common::{assert_same_bits, assert_validation_is_silent, scenes, shared};
use surfel::{
    error::ErrorKind,
    hard_scenes::{Hard, transparent},
    renderer::{Frame, Headless},
    scene::{
        Cull, Epsilon, Filter, Kernel, KernelEval, LastLayer, Layers, Rasterizer, Scene, SetUp, Settings,
        SplatFormat,
    },
};

fn draw(headless: &mut Headless, hard: &Hard, set_up: SetUp) -> Frame {
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let settings = Settings { set_up, ..hard.settings.clone() };
    headless.render(&prepared, &hard.camera, &settings, common::ALL).unwrap()
}

fn sets_up_once(frame: &Frame) -> bool {
    frame.plan.passes.iter().any(|pass| pass.name.starts_with("set up") && pass.name.ends_with("points"))
}

/// Both, compared; how many pixels have splats.
fn compare(headless: &mut Headless, hard: &Hard) -> usize {
    let stages = draw(headless, hard, SetUp::Stages);
    let once = draw(headless, hard, SetUp::Once);
    assert!(sets_up_once(&once) && !sets_up_once(&stages), "{}", hard.name);
    let what = format!("{} {:?}", hard.name, hard.settings);
    if hard.settings.filter == Filter::Ewa && hard.settings.rasterizer == Rasterizer::AffineContour {
        assert_same_but_for_rounding(&stages, &once, &what);
    } else {
        assert_same_bits(&stages, &once, &what);
    }
    once.weight.iter().filter(|weight| **weight > 0.0).count()
}

/// The axes of a contour far below a pixel are differences of nearly equal squares, and compute and vertex stages are compiled
/// apart: seen is 2e-5 of a weight in one pixel. The oracle's tolerance for weights is 1e-3.
fn assert_same_but_for_rounding(a: &Frame, b: &Frame, what: &str) {
    for (a, b) in a.weight.iter().zip(&b.weight).chain(a.depth.iter().zip(&b.depth)) {
        assert!(a == b || (a - b).abs() <= 1e-4 * a.max(*b), "{what}: {a} and {b}");
    }
    let means =
        |frame: &Frame| frame.albedo.iter().chain(&frame.linear).flatten().copied().collect::<Vec<_>>();
    for (a, b) in means(a).into_iter().zip(means(b)) {
        assert!((a - b).abs() <= 1e-4, "{what}: {a} and {b}");
    }
}

#[test]
fn the_same_bits_on_every_hard_scene_with_every_method() {
    use Rasterizer::{AffineCenter, AffineContour, Perspective, PerspectivePaper};
    let mut headless = shared();
    let (mut checked, mut covered) = (0, 0);
    for scene in scenes::all() {
        for rasterizer in [Perspective, PerspectivePaper, AffineCenter, AffineContour] {
            for (_, filter) in Filter::NAMES {
                let settings =
                    Settings { size_px: [64, 48], rasterizer, filter: *filter, ..scene.settings.clone() };
                let hard = Hard { settings, ..scene.clone() };
                let second_place =
                    *filter == Filter::Max && matches!(rasterizer, PerspectivePaper | AffineContour);
                if second_place
                    || hard.settings.validate().is_err()
                    || hard.settings.check_scene(&hard.scene).is_err()
                {
                    continue;
                }
                covered += compare(&mut headless, &hard);
                checked += 1;
            }
        }
    }
    println!("{checked} pictures, {covered} pixels");
    assert!(checked > 200 && covered > 100_000, "{checked}, {covered}");
    assert_validation_is_silent(&headless);
}

#[test]
fn the_same_bits_from_lists_of_packed_splats_with_a_kernel_from_a_texture() {
    let mut headless = shared();
    for mut hard in scenes::all() {
        hard.settings.size_px = [64, 48];
        hard.settings.kernel_eval = KernelEval::Texture;
        hard.settings.kernel = Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 };
        hard.scene.storage.format = SplatFormat::Packed;
        for cull in [Cull::List, Cull::Hidden] {
            hard.settings.cull = cull;
            compare(&mut headless, &hard);
        }
    }
    assert_validation_is_silent(&headless);
}

#[test]
fn the_same_bits_in_layers_and_beside_polygons() {
    let mut headless = shared();
    let mut checked = 0;
    for mut hard in transparent::all() {
        hard.settings.size_px = [64, 48];
        hard.settings.rasterizer = Rasterizer::Perspective;
        let has_splats = |scene: &Scene| scene.objects.iter().any(|object| !object.splats.is_empty());
        if !has_splats(&hard.scene) {
            continue;
        }
        let epsilon = hard.settings.epsilon;
        for (layers, last_layer, epsilon) in [
            (Layers::Fixed(3), LastLayer::Drop, epsilon),
            (Layers::Fixed(3), LastLayer::Blend, Epsilon::Radii(0.0)),
            (Layers::Auto(5), LastLayer::Stack, epsilon),
            (Layers::Fixed(1), LastLayer::Stack, epsilon),
        ] {
            hard.settings.layers = layers;
            hard.settings.last_layer = last_layer;
            hard.settings.epsilon = epsilon;
            compare(&mut headless, &hard);
            checked += 1;
        }
    }
    assert!(checked > 16, "{checked}");
    assert_validation_is_silent(&headless);
}

#[test]
fn every_pass_draws_from_records_and_none_without() {
    let of_opaque = scenes::sphere_of_disks();
    let mut hard = transparent::spheres();
    hard.settings.layers = Layers::Fixed(3);
    hard.settings.last_layer = LastLayer::Stack;
    for set_up in [SetUp::Once, SetUp::Stages] {
        // Pipelines are kept, so that others' must not be there.
        let mut headless = common::headless();
        for hard in [&of_opaque, &hard] {
            let settings = Settings { rasterizer: Rasterizer::Perspective, ..hard.settings.clone() };
            draw(&mut headless, &Hard { settings, ..hard.clone() }, set_up);
        }
        let names = headless.renderer.shaders.pipeline_names();
        let points = names.iter().filter(|name| name.contains("points_plain")).collect::<Vec<_>>();
        let recorded = points.iter().filter(|name| name.contains("recorded_points")).count();
        // Visibility with and without a layer before, sums of opaque splats, of two layers, of the last one.
        assert!(points.len() >= 6, "{names:#?}");
        assert_eq!(recorded, if set_up == SetUp::Once { points.len() } else { 0 }, "{names:#?}");
        assert_validation_is_silent(&headless);
    }
}

#[test]
fn what_records_cannot_hold_is_refused() {
    let mut headless = shared();
    let hard = scenes::sphere_of_disks();
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let points =
        Settings { rasterizer: Rasterizer::Perspective, set_up: SetUp::Once, ..hard.settings.clone() };
    let refused = [
        Settings { rasterizer: Rasterizer::Raycast, ..points.clone() },
        Settings { rasterizer: Rasterizer::Quad, ..points.clone() },
        Settings { rasterizer: Rasterizer::AffineContour, filter: Filter::Max, ..points.clone() },
        Settings { early_depth: true, ..points },
    ];
    for settings in refused {
        let error = headless.render(&prepared, &hard.camera, &settings, common::ALL).unwrap_err();
        assert!(
            matches!(error.kind(), ErrorKind::Option { .. }) && error.to_string().contains("--set-up"),
            "{error}"
        );
    }
    drop(prepared);
    assert_validation_is_silent(&headless);
}
