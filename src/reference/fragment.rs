//! A splat in a pixel: its weight and depth, and how close that is to another outcome.

use glam::DVec3;

use super::creases::is_undecided;
use super::drawn_clip::{Clipped, Kept};
use super::intersect::r2_margin;
use super::kernel::weight;
use super::reach::MOST_REACH;
use super::splat::DrawnSplat;
use super::view::View;
use crate::scene::Kernel;

/// A splat's part of a pixel that it covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fragment {
    /// View-space depth, at or beyond the near plane.
    pub z: f64,
    /// Above 0.
    pub weight: f64,
}

/// A pixel so close to a border of a splat that an evaluation with 24 bits may take it for the other side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rim {
    /// The smallest depth that the splat has on either side of the border.
    pub z: f64,
    /// How far `r²` may be off. See [`DrawnSplat::r2_margin`].
    pub margin: f64,
}

impl DrawnSplat {
    /// `None` where the splat does not cover.
    pub fn fragment(&self, ray: DVec3, view: &View, kernel: Kernel) -> Option<Fragment> {
        let x = ray.truncate();
        if self.square.is_some_and(|square| square.depth_inside(x) < 0.0) {
            return None;
        }
        // Up to its reach it covers; with a weight as far as its filtered kernel goes.
        let disk = self.hit(ray, view.near).filter(|hit| weight(kernel, hit.r2()) > 0.0);
        let disk = disk.map(|hit| (hit.z, weight(kernel, self.filtered_r2(&hit))));
        let low_pass = self.low_pass.map(|low_pass| (low_pass.z, weight(kernel, low_pass.r2(x))));
        let low_pass = low_pass.filter(|(_, weight)| *weight > 0.0);
        // The depth is the disk's own wherever the disk is.
        let (z, _) = disk.or(low_pass)?;
        let kept = self.kept(ray, z, view);
        if kept.is_some_and(|kept| kept.part == 0.0) {
            return None;
        }
        let weight = disk.map_or(0.0, |disk| disk.1).max(low_pass.map_or(0.0, |low_pass| low_pass.1));
        Some(Fragment {
            z,
            weight: kept.map_or(1.0, Kept::priority) * (self.share * weight).max(self.least_weight),
        })
    }

    /// What clip curves and planes leave of it in a pixel that it covers at that depth, where there are any.
    pub fn kept(&self, ray: DVec3, z: f64, view: &View) -> Option<Kept> {
        let by_curves = self.clip.map(|clip| clip.kept(ray));
        match (by_curves, self.left_by_planes(ray, z, view)) {
            (Some(curves), Some(planes)) => Some(if planes.part < curves.part { planes } else { curves }),
            (curves, planes) => curves.or(planes),
        }
    }

    /// `None` where no rounding can change what the splat is here. `limit_r2` is the kernel's.
    pub fn rim(&self, ray: DVec3, distance_px: f64, limit_r2: f64, view: &View) -> Option<Rim> {
        let x = ray.truncate();
        let inside_square =
            self.square.map_or(f64::INFINITY, |square| square.depth_inside(x) * view.focal_px);
        let square_margin_px = 1e-3 + 16.0 * 0.5_f64.powi(24) * distance_px;
        if inside_square < -square_margin_px {
            return None;
        }

        // How far r² is below the limit, with the margin and the depth.
        let hit = self.hit(ray, view.near);
        let disk = hit.map(|hit| {
            let margin = self.r2_margin(ray, hit.z, distance_px, view);
            (limit_r2 - hit.r2(), Rim { z: hit.z, margin })
        });
        // Where its weights end, if it reaches further.
        let at_filtered = hit.zip(disk).filter(|_| self.reach.is_some()).is_some_and(|(hit, (_, rim))| {
            let most = MOST_REACH * MOST_REACH;
            (limit_r2 - self.filtered_r2(&hit)).abs() <= most * rim.margin
        });
        let low_pass = self.low_pass.map(|low_pass| {
            let margin = r2_margin(distance_px, low_pass.minor_px);
            (limit_r2 - low_pass.r2(x), Rim { z: low_pass.z, margin })
        });
        let covers = |part: &(f64, Rim)| part.0 > part.1.margin;
        let undecided = |part: &(f64, Rim)| part.0.abs() <= part.1.margin;
        let may_cover = |part: &(f64, Rim)| covers(part) || undecided(part);

        let at_disk = disk.is_some_and(|disk| undecided(&disk));
        // Under the disk the border of the low-pass filter shows nowhere: there it weighs least.
        let at_low_pass =
            low_pass.is_some_and(|part| undecided(&part)) && !disk.is_some_and(|disk| covers(&disk));
        let at_square = inside_square.abs() <= square_margin_px;
        // Of (u, v) the error is no larger than that of r² where that is 1.
        let margin = disk.map(|disk| disk.1.margin).or(low_pass.map(|part| part.1.margin)).unwrap_or(0.0);
        let clipped = self.clip.map_or(Clipped::Kept, |clip| clip.near(ray, margin));
        let z = disk.map(|disk| disk.1.z).or(low_pass.map(|part| part.1.z));
        let cut = z.map_or(Clipped::Kept, |z| self.near_planes(ray, z, view));
        let at_half = || self.clip.and(z).and_then(|z| self.kept(ray, z, view)).is_some_and(is_undecided);
        let at_curve = clipped == Clipped::Undecided || cut == Clipped::Undecided || at_half();
        if clipped == Clipped::Removed
            || cut == Clipped::Removed
            || !(at_disk || at_filtered || at_low_pass || at_square || at_curve)
        {
            return None;
        }
        let parts = [disk, low_pass].into_iter().flatten().filter(may_cover);
        let rim = parts
            .map(|part| part.1)
            .reduce(|a, b| Rim { z: a.z.min(b.z), margin: a.margin.max(b.margin) })?;
        Some(Rim { margin: rim.margin * view.depth_share, ..rim })
    }
}
