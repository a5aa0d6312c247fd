//! The part of a row of samples that a splat may cover: much less than its search box, where there are many samples.

use std::ops::Range;

use glam::DVec3;

use super::search_box::SearchBox;
use super::splat::DrawnSplat;
use super::view::View;

/// The columns of `search` in which the splat, under the projective map, may have an `r²` of at most `limit_r2` in
/// the row with image-plane coordinate `y`: at least all in which it has.
pub(super) fn row_span(
    splat: &DrawnSplat,
    search: &SearchBox,
    limit_r2: f64,
    y: f64,
    view: &View,
) -> Range<usize> {
    let all = search.columns.start as usize..search.columns.end as usize;
    // The ray (x, y, 1) meets the plane at z = d/w with d = n·p, w = n·ray. There u = U/w with U = d u_axis·ray −
    // u_axis·p w, v alike; all are linear in x, and u² + v² ≤ limit is U² + V² − limit w² ≤ 0.
    let d = splat.plane_normal.dot(splat.center);
    let linear = |axis: DVec3| {
        let of = d * axis - axis.dot(splat.center) * splat.plane_normal;
        (of.x, of.y * y + of.z)
    };
    let (u, v) = (linear(splat.u_axis), linear(splat.v_axis));
    let w = (splat.plane_normal.x, splat.plane_normal.y * y + splat.plane_normal.z);
    let a = u.0 * u.0 + v.0 * v.0 - limit_r2 * w.0 * w.0;
    let b = u.0 * u.1 + v.0 * v.1 - limit_r2 * w.0 * w.1;
    let c = u.1 * u.1 + v.1 * v.1 - limit_r2 * w.1 * w.1;
    let discriminant = b * b - a * c;
    // With a > 0 that holds between the roots and nowhere else. Rounding of the discriminant decides about a sample
    // at the very top and bottom alone, and of those none is to be lost.
    let scale = b * b + (a * c).abs();
    if a.is_nan() || a <= 1e-9 * (u.0 * u.0 + v.0 * v.0) {
        return all;
    }
    if discriminant < -1e-9 * scale {
        return 0..0;
    }
    let half = (discriminant.max(0.0) + 1e-9 * scale).sqrt();
    let column = |x: f64| x * view.focal_px + view.middle_px[0] - 0.5;
    let (first, last) = (column((-b - half) / a).floor(), column((-b + half) / a).ceil());
    if first.is_nan() || last.is_nan() {
        return all;
    }
    all.start.max(first.max(0.0) as usize)..all.end.min(last.max(-1.0) as usize + 1)
}
