//! Quadric error metrics (Garland, Heckbert, "Surface simplification using quadric error metrics", 1997): the sum of squared distances
//! to planes, each weighted by the area of its triangle.

use glam::DVec3;

/// `p·A p + 2 b·p + c`, and the weights' sum.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Quadric {
    /// xx, yy, zz.
    diagonal: DVec3,
    /// yz, zx, xy.
    others: DVec3,
    linear: DVec3,
    constant: f64,
    weight: f64,
}

impl Quadric {
    /// The plane of a triangle with its unit normal.
    pub fn of_plane(normal: DVec3, place: DVec3, weight: f64) -> Self {
        let distance = -normal.dot(place);
        Self {
            diagonal: weight * normal * normal,
            others: weight * DVec3::new(normal.y * normal.z, normal.z * normal.x, normal.x * normal.y),
            linear: weight * distance * normal,
            constant: weight * distance * distance,
            weight,
        }
    }

    pub fn add(&mut self, other: &Self) {
        self.diagonal += other.diagonal;
        self.others += other.others;
        self.linear += other.linear;
        self.constant += other.constant;
        self.weight += other.weight;
    }

    /// The mean squared distance of a place to the planes; not negative.
    pub fn mean_square(&self, p: DVec3) -> f64 {
        let mixed = DVec3::new(p.y * p.z, p.z * p.x, p.x * p.y);
        let sum =
            self.diagonal.dot(p * p) + 2.0 * (self.others.dot(mixed) + self.linear.dot(p)) + self.constant;
        if self.weight > 0.0 { (sum / self.weight).max(0.0) } else { 0.0 }
    }
}
