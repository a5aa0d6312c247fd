//! The splats of an object among each other, for whoever looks at each pair of them.

use glam::{DVec2, DVec3};

use super::tangents::tangents;
use crate::scene::{Clip, Splats};

/// A splat among others.
pub(super) struct Among {
    pub number: usize,
    pub center: DVec3,
    pub s: DVec3,
    pub t: DVec3,
    pub normal: DVec3,
    pub radius: f64,
    pub clip: Clip,
}

/// Those that can be drawn, along x, so that only a slab of them is looked at.
pub(super) fn all_along_x(splats: &Splats) -> Vec<Among> {
    let drawn = (0..splats.len()).filter(|&i| splats.defect(i).is_none());
    let mut all: Vec<Among> = drawn
        .map(|number| {
            let (s, t) = tangents(&splats.shapes, number);
            let normal = s.normalize().cross(t.normalize()).normalize();
            let (center, radius) = (splats.positions[number], splats.major_radius(number));
            Among { number, center, s, t, normal, radius, clip: splats.clips.get(number) }
        })
        .collect();
    all.sort_by(|a, b| a.center.x.total_cmp(&b.center.x));
    all
}

impl Among {
    /// (u, v) of a place, seen along the normal: q = u s + v t + h n, solved by Cramer's rule.
    pub fn seen_at(&self, place: DVec3) -> DVec2 {
        let q = place - self.center;
        let volume = self.s.cross(self.t).dot(self.normal);
        DVec2::new(q.cross(self.t).dot(self.normal), self.s.cross(q).dot(self.normal)) / volume
    }
}
