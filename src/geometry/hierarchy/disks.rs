//! The splats along the tree, as all that is found about nodes reads them.

use std::ops::Range;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::scene::{Shapes, Splats};

/// A splat: `center + u·s + v·t` with `u² + v² ≤ 1`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disk {
    pub center: DVec3,
    pub s: Vec3,
    pub t: Vec3,
    /// In the input.
    pub number: u32,
}

/// All splats, in the order of the tree: those below a node are a run.
pub(super) struct Disks(pub Vec<Disk>);

impl Disks {
    pub fn of(splats: &Splats, order: &[u32]) -> Self {
        let disk = |&number: &u32| {
            let i = number as usize;
            let (s, t) = tangents(&splats.shapes, i);
            Disk { center: splats.positions[i], s, t, number }
        };
        Self(order.par_iter().map(disk).collect())
    }

    /// Those at these places along the tree.
    pub fn run(&self, places: &Range<u32>) -> &[Disk] {
        &self.0[places.start as usize..places.end as usize]
    }
}

impl Disk {
    /// Along the normal, as long as the area over π.
    pub fn area_normal(&self) -> DVec3 {
        self.s.as_dvec3().cross(self.t.as_dvec3())
    }

    /// No point of it is farther from its center: the larger singular value of `[s t]`.
    pub fn radius(&self) -> f64 {
        let (s, t) = (self.s.as_dvec3(), self.t.as_dvec3());
        let (ss, tt, st) = (s.length_squared(), t.length_squared(), s.dot(t));
        (0.5 * (ss + tt + ((ss - tt) * (ss - tt) + 4.0 * st * st).sqrt())).sqrt()
    }
}

/// With `s × t` along the normal. Those of a disk are rounded to f32, half a step of which no bound here is too small for.
pub(super) fn tangents(shapes: &Shapes, i: usize) -> (Vec3, Vec3) {
    match shapes {
        Shapes::Disks { normals, radii } => {
            let (s, t) = normals[i].as_dvec3().normalize().any_orthonormal_pair();
            let radius = f64::from(radii[i]);
            ((radius * s).as_vec3(), (radius * t).as_vec3())
        }
        Shapes::Ellipses { s, t } => (s[i], t[i]),
    }
}
