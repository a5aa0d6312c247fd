//! Each formula of the GPU path, made wrong by 1%, must be seen by the comparison with the oracle: a comparison that
//! lets one pass tests nothing of it. Levers: `glsl/inc/perturb.glsl`.
//!
//! `cargo test --release --features test-formulas --test formulas`: minutes, the build of the shaders with their levers among
//! them. The nightly workflow runs it.

#[path = "../common/mod.rs"]
mod common;
mod selftest;

use std::rc::Rc;

use glam::DVec3;

use common::{
    ALL, PICTURE,
    bent::bent,
    oracle_of, passes, render_as,
    scenes::{self, Hard, transparent},
    shared, sheets, with, with_points_up_to,
};
use surfel::{
    load::builtin::checkerboard,
    passes::Formula,
    reference::Picture,
    renderer::{Frame, Headless, Wanted},
    scene::{Cull, Edges, Epsilon, Filter, Kernel, KernelEval, Rasterizer, Scene, Shading, Transition},
    selftest::{agreement::compare, light::compare_light, tolerance},
};

/// Fails unless each formula, if it is wrong, makes one of the pictures wrong, and none is if all are right.
fn assert_seen(
    headless: &mut Headless,
    scenes: &[(Hard, Rc<Picture>)],
    formulas: &[Formula],
    wrong: &dyn Fn(&mut Headless, &Hard, &Picture) -> Option<String>,
) {
    let mut is_wrong = |formula| {
        headless.renderer.perturb(formula);
        scenes
            .iter()
            .find_map(|(hard, oracle)| Some(format!("{}: {}", hard.name, wrong(headless, hard, oracle)?)))
    };
    assert_eq!(is_wrong(None), None, "differs already");
    let mut unseen = Vec::new();
    for &formula in formulas {
        let seen = is_wrong(Some(formula));
        println!("{:20} {}", format!("{formula:?}"), seen.as_deref().unwrap_or("SEEN BY NOTHING"));
        if seen.is_none() {
            unseen.push(formula);
        }
    }
    headless.renderer.perturb(None);
    assert!(unseen.is_empty(), "{unseen:?}");
}

fn with_oracles(scenes: impl IntoIterator<Item = Hard>) -> Vec<(Hard, Rc<Picture>)> {
    scenes.into_iter().map(|hard| (oracle_of(&hard), hard)).map(|(oracle, hard)| (hard, oracle)).collect()
}

/// How the surface of a frame is wrong.
fn surface(frame: &Frame, hard: &Hard, oracle: &Picture) -> Option<String> {
    // Ray casting subtracts the center from a point of the plane: twice the error of an expansion about the center.
    let is_cast = matches!(hard.settings.rasterizer, Rasterizer::Raycast | Rasterizer::RaycastApproximate);
    let factor = if is_cast { 2.0 } else { 1.0 };
    let beyond = compare(frame, oracle).beyond(&tolerance::of(hard).times(factor));
    (!beyond.is_empty()).then(|| beyond.join(", "))
}

/// How its picture is wrong.
fn light(frame: &Frame, _: &Hard, oracle: &Picture) -> Option<String> {
    let errors = compare_light(frame, oracle);
    (errors.worst > tolerance::LIGHT).then(|| errors.row(""))
}

/// Of opaque splats: those that see most formulas first, then those that see one that no other does.
fn opaque() -> Vec<Hard> {
    let (sphere, ellipses) = (scenes::sphere_of_disks(), scenes::random_ellipses(Filter::None));
    let board = Scene { objects: vec![checkerboard(20)], ..Scene::default() };
    let board = Hard::seen_from([0.0, 0.0, 40.0], "board", board);
    let psi_e = Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 };
    let rasterizers = [
        Rasterizer::AffineContour,
        Rasterizer::Raycast,
        Rasterizer::RaycastApproximate,
        Rasterizer::Triangle,
    ];
    let mut all = vec![
        sphere.clone(),
        with(&sphere, |s| s.kernel = psi_e),
        scenes::random_ellipses(Filter::Adjust),
        ellipses.clone(),
        scenes::cut_by_the_near_plane(),
        with(&ellipses, |s| s.filter = Filter::Ewa),
        with(&ellipses, |s| (s.rasterizer, s.filter) = (Rasterizer::AffineContour, Filter::Ewa)),
        with(&ellipses, |s| s.filter = Filter::Max),
        with(&scenes::subpixel_filtered(), |s| s.filter = Filter::Max),
        // Flat, and ε below a hundredth of the distance: what is not hidden is taken for it.
        with(&board, |s| (s.cull, s.epsilon) = (Cull::Hidden, Epsilon::Radii(0.1))),
        with(&sphere, |s| s.kernel_eval = KernelEval::Texture),
    ];
    all.extend(rasterizers.map(|rasterizer| with(&ellipses, |s| s.rasterizer = rasterizer)));
    all.extend([scenes::edge_on(), scenes::ground(), scenes::larger_than_the_screen()]);
    all
}

