//! The splat passes as Guennebaud et al. 2006 publish them, against the oracle of their filter: how wrong the plain programs
//! are where ours, with the same filter, are exact. What our additional instructions buy; printed with `--nocapture`.

use crate::common::{
    PICTURE, oracle_of, render_as,
    scenes::{self, Hard},
    shared,
};
use surfel::{
    instruments::draw_as_published,
    reference::Picture,
    renderer::Headless,
    scene::{Accumulate, Filter, FilterWeight, Shading, Shapes},
};

/// Against the oracle: pixels with color in one of both only, and the color's error over those with color in both.
#[derive(Clone, Copy, Debug)]
struct Wrong {
    covered_px: usize,
    coverage_px: usize,
    rms: f64,
    max: f64,
}

fn wrong(pixels: &[[f32; 4]], oracle: &Picture) -> Wrong {
    let mut wrong = Wrong { covered_px: 0, coverage_px: 0, rms: 0.0, max: 0.0 };
    let mut squares = 0.0;
    let mut values = 0;
    for (drawn, exact) in pixels.iter().zip(&oracle.pixels) {
        // Not a number is no color.
        let is_drawn = drawn[3] > 0.0 && drawn.iter().all(|value| value.is_finite());
        wrong.covered_px += usize::from(exact.is_covered());
        wrong.coverage_px += usize::from(is_drawn != exact.is_covered());
        if is_drawn && exact.is_covered() {
            for (value, exact) in drawn.iter().zip(exact.albedo) {
                let off = (f64::from(*value) - exact).abs();
                squares += off * off;
                values += 1;
                wrong.max = wrong.max.max(off);
            }
        }
    }
    // NaN where nothing is in both.
    wrong.rms = (squares / f64::from(values)).sqrt();
    wrong
}

/// The errors of the published programs, of the same with the filter in visibility too, and of ours.
fn errors(headless: &mut Headless, hard: &Hard) -> [Wrong; 3] {
    let oracle = oracle_of(hard);
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let published = |headless: &mut Headless, filtered| {
        let pixels = draw_as_published(headless, &prepared, &hard.camera, &hard.settings, filtered);
        wrong(&pixels.unwrap(), &oracle)
    };
    let [plain, filtered] = [published(headless, false), published(headless, true)];
    let ours = render_as(headless, hard, PICTURE);
    [plain, filtered, wrong(&ours.linear, &oracle)]
}

/// The scenes of disks, with the paper's filter.
fn of_disks() -> Vec<Hard> {
    let mut all = scenes::all();
    all.retain(|hard| {
        hard.scene.objects.iter().all(|object| matches!(object.splats.shapes, Shapes::Disks { .. }))
            && hard.settings.filter != Filter::None
    });
    for hard in &mut all {
        hard.settings.filter = Filter::AdjustPaper;
        hard.settings.filter_weight = FilterWeight::Unit;
        hard.settings.shading = Shading::Albedo;
        hard.settings.accumulate = Accumulate::F32;
        hard.settings.background = None;
        hard.settings.size_px = [128, 128];
    }
    all
}

#[test]
fn the_published_programs_draw_and_ours_are_nearer_to_the_oracle() {
    let mut headless = shared();
    println!(
        "| scene | pixels | published: coverage | rms | max | visibility filtered: coverage | rms | max \
         | ours: coverage | rms | max |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    let mut seen = 0;
    for hard in of_disks() {
        let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
        if prepared.chunks().iter().any(|chunk| chunk.fine) {
            continue; // for f64
        }
        let [published, filtered, ours] = errors(&mut headless, &hard);
        let columns = |wrong: Wrong| format!("{} | {:.1e} | {:.1e}", wrong.coverage_px, wrong.rms, wrong.max);
        let [a, b, c] = [published, filtered, ours].map(columns);
        println!("| {} | {} | {a} | {b} | {c} |", hard.name, published.covered_px);
        // Not a number where no pixel has color in both.
        // Beyond a fortieth of a step of 8 bits: of 3000 disks sums of f32 are as far off by their order.
        let is_nearer = (ours.rms <= published.rms.max(1e-4) || published.rms.is_nan())
            && ours.coverage_px <= published.coverage_px;
        assert!(is_nearer, "{}: {ours:?}, published {published:?}", hard.name);
        if hard.name == "sphere of disks" {
            // Visibility is not filtered, so that the silhouette lacks a pixel: 4.8% at 128 x 128. Rims that hide less, and
            // the kernel's texels, are 4.6e-3 of the color.
            let fits = published.rms < 5e-3 && published.coverage_px < published.covered_px / 20;
            assert!(fits, "{published:?}");
        }
        seen += 1;
    }
    assert!(seen >= 6, "{seen}");
}
