//! Eigenvalues and eigenvectors of symmetric 3×3 matrices: Jacobi's rotations (1846), cyclic, as in Golub and Van Loan, "Matrix
//! Computations", section 8.5. Accurate also where the matrix has rank 1 or 0, which closed forms are not.

use glam::{DMat3, DVec3};

/// Each sweep squares what is left beside the diagonal; a fifth finds nothing left in f64.
const MOST_SWEEPS: usize = 12;

/// Eigenvalues, rising, and their unit eigenvectors. NaN in, NaN or anything out.
pub(super) fn eigen(matrix: &DMat3) -> ([f64; 3], [DVec3; 3]) {
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
}
