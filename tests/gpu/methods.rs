//! Every rasterizer with every filter against its own oracle, on every hard scene.

use std::collections::HashMap;

use crate::common::{
    assert_same_bits,
    compare::compare,
    render,
    scenes::{self, Hard},
    shared,
};
use surfel::{
    reference::{self, Picture},
    scene::{Filter, FilterWeight, Kernel, KernelEval, Rasterizer, Settings, Shapes, TileInvocations},
    selftest::tolerance,
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

#[test]
fn every_rasterizer_with_every_filter_agrees_with_its_oracle_on_every_hard_scene() {
    let mut headless = shared();
    let mut failures = Vec::new();
    let mut compared = 0;
    for scene in scenes::all() {
        let mut oracles: HashMap<(Rasterizer, Filter), Picture> = HashMap::new();
        for (_, rasterizer) in Rasterizer::METHODS {
            for (_, filter) in Filter::NAMES {
                let method = |s: &mut Settings| (s.rasterizer, s.filter) = (*rasterizer, *filter);
                let Some(hard) = with(&scene, method) else { continue };
                let oracle = oracles.entry((rasterizer.family(), *filter)).or_insert_with(|| {
                    reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap()
                });
                let frame = render(&mut headless, &hard);
                let errors = compare(&frame, oracle);
                let name = format!("{} {} {}", rasterizer.name(), filter.name(), hard.name);
                if *rasterizer == Rasterizer::Compute {
                    for tile_invocations in [TileInvocations::Pixel, TileInvocations::ShortColumn] {
                        let otherwise = Hard {
                            settings: Settings { tile_invocations, ..hard.settings.clone() },
                            ..hard.clone()
                        };
                        let name = format!("{name} {tile_invocations:?}");
                        assert_same_bits(&frame, &render(&mut headless, &otherwise), &name);
                    }
                }
                println!("{}", errors.row(&name));
                let limit = tolerance::of(&hard);
                failures.extend(errors.beyond(&limit).into_iter().map(|beyond| format!("{name}: {beyond}")));
                compared += 1;
            }
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
    assert!(compared > 300, "{compared} methods on scenes");
}

#[test]
fn unit_weights_agree_with_the_oracle() {
    let mut headless = shared();
    let mut failures = Vec::new();
    for scene in [scenes::sphere_of_disks(), scenes::random_ellipses(Filter::Adjust), scenes::edge_on()] {
        for filter in [Filter::Adjust, Filter::AdjustPaper] {
            for (_, rasterizer) in Rasterizer::METHODS {
                let method = |s: &mut Settings| {
                    (s.rasterizer, s.filter, s.filter_weight) = (*rasterizer, filter, FilterWeight::Unit);
                };
                let Some(hard) = with(&scene, method) else { continue };
                let oracle =
                    reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap();
                let errors = compare(&render(&mut headless, &hard), &oracle);
                let name = format!("{} {} {} unit weight", rasterizer.name(), filter.name(), hard.name);
                println!("{}", errors.row(&name));
                let limit = tolerance::of(&hard);
                failures.extend(errors.beyond(&limit).into_iter().map(|beyond| format!("{name}: {beyond}")));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn kernels_from_a_texture_are_as_exact_as_its_texels_allow() {
    let mut headless = shared();
    let kernels = [
        Kernel::Gaussian { sigma: 0.5 },
        Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 },
        Kernel::Gaussian { sigma: 0.1 },
    ];
    for kernel in kernels {
        for (_, rasterizer) in Rasterizer::METHODS {
            let method = |s: &mut Settings| {
                (s.rasterizer, s.kernel, s.kernel_eval) = (*rasterizer, kernel, KernelEval::Texture);
            };
            // Tiles find kernels by arithmetic.
            let Some(hard) = with(&scenes::sphere_of_disks(), method) else {
                assert_eq!(*rasterizer, Rasterizer::Compute);
                continue;
            };
            let oracle = reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap();
            let errors = compare(&render(&mut headless, &hard), &oracle);
            let limit = tolerance::of(&hard);
            println!("{}", errors.row(&format!("{} {kernel:?} {:.1e}", rasterizer.name(), limit.weight)));
            assert!(errors.beyond(&limit).is_empty(), "{}: {:#?}", rasterizer.name(), errors.beyond(&limit));
            assert!(errors.weight > 1e-5, "{}: no texture was read", rasterizer.name());
        }
    }
}
