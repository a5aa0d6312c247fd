//! From the leaves to the root: what a node's splat is made of is the sum of what its children are made of.
//!
//! All means weigh by area: a splat stands for as much of the surface as it is large. The mean color of a surface seen from so far
//! that the node is a pixel is that by area; by number, parts that are sampled more densely would show through. Colors weigh by
//! alpha, too, as light does that passes through a surface.

use std::ops::Range;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::{
    Node, STEPS,
    bounds::Bounds,
    contrast::Contrast,
    disks::{Disk, Disks},
    ellipse::Ellipse,
    moments::Moments,
    split::Tree,
};
use crate::{progress::Progress, scene::Colors};

/// What a node's own splat is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct NodeSplat {
    pub center: DVec3,
    pub s: Vec3,
    pub t: Vec3,
    /// Linear, and straight alpha.
    pub color: [f32; 4],
    /// What parts of s and t are drawn.
    pub drawn: [f32; 2],
}

/// What a disk or a node adds to its parent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sums {
    /// About which the moments are; a node's is its centroid but for rounding.
    pub center: DVec3,
    pub moments: Moments,
    /// Of unit normals, by area.
    normal: DVec3,
    /// Red, green and blue by area and alpha; alpha by area.
    color: [f64; 4],
    /// Squares of red, green and blue, each times alpha, by area.
    color_squares: f64,
    /// Of the moments, what the disks have about their own centers.
    own: Moments,
}

/// The splats and the bounds of all nodes, level by level from the lowest; `origin` is that of the bounds.
pub(super) fn node_splats(
    tree: &Tree,
    disks: &Disks,
    colors: &Colors,
    origin: DVec3,
    progress: &dyn Progress,
) -> (Vec<NodeSplat>, Vec<Bounds>) {
    let mut splats = vec![NodeSplat::default(); tree.nodes.len()];
    let mut bounds = vec![Bounds::NONE; tree.nodes.len()];
    let mut sums_below: Vec<Sums> = Vec::new();
    for (done, level) in tree.levels.iter().rev().enumerate() {
        progress.step(STEPS[1], done as u64, tree.levels.len() as u64);
        let sums = of_level(tree, level, &sums_below, disks, colors);
        let (of_level, bounds_below) = bounds.split_at_mut(level.end);
        let targets = splats[level.clone()].par_iter_mut().zip(&mut of_level[level.start..]);
        let nodes = tree.nodes[level.clone()].par_iter().zip(&sums);
        nodes.zip(targets).for_each(|((node, sums), (splat, bounds))| {
            let center = sums.center;
            let (ellipse, spread) = sums.ellipse();
            let (s, t) = ellipse.axes_around(disks.run(&node.splats));
            let (drawn, color) = (ellipse.drawn_parts((s, t), node.splats.len()), sums.mean_color());
            *splat = NodeSplat { center, s: s.as_vec3(), t: t.as_vec3(), color, drawn };
            let leaves = node.leaf_runs(&tree.nodes).flat_map(|run| disks.run(&run));
            let own = (center - origin, ellipse.normal, s.length());
            let size = (spread, sums.contrast());
            *bounds = Bounds::around(own, size, &bounds_below[below(node, level)], origin, leaves);
        });
        sums_below = sums;
    }
    progress.step(STEPS[1], tree.levels.len() as u64, tree.levels.len() as u64);
    (splats, bounds)
}

/// The sums of all nodes of a level, from those of the next.
pub(super) fn of_level(
    tree: &Tree,
    level: &Range<usize>,
    sums_below: &[Sums],
    disks: &Disks,
    colors: &Colors,
) -> Vec<Sums> {
    let sums = |node: &Node| {
        // Parts of a cut or splats of a leaf, of both of which there are eight at most.
        let mut parts = [Sums::NONE; 8];
        let leaves = node.leaf_runs(&tree.nodes).flat_map(|run| disks.run(&run));
        let leaves = leaves.map(|disk| Sums::of_disk(disk, colors));
        let children = sums_below[below(node, level)].iter().copied();
        let count = parts.iter_mut().zip(children.chain(leaves)).map(|(part, sums)| *part = sums).count();
        Sums::of_parts(&parts[..count])
    };
    tree.nodes[level.clone()].par_iter().map(sums).collect()
}

/// A node's children, counted from the begin of the next level.
fn below(node: &Node, level: &Range<usize>) -> Range<usize> {
    node.children.start as usize - level.end..node.children.end as usize - level.end
}

impl Sums {
    const NONE: Self = Self {
        center: DVec3::ZERO,
        moments: Moments::NONE,
        normal: DVec3::ZERO,
        color: [0.0; 4],
        color_squares: 0.0,
        own: Moments::NONE,
    };

    pub fn of_disk(disk: &Disk, colors: &Colors) -> Self {
        let moments = Moments::of(disk);
        let [red, green, blue, alpha] = colors.get(disk.number as usize).unwrap_or_default().map(f64::from);
        let (alpha, weight) = (alpha.clamp(0.0, 1.0), moments.weight);
        let seen = alpha * DVec3::new(red, green, blue);
        let [red, green, blue] = (weight * seen).to_array();
        Self {
            center: disk.center,
            moments,
            normal: disk.area_normal(),
            color: [red, green, blue, weight * alpha],
            color_squares: weight * seen.length_squared(),
            own: moments,
        }
    }

    pub fn of_parts(parts: &[Self]) -> Self {
        // Counted from one of them: the sum of coordinates far from the origin would lose digits.
        let start = parts[0].center;
        let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
        for part in parts {
            sum += part.moments.weight * (part.center - start) + part.moments.first;
            weight += part.moments.weight;
        }
        let mut sums = Self { center: start + sum / weight, ..Self::NONE };
        for part in parts {
            sums.moments += part.moments.moved(part.center - sums.center);
            sums.normal += part.normal;
            sums.own += part.own;
            sums.color_squares += part.color_squares;
            sums.color = std::array::from_fn(|i| sums.color[i] + part.color[i]);
        }
        sums
    }

    /// The ellipse of what this is the sum of, not yet scaled, and how far its disks spread.
    pub fn ellipse(&self) -> (Ellipse, f64) {
        let covariance = self.moments.covariance();
        let squares = covariance.x_axis.x + covariance.y_axis.y + covariance.z_axis.z;
        let spread = (squares - self.own.trace() / self.moments.weight).max(0.0).sqrt();
        let of_kernels = self.moments.covariance_of_kernels(&self.own);
        let mean_normal = self.normal / self.moments.weight;
        (Ellipse::new(self.center, mean_normal, &covariance, &of_kernels), spread)
    }

    /// How much of what this is the sum of differs.
    pub fn contrast(&self) -> Contrast {
        let [red, green, blue, _] = self.color;
        let weight = self.moments.weight;
        Contrast::of(self.normal / weight, DVec3::new(red, green, blue) / weight, self.color_squares / weight)
    }

    /// Straight alpha; black where nothing is seen.
    pub fn mean_color(&self) -> [f32; 4] {
        let [red, green, blue, alpha] = self.color;
        let straight = |sum: f64| if alpha > 0.0 { (sum / alpha) as f32 } else { 0.0 };
        [straight(red), straight(green), straight(blue), (alpha / self.moments.weight) as f32]
    }
}
