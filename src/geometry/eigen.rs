//! Eigenvalues and eigenvectors of symmetric 3×3 matrices: Jacobi's rotations (1846), cyclic, as in Golub and Van Loan, "Matrix
//! Computations", section 8.5. Accurate also where the matrix has rank 1 or 0, which closed forms are not.

use glam::{DMat3, DVec3};

/// Each sweep squares what is left beside the diagonal; a fifth finds nothing left in f64.
const MOST_SWEEPS: usize = 12;

/// Eigenvalues, rising, and their unit eigenvectors. NaN in, NaN or anything out.
pub(crate) fn eigen(matrix: &DMat3) -> ([f64; 3], [DVec3; 3]) {
    let mut a = matrix.transpose().to_cols_array_2d();
    let mut vectors = [DVec3::X, DVec3::Y, DVec3::Z];
    for _ in 0..MOST_SWEEPS {
        let beside = a[0][1] * a[0][1] + a[0][2] * a[0][2] + a[1][2] * a[1][2];
        let along = a[0][0] * a[0][0] + a[1][1] * a[1][1] + a[2][2] * a[2][2];
        if beside <= 1e-32 * along || !beside.is_finite() {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            rotate(&mut a, &mut vectors, p, q);
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a[i][i].total_cmp(&a[j][j]));
    (order.map(|i| a[i][i]), order.map(|i| vectors[i]))
}

/// Newton's steps after which nothing is left of the least root's error, where [`FLAT`] holds.
const STEPS: usize = 5;

/// The least eigenvalue over the middle one up to which [`flat`] answers, and the middle over the largest from which on.
const FLAT: f64 = 0.25;
const WIDE: f64 = 0.01;

/// Eigenvalues, rising, and the least one's unit eigenvector of a positive matrix that is flat and wide, in a fourth of the time; `None` of others.
///
/// The least root of the characteristic polynomial λ³ − tλ² + pλ − d is found by Newton's steps from 0, which stay below it; rounding leaves 1e-16 of
/// the largest, so 1e-14 of the middle. The adjugate of A − λ is the other two eigenvalues' product times n nᵀ.
pub(super) fn flat(matrix: &DMat3) -> Option<([f64; 3], DVec3)> {
    let trace = matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z;
    let by = trace.recip();
    if !by.is_normal() {
        return None;
    }
    let minors =
        |[xx, xy, xz, yy, yz, zz]: [f64; 6]| [yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy];
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = (*matrix * by).transpose().to_cols_array_2d();
    let of = minors([xx, xy, xz, yy, yz, zz]);
    let pairs = of[0] + of[1] + of[2];
    let determinant = xx * of[0] + xy * (xz * yz - xy * zz) + xz * (xy * yz - xz * yy);
    let mut least = 0.0;
    for _ in 0..STEPS {
        let value = ((least - 1.0) * least + pairs) * least - determinant;
        least -= value / ((3.0 * least - 2.0) * least + pairs);
    }
    // The other two have this sum and product.
    let (sum, product) = (1.0 - least, pairs - least * (1.0 - least));
    let most = 0.5 * (sum + (sum * sum - 4.0 * product).max(0.0).sqrt());
    let middle = product / most;
    if !(least <= FLAT * middle && middle >= WIDE * most) {
        return None;
    }
    let [xx, yy, zz] = [xx - least, yy - least, zz - least];
    let [x, y, z] = minors([xx, xy, xz, yy, yz, zz]);
    let (of_xy, of_xz, of_yz) = (xz * yz - xy * zz, xy * yz - xz * yy, xy * xz - xx * yz);
    let along = if x >= y && x >= z {
        DVec3::new(x, of_xy, of_xz)
    } else if y >= z {
        DVec3::new(of_xy, y, of_yz)
    } else {
        DVec3::new(of_xz, of_yz, z)
    };
    Some(([least, middle, most].map(|value| value * trace), along.normalize()))
}

/// The rotation of axes p and q that makes `a[p][q]` zero.
fn rotate(a: &mut [[f64; 3]; 3], vectors: &mut [DVec3; 3], p: usize, q: usize) {
    if a[p][q] == 0.0 {
        return;
    }
    let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    // The smaller root of t² + 2θt − 1 = 0; where θ overflows it is 0.
    let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    let cos = 1.0 / (t * t + 1.0).sqrt();
    let sin = t * cos;
    let r = 3 - p - q;
    let (apr, aqr) = (a[p][r], a[q][r]);
    a[p][p] -= t * a[p][q];
    a[q][q] += t * a[p][q];
    (a[p][q], a[q][p]) = (0.0, 0.0);
    a[p][r] = cos * apr - sin * aqr;
    a[q][r] = sin * apr + cos * aqr;
    (a[r][p], a[r][q]) = (a[p][r], a[q][r]);
    let (vp, vq) = (vectors[p], vectors[q]);
    vectors[p] = cos * vp - sin * vq;
    vectors[q] = sin * vp + cos * vq;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix;

    #[test]
    fn vectors_are_unit_orthogonal_and_scaled_by_their_values() {
        let mut random = SplitMix(3);
        let mut unit = move || 2.0 * random.unit() - 1.0;
        for i in 0..300 {
            let scale = 10.0_f64.powi(i % 21 - 10);
            let mut column = || scale * DVec3::new(unit(), unit(), unit());
            // Rank 1, 2 and 3.
            let columns: Vec<DVec3> = (0..=i % 3).map(|_| column()).collect();
            let outer = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
            let matrix = columns.iter().fold(DMat3::ZERO, |sum, &v| sum + outer(v));
            let (values, vectors) = eigen(&matrix);
            let size = values[2].abs();
            assert!(values[0] <= values[1] && values[1] <= values[2], "{values:?}");
            for (value, vector) in values.into_iter().zip(vectors) {
                assert!((vector.length() - 1.0).abs() < 1e-12, "{vector}");
                assert!((matrix * vector - value * vector).length() < 1e-13 * size, "{matrix} {value}");
            }
            assert!(vectors[0].cross(vectors[1]).dot(vectors[2]).abs() > 1.0 - 1e-12);
        }
        assert_eq!(eigen(&DMat3::ZERO).0, [0.0; 3]);
        let _ = eigen(&DMat3::from_cols(DVec3::NAN, DVec3::X, DVec3::INFINITY));
    }
    #[test]
    fn flat_matrices_have_the_values_and_the_normal_that_rotations_find() {
        let mut random = SplitMix(5);
        let mut answered = 0;
        for i in 0..3000 {
            let mut unit = || 2.0 * random.unit() - 1.0;
            let scale = 10.0_f64.powi(i % 241 - 120);
            let [u, v, w] = [0; 3].map(|_| DVec3::new(unit(), unit(), unit()));
            let thickness = [0.0, 1e-8, 1e-3, 0.1, 0.3, 0.5, 1.0][i as usize % 7];
            let outer = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
            let matrix = (outer(u) + outer(v) + outer(thickness * w)) * scale;
            let (values, vectors) = eigen(&matrix);
            let is_flat = values[0] <= 0.999 * FLAT * values[1] && values[1] >= 1.001 * WIDE * values[2];
            let is_not = values[0] >= 1.001 * FLAT * values[1] || values[1] <= 0.999 * WIDE * values[2];
            let Some((found, normal)) = flat(&matrix) else {
                assert!(!is_flat, "{values:?}");
                continue;
            };
            assert!(!is_not, "{values:?}");
            answered += 1;
            for (one, other) in found.into_iter().zip(values) {
                // Of two that are nearly equal the square root of rounding tells them apart.
                assert!((one - other).abs() <= 1e-7 * values[2], "{found:?} {values:?}");
            }
            assert!((found[0] - values[0]).abs() <= 1e-14 * values[2], "{found:?} {values:?}");
            assert!(normal.cross(vectors[0]).length() < 1e-12, "{values:?}: {normal} {}", vectors[0]);
        }
        assert!(answered > 1000, "{answered}");
        let diagonal = |x, y, z| DMat3::from_diagonal(DVec3::new(x, y, z));
        assert_eq!(flat(&diagonal(2.0, 0.0, 2.0)), Some(([0.0, 2.0, 2.0], DVec3::Y)));
        for none in [diagonal(1.0, 0.0, 0.0), diagonal(1.0, 1.0, 1.0), diagonal(0.0, 0.0, 0.0)] {
            assert_eq!(flat(&none), None);
        }
        assert_eq!(flat(&DMat3::from_cols(DVec3::NAN, DVec3::X, DVec3::INFINITY)), None);
        assert_eq!(flat(&diagonal(f64::MAX, f64::MAX, 0.0)), None, "whose sum overflows");
    }
}
