//! How far a picture is from a reference.

use serde::Serialize;

use super::{Surface, ssim};

/// The difference between two pictures of one size. Figures are over the pixels that both cover (at least by half),
/// save those that are left out; `None` where there is no such pixel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ErrorFigures {
    /// Pixels that both cover and that are compared.
    pub compared_px: u64,
    /// Pixels that one of them covers and that are left out, because rounding alone may turn them.
    pub left_out_px: u64,
    /// `left_out_px` as a share of all pixels that one of them covers.
    pub left_out_share: f64,
    /// Pixels covered in one and empty in the other, without those left out.
    pub coverage_px: u64,
    /// Linear color, all three components; white is 1.
    pub color: Option<Deviation>,
    /// The error of the linear color over one background, over all pixels in which either picture has anything, save those that are
    /// left out: what wrong and missing coverage costs is in it.
    pub image: Option<Deviation>,
    /// The error of the linear color in the pixels that are left out and both cover.
    pub left_out_color: Option<Deviation>,
    /// The error of the linear color in decibels below white: `−20 log10(rms)`. `None` where there is no difference.
    pub psnr_db: Option<f64>,
    /// Structural similarity of the whole pictures over one background, in gray: the mean over windows of 8×8 pixels;
    /// 1 for equal ones.
    pub ssim: Option<f64>,
    /// Degrees between the normals.
    pub normal_deg: Option<Deviation>,
    /// Depth, relative to the reference's.
    pub depth: Option<Deviation>,
}

/// The largest and the root of the mean square of many differences. Not finite where one of them is not.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Deviation {
    /// The largest.
    pub max: f64,
    /// The root of the mean square.
    pub rms: f64,
}

/// Sums up differences.
#[derive(Default)]
struct Deviations {
    max: f64,
    squares: f64,
    count: f64,
}

impl Deviations {
    fn add(&mut self, difference: f64) {
        // A NaN is the worst of all.
        let difference = if difference.is_nan() { f64::INFINITY } else { difference.abs() };
        self.max = self.max.max(difference);
        self.squares += difference * difference;
        self.count += 1.0;
    }

    fn all(&self) -> Option<Deviation> {
        (self.count > 0.0).then(|| Deviation { max: self.max, rms: (self.squares / self.count).sqrt() })
    }
}

/// Compares two pictures of one size. `left_out` has a value for each pixel, or none at all; `background` is linear and
/// matters for [`ErrorFigures::image`] and the structural similarity alone.
///
/// # Panics
/// If the sizes or the lengths of the arrays differ.
pub fn errors(
    picture: &Surface,
    reference: &Surface,
    left_out: &[bool],
    background: [f32; 3],
) -> ErrorFigures {
    assert_eq!(picture.size_px, reference.size_px, "pictures of two sizes");
    let (mut color, mut normal, mut depth) = <(Deviations, Deviations, Deviations)>::default();
    let (mut image, mut left_out_color) = <(Deviations, Deviations)>::default();
    let (mut compared_px, mut left_out_px, mut coverage_px, mut covered_px) = (0, 0, 0, 0_u64);
    for i in 0..reference.coverage.len() {
        let is_left_out = left_out.get(i).copied().unwrap_or(false);
        if !is_left_out && (picture.coverage[i] > 0.0 || reference.coverage[i] > 0.0) {
            let [own, expected] = [picture, reference].map(|surface| surface.over(i, background));
            for (own, expected) in own.iter().zip(expected) {
                image.add(f64::from(*own) - f64::from(expected));
            }
        }
        let covers = [picture.covers(i), reference.covers(i)];
        if covers == [false; 2] {
            continue;
        }
        covered_px += 1;
        let colors = if is_left_out { &mut left_out_color } else { &mut color };
        if covers == [true; 2] {
            for (own, expected) in picture.color[i].iter().zip(reference.color[i]) {
                colors.add(f64::from(*own) - f64::from(expected));
            }
        }
        if is_left_out {
            left_out_px += 1;
        } else if covers == [true; 2] {
            compared_px += 1;
            normal.add(degrees_between(picture.normal[i], reference.normal[i]));
            depth.add(f64::from(picture.depth[i]) / f64::from(reference.depth[i]) - 1.0);
        } else {
            coverage_px += 1;
        }
    }
    let color = color.all();
    let rms = color.map_or(0.0, |color| color.rms);
    ErrorFigures {
        compared_px,
        left_out_px,
        left_out_share: share(left_out_px, covered_px),
        coverage_px,
        color,
        image: image.all(),
        left_out_color: left_out_color.all(),
        psnr_db: (rms > 0.0 && rms.is_finite()).then(|| -20.0 * rms.log10()),
        ssim: ssim(picture, reference, background),
        normal_deg: normal.all(),
        depth: depth.all(),
    }
}

fn share(part: u64, all: u64) -> f64 {
    if all == 0 { 0.0 } else { part as f64 / all as f64 }
}

