//! Meshes to measure the seam on that [`super::hybrid`] makes: each is in two parts in a way that is hard for it.

use glam::DVec3;

use crate::scene::Mesh;

/// A mesh, and which of its triangles stay polygons.
#[derive(Clone, Debug)]
pub struct Seam {
    /// Its name: what is hard about it.
    pub name: &'static str,
    /// No normals and no colors: whatever is seen at the seam is its own.
    pub mesh: Mesh,
    /// One for each triangle.
    pub polygon: Vec<bool>,
}

/// All of them. Squares are from −1 to 1 in the plane z = 0, spheres have radius 1; both are around the origin.
pub fn seams() -> Vec<Seam> {
    let right = |at: DVec3| at.x > 0.0;
    let below = |at: DVec3| at.z < 0.0;
    vec![
        seam("plane, triangles larger than splats", square(2), right),
        seam("plane, triangles as small as splats", square(60), right),
        seam("plane, the edge a zigzag", square(16), |at| at.x + 0.3 * at.y > 0.1),
        seam("plane, squares by turns: edges cross and are short", square(8), |at| {
            let [column, row] = [at.x, at.y].map(|x| (4.0 * (x + 1.0)).floor() as u32);
            (column + row) % 2 == 1
        }),
        seam("sphere, halves, triangles larger than splats", sphere(3), below),
        seam("sphere, halves, triangles smaller than splats", sphere(6), below),
        seam("sphere, the edge a zigzag", sphere(4), |at| at.z + 0.3 * at.x < 0.1),
    ]
}

/// `polygon` is asked with the triangles' middles.
fn seam(name: &'static str, mesh: Mesh, polygon: impl Fn(DVec3) -> bool) -> Seam {
    let middle = |triangle: &[u32; 3]| {
        triangle.iter().map(|&vertex| mesh.positions[vertex as usize]).sum::<DVec3>() / 3.0
    };
    let polygon = mesh.triangles.iter().map(|triangle| polygon(middle(triangle))).collect();
    Seam { name, mesh, polygon }
}

/// `n`² squares of two triangles each.
fn square(n: u32) -> Mesh {
    let at = |i: u32| 2.0 * f64::from(i) / f64::from(n) - 1.0;
    let vertices = (0..=n).flat_map(|row| (0..=n).map(move |column| DVec3::new(at(column), at(row), 0.0)));
    let corners = (0..n).flat_map(|row| (0..n).map(move |column| row * (n + 1) + column));
    let triangles = corners.flat_map(|a| [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]);
    Mesh { positions: vertices.collect(), triangles: triangles.collect(), ..Mesh::default() }
}

/// An octahedron, each face cut into 4 `levels` times, on the unit sphere; counterclockwise seen from outside.
pub(super) fn sphere(levels: usize) -> Mesh {
    let mut positions = vec![DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let mut triangles =
        vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    for _ in 0..levels {
        let mut middles = std::collections::HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]).normalize());
                positions.len() as u32 - 1
            })
        };
        let mut finer = Vec::new();
        for [a, b, c] in triangles {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    Mesh { positions, triangles, ..Mesh::default() }
}
