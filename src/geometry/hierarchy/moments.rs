//! Homogeneous covariance (Pajarola et al. 2003, section 3.3): sums of `p' p'ᵀ` with `p' = (p, 1)`, from which the covariance about any
//! center follows.
//!
//! About one common origin the sums cancel: at 1e7 from it, a node of 3e-4 has lost all digits of its covariance. So each node's moments
//! are about a center of its own, and a parent adds those of its children moved to its center, which is the paper's `T M' Tᵀ`.
//!
//! A splat is no point: its own covariance, ¼ (s sᵀ + t tᵀ) of a uniform disk, is added, so that no node's vanishes. Points are weighted
//! by the splat's area where the paper counts them: the moments are then those of the surface, however densely its parts are sampled.

use std::ops::AddAssign;

use glam::{DMat3, DVec3};

use super::disks::Disk;

/// The mean of u² over the unit disk.
const DISK_SQUARE: f64 = 0.25;

/// The mean of u² by the weights that a splat has by default, exp(−2 r²) up to its rim: (1 − 3 e⁻²) / 4 (1 − e⁻²).
pub(super) const KERNEL_SQUARE: f64 = 0.171_741;

/// The distinct entries of `M' = Σ w p' p'ᵀ`, with `p` counted from some center.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moments {
    /// `Σ w`: area over π.
    pub weight: f64,
    /// `Σ w p`.
    pub first: DVec3,
    /// `Σ w p pᵀ`: the entries xx, yy, zz.
    squares: DVec3,
    /// And yz, zx, xy.
    products: DVec3,
}

impl Moments {
    /// Of nothing.
    pub const NONE: Self =
        Self { weight: 0.0, first: DVec3::ZERO, squares: DVec3::ZERO, products: DVec3::ZERO };

    /// Of one disk, about its own center.
    pub fn of(disk: &Disk) -> Self {
        let weight = disk.area_normal().length();
        let (s, t) = (disk.s.as_dvec3(), disk.t.as_dvec3());
        let quarter = DISK_SQUARE * weight;
        Self {
            weight,
            first: DVec3::ZERO,
            squares: quarter * (s * s + t * t),
            products: quarter * (products(s) + products(t)),
        }
    }

    /// About a center from which the present one is seen at `offset`: `T M' Tᵀ`.
    #[must_use]
    pub fn moved(&self, offset: DVec3) -> Self {
        let (d, m) = (offset, self.first);
        let crossed = DVec3::new(d.y * m.z + d.z * m.y, d.z * m.x + d.x * m.z, d.x * m.y + d.y * m.x);
        Self {
            weight: self.weight,
            first: m + self.weight * d,
            squares: self.squares + 2.0 * d * m + self.weight * d * d,
            products: self.products + crossed + self.weight * products(d),
        }
    }

    /// Of the squares: how far from the center in all.
    pub fn trace(&self) -> f64 {
        self.squares.element_sum()
    }

    /// The covariance about the present center: the upper left 3 × 3 entries over the weight.
    pub fn covariance(&self) -> DMat3 {
        let DVec3 { x: xx, y: yy, z: zz } = self.squares / self.weight;
        let DVec3 { x: yz, y: zx, z: xy } = self.products / self.weight;
        DMat3::from_cols(DVec3::new(xx, xy, zx), DVec3::new(xy, yy, yz), DVec3::new(zx, yz, zz))
    }
}

impl Moments {
    /// The covariance where the weight of each disk falls toward its rim as its kernel does. `own`: the sum of those of the disks, each about its own center.
    pub fn covariance_of_kernels(&self, own: &Self) -> DMat3 {
        let less = 1.0 - KERNEL_SQUARE / DISK_SQUARE;
        Self {
            squares: self.squares - less * own.squares,
            products: self.products - less * own.products,
            ..*self
        }
        .covariance()
    }
}

impl AddAssign for Moments {
    /// Of the union of two sets, about the same center.
    fn add_assign(&mut self, other: Self) {
        self.weight += other.weight;
        self.first += other.first;
        self.squares += other.squares;
        self.products += other.products;
    }
}

/// The entries yz, zx, xy of `v vᵀ`.
fn products(v: DVec3) -> DVec3 {
    DVec3::new(v.y * v.z, v.z * v.x, v.x * v.y)
}