/// The angle between two vectors, exact for small angles too.
fn degrees_between(a: [f32; 3], b: [f32; 3]) -> f64 {
    let [a, b] = [a, b].map(|v| glam::Vec3::from(v).as_dvec3());
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One row; each pixel is (coverage, gray, normal, depth).
    fn row(pixels: &[(f32, f32, [f32; 3], f32)]) -> Surface {
        Surface {
            size_px: [u32::try_from(pixels.len()).unwrap(), 1],
            coverage: pixels.iter().map(|pixel| pixel.0).collect(),
            color: pixels.iter().map(|pixel| [pixel.1; 3]).collect(),
            normal: pixels.iter().map(|pixel| pixel.2).collect(),
            depth: pixels.iter().map(|pixel| pixel.3).collect(),
        }
    }

    const Z: [f32; 3] = [0.0, 0.0, -1.0];
    const WHITE: [f32; 3] = [1.0; 3];

    fn close(got: f64, expected: f64) {
        assert!((got - expected).abs() <= 1e-7 * expected.abs(), "{got}, expected {expected}");
    }

    #[test]
    fn figures_are_those_computed_by_hand() {
        let reference = row(&[(1.0, 0.5, Z, 2.0), (1.0, 0.5, Z, 4.0)]);
        let tilted = [0.0, 0.6, -0.8];
        let picture = row(&[(1.0, 0.5, tilted, 2.5), (1.0, 0.75, Z, 4.0)]);
        let figures = errors(&picture, &reference, &[], WHITE);
        let color = figures.color.unwrap();
        close(color.max, 0.25);
        // Three components of the six differ by 1/4: √(1/32).
        close(color.rms, (1.0_f64 / 32.0).sqrt());
        close(figures.psnr_db.unwrap(), 10.0 * 32.0_f64.log10());
        let angle = 0.6_f64.asin().to_degrees();
        close(figures.normal_deg.unwrap().max, angle);
        close(figures.normal_deg.unwrap().rms, angle / 2.0_f64.sqrt());
        close(figures.depth.unwrap().max, 0.25);
        close(figures.depth.unwrap().rms, 0.25 / 2.0_f64.sqrt());
        assert_eq!((figures.compared_px, figures.coverage_px, figures.left_out_px), (2, 0, 0));
    }

    #[test]
    fn equal_pictures_have_no_error_and_no_ratio_to_it() {
        let picture = row(&[(1.0, 0.5, Z, 2.0), (0.0, 0.0, [0.0; 3], f32::INFINITY)]);
        let figures = errors(&picture, &picture, &[], WHITE);
        let none = Some(Deviation { max: 0.0, rms: 0.0 });
        assert_eq!((figures.color, figures.normal_deg, figures.depth), (none, none, none));
        assert_eq!((figures.psnr_db, figures.ssim), (None, Some(1.0)));
        assert_eq!(figures.compared_px, 1);
    }

    #[test]
    fn coverage_is_judged_at_one_half() {
        let surface = |coverages: &[f32]| {
            row(&coverages.iter().map(|&coverage| (coverage, 0.5, Z, 1.0)).collect::<Vec<_>>())
        };
        let picture = surface(&[0.0, 1.0, 0.0, 1.0, 0.0, 1.0]);
        let truth = surface(&[0.49, 0.49, 0.5, 0.5, 0.0, 1.0]);
        let figures = errors(&picture, &truth, &[], WHITE);
        // The second is covered and should be empty, the third is empty and should be covered.
        assert_eq!((figures.coverage_px, figures.compared_px), (2, 2));
    }

    #[test]
    fn what_is_left_out_counts_for_nothing_but_its_share() {
        let reference =
            row(&[(1.0, 0.5, Z, 1.0), (1.0, 0.5, Z, 1.0), (0.0, 0.0, Z, 1.0), (0.0, 0.0, Z, 1.0)]);
        let picture = row(&[(1.0, 0.9, Z, 9.0), (1.0, 0.5, Z, 1.0), (1.0, 0.0, Z, 1.0), (0.0, 0.0, Z, 1.0)]);
        let figures = errors(&picture, &reference, &[true, false, true, true], WHITE);
        assert_eq!((figures.left_out_px, figures.compared_px, figures.coverage_px), (2, 1, 0));
        close(figures.left_out_share, 2.0 / 3.0);
        assert_eq!(figures.color, Some(Deviation { max: 0.0, rms: 0.0 }));
        close(figures.left_out_color.unwrap().rms, f64::from(0.9_f32 - 0.5));
    }

    #[test]
    fn the_image_counts_what_is_covered_by_either_over_the_background() {
        // Half covered by black over white is 0.5, which a full gray matches; one covered pixel too many, black on white.
        let reference =
            row(&[(0.5, 0.0, Z, 1.0), (0.0, 0.0, Z, f32::INFINITY), (0.0, 0.0, Z, f32::INFINITY)]);
        let picture = row(&[(1.0, 0.5, Z, 1.0), (1.0, 0.0, Z, 1.0), (0.0, 0.0, Z, f32::INFINITY)]);
        let image = errors(&picture, &reference, &[], WHITE).image.unwrap();
        close(image.max, 1.0);
        close(image.rms, 0.5_f64.sqrt());
    }

    #[test]
    fn values_that_are_no_numbers_are_the_worst() {
        let reference = row(&[(1.0, 0.5, Z, 1.0), (1.0, 0.5, Z, 1.0)]);
        let picture = row(&[(1.0, f32::NAN, [f32::NAN; 3], f32::NAN), (1.0, 0.5, Z, 1.0)]);
        let figures = errors(&picture, &reference, &[], WHITE);
        for deviation in [figures.color, figures.normal_deg, figures.depth] {
            assert_eq!(deviation, Some(Deviation { max: f64::INFINITY, rms: f64::INFINITY }));
        }
        assert_eq!(figures.psnr_db, None);
    }

    #[test]
    fn without_a_common_pixel_there_are_no_figures() {
        let figures = errors(&row(&[(1.0, 0.5, Z, 1.0)]), &row(&[(0.0, 0.0, Z, f32::INFINITY)]), &[], WHITE);
        assert_eq!(
            (figures.color, figures.depth, figures.compared_px, figures.coverage_px),
            (None, None, 0, 1)
        );
    }
}
