//! Curves that bring linear light of any brightness to what a screen shows, linear light from 0 to 1.

use glam::{DMat3, DVec3};

/// ACES as Stephen Hill fitted its reference rendering transform and output transform for sRGB screens (BakingLab, 2016). Color
/// shifts to white where it is bright; 0.18 becomes 0.11, 1 becomes 0.62.
pub fn aces(color: [f64; 3]) -> [f64; 3] {
    // From Rec. 709 to the space of the transforms, and back; both are rows.
    const INTO: [[f64; 3]; 3] =
        [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]];
    const OUT: [[f64; 3]; 3] =
        [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]];
    let fitted = |v: f64| {
        let v = v.min(BRIGHTEST);
        (v * (v + 0.024_578_6) - 0.000_090_537) / (v * (0.983_729 * v + 0.432_951) + 0.238_081)
    };
    times(OUT, times(INTO, color.map(bright)).map(fitted)).map(|component| component.clamp(0.0, 1.0))
}

/// AgX (Troy Sobotka 2022) with the polynomial that Benjamin Wrensch fitted to its base contrast (2023). Bright colors fade to
/// white without a change of hue; 0.18 becomes 0.21, half of what a screen of gamma 2.2 is told.
pub fn agx(color: [f64; 3]) -> [f64; 3] {
    // By rows; published by columns.
    const INTO: [[f64; 3]; 3] = [
        [0.842_479_062_253_094, 0.078_433_599_999_999_2, 0.079_223_745_147_764_3],
        [0.042_328_242_261_012_3, 0.878_468_636_469_772, 0.079_166_127_460_543_4],
        [0.042_375_654_905_705_1, 0.078_433_6, 0.879_142_973_793_104],
    ];
    const OUT: [[f64; 3]; 3] = [
        [1.196_879_005_120_17, -0.098_020_881_140_136_8, -0.099_029_744_079_720_5],
        [-0.052_896_851_757_456_2, 1.151_903_129_904_17, -0.098_961_176_844_843_3],
        [-0.052_971_635_514_443_8, -0.098_043_450_117_124_1, 1.151_073_672_641_16],
    ];
    const STOPS: [f64; 2] = [-12.473_93, 4.026_069];
    let logarithmic = |v: f64| (v.log2().clamp(STOPS[0], STOPS[1]) - STOPS[0]) / (STOPS[1] - STOPS[0]);
    let contrast = |x: f64| {
        let coefficients = [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232];
        coefficients.iter().fold(0.0, |sum, coefficient| sum * x + coefficient)
    };
    let shown = times(INTO, color.map(bright)).map(logarithmic).map(contrast);
    // It ends in a screen's own 2.2.
    times(OUT, shown).map(|component| component.clamp(0.0, 1.0).powf(2.2))
}

/// Beyond it, every curve is flat.
const BRIGHTEST: f64 = 1e12;

/// Light is at least 0; NaN is none.
fn bright(component: f64) -> f64 {
    if component > 0.0 { component.min(BRIGHTEST) } else { 0.0 }
}

fn times(rows: [[f64; 3]; 3], color: [f64; 3]) -> [f64; 3] {
    (DMat3::from_cols_array_2d(&rows).transpose() * DVec3::from(color)).to_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_close(got: [f64; 3], expected: [f64; 3], within: f64) {
        let close = got.iter().zip(expected).all(|(a, b)| (a - b).abs() <= within);
        assert!(close, "{got:?}, expected {expected:?}");
    }

    #[test]
    fn aces_is_the_fit_by_hand() {
        // The matrices' rows sum to 1: gray stays gray, and is what the fraction makes of it.
        for gray in [0.0_f64, 0.01, 0.18, 1.0, 4.0] {
            let above = gray * (gray + 0.0245786) - 0.000090537;
            let expected = (above / (gray * (0.983729 * gray + 0.4329510) + 0.238081)).max(0.0);
            assert_close(aces([gray; 3]), [expected.min(1.0); 3], 2e-5);
        }
        assert_close(aces([1.0; 3]), [0.61912; 3], 5e-5);
        // Red is shifted to orange and keeps some of every component.
        let [red, green, blue] = aces([4.0, 0.0, 0.0]);
        assert!(red > 0.8 && green > 0.05 && blue > 0.02 && green < red, "{red} {green} {blue}");
    }

    #[test]
    fn agx_keeps_gray_and_hue_and_ends_in_white() {
        assert_close(agx([0.18; 3]), [0.4968_f64.powf(2.2); 3], 1e-3);
        assert_close(agx([0.0; 3]), [0.0; 3], 1e-5);
        // The brightest stop of 16.5, and all beyond it, is white but for the polynomial's error.
        assert_close(agx([2.0_f64.powf(4.026_069); 3]), [1.0; 3], 0.01);
        assert_eq!(agx([1e9; 3]), agx([1e300; 3]));
        let [red, green, blue] = agx([2.0, 0.02, 0.02]);
        assert!(red > 2.0 * green && (green - blue).abs() < 0.01, "{red} {green} {blue}");
    }

    #[test]
    fn brighter_is_never_darker_and_all_is_on_the_screen() {
        for curve in [aces, agx] {
            let mut before = -1.0;
            for step in 0..200 {
                let [shown, ..] = curve([10.0_f64.powf(f64::from(step) / 25.0 - 4.0); 3]);
                assert!(shown >= before - 1e-9 && (0.0..=1.0).contains(&shown), "{step}: {before} {shown}");
                before = shown;
            }
            for strange in [f64::NAN, f64::INFINITY, -1.0, -f64::INFINITY] {
                let shown = curve([strange, 0.5, 0.5]);
                assert!(
                    shown.iter().all(|component| (0.0..=1.0).contains(component)),
                    "{strange}: {shown:?}"
                );
            }
        }
    }
}
