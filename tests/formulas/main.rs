//! Each formula of the GPU path, made wrong by 1%, must be seen by the comparison with the oracle: a comparison that
//! lets one pass tests nothing of it. Levers: `glsl/inc/perturb.glsl`.

#[path = "../common/mod.rs"]
mod common;
mod selftest;

use glam::DVec3;

use common::{
    assert_validation_is_silent,
    compare::{Errors, F32, compare},
    headless, render,
    scenes::{self, Hard, transparent},
    with_limits,
};
use surfel::{
    passes::Formula,
    reference::{self, Picture},
    renderer::{Headless, Wanted},
    scene::{Cull, Filter, Kernel, KernelEval, Rasterizer, Settings, TileInvocations, Transition},
    selftest::light::{LightErrors, compare_light},
};

/// The scenes of the comparison, those that see most formulas first.
fn scenes() -> Vec<(Hard, Picture)> {
    let sphere = scenes::sphere_of_disks();
    let psi_e = Settings { kernel: Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 }, ..sphere.settings.clone() };
    let mut all = vec![
        sphere.clone(),
        Hard { name: "sphere of disks, psi_e", settings: psi_e, ..sphere },
        scenes::random_ellipses(Filter::Adjust),
        scenes::random_ellipses(Filter::None),
        scenes::cut_by_the_near_plane(),
    ];
    // Each has a formula that no other does.
    type Change = fn(&mut Settings);
    let methods: [(&str, Hard, Change); 10] = [
        ("ellipses, ewa", scenes::random_ellipses(Filter::None), |s| s.filter = Filter::Ewa),
        ("ellipses, contour ewa", scenes::random_ellipses(Filter::None), |s| {
            (s.rasterizer, s.filter) = (Rasterizer::AffineContour, Filter::Ewa);
        }),
        ("ellipses, affine-contour", scenes::random_ellipses(Filter::None), |s| {
            s.rasterizer = Rasterizer::AffineContour;
        }),
        ("ellipses, raycast", scenes::random_ellipses(Filter::None), |s| s.rasterizer = Rasterizer::Raycast),
        ("ellipses, raycast-approximate", scenes::random_ellipses(Filter::None), |s| {
            s.rasterizer = Rasterizer::RaycastApproximate;
        }),
        ("ellipses, triangle", scenes::random_ellipses(Filter::None), |s| {
            s.rasterizer = Rasterizer::Triangle
        }),
        ("ellipses, max", scenes::random_ellipses(Filter::None), |s| s.filter = Filter::Max),
        ("subpixel disks, max", scenes::subpixel_filtered(), |s| s.filter = Filter::Max),
        ("sphere, hidden splats left out", scenes::sphere_of_disks(), |s| s.cull = Cull::Hidden),
        ("sphere, kernel texture", scenes::sphere_of_disks(), |s| s.kernel_eval = KernelEval::Texture),
    ];
    all.extend(methods.map(|(name, mut hard, change)| {
        change(&mut hard.settings);
        Hard { name, ..hard }
    }));
    let seen: Vec<_> = all.iter().map(|hard| hard.name).collect();
    all.extend(scenes::all().into_iter().filter(|hard| !seen.contains(&hard.name)));
    let oracle =
        |hard: &Hard| reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap();
    all.into_iter().map(|hard| (oracle(&hard), hard)).map(|(oracle, hard)| (hard, oracle)).collect()
}

/// Those that no scene by tiles has: of points, other rasterizers and filters.
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

/// The same scenes by tiles, where they can be drawn so.
fn by_tiles(scenes: &[(Hard, Picture)], tile_invocations: TileInvocations) -> Vec<(Hard, &Picture)> {
    let own_map = |hard: &Hard| hard.settings.rasterizer != Rasterizer::Perspective;
    let changed = scenes.iter().filter(|(hard, _)| !own_map(hard)).map(|(hard, oracle)| {
        let settings =
            Settings { rasterizer: Rasterizer::Compute, tile_invocations, ..hard.settings.clone() };
        (Hard { settings, ..hard.clone() }, oracle)
    });
    changed.filter(|(hard, _)| hard.settings.validate().is_ok()).collect()
}

