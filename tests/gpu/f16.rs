//! 16-bit accumulation: how far it is from the oracle beside 32 bits, how far it may be, and what many splats do to it.
//!
//! A sum S of `n` positive values in binary16 errs by at most `e = n (2·2⁻¹⁰ S + 2·2⁻²⁴)`, and a quotient of two such sums
//! by about twice that, relative (`selftest::half::Rounding`): the self-test holds every pixel to that. It says nothing beyond some hundred fragments, where sums stall: a sum of equal
//! summands a stops in the first binade whose step is 2a or more (with truncation: more than a), between 2048 a and
//! 4096 a (1024 a and 2048 a): a normalized color is then within a factor 2 of the input. On the way there a summand of
//! 0.5 to 1.5 steps is taken as a whole step, so that a sum may grow by 2/3 to 2 times its rate: a factor 3.

use crate::common::{
    builder::{Builder, camera, settings},
    render,
    scenes::{self, Hard},
    shared, with,
};
use glam::DVec3;
use surfel::{
    renderer::Headless,
    scene::{Accumulate, Filter, Kernel, Settings},
};

/// A filter takes all but a 16th of a small splat's weight, and a kernel may end at 2⁻²⁴: what covers must not vanish in
/// 16 bits, or the background would show where visibility has hidden all else; nor may the color of dark splats.
#[test]
fn small_filtered_splats_cover_in_16_bits_what_they_cover_in_32() {
    let mut headless = shared();
    let kernels = [
        Kernel::Gaussian { sigma: 0.5 },
        Kernel::Gaussian { sigma: 0.2 },
        Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 },
    ];
    for kernel in kernels {
        for filter in [Filter::Adjust, Filter::Ewa] {
            let hard = with(&scenes::subpixel_filtered(), |s| (s.kernel, s.filter) = (kernel, filter));
            if hard.settings.validate().is_err() {
                continue; // ewa adds the covariances of Gaussians
            }
            let in_32 = render(&mut headless, &hard);
            let in_16 = render(&mut headless, &with(&hard, |s| s.accumulate = Accumulate::F16));
            let covered = |weight: &[f32]| weight.iter().map(|weight| *weight > 0.0).collect::<Vec<_>>();
            assert!(covered(&in_32.weight) == covered(&in_16.weight), "{kernel:?} {filter:?}");
            assert!(in_32.weight.iter().filter(|weight| **weight > 0.0).count() > 10_000);
        }
    }
    // Isolated specks of linear 0.0015, 5 of 255 in sRGB, weigh 0.0085 at least: 214 steps of 2⁻²⁴ of color.
    let dark = 0.0015;
    let mut builder = Builder::default();
    for i in 0..64 {
        let at = |k: i32| 0.04 * f64::from(k) - 0.14 + 0.001 * f64::from(i);
        builder.disk(DVec3::new(at(i % 8), at(i / 8), 0.0), DVec3::Z, 1e-5, [dark, dark, dark, 1.0]);
    }
    let settings = Settings { size_px: [128, 128], accumulate: Accumulate::F16, ..settings() };
    let camera = camera([0.0, 0.0, 0.5], [0.0; 3]);
    let hard = Hard { name: "dark specks", scene: builder.scene(false), camera, settings };
    let frame = render(&mut headless, &hard);
    let covered: Vec<_> = (0..frame.weight.len()).filter(|i| frame.weight[*i] > 0.0).collect();
    assert!(covered.len() > 200, "{}", covered.len());
    for i in covered {
        // A step of color, by which the device may cut off, and as much again for two relative roundings.
        let error = (f64::from(frame.albedo[i][0]) / f64::from(dark) - 1.0).abs();
        assert!(error < 2.0 / 200.0, "pixel {i}: {error}");
    }
}

/// N13: identical splats at one place, a few pixels large.
fn identical(count: usize, color: [f32; 4], accumulate: Accumulate) -> Hard {
    let mut builder = Builder::default();
    for _ in 0..count {
        builder.disk(DVec3::ZERO, DVec3::Z, 0.04, color);
    }
    let settings = Settings { size_px: [32, 32], accumulate, ..settings() };
    let camera = camera([0.0, 0.0, 0.5], [0.0; 3]);
    Hard { name: "identical splats", scene: builder.scene(false), camera, settings }
}

/// How far the color of identical splats is off at most, in 255ths.
fn off(headless: &mut Headless, accumulate: Accumulate) -> f32 {
    let color = [0.9, 0.3, 0.011, 1.0];
    let frame = render(headless, &identical(2000, color, accumulate));
    let covered = (0..frame.weight.len()).filter(|i| frame.weight[*i] > 0.0);
    let channels = covered.flat_map(|i| (0..3).map(move |channel| (i, channel)));
    channels.map(|(i, channel)| 255.0 * (frame.albedo[i][channel] - color[channel]).abs()).fold(0.0, f32::max)
}

#[test]
fn by_default_2000_identical_splats_have_the_color_of_one() {
    let mut headless = shared();
    let [default, half] =
        [Settings::default().accumulate, Accumulate::F16].map(|accumulate| off(&mut headless, accumulate));
    println!("off by {default:.3}/255, with sums of 16 bits by {half:.3}/255");
    assert!(default <= 1.0 && half > 1.0, "{default} {half}");
}

#[test]
fn n13_the_color_of_identical_splats_is_that_of_one() {
    let mut headless = shared();
    let color = [0.9, 0.3, 0.011, 1.0];
    for count in [1_usize, 10, 100, 2047, 2048, 10_000, 100_000] {
        for accumulate in [Accumulate::F32, Accumulate::F16] {
            let frame = render(&mut headless, &identical(count, color, accumulate));
            let covered: Vec<_> = (0..frame.weight.len()).filter(|i| frame.weight[*i] > 0.0).collect();
            assert!(covered.len() > 20);
            let (mut error, mut ratio) = (0.0_f32, 1.0_f32);
            for &i in &covered {
                let finite = frame.albedo[i].iter().chain(&frame.normal[i]).all(|v| v.is_finite());
                assert!(finite && frame.weight[i].is_finite() && frame.depth[i].is_finite());
                for (got, color) in frame.albedo[i].iter().zip(&color[..3]) {
                    error = error.max((got - color).abs());
                    ratio = ratio.max((got / color).max(color / got));
                }
            }
            let in_255 = error * 255.0;
            println!(
                "{count:6} identical splats, {accumulate:?}: color off by {in_255:.3}/255, factor {ratio:.4}"
            );
            match accumulate {
                Accumulate::F32 | Accumulate::Auto => assert!(in_255 <= 1.0, "{count}: {in_255}/255"),
                // See the head of this file, here and below; 1% for the rounding of the summands themselves.
                Accumulate::F16 if count <= 10 => {
                    let relative = 2.0 * count as f32 / 1024.0;
                    assert!(ratio <= (1.0 + relative) / (1.0 - relative), "{count}: factor {ratio}");
                }
                Accumulate::F16 if count < 10_000 => assert!(ratio <= 3.03, "{count}: factor {ratio}"),
                Accumulate::F16 => assert!(ratio <= 2.02, "{count}: factor {ratio}"),
            }
        }
    }
}
