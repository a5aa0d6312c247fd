//! Triangles whose corners each stand alone become ones that share vertices.

use glam::DVec3;
use rayon::prelude::*;

/// Triangles that share vertices.
pub(super) struct Welded {
    /// In the order in which the triangles name them first.
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    /// How many triangles had two corners at one place and are left out.
    pub degenerate: u64,
}

/// Makes one vertex of all corners that are equal to the bit, but for the sign of zero. Each three corners are a
/// triangle; there are fewer than 2³².
pub(super) fn weld(corners: &[[f32; 3]]) -> Welded {
    // Zero has two forms that are equal.
    let bits = |corner: &[f32; 3]| corner.map(|v| (v + 0.0).to_bits());
    // Sorting has no worst case that a file could aim at, as hashing has.
    let mut sorted: Vec<([u32; 3], u32)> =
        corners.par_iter().map(bits).zip((0..corners.len() as u32).into_par_iter()).collect();
    sorted.par_sort_unstable();
    let mut first_of = vec![0_u32; corners.len()];
    for equal in sorted.chunk_by(|a, b| a.0 == b.0) {
        let Some(&(_, first)) = equal.first() else { continue };
        for &(_, corner) in equal {
            if let Some(slot) = first_of.get_mut(corner as usize) {
                *slot = first;
            }
        }
    }
    drop(sorted);
    let mut welded = Welded { positions: Vec::new(), triangles: Vec::new(), degenerate: 0 };
    // From here on a corner's vertex, once it has one; `first_of` names only corners before it or itself.
    for i in 0..corners.len() {
        let Some((&first, corner)) = first_of.get(i).zip(corners.get(i)) else { continue };
        let vertex = match first as usize == i {
            true => {
                welded.positions.push(DVec3::from(corner.map(f64::from)));
                welded.positions.len() as u32 - 1
            }
            false => first_of.get(first as usize).copied().unwrap_or_default(),
        };
        if let Some(slot) = first_of.get_mut(i) {
            *slot = vertex;
        }
    }
    for triangle in first_of.chunks_exact(3) {
        match *triangle {
            [a, b, c] if a != b && b != c && c != a => welded.triangles.push([a, b, c]),
            _ => welded.degenerate += 1,
        }
    }
    welded
}
