//! A corner's cell: the part of a triangle that is nearer to it than to the other two. A vertex's disk must cover its cells; then
//! every point of the surface is covered by the disk of its nearest corner.

use glam::DVec3;

/// The corners of the cell of corner `place`, in order; it is convex. The first is the corner itself.
pub(super) fn cell(p: [DVec3; 3], place: usize) -> Vec<DVec3> {
    let own = p[place];
    let (next, last) = (p[(place + 1) % 3], p[(place + 2) % 3]);
    let mut polygon = vec![own, next, last];
    for other in [next, last] {
        let middle = 0.5 * (own + other);
        // How far beyond the plane halfway to the other corner, times the distance to that.
        let beyond = |point: DVec3| (point - middle).dot(other - own);
        let mut clipped = Vec::with_capacity(5);
        for (i, &from) in polygon.iter().enumerate() {
            let to = polygon[(i + 1) % polygon.len()];
            let (start, end) = (beyond(from), beyond(to));
            if start <= 0.0 {
                clipped.push(from);
            }
            if (start < 0.0 && end > 0.0) || (start > 0.0 && end < 0.0) {
                clipped.push(from.lerp(to, start / (start - end)));
            }
        }
        polygon = clipped;
    }
    polygon
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of the triangle are nearest to a corner exactly where its cell has them.
    #[test]
    fn cells_are_the_points_nearest_to_each_corner() {
        let triangles = [
            [DVec3::ZERO, DVec3::X, DVec3::new(0.5, 0.8, 0.3)],
            [DVec3::ZERO, DVec3::X, DVec3::new(0.4, 0.1, 0.0)],
            [DVec3::new(0.9, 0.05, 0.0), DVec3::ZERO, DVec3::X],
        ];
        for p in triangles {
            let normal = (p[1] - p[0]).cross(p[2] - p[0]).normalize();
            let cells = [0, 1, 2].map(|place| cell(p, place));
            for place in 0..3 {
                assert_eq!(cells[place][0], p[place]);
            }
            for (i, j) in (0..40).flat_map(|i| (0..40 - i).map(move |j| (i, j))) {
                let q = p[0]
                    + (f64::from(i) + 0.31) / 41.0 * (p[1] - p[0])
                    + (f64::from(j) + 0.27) / 41.0 * (p[2] - p[0]);
                let distances = p.map(|corner| corner.distance(q));
                let nearest = (0..3).min_by(|a, b| distances[*a].total_cmp(&distances[*b])).unwrap();
                for (place, cell) in cells.iter().enumerate() {
                    let sides = cell.iter().zip(cell.iter().cycle().skip(1)).take(cell.len());
                    let inside =
                        sides.map(|(a, b)| (*b - *a).cross(q - *a).dot(normal)).all(|area| area >= -1e-12);
                    assert_eq!(inside, place == nearest, "{p:?} {q} {place}");
                }
            }
        }
    }
}
