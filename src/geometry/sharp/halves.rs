//! Triangles that are cut in two, where one ellipse can't be cut at all ridges that cross it.

use glam::DVec3;

use super::conic::Conic;

/// A triangle, or what is left of one that was cut.
pub(super) struct Part {
    pub p: [DVec3; 3],
    /// Of ridges, from each corner to the next.
    pub curves: [Option<Conic>; 3],
}

/// Cut across the longest side, in the plane. Where that is a ridge, in the middle of its curve: an ellipse through the middle of its chord would not reach so far.
pub(super) fn halves(Part { p, curves }: &Part, normal: DVec3) -> [Part; 2] {
    let side = |i: usize| p[i].distance_squared(p[(i + 1) % 3]);
    let i = (0..3).max_by(|a, b| side(*a).total_cmp(&side(*b))).unwrap_or(0);
    let turned = [0, 1, 2].map(|step| (i + step) % 3);
    let ([a, b, c], [cut, of_b, of_c]) = (turned.map(|i| p[i]), turned.map(|i| curves[i]));
    let middle = cut.map_or(0.5 * (a + b), |curve| {
        let middle = curve.point(0.5);
        middle - (middle - a).dot(normal) * normal
    });
    let [first, second] = [[0.0, 0.5], [0.5, 1.0]].map(|[from, to]| cut?.part(from, to));
    [
        Part { p: [a, middle, c], curves: [first, None, of_c] },
        Part { p: [middle, b, c], curves: [second, of_b, None] },
    ]
}
