//! How much a surface overlaps itself: the sum of weights that splats leave inside of it, by which `glsl/inc/edges.glsl` tells what part of a
//! pixel it covers.

use glam::{DVec2, DVec3};

use super::clip::removes;
use crate::scene::{Shapes, Splats};

/// Splats at whose centers it is looked for.
const SAMPLES: usize = 512;

/// The standard deviation of the weights, Gaussian and cut off at 1, in radii.
const SIGMA: f64 = 0.5;

/// A place on the surface.
struct Sample {
    position: DVec3,
    normal: DVec3,
    weight: f64,
}

/// The median of what an object's splats find at their centers of Σ exp(−2 (u² + v²)), with the splat itself, over those that face the same
/// way and whose disks are there, not cut off: no farther above or below than their major radius. 1 or more; 1 of nothing.
pub fn overlap(splats: &Splats) -> f64 {
    let count = splats.len();
    let places = (0..count.min(SAMPLES)).map(|i| i * count / count.min(SAMPLES));
    let mut samples: Vec<_> = places
        .filter(|&i| splats.defect(i).is_none() && !removes(&splats.clips.get(i), DVec2::ZERO))
        .map(|i| Sample { position: splats.positions[i], normal: frame(splats, i)[2], weight: 0.0 })
        .collect();
    samples.sort_unstable_by(|a, b| a.position.x.total_cmp(&b.position.x));
    for i in (0..count).filter(|&i| splats.defect(i).is_none()) {
        let (center, reach) = (splats.positions[i], splats.major_radius(i));
        let first = samples.partition_point(|sample| sample.position.x < center.x - reach);
        let near = samples[first..].iter_mut().take_while(|sample| sample.position.x <= center.x + reach);
        for sample in near.filter(|sample| (sample.position - center).abs().max_element() <= reach) {
            let [to_u, to_v, normal] = frame(splats, i);
            let from_center = sample.position - center;
            let place = DVec2::new(from_center.dot(to_u), from_center.dot(to_v));
            let covers = place.length_squared() <= 1.0 && !removes(&splats.clips.get(i), place);
            if covers && normal.dot(sample.normal) > 0.0 {
                sample.weight += (-place.length_squared() / (2.0 * SIGMA * SIGMA)).exp();
            }
        }
    }
    let mut weights: Vec<_> = samples.iter().map(|sample| sample.weight).collect();
    weights.sort_unstable_by(f64::total_cmp);
    weights.get(weights.len() / 2).map_or(1.0, |weight| weight.max(1.0))
}

/// What gives u and v of a place when it is multiplied by them, counted from the center of splat `i`; and the unit normal.
fn frame(splats: &Splats, i: usize) -> [DVec3; 3] {
    let [s, t] = match &splats.shapes {
        Shapes::Disks { normals, radii } => {
            let (s, t) = normals[i].as_dvec3().normalize().any_orthonormal_pair();
            [s, t].map(|axis| axis * f64::from(radii[i]))
        }
        Shapes::Ellipses { s, t } => [s[i].as_dvec3(), t[i].as_dvec3()],
    };
    let normal = match &splats.shapes {
        Shapes::Disks { normals, .. } => normals[i].as_dvec3().normalize(),
        Shapes::Ellipses { .. } => s.cross(t).normalize(),
    };
    // The dual basis in the plane.
    let area = s.cross(t).dot(normal);
    [t.cross(normal) / area, normal.cross(s) / area, normal]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Colors;
    use glam::Vec3;

    /// A square grid of disks in the plane z = 0, with a second one close below that faces the other way.
    fn plate(radius: f32) -> Splats {
        let grid = (0..60).flat_map(|x| (0..60).map(move |y| DVec3::new(f64::from(x), f64::from(y), 0.0)));
        let mut positions: Vec<_> = grid.collect();
        let side = positions.len();
        positions.extend(positions.clone().iter().map(|p| *p - 0.1 * DVec3::Z));
        let normals = (0..2 * side).map(|i| if i < side { Vec3::Z } else { -Vec3::Z }).collect();
        let shapes = Shapes::Disks { normals, radii: vec![radius; 2 * side] };
        Splats::new(positions, shapes, Colors::Uniform([1.0; 4]))
    }

    #[test]
    fn a_grid_overlaps_by_the_sum_of_its_weights_on_its_own_side_alone() {
        let sum = |radius: f64| -> f64 {
            let places =
                (-9..=9).flat_map(|x| (-9..=9).map(move |y| f64::from(x * x + y * y) / radius.powi(2)));
            places.filter(|r2| *r2 <= 1.0).map(|r2| (-2.0 * r2).exp()).sum()
        };
        for radius in [0.5, 1.5, 2.75] {
            let found = overlap(&plate(radius as f32));
            // At the rim of the plate there is less, but of few.
            assert!((found - sum(radius)).abs() < 1e-9, "{found} {}", sum(radius));
        }
        assert_eq!(overlap(&plate(0.5)), 1.0);
    }

    #[test]
    fn ellipses_in_any_frame_overlap_as_the_disks_that_they_are() {
        let disks = plate(1.5);
        let (s, t) = (Vec3::new(1.2, 0.9, 0.0), Vec3::new(-0.9, 1.2, 0.0));
        let Shapes::Disks { normals, .. } = &disks.shapes else { unreachable!("a plate is of disks") };
        let up = |normal: &Vec3| normal.z > 0.0;
        let shapes = Shapes::Ellipses {
            s: normals.iter().map(|normal| if up(normal) { s } else { t }).collect(),
            t: normals.iter().map(|normal| if up(normal) { t } else { s }).collect(),
        };
        let ellipses = Splats { shapes, ..disks.clone() };
        assert!((overlap(&ellipses) - overlap(&disks)).abs() < 1e-6);
    }

    #[test]
    fn nothing_and_one_splat_overlap_by_one() {
        let none = Splats::new(
            Vec::new(),
            Shapes::Disks { normals: Vec::new(), radii: Vec::new() },
            Colors::Uniform([1.0; 4]),
        );
        assert_eq!(overlap(&none), 1.0);
        let mut one = plate(1.0);
        one.keep(&[vec![true], vec![false; 2 * 3600 - 1]].concat());
        assert_eq!(overlap(&one), 1.0);
    }
}