/// Ray casting subtracts the center from a point of the plane: twice the error of an expansion about the center.
fn limit(hard: &Hard) -> Errors {
    if hard.name.contains("raycast") { F32.times(2.0) } else { F32 }
}

#[test]
fn every_formula_of_layers_that_is_wrong_by_one_percent_fails_the_comparison() {
    let mut headless = headless();
    let oracle =
        |hard: &Hard| reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap();
    let scenes = [
        transparent::transparent_hybrid(Transition::Color),
        transparent::meshes_only(),
        transparent::hybrid(Transition::Color),
        transparent::stacked(Transition::Color),
        transparent::crossing(),
        transparent::upon_the_opaque(),
    ];
    let scenes: Vec<_> = scenes.into_iter().map(|hard| (oracle(&hard), hard)).collect();
    // The limit of tests/transparency.rs.
    let is_beyond = |errors: &LightErrors| errors.worst > 1.0 / 1024.0;
    for (oracle, hard) in &scenes {
        let errors = compare_light(&render(&mut headless, hard), oracle);
        assert!(!is_beyond(&errors), "{} differs already: {}", hard.name, errors.row(hard.name));
    }
    let mut unseen = Vec::new();
    for formula in Formula::OF_LAYERS {
        headless.renderer.shaders.perturbed = Some(formula);
        let caught = scenes.iter().find_map(|(oracle, hard)| {
            let errors = compare_light(&render(&mut headless, hard), oracle);
            is_beyond(&errors).then(|| errors.row(hard.name))
        });
        println!("{:20} {}", format!("{formula:?}"), caught.as_deref().unwrap_or("SEEN BY NOTHING"));
        if caught.is_none() {
            unseen.push(formula);
        }
    }
    assert_validation_is_silent(&headless);
    assert!(unseen.is_empty(), "{unseen:?}");
}

/// The same where a tile's layers are drawn at once.
#[test]
fn every_formula_of_layers_by_tiles_that_is_wrong_by_one_percent_fails_the_comparison() {
    let mut headless = headless();
    // A layer with polygons is not drawn by tiles.
    let mut stacked = transparent::stacked(Transition::Color);
    stacked.scene.meshes.clear();
    let mut behind = transparent::interpenetrating();
    behind.scene.objects.push(scenes::sphere(1500, DVec3::new(0.0, -0.2, -0.3)));
    let scenes = [stacked, behind, transparent::spheres()];
    let mut scenes = scenes.map(|hard| {
        let oracle = reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap();
        let settings = Settings { rasterizer: Rasterizer::Compute, ..hard.settings.clone() };
        (Hard { settings, ..hard }, oracle)
    });
    for tile_invocations in [TileInvocations::Column, TileInvocations::Pixel] {
        scenes.iter_mut().for_each(|(hard, _)| hard.settings.tile_invocations = tile_invocations);
        assert_formulas_of_layers_are_seen(&mut headless, &scenes);
    }
}

fn assert_formulas_of_layers_are_seen(headless: &mut Headless, scenes: &[(Hard, Picture)]) {
    headless.renderer.shaders.perturbed = None;
    let is_beyond = |errors: &LightErrors| errors.worst > 1.0 / 1024.0;
    for (hard, oracle) in scenes {
        let frame = render(headless, hard);
        assert!(frame.plan.passes.iter().any(|pass| pass.name == "layers of tiles"), "{}", hard.name);
        let errors = compare_light(&frame, oracle);
        assert!(!is_beyond(&errors), "{} differs already: {}", hard.name, errors.row(hard.name));
    }
    for formula in [
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
    ] {
        headless.renderer.shaders.perturbed = Some(formula);
        let caught = scenes.iter().find_map(|(hard, oracle)| {
            let errors = compare_light(&render(headless, hard), oracle);
            is_beyond(&errors).then(|| errors.row(hard.name))
        });
        println!("{:20} {}", format!("{formula:?}"), caught.as_deref().unwrap_or("SEEN BY NOTHING"));
        assert!(caught.is_some(), "{formula:?}");
    }
    assert_validation_is_silent(headless);
}

