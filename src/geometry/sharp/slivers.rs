//! Triangles without area, which hold their neighbors together: CAD programs write them where a vertex lies on another face's edge.

use std::collections::HashMap;

use glam::DVec3;

use crate::{geometry::corners, scene::Mesh};

/// Leaves out triangles without area; how many there were. Of one whose three vertices are on a line the middle one is given to the triangle beyond
/// the longest side, which becomes two: so what was closed stays closed.
pub(super) fn leave_out(mesh: &mut Mesh) -> usize {
    let mut flat: Vec<usize> =
        (0..mesh.triangles.len()).filter(|i| corners(mesh, mesh.triangles[*i]).is_none()).collect();
    if flat.is_empty() {
        return 0;
    }
    let count = flat.len();
    let mut by_side: HashMap<(u32, u32), usize> = HashMap::new();
    let sides = |[a, b, c]: [u32; 3]| [(a, b), (b, c), (c, a)];
    for (i, triangle) in mesh.triangles.iter().enumerate() {
        by_side.extend(sides(*triangle).map(|side| (side, i)));
    }
    let mut is_flat = vec![false; mesh.triangles.len()];
    flat.iter().for_each(|i| is_flat[*i] = true);
    // Those beyond which there is another one wait for it.
    loop {
        let before = flat.len();
        flat.retain(|&i| {
            let Some([a, middle, c]) = from_middle(mesh, mesh.triangles[i]) else { return false };
            let Some(&beyond) = by_side.get(&(a, c)) else { return false };
            if is_flat[beyond] {
                return true;
            }
            let [x, y, z] = mesh.triangles[beyond];
            let Some(&d) = [x, y, z].iter().find(|v| **v != a && **v != c) else { return false };
            let (first, second) = ([a, middle, d], [middle, c, d]);
            mesh.triangles[beyond] = first;
            mesh.triangles.push(second);
            is_flat.push(false);
            by_side.extend(sides(first).map(|side| (side, beyond)));
            by_side.extend(sides(second).map(|side| (side, mesh.triangles.len() - 1)));
            false
        });
        if flat.is_empty() || flat.len() == before {
            break;
        }
    }
    let mut is_flat = is_flat.iter();
    mesh.triangles.retain(|_| !*is_flat.next().unwrap_or(&false));
    count
}

/// The corners in their order, the one that lies between the others in the middle; `None` where two are one, or a place is no number.
fn from_middle(mesh: &Mesh, [a, b, c]: [u32; 3]) -> Option<[u32; 3]> {
    let at = |vertex: u32| mesh.positions.get(vertex as usize).copied().filter(|at| DVec3::is_finite(*at));
    let turns = [[a, b, c], [b, c, a], [c, a, b]];
    let between = |[from, _, to]: &[u32; 3]| Some(at(*from)?.distance_squared(at(*to)?));
    if a == b || b == c || c == a || turns.iter().any(|turn| between(turn).is_none()) {
        return None;
    }
    turns.into_iter().max_by(|x, y| between(x).unwrap_or(0.0).total_cmp(&between(y).unwrap_or(0.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::sharp::edges::{NONE, edges};

    /// A pyramid one side of whose base has two vertices more, in one chain of flat triangles in whatever order.
    #[test]
    fn what_is_closed_stays_closed() {
        let places = [[0., 0., 0.], [3., 0., 0.], [0., 3., 0.], [0., 0., 3.], [1., 0., 0.], [2., 0., 0.]]
            .map(DVec3::from);
        // The base has the side from 1 to 0, the front its parts.
        let whole = [[0, 2, 1], [0, 3, 2], [1, 2, 3], [0, 4, 3], [4, 5, 3], [5, 1, 3]];
        let flat = [[[4, 0, 5], [5, 0, 1]], [[5, 0, 1], [4, 0, 5]]];
        for flat in flat {
            let triangles = [&whole[..], &flat[..], &[[2, 2, 1]]].concat();
            let mut mesh = Mesh { positions: places.to_vec(), triangles, ..Mesh::default() };
            assert_eq!(leave_out(&mut mesh), 3);
            let edges = edges(&mesh.triangles).all;
            assert!(edges.iter().all(|edge| edge.left != NONE && edge.right != NONE), "{:?}", mesh.triangles);
            assert_eq!(mesh.triangles.len(), 8);
            assert!(mesh.triangles.iter().all(|t| corners(&mesh, *t).is_some()));
        }
    }

    #[test]
    fn those_that_nothing_is_beside_are_left_out() {
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]].map(DVec3::from).to_vec();
        let mut mesh =
            Mesh { positions, triangles: vec![[0, 1, 2], [0, 0, 9], [2, 1, 0]], ..Mesh::default() };
        assert_eq!((leave_out(&mut mesh), mesh.triangles.len()), (3, 0));
    }
}
