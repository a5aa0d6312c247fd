//! From the leaves to the root: what a node's splat is made of is the sum of what its children are made of.
//!
//! All means weigh by area: a splat stands for as much of the surface as it is large. The mean color of a surface seen from so far
//! that the node is a pixel is that by area; by number, parts that are sampled more densely would show through. Colors weigh by
//! alpha, too, as light does that passes through a surface.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::{
    bounds::Bounds,
    disks::{Disk, Disks},
    ellipse::Ellipse,
    moments::Moments,
    split::Tree,
};
use crate::scene::Colors;

/// What a node's own splat is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct NodeSplat {
    pub center: DVec3,
    pub s: Vec3,
    pub t: Vec3,
    /// Linear, and straight alpha.
    pub color: [f32; 4],
}

/// What a disk or a node adds to its parent.
#[derive(Clone, Copy, Debug)]
struct Sums {
    /// About which the moments are; a node's is its centroid but for rounding.
    center: DVec3,
    moments: Moments,
    /// Of unit normals, by area.
    normal: DVec3,
    /// Red, green and blue by area and alpha; alpha by area.
    color: [f64; 4],
}

/// The splats and the bounds of all nodes, level by level from the lowest; `origin` is that of the bounds. `progress` is told how many
/// disks are below the nodes that are done, as if all levels were equally large.
pub(super) fn node_splats(
    tree: &Tree,
    disks: &Disks,
    colors: &Colors,
    origin: DVec3,
    progress: &dyn Fn(usize),
) -> (Vec<NodeSplat>, Vec<Bounds>) {
    let mut splats = vec![NodeSplat::default(); tree.nodes.len()];
    let mut bounds = vec![Bounds::NONE; tree.nodes.len()];
    let mut sums_below: Vec<Sums> = Vec::new();
    for (done, level) in tree.levels.iter().rev().enumerate() {
        progress(disks.0.len() * done / tree.levels.len());
        let (of_level, bounds_below) = bounds.split_at_mut(level.end);
        let nodes = tree.nodes[level.clone()].par_iter();
        let targets = splats[level.clone()].par_iter_mut().zip(&mut of_level[level.start..]);
        sums_below = nodes
            .zip(targets)
            .map(|(node, (splat, bounds))| {
                let [first, end] = [node.children.start, node.children.end].map(|i| i as usize - level.end);
                let runs = || node.leaf_runs(&tree.nodes);
                let leaves = || runs().flat_map(|run| &disks.0[run.start as usize..run.end as usize]);
                let sums = Sums::of(&sums_below[first..end], leaves, colors);
                let (center, weight) = (sums.center, sums.moments.weight);
                let ellipse = Ellipse::new(center, sums.normal / weight, &sums.moments.covariance());
                let (s, t) =
                    ellipse.axes_around(&disks.0[node.splats.start as usize..node.splats.end as usize]);
                *splat = NodeSplat { center, s: s.as_vec3(), t: t.as_vec3(), color: sums.mean_color() };
                let leaves = leaves().map(|disk| (disk.center - origin, *disk));
                let own = (center - origin, ellipse.normal, s.length());
                *bounds = Bounds::around(own, &bounds_below[first..end], leaves);
                sums
            })
            .collect();
    }
    (splats, bounds)
}

impl Sums {
    fn of<'a, I: Iterator<Item = &'a Disk>>(
        children: &[Self],
        leaves: impl Fn() -> I,
        colors: &Colors,
    ) -> Self {
        let leaf = |disk: &Disk| {
            let moments = Moments::of(disk);
            let [red, green, blue, alpha] =
                colors.get(disk.number as usize).unwrap_or_default().map(f64::from);
            let alpha = alpha.clamp(0.0, 1.0) * moments.weight;
            let color = [alpha * red, alpha * green, alpha * blue, alpha];
            Self { center: disk.center, moments, normal: disk.area_normal(), color }
        };
        let parts = || children.iter().copied().chain(leaves().map(leaf));
        // Counted from one of them: the sum of coordinates far from the origin would lose digits.
        let Some(start) = parts().next().map(|part| part.center) else { unreachable!("a node has children") };
        let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
        for part in parts() {
            sum += part.moments.weight * (part.center - start) + part.moments.first;
            weight += part.moments.weight;
        }
        let center = start + sum / weight;
        let mut sums = Self { center, moments: Moments::default(), normal: DVec3::ZERO, color: [0.0; 4] };
        for part in parts() {
            sums.moments += part.moments.moved(part.center - center);
            sums.normal += part.normal;
            sums.color = std::array::from_fn(|i| sums.color[i] + part.color[i]);
        }
        sums
    }

    /// Straight alpha; black where nothing is seen.
    fn mean_color(&self) -> [f32; 4] {
        let [red, green, blue, alpha] = self.color;
        let straight = |sum: f64| if alpha > 0.0 { (sum / alpha) as f32 } else { 0.0 };
        [straight(red), straight(green), straight(blue), (alpha / self.moments.weight) as f32]
    }
}