#[test]
fn every_formula_of_opaque_splats_is_seen_by_points_and_by_quads() {
    let mut headless = shared();
    let scenes = with_oracles(opaque());
    let points = |headless: &mut Headless, hard: &Hard, oracle: &Picture| {
        surface(&render_as(headless, hard, ALL), hard, oracle)
    };
    assert_seen(&mut headless, &scenes, &Formula::ALL, &points);
    // All as quads, which have formulas of their own in the same places.
    let quads = |headless: &mut Headless, hard: &Hard, oracle: &Picture| {
        with_points_up_to(headless, 0.0, |headless| points(headless, hard, oracle))
    };
    // Lists of what is not hidden are of points alone.
    let of_points = [Formula::PointCenter, Formula::PointSize, Formula::NearestDepth];
    let of_quads: Vec<_> = Formula::ALL.into_iter().filter(|formula| !of_points.contains(formula)).collect();
    assert_seen(&mut headless, &scenes, &of_quads, &quads);
}

/// Those of points, of other rasterizers and of filters that tiles don't have.
const NOT_BY_TILES: [Formula; 11] = [
    Formula::PointCenter,
    Formula::PointSize,
    Formula::LowPass,
    Formula::LowPassBox,
    Formula::Contour,
    Formula::RayDepth,
    Formula::RayAxis,
    Formula::ApproximateSize,
    Formula::TriangleCorner,
    Formula::KernelTexture,
    Formula::NearestDepth,
];

/// That an invocation is a pixel changes no bit, which the self-test sees.
#[test]
fn every_formula_of_opaque_splats_is_seen_by_tiles() {
    let mut headless = shared();
    let is_own = |hard: &Hard| hard.settings.rasterizer == Rasterizer::Perspective;
    let scenes =
        opaque().into_iter().filter(is_own).map(|hard| with(&hard, |s| s.rasterizer = Rasterizer::Compute));
    let scenes = with_oracles(scenes.filter(|hard| hard.settings.validate().is_ok()));
    let formulas: Vec<_> =
        Formula::ALL.into_iter().filter(|formula| !NOT_BY_TILES.contains(formula)).collect();
    assert_seen(&mut headless, &scenes, &formulas, &|headless, hard, oracle| {
        surface(&render_as(headless, hard, ALL), hard, oracle)
    });
}

#[test]
fn every_formula_of_layers_is_seen() {
    let scenes = with_oracles([
        transparent::transparent_hybrid(Transition::Color),
        transparent::meshes_only(),
        transparent::hybrid(Transition::Color),
        transparent::stacked(Transition::Color),
        transparent::crossing(),
        transparent::upon_the_opaque(),
    ]);
    assert_seen(&mut shared(), &scenes, &Formula::OF_LAYERS, &|headless, hard, oracle| {
        light(&render_as(headless, hard, ALL), hard, oracle)
    });
}

#[test]
fn every_formula_of_edges_is_seen() {
    let balls = [scenes::sphere_of_disks(), transparent::interpenetrating()].map(|balls| {
        with(&balls, |settings| {
            (settings.edges, settings.rasterizer) = (Edges::Coverage, Rasterizer::Compute);
        })
    });
    assert_seen(&mut shared(), &with_oracles(balls), &Formula::OF_EDGES, &|headless, hard, oracle| {
        light(&render_as(headless, hard, PICTURE), hard, oracle)
    });
}

#[test]
fn every_formula_of_borders_is_seen() {
    let sheet = sheets::covering(vec![sheets::sheet(12, 0.1, DVec3::ZERO, false)]);
    assert_seen(&mut shared(), &with_oracles([sheet]), &Formula::OF_BORDERS, &|headless, hard, oracle| {
        light(&render_as(headless, hard, PICTURE), hard, oracle)
    });
}