/// The same of opaque splats and polygons that tiles show without anyone else reading their sums.
#[test]
fn every_formula_of_tiles_that_are_shaded_at_once_fails_the_comparison() {
    let mut headless = headless();
    let picture = Wanted { surface: false, ..common::ALL };
    let lights = transparent::meshes_only().scene.lights;
    let mut scenes: Vec<_> = [Vec::new(), lights]
        .map(|lights| {
            let mut hard = transparent::hybrid(Transition::Color);
            hard.scene.lights = lights;
            hard.settings.rasterizer = Rasterizer::Compute;
            let oracle = reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap();
            (hard, oracle)
        })
        .into();
    let mut draw = |hard: &Hard, perturbed| {
        headless.renderer.shaders.perturbed = perturbed;
        let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
        headless.render(&prepared, &hard.camera, &hard.settings, picture).unwrap()
    };
    for tile_invocations in [TileInvocations::Column, TileInvocations::Pixel] {
        scenes.iter_mut().for_each(|(hard, _)| hard.settings.tile_invocations = tile_invocations);
        let mut is_caught = |formula| {
            scenes.iter().any(|(hard, oracle)| {
                let frame = draw(hard, formula);
                assert!(frame.plan.passes.iter().any(|pass| pass.name == "see, sum and shade tiles"));
                compare_light(&frame, oracle).worst > 1.0 / 1024.0
            })
        };
        assert!(!is_caught(None), "differs already");
        for formula in [
            Formula::Diffuse,
            Formula::LitDiffuse,
            Formula::LitSpecular,
            Formula::NormalizedColor,
            Formula::Specular,
            Formula::Transition,
        ] {
            assert!(is_caught(Some(formula)), "{formula:?}");
        }
    }
    assert_validation_is_silent(&headless);
}

#[test]
fn every_formula_that_is_wrong_by_one_percent_fails_the_comparison() {
    let mut headless = headless();
    let scenes = scenes();
    for (hard, oracle) in &scenes {
        let errors = compare(&render(&mut headless, hard), oracle);
        assert!(
            errors.beyond(&limit(hard)).is_empty(),
            "{} differs already: {}",
            hard.name,
            errors.row(hard.name)
        );
    }
    // As this device draws them, and all as quads, which have formulas of their own in the same places.
    let own_px = headless.device().facts().limits.point_size_range[1];
    let as_they_are = || scenes.iter().map(|(hard, oracle)| (hard.clone(), oracle)).collect::<Vec<_>>();
    let ways = [
        ("points", own_px, as_they_are()),
        ("quads", 0.0, as_they_are()),
        ("tiles", own_px, by_tiles(&scenes, TileInvocations::Column)),
        ("tiles by pixels", own_px, by_tiles(&scenes, TileInvocations::Pixel)),
    ];
    let mut unseen = Vec::new();
    for (way, cap_px, scenes) in ways {
        for formula in Formula::ALL {
            if way == "quads" && matches!(formula, Formula::PointCenter | Formula::PointSize)
                || way.starts_with("tiles") && NOT_BY_TILES.contains(&formula)
            {
                continue;
            }
            headless.renderer.shaders.perturbed = Some(formula);
            let caught = scenes.iter().find_map(|(hard, oracle)| {
                let frame = with_limits(
                    &mut headless,
                    |limits| limits.point_size_range[1] = cap_px,
                    |headless| render(headless, hard),
                );
                let beyond = compare(&frame, oracle).beyond(&limit(hard));
                (!beyond.is_empty()).then(|| format!("{}: {}", hard.name, beyond.join(", ")))
            });
            let name = format!("{formula:?}");
            println!("{way} {name:20} {}", caught.as_deref().unwrap_or("SEEN BY NOTHING"));
            if caught.is_none() {
                unseen.push((way, formula));
            }
        }
    }
    assert_validation_is_silent(&headless);
    assert!(unseen.is_empty(), "{unseen:?}");
}
