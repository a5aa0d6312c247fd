//! How far pictures are off near edges of a mesh, and elsewhere.

use super::SIDE;

/// Pixels within so many of an edge are near it.
const BAND: i64 = 2;

/// Cosine of the angle between normals beside each other from which an edge is between them.
const EDGE: f32 = 0.94;

/// Pixels near a crease or silhouette, of a picture of normals.
pub(super) fn band(normals: &[[f32; 4]]) -> Vec<bool> {
    let side = SIDE as i64;
    let differ = |a: usize, b: usize| {
        let [a, b] =
            [normals[a], normals[b]].map(|[x, y, z, alpha]| (glam::Vec3::new(x, y, z) * 2.0 - 1.0, alpha));
        (a.1 > 0.5) != (b.1 > 0.5) || a.1 > 0.5 && a.0.normalize_or_zero().dot(b.0.normalize_or_zero()) < EDGE
    };
    let mut near = vec![false; normals.len()];
    for y in 0..side - 1 {
        for x in 0..side - 1 {
            let at = (y * side + x) as usize;
            if differ(at, at + 1) || differ(at, at + SIDE) {
                for (dx, dy) in (-BAND..=BAND).flat_map(|dx| (-BAND..=BAND).map(move |dy| (dx, dy))) {
                    let (x, y) = ((x + dx).clamp(0, side - 1), (y + dy).clamp(0, side - 1));
                    near[(y * side + x) as usize] = true;
                }
            }
        }
    }
    near
}

/// Sums of squares over white, and pixels: near edges, and elsewhere where anything is.
#[derive(Default)]
pub(super) struct Sums([(f64, usize); 2]);

impl Sums {
    pub fn add(&mut self, own: &[[f32; 4]], truth: &[[f32; 4]], near: &[bool]) {
        let over_white = |pixel: &[f32; 4], i: usize| f64::from(pixel[3] * pixel[i] + 1.0 - pixel[3]);
        for ((own, truth), near) in own.iter().zip(truth).zip(near) {
            if *near || own[3] > 0.0 || truth[3] > 0.0 {
                let sum = &mut self.0[usize::from(!near)];
                sum.0 +=
                    (0..3).map(|i| (over_white(own, i) - over_white(truth, i)).powi(2)).sum::<f64>() / 3.0;
                sum.1 += 1;
            }
        }
    }

    pub fn rms(&self) -> [f64; 2] {
        self.0.map(|(sum, count)| (sum / count.max(1) as f64).sqrt())
    }
}
