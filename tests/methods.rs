//! Every rasterizer with every filter against its own oracle, on every hard scene.

mod common;

use std::collections::HashMap;

use common::{
    assert_validation_is_silent,
    compare::{F32, compare},
    render,
    scenes::{self, Hard},
    shared,
};
use surfel::{
    reference::{self, Picture},
    scene::{Filter, FilterWeight, Kernel, KernelEval, Rasterizer, Settings, Shapes},
};

/// A hard scene as this method draws it; `None` where the method can't, or the scene is not hard with it.
fn with(hard: &Hard, change: impl Fn(&mut Settings)) -> Option<Hard> {
    let mut hard = hard.clone();
    let hard_without_filter = hard.settings.filter == Filter::None;
    // A quarter of the pixels: there are many methods.
    hard.settings.size_px = [128, 128];
    change(&mut hard.settings);
    let ellipses = hard.scene.objects.iter().any(|o| matches!(o.splats.shapes, Shapes::Ellipses { .. }));
    let allowed = hard.settings.validate().is_ok() && hard.settings.check_object("test", ellipses).is_ok();
    (allowed && !(hard_without_filter && hard.settings.filter.adjusts())).then_some(hard)
}

/// What draws the same picture has the same oracle.
fn family(rasterizer: Rasterizer) -> Rasterizer {
    match rasterizer {
        Rasterizer::RaycastApproximate | Rasterizer::AffineCenter | Rasterizer::AffineContour => rasterizer,
        _ => Rasterizer::Perspective,
    }
}

/// How much larger than [`F32`] errors may be.
///
/// Disks seen within 1° of grazing are 0.02 px thin where nothing widens them. A triangle's vertices are placed to half a
/// step of f32 in pixels, 3.8e-6 at 64 px, which is 2e-4 of such an axis; both ends of the kernel's slope of 4 see it, and
/// no expansion about the center takes it out, since (u, v) are interpolated between them: 1.03e-3 of the weight. (A device
/// that snaps vertices to 1/256 px will be wrong by more than that.)
fn factor(hard: &Hard) -> f64 {
    let thin = hard.name == "edge-on disks" && !matches!(hard.settings.filter, Filter::Adjust | Filter::Ewa);
    if thin && hard.settings.rasterizer == Rasterizer::Triangle { 1.1 } else { 1.0 }
}

/// Scenes whose splats are mostly too small for a picture without filter have few pixels.
fn fewest_px(hard: &Hard) -> usize {
    if hard.name.starts_with("subpixel") { 100 } else { 300 }
}

#[test]
fn every_rasterizer_with_every_filter_agrees_with_its_oracle_on_every_hard_scene() {
    let mut headless = shared();
    let mut failures = Vec::new();
    let mut compared = 0;
    for scene in scenes::all() {
        let mut oracles: HashMap<(Rasterizer, Filter), Picture> = HashMap::new();
        for (_, rasterizer) in Rasterizer::NAMES {
            for (_, filter) in Filter::NAMES {
                let method = |s: &mut Settings| (s.rasterizer, s.filter) = (*rasterizer, *filter);
                let Some(hard) = with(&scene, method) else { continue };
                let oracle = oracles.entry((family(*rasterizer), *filter)).or_insert_with(|| {
                    reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap()
                });
                let errors = compare(&render(&mut headless, &hard), oracle);
                let name = format!("{} {} {}", rasterizer.name(), filter.name(), hard.name);
                println!("{}", errors.row(&name));
                let limit = F32.times(factor(&hard)).of_at_least(fewest_px(&hard));
                failures.extend(errors.beyond(&limit).into_iter().map(|beyond| format!("{name}: {beyond}")));
                compared += 1;
            }
        }
    }
    assert_validation_is_silent(&headless);
    assert!(failures.is_empty(), "{failures:#?}");
    assert!(compared > 300, "{compared} methods on scenes");
}

