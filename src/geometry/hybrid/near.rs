//! Samples of the splat part near transition edges: which are removed, and radii that do not grow toward the edge.
//!
//! **Radii.** At the edge a sample has neighbors on one side only, and their mean distance would be up to 1.27 times that
//! inside (in the last quarter of a radius). Sampling the whole mesh instead would give true neighbors beyond the edge,
//! but at the cost of the polygon part, which may be most of a mesh. With the edge's splats as neighbors alone it is 1.04
//! times in the nearest half radius, and where none are wanted 1.13. So the samples near the edge are also reflected
//! through its nearest place, which continues the surface beyond it as dense as it is here: 1.02 and 0.99 times.
//!
//! **Removal.** Within [`CLEARANCE`] of the edge its own splats do the work of the samples. Measured on the square of two
//! times four triangles and that of two times 3600 of [`crate::geometry::seams`], each with 3000 samples of 8 seeds: Σw
//! on the splat side up to 1.5 radii from the edge (mean; largest or least), the share of that strip where it is below 1,
//! the mean radius in the strip's first third over that inside, and Σw and its standard deviation a quarter of a radius
//! *beyond* the edge, where the fade should be even:
//!
//! | removed within | Gaussian | ψ_E | ψ_E < 1, small triangles | radii | beyond: Gaussian | ψ_E |
//! |---|---|---|---|---|---|---|
//! | 0 | 3.81, to 4.54 | 2.14, from 0.97 to 3.16 | | 0.85 | 1.98 ± 0.16 | 1.06 ± 0.16 |
//! | 0.2 | 3.78, to 4.59 | 2.12, from 1.06 to 3.16 | | 0.96 | 1.83 ± 0.14 | 0.97 ± 0.08 |
//! | **0.3** | 3.69, to 4.65 | 2.08, from 1.00 to 2.92 | 7.1% | 1.02 | 1.73 ± 0.13 | 0.93 ± 0.05 |
//! | 0.4 | 3.56, to 4.70 | 2.00, from 1.00 to 2.92 | 7.7% | 1.06 | 1.62 ± 0.11 | 0.90 ± 0.03 |
//! | 0.5 | 3.39, to 4.72 | 1.91, from 0.78 to 2.96 | 11.5% | 1.08 | 1.53 ± 0.10 | 0.89 ± 0.02 |
//! | *inside* | 4.06, to 4.65 | 2.21, from 1.13 to 2.82 | 7.2% | 1 | | |
//!
//! 0.3 is the most that leaves radii and coverage as they are inside; less leaves more splats than inside and an uneven
//! fade.

use glam::DVec3;

use super::{chains::Place, sizes::Sizes};
use crate::{
    geometry::resample::radii::radii,
    progress::Progress,
    scene::{Shapes, Splats},
};

/// Samples nearer than this to a transition edge are removed, in radii of the splats on it.
pub(super) const CLEARANCE: f64 = 0.3;

/// Samples farther than this from a transition edge, in radii of the splats on it, have all their neighbors on their side of it:
/// those are mostly less than a radius away.
const BORDER: f64 = 2.0;

/// Removes what is too near to the edges, and tells how many that were.
pub(super) fn remove(splats: &mut Splats, sizes: &Sizes) -> usize {
    let far = |&sample: &DVec3| {
        let near = sizes.nearest(sample, CLEARANCE);
        near.is_none_or(|near| near.distance >= CLEARANCE * near.radius)
    };
    let keep: Vec<bool> = splats.positions.iter().map(far).collect();
    splats.keep(&keep);
    keep.iter().filter(|keep| !**keep).count()
}

/// Gives the samples near the edges radii as if the surface went on beyond them; where sizes are bounded they reach over an edge
/// no farther than the splats on it. `places` are the splats that are there, each
/// sample stands for `area` at most.
pub(super) fn correct_radii(
    splats: &mut Splats,
    places: &[Place],
    sizes: &Sizes,
    area: f64,
    progress: &dyn Progress,
) {
    let Shapes::Disks { radii: of_samples, .. } = &mut splats.shapes else { return };
    let (mut near, mut points, mut beyond) = (Vec::new(), Vec::new(), Vec::new());
    for (i, &sample) in splats.positions.iter().enumerate() {
        // As many again as are corrected: their neighbors.
        let nearest = sizes.nearest(sample, 2.0 * BORDER);
        if let Some(edge) = nearest.filter(|edge| edge.distance < 2.0 * BORDER * edge.radius) {
            points.push(sample);
            beyond.push(2.0 * edge.position - sample);
            near.push((i, edge));
        }
    }
    points.extend(beyond);
    points.extend(places.iter().map(|place| place.position));
    let corrected = radii(&points, area, progress);
    for ((i, edge), radius) in near.into_iter().zip(corrected) {
        if edge.distance < BORDER * edge.radius {
            let reaches_over = edge.radius < sizes.inside();
            let most = if reaches_over { (edge.radius + edge.distance) as f32 } else { f32::INFINITY };
            of_samples[i] = radius.min(most);
        }
    }
}