#[test]
fn every_formula_of_clip_curves_is_seen() {
    let clipped = with(&scenes::clipped(), |settings| {
        (settings.edges, settings.rasterizer) = (Edges::Coverage, Rasterizer::Compute);
    });
    let bent = with(&bent(24, 4), |settings| settings.size_px = [200, 200]);
    assert_seen(
        &mut shared(),
        &with_oracles([clipped, bent]),
        &Formula::OF_CLIPS,
        &|headless, hard, oracle| light(&render_as(headless, hard, PICTURE), hard, oracle),
    );
}

#[test]
fn the_formula_of_planes_is_seen_by_points_quads_triangles_and_tiles() {
    let scenes = [Rasterizer::Perspective, Rasterizer::Quad, Rasterizer::Triangle, Rasterizer::Compute]
        .map(|rasterizer| with(&scenes::cut_by_a_box(), |settings| settings.rasterizer = rasterizer));
    for scene in with_oracles(scenes) {
        assert_seen(&mut shared(), &[scene], &Formula::OF_PLANES, &|headless, hard, oracle| {
            surface(&render_as(headless, hard, ALL), hard, oracle)
        });
    }
}

#[test]
fn the_formula_of_eye_dome_lighting_is_seen_by_points_and_by_tiles() {
    for rasterizer in [Rasterizer::Perspective, Rasterizer::Compute] {
        let ground = with(&scenes::ground(), |s| (s.shading, s.rasterizer) = (Shading::EyeDome, rasterizer));
        assert_seen(
            &mut shared(),
            &with_oracles([ground]),
            &Formula::OF_EYE_DOME,
            &|headless, hard, oracle| light(&render_as(headless, hard, PICTURE), hard, oracle),
        );
    }
}

/// Draws by tiles, which a frame shows in a pass of this name.
fn by_tiles(
    headless: &mut Headless,
    hard: &Hard,
    oracle: &Picture,
    wanted: Wanted,
    pass: &str,
) -> Option<String> {
    let frame = render_as(headless, hard, wanted);
    assert!(passes(&frame).contains(&pass), "{}: {:?}", hard.name, passes(&frame));
    light(&frame, hard, oracle)
}

/// The same where a tile's layers are drawn at once.
#[test]
fn every_formula_of_layers_is_seen_by_tiles() {
    // A layer with polygons is not drawn by tiles.
    let mut stacked = transparent::stacked(Transition::Color);
    stacked.scene.meshes.clear();
    let mut behind = transparent::interpenetrating();
    behind.scene.objects.push(scenes::sphere(1500, DVec3::new(0.0, -0.2, -0.3)));
    let scenes = [stacked, behind].map(|hard| with(&hard, |s| s.rasterizer = Rasterizer::Compute));
    let formulas = [
        Formula::Alpha,
        Formula::Color,
        Formula::Coverage,
        Formula::EyeDirection,
        Formula::Kernel,
        Formula::Lengthened,
        Formula::LitDiffuse,
        Formula::LitSpecular,
        Formula::NormalizedColor,
        Formula::Peeled,
        Formula::Stacked,
    ];
    assert_seen(&mut shared(), &with_oracles(scenes), &formulas, &|headless, hard, oracle| {
        by_tiles(headless, hard, oracle, ALL, "layers of tiles")
    });
}

/// The same of opaque splats and polygons that tiles show without anyone else reading their sums.
#[test]
fn every_formula_of_shading_is_seen_by_tiles_that_are_shaded_at_once() {
    let lights = transparent::meshes_only().scene.lights;
    let scenes = [Vec::new(), lights].map(|lights| {
        let mut hard = transparent::hybrid(Transition::Color);
        (hard.scene.lights, hard.settings.rasterizer) = (lights, Rasterizer::Compute);
        hard
    });
    let formulas = [
        Formula::Diffuse,
        Formula::LitDiffuse,
        Formula::LitSpecular,
        Formula::NormalizedColor,
        Formula::Specular,
        Formula::Transition,
    ];
    assert_seen(&mut shared(), &with_oracles(scenes), &formulas, &|headless, hard, oracle| {
        by_tiles(headless, hard, oracle, PICTURE, "see, sum and shade tiles")
    });
}
