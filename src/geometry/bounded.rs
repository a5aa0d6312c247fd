//! An ellipse that covers a vertex's cells and ends where the surface turns.
//!
//! **The rule.** In the plane of the splat, the cells' extent (seen along each face's normal) is known, and so are the lines at
//! which the surface turns. Across the nearest of them the ellipse reaches from `overlap` times the cells' extent on the
//! inner side to the line; along it, `overlap` times the cells' extent. Then its half axis across grows, at the side
//! where that is needed, until all cells are covered: an ellipse that ends on a straight line covers it in a point, so
//! that it stands out by `b (1 − √(1 − x²/a²))` where it must cover the line up to x. Its center is wherever these
//! extents have their middle, and not at the vertex.

use glam::DVec2;

/// A line in a splat's plane at which the surface turns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limit {
    /// Unit, away from the surface.
    pub outward: DVec2,
    /// How far the line is from the vertex; 0 where the vertex is on it.
    pub distance: f64,
}

/// An ellipse in the splat's plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ellipse {
    /// Of its center, from the vertex.
    pub center: DVec2,
    /// Unit, across the limit; the other axis is `axis` turned by −90°.
    pub across: DVec2,
    /// Half axes along and across the limit.
    pub half: DVec2,
}

/// How much larger the cells are taken than they are, around their middle: a bent one needs more where its faces aren't seen
/// along their normals.
const MARGIN: f64 = 1.15;

/// How far the ellipse reaches along the limit at least, in extents of the cells: its height there is half of that in
/// the middle, so that covering the cells' corners costs no more than twice.
const LEAST_ALONG: f64 = 1.15;

/// The ellipse for cells with these corners, around a vertex at the origin; `None` where none is found.
pub(super) fn ellipse(cells: &[DVec2], limits: &[Limit], overlap: f64) -> Option<Ellipse> {
    let across = direction(limits)?;
    let along = DVec2::new(across.y, -across.x);
    let middle = cells.iter().sum::<DVec2>() / cells.len() as f64;
    let larger = |p: &DVec2| middle + MARGIN * (p - middle);
    let turned = |p: DVec2| DVec2::new(p.dot(along), p.dot(across));
    let points: Vec<DVec2> = cells.iter().map(larger).map(turned).collect();
    let low = points.iter().copied().fold(DVec2::ZERO, DVec2::min);
    let high = points.iter().copied().fold(DVec2::ZERO, DVec2::max);
    let (mut from, mut to) = (overlap * low, overlap * high);
    for limit in limits {
        let share = DVec2::new(limit.outward.dot(along), limit.outward.dot(across));
        for axis in 0..2 {
            // A line that is oblique to both axes bounds neither alone.
            if share[axis].abs() > 0.5 && (axis == 1 || share[axis].abs() > 0.86) {
                let at = limit.distance / share[axis];
                if at >= 0.0 && share[axis] > 0.0 {
                    to[axis] = to[axis].min(at);
                } else {
                    from[axis] = from[axis].max(at);
                }
            }
        }
    }
    let center = 0.5 * (from.x + to.x);
    let farthest = points.iter().map(|p| (p.x - center).abs()).fold(0.0, f64::max);
    let half = (0.5 * (to.x - from.x)).max(LEAST_ALONG * farthest);
    let (from, to) = cover(&points, center, half, from.y, to.y)?;
    let y = 0.5 * (from + to);
    Some(Ellipse { center: center * along + y * across, across, half: DVec2::new(half, 0.5 * (to - from)) })
}

/// Across which line the ellipse ends: what the lines through the vertex leave on their whole, or else the nearest.
fn direction(limits: &[Limit]) -> Option<DVec2> {
    let nearest = limits.iter().min_by(|a, b| a.distance.total_cmp(&b.distance))?;
    let through = limits.iter().filter(|limit| limit.distance <= 0.0);
    let sum: DVec2 = through.map(|limit| limit.outward).sum();
    // Two that are opposite, as of a strip, have no sum.
    Some(if sum.length() > 0.2 { sum.normalize() } else { nearest.outward })
}

/// Moves the ends across until all points are covered.
fn cover(points: &[DVec2], center: f64, half: f64, mut from: f64, mut to: f64) -> Option<(f64, f64)> {
    for _ in 0..64 {
        let (middle, b) = (0.5 * (from + to), 0.5 * (to - from));
        let mut outside: Option<(f64, f64, f64)> = None;
        for p in points {
            let height = (1.0 - ((p.x - center) / half).powi(2)).max(0.0).sqrt();
            let missing = (p.y - middle).abs() - b * height;
            if missing > outside.map_or(1e-9 * half, |(most, ..)| most) {
                outside = Some((missing, p.y, height));
            }
        }
        let Some((_, y, height)) = outside else { return (b > 1e-3 * half).then_some((from, to)) };
        // The other end stays: middle + b · height = y.
        if y > middle {
            to = from + 2.0 * (y - from) / (1.0 + height);
        } else {
            from = to - 2.0 * (to - y) / (1.0 + height);
        }
    }
    None
}
