//! Where the surface that is sampled has an edge: beyond it there is nothing, or another surface behind it.

use glam::DVec3;

/// The edge that passes through a pixel of the ground truth, as its samples see it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Edge {
    /// None: neighboring samples see one surface, or nothing.
    #[default]
    None,
    /// From one surface to another, farther one.
    Jump,
    /// From a surface to nothing.
    Outline,
}

/// What a sample sees, as far as edges matter.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    /// View-space z; +∞ where there is nothing.
    z: f64,
    /// The depth up to which splats are of this surface, by ε.
    z_shifted: f64,
    /// By how much the surface's plane changes its depth from here to the next sample, along a row and along a column.
    steps: [f64; 2],
}

impl Seen {
    pub const NOTHING: Self = Self { z: f64::INFINITY, z_shifted: f64::INFINITY, steps: [0.0; 2] };

    /// A surface at depth `z` with a unit normal, seen along `ray`, whose z is 1; samples are `sample` apart in the image
    /// plane.
    pub fn surface(z: f64, z_shifted: f64, normal: DVec3, ray: DVec3, sample: f64) -> Self {
        // n · ray · z is the same all over the plane.
        let here = normal.dot(ray);
        let step = |along: f64| {
            let ratio = here / (here + sample * along);
            // The plane is edge-on before the next sample.
            if ratio > 0.0 { (z * (ratio - 1.0)).abs() } else { f64::INFINITY }
        };
        Self { z, z_shifted, steps: [step(normal.x), step(normal.y)] }
    }

    /// The edge between neighbors along a row (`axis` 0) or along a column (1).
    ///
    /// Two surfaces are two where the farther lies behind what ε counts to the nearer by more than twice what the flatter one of both
    /// planes would change from sample to sample, and by more than `pixel`, the side of a pixel in the image plane, at its depth. So a floor
    /// that is seen at any angle is one surface up to the horizon.
    fn edge_to(&self, other: &Self, axis: usize, pixel: f64) -> Edge {
        let (near, far) = if self.z <= other.z { (self, other) } else { (other, self) };
        if near.z == f64::INFINITY {
            return Edge::None;
        }
        if far.z == f64::INFINITY {
            return Edge::Outline;
        }
        let step = near.steps[axis].min(far.steps[axis]);
        match far.z - near.z_shifted > 2.0 * step + pixel * near.z {
            true => Edge::Jump,
            false => Edge::None,
        }
    }
}

/// Looks for edges row by row of samples, and marks the pixels of both sides.
pub(super) struct Edges {
    /// The side of a pixel in the image plane.
    pub pixel: f64,
    pub samples_per_side: usize,
    /// How many pixels of samples there are before the picture's first, along both axes.
    pub margin_px: usize,
    pub width_px: usize,
    /// The row of samples before the next one.
    pub above: Vec<Seen>,
}

impl Edges {
    /// Looks at the next row of samples, which is the `row`th, and marks `edges`, the pixels of the band.
    pub fn mark(&mut self, row: usize, samples: &[Seen], edges: &mut [Edge]) {
        for (column, here) in samples.iter().enumerate() {
            if let Some(left) = column.checked_sub(1) {
                let edge = here.edge_to(&samples[left], 0, self.pixel);
                self.note(edge, [[left, row], [column, row]], edges);
            }
            if let Some((above, before)) = self.above.get(column).zip(row.checked_sub(1)) {
                let edge = here.edge_to(above, 1, self.pixel);
                self.note(edge, [[column, before], [column, row]], edges);
            }
        }
        self.above.clear();
        self.above.extend_from_slice(samples);
    }

    fn note(&self, edge: Edge, samples: [[usize; 2]; 2], edges: &mut [Edge]) {
        if edge == Edge::None {
            return;
        }
        for sample in samples {
            let [column, row] = sample.map(|at| (at / self.samples_per_side).checked_sub(self.margin_px));
            let Some((column, row)) = column.zip(row).filter(|(column, _)| *column < self.width_px) else {
                continue;
            };
            if let Some(pixel) = edges.get_mut(row * self.width_px + column) {
                *pixel = edge.max(*pixel);
            }
        }
    }
}
