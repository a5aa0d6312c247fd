//! ꟻLIP: how much of a difference between two pictures a person sees who flips between them (Andersson, Nilsson,
//! Akenine-Möller, Oskarsson, Åström, Fairchild 2020), for pictures of a screen's range.
//!
//! A color part: both pictures as blurred as the eye blurs them at that distance, in a space where distances of colors
//! are what is seen of them. A feature part: edges and points that one picture has and the other does not, which
//! amplifies the first.

use super::{
    flip_color::{color_distance, from_opponent, opponent},
    flip_filter::{Plane, features, see},
};

/// Pixels in one degree of the view: a screen of 0.7 m and 3840 pixels across, seen from 0.7 m, as the paper's program has it.
pub(super) const PIXELS_PER_DEGREE: f64 = 3840.0 * std::f64::consts::PI / 180.0;

/// What the feature part is raised to.
const FEATURE_EXPONENT: f64 = 0.5;

/// The difference that is seen in each pixel, 0–1, between two pictures of `width` columns: linear red, green and blue (Rec. 709
/// primaries), of which what lies outside of 0–1 is cut off, as a screen does. It is the same either way round. A component that is no
/// number is the largest difference.
///
/// # Panics
/// If the pictures differ in length or are not whole rows.
pub fn flip(a: &[[f64; 3]], b: &[[f64; 3]], width: usize) -> Vec<f64> {
    assert!(a.len() == b.len() && (a.is_empty() || a.len().is_multiple_of(width)), "pictures of two sizes");
    let [seen_a, seen_b] = [a, b].map(|picture| Seen::of(picture, width));
    (0..a.len())
        .map(|i| {
            if a[i].iter().chain(&b[i]).any(|component| component.is_nan()) {
                return 1.0;
            }
            let color = color_distance(seen_a.color(i), seen_b.color(i));
            let [edge, point] = [0, 1].map(|of| (seen_a.features[of].0[i] - seen_b.features[of].0[i]).abs());
            let feature = (edge.max(point) / std::f64::consts::SQRT_2).powf(FEATURE_EXPONENT);
            color.powf(1.0 - feature)
        })
        .collect()
}

/// One picture as it is seen.
struct Seen {
    /// The blurred channels of the opponent space.
    channels: [Plane; 3],
    /// How much of an edge and of a point each pixel is.
    features: [Plane; 2],
}

impl Seen {
    fn of(picture: &[[f64; 3]], width: usize) -> Self {
        // A NaN has no place in a sum: it counts as 0 for its neighbors.
        let on_screen = |value: f64| if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) };
        let opponent: Vec<[f64; 3]> = picture.iter().map(|color| opponent(color.map(on_screen))).collect();
        let plane = |channel: usize| Plane(opponent.iter().map(|color| color[channel]).collect(), width);
        let luminance = Plane(opponent.iter().map(|color| (color[0] + 16.0) / 116.0).collect(), width);
        Self { channels: see([0, 1, 2].map(plane)), features: features(&luminance) }
    }

    /// The linear color that is seen at a pixel.
    fn color(&self, i: usize) -> [f64; 3] {
        let [y, x, z] = &self.channels;
        from_opponent([y.0[i], x.0[i], z.0[i]]).map(|component| component.clamp(0.0, 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [usize; 2] = [24, 16];

    fn picture(color: impl Fn(f64, f64) -> [f64; 3]) -> Vec<[f64; 3]> {
        let [width, height] = SIZE;
        (0..width * height).map(|i| color((i % width) as f64, (i / width) as f64)).collect()
    }

    fn mean(values: &[f64]) -> f64 {
        values.iter().sum::<f64>() / values.len() as f64
    }

    /// Means and single pixels that the authors' program finds for these pictures (flip_evaluator 1.7, `LDR`, linear input,
    /// 67 pixels a degree). It sums in f32, which leaves up to 6e-8 of a feature where there is none, and its root is an exponent
    /// that is 2.5e-4 too small: 1e-4 of a difference.
    #[test]
    fn the_values_are_those_of_the_authors_program() {
        let gray = |value: f64| picture(|_, _| [value; 3]);
        let edge = |at: f64| picture(|x, _| [if x < at { 0.0 } else { 1.0 }; 3]);
        let colors = picture(|x, y| [x / 23.0, y / 15.0, (x + y) / 38.0]);
        let turned = picture(|x, y| [y / 15.0, x / 23.0, 1.0 - (x + y) / 38.0]);
        let dot = picture(|x, y| if (x, y) == (12.0, 8.0) { [1.0, 0.0, 0.25] } else { [0.5; 3] });
        let primary = |color: [f64; 3]| picture(|_, _| color);
        let at = |x: usize, y: usize| y * SIZE[0] + x;
        let [corner, left, right, last] = [at(0, 0), at(11, 7), at(12, 8), at(23, 15)];
        for (name, a, b, expected, pixels) in [
            ("grays", gray(0.5), gray(0.6), 0.196_255, [(corner, 0.196_255), (last, 0.196_255)]),
            ("edge", edge(12.0), edge(13.0), 0.137_951, [(left, 0.772_917), (right, 0.538_265)]),
            ("colors", colors.clone(), turned.clone(), 0.884_781, [(left, 0.254_771), (right, 0.257_273)]),
            ("corners", colors, turned, 0.884_781, [(corner, 0.963_243), (last, 0.968_466)]),
            ("dot", gray(0.5), dot, 0.009_278_4, [(left, 0.177_830), (right, 0.312_658)]),
            (
                "green, blue",
                primary([0.0, 1.0, 0.0]),
                primary([0.0, 0.0, 1.0]),
                1.0,
                [(corner, 1.0), (last, 1.0)],
            ),
            ("black, white", gray(0.0), gray(1.0), 0.967_387, [(corner, 0.967_388), (last, 0.967_388)]),
        ] {
            let seen = flip(&a, &b, SIZE[0]);
            assert!((mean(&seen) - expected).abs() < 1e-4, "{name}: {} {expected}", mean(&seen));
            for (pixel, expected) in pixels {
                assert!((seen[pixel] - expected).abs() < 1e-4, "{name}, {pixel}: {} {expected}", seen[pixel]);
            }
            assert_eq!(seen, flip(&b, &a, SIZE[0]), "{name}");
        }
    }

    #[test]
    fn equal_pictures_differ_in_nothing_and_what_is_no_number_is_the_worst() {
        let own = picture(|x, y| [x / 23.0, y / 15.0, 2.0]);
        assert!(flip(&own, &own, SIZE[0]).iter().all(|value| *value == 0.0));
        let mut other = own.clone();
        other[0][1] = f64::NAN;
        let seen = flip(&own, &other, SIZE[0]);
        assert_eq!(seen[0], 1.0);
        assert!(seen.iter().all(|value| (0.0..=1.0).contains(value)));
        assert!(flip(&[], &[], 4).is_empty());
    }
}
