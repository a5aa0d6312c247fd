//! Where a mesh's surface turns: the sides of its triangles over which it bends by a crease's angle or ends.

use glam::DVec3;

use super::creases::{COS_CREASE, Face};
use crate::scene::Mesh;

/// The sides of each triangle that turn, by the corner that is opposite to them.
///
/// A side turns unless another triangle at the same two places goes on with less than a crease's bend. Places and not
/// vertices are compared: many files repeat vertices along edges, and such an edge is no end of the surface. Bits of
/// positions decide (−0 is 0).
pub(super) fn turning_sides(mesh: &Mesh, faces: &[Option<Face>]) -> Vec<[bool; 3]> {
    let first = first_at_place(&mesh.positions);
    let mut sides = Vec::with_capacity(3 * mesh.triangles.len());
    for (triangle, vertices) in mesh.triangles.iter().enumerate() {
        if faces[triangle].is_some() {
            for opposite in 0..3 {
                let [a, b] = [1, 2].map(|step| first[vertices[(opposite + step) % 3] as usize]);
                sides.push((a.min(b), a.max(b), triangle, opposite));
            }
        }
    }
    sides.sort_unstable();
    let mut turning = vec![[false; 3]; mesh.triangles.len()];
    for alike in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let normal = |triangle: usize| faces[triangle].as_ref().map_or(DVec3::ZERO, |face| face.normal);
        // Where hundreds share an edge there is no surface to tell.
        let goes_on = |own: usize| {
            let others = alike.iter().take(8).filter(|side| side.2 != own);
            others.map(|side| normal(side.2).dot(normal(own))).any(|cos| cos > COS_CREASE)
        };
        for &(_, _, triangle, opposite) in alike {
            turning[triangle][opposite] = !goes_on(triangle);
        }
    }
    turning
}

/// For each vertex the first one at the same place.
pub(super) fn first_at_place(positions: &[DVec3]) -> Vec<u32> {
    // Adding 0 turns −0 into 0.
    let bits = |vertex: u32| positions[vertex as usize].to_array().map(|x| (x + 0.0).to_bits());
    // Triangles name no vertex beyond 32 bits.
    let mut order: Vec<u32> = (0..=u32::MAX).take(positions.len()).collect();
    let mut first = order.clone();
    order.sort_unstable_by_key(|&vertex| (bits(vertex), vertex));
    for group in order.chunk_by(|&a, &b| bits(a) == bits(b)) {
        group.iter().for_each(|&vertex| first[vertex as usize] = group[0]);
    }
    first
}