#[test]
fn unit_weights_and_early_depth_agree_with_the_oracle() {
    let mut headless = shared();
    let mut failures = Vec::new();
    for scene in [scenes::sphere_of_disks(), scenes::random_ellipses(Filter::Adjust), scenes::edge_on()] {
        for filter in [Filter::Adjust, Filter::AdjustPaper] {
            for (_, rasterizer) in Rasterizer::NAMES {
                let method = |s: &mut Settings| {
                    (s.rasterizer, s.filter) = (*rasterizer, filter);
                    (s.filter_weight, s.early_depth) = (FilterWeight::Unit, true);
                };
                let Some(hard) = with(&scene, method) else { continue };
                let oracle =
                    reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap();
                let errors = compare(&render(&mut headless, &hard), &oracle);
                let name = format!("{} {} {} unit weight", rasterizer.name(), filter.name(), hard.name);
                println!("{}", errors.row(&name));
                let limit = F32.times(factor(&hard)).of_at_least(fewest_px(&hard));
                failures.extend(errors.beyond(&limit).into_iter().map(|beyond| format!("{name}: {beyond}")));
            }
        }
    }
    assert_validation_is_silent(&headless);
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn early_depth_changes_no_bit() {
    let mut headless = shared();
    for (_, rasterizer) in Rasterizer::NAMES {
        for scene in [scenes::sphere_of_disks(), scenes::cut_by_the_near_plane(), scenes::ground()] {
            let frames = [false, true].map(|early_depth| {
                let method = |s: &mut Settings| {
                    (s.rasterizer, s.filter, s.early_depth) = (*rasterizer, Filter::None, early_depth);
                };
                render(&mut headless, &with(&scene, method).unwrap())
            });
            common::assert_same_bits(
                &frames[0],
                &frames[1],
                &format!("{} {}", rasterizer.name(), scene.name),
            );
        }
    }
    assert_validation_is_silent(&headless);
}

/// Bilinear interpolation between 256 texels over a diameter is wrong by at most `h²/8 · (|k_uu| + |k_vv|)`, h = 2/255, and
/// half floats hold weights to 2⁻¹² of themselves. Second derivatives along u and v together: below 2·4 for the Gaussian of
/// σ = ½ (1/σ² at the middle), below 60 for ψ_E(6, 1.5, 3) (by numerical search), below 2·100 for σ = 0.1.
#[test]
fn kernels_from_a_texture_are_as_exact_as_its_texels_allow() {
    let mut headless = shared();
    let texel = 2.0 / 255.0_f64;
    let kernels: [(Kernel, f64); 3] = [
        (Kernel::Gaussian { sigma: 0.5 }, 8.0),
        (Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 }, 60.0),
        (Kernel::Gaussian { sigma: 0.1 }, 200.0),
    ];
    for (kernel, curvature) in kernels {
        let interpolation = texel * texel / 8.0 * curvature;
        // `compare` divides by the weight or 0.135, whichever is larger; a device may filter with 8 bits of fraction.
        let weight =
            (interpolation + 1.0 / 256.0 * texel * curvature.sqrt()) / 0.135 + 1.0 / 4096.0 + F32.weight;
        for (_, rasterizer) in Rasterizer::NAMES {
            let method = |s: &mut Settings| {
                (s.rasterizer, s.kernel, s.kernel_eval) = (*rasterizer, kernel, KernelEval::Texture);
            };
            let hard = with(&scenes::sphere_of_disks(), method).unwrap();
            let oracle = reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap();
            let errors = compare(&render(&mut headless, &hard), &oracle);
            println!("{}", errors.row(&format!("{} {kernel:?} {weight:.1e}", rasterizer.name())));
            // Albedo and the like are means: their errors follow the weights' by at most the spread of the values, 1.
            let limit = common::compare::Errors {
                weight,
                albedo: weight,
                color: 2.0 * weight,
                normal_deg: (2.0 * weight).to_degrees(),
                depth: weight,
                ..F32.of_at_least(300)
            };
            assert!(errors.beyond(&limit).is_empty(), "{}: {:#?}", rasterizer.name(), errors.beyond(&limit));
            assert!(errors.weight > 1e-5, "{}: no texture was read", rasterizer.name());
        }
    }
    assert_validation_is_silent(&headless);
}
