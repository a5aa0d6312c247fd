//! Trained Gaussians as disks of a surface.
//!
//! Files of 3D and 2D Gaussian splatting have the same properties; those of a 2D Gaussian lack the third scale. Of a 3D
//! Gaussian the shortest axis is the normal, as surfaces that were trained into flat ones have it.
//!
//! **Size.** A Gaussian's weight at r standard deviations is exp(−r²/2). The default kernel's at u radii, exp(−u²/(2·½²)),
//! is the same function where a radius is 2 standard deviations: no other factor leaves no difference within the disk.
//! There it ends, at a weight of 0.135.
//!
//! **Opacity.** Surfaces here are opaque, and splats of one are blended by their weights. So a Gaussian that hides less
//! than half of what is behind it at its center (its logit is below 0) is no part of the surface, and is left out; the
//! others count as whole. Training fills space with faint ones, which would be a fog of plates.
//!
//! **Color.** 0.5 + f_dc / (2√π) is the mean over all directions, an sRGB value.

use std::f64::consts::PI;

use glam::{DMat3, DQuat, DVec3, Vec3};

use super::{body::Table, layout::Gaussian};

/// A disk's radius in standard deviations.
const RADIUS: f64 = 2.0;

/// The scaled tangent vectors of a table's Gaussians: of a rotation that is none, zeros, which no splat may have.
pub(super) fn tangents(gaussian: &Gaussian, table: &Table) -> impl Iterator<Item = [Vec3; 2]> {
    let [first, second] = gaussian.scales.map(|column| table.column(column));
    let third = gaussian.third_scale.map_or(&[][..], |column| table.column(column));
    let [w, x, y, z] = gaussian.rotation.map(|column| table.column(column));
    let rotations =
        w.iter().zip(x).zip(y.iter().zip(z)).map(|((&w, &x), (&y, &z))| DQuat::from_xyzw(x, y, z, w));
    let thirds = third.iter().map(|&scale| Some(scale)).chain(std::iter::repeat(None));
    first.iter().zip(second).zip(thirds).zip(rotations).map(|(((&first, &second), third), rotation)| {
        let length = rotation.length();
        let axes = match length > 0.0 && length.is_finite() {
            true => DMat3::from_quat(rotation / length),
            false => DMat3::ZERO,
        };
        tangents_of(axes, first, second, third)
    })
}

fn tangents_of(axes: DMat3, first: f64, second: f64, third: Option<f64>) -> [Vec3; 2] {
    let scaled = |axis: DVec3, scale: f64| (axis * (RADIUS * scale.exp())).as_vec3();
    let [a, b, c] = [axes.x_axis, axes.y_axis, axes.z_axis];
    match third {
        // In this order, the normal s×t is the axis that is left out.
        Some(third) if first < second && first < third => [scaled(b, second), scaled(c, third)],
        Some(third) if second < third => [scaled(c, third), scaled(a, first)],
        _ => [scaled(a, first), scaled(b, second)],
    }
}

/// Which of a table's Gaussians hide at least half of what is behind them; all, where the file does not say it.
pub(super) fn are_solid(gaussian: &Gaussian, table: &Table) -> impl Iterator<Item = bool> {
    let told = gaussian.opacity.map_or(&[][..], |column| table.column(column));
    let all = if gaussian.opacity.is_none() { table.column(gaussian.scales[0]) } else { &[] };
    told.iter().map(|&logit| logit >= 0.0).chain(all.iter().map(|_| true))
}

/// The mean colors of a table's Gaussians, sRGB values.
pub(super) fn colors(columns: [usize; 3], table: &Table) -> impl Iterator<Item = DVec3> {
    let factor = 0.5 / PI.sqrt();
    table.vectors(columns).map(move |coefficients| DVec3::splat(0.5) + factor * coefficients)
}
