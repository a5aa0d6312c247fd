//! A ball, as splats and as triangles: the simplest closed surface.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::fibonacci_direction;
use crate::scene::{Colors, Mesh, Object, Shapes, Splats};

/// How many splats the ball has where nothing else is asked for.
pub const DEFAULT_SPHERE_SPLATS: usize = 20_000;

/// How many triangles at least it has where nothing else is asked for.
pub const DEFAULT_SPHERE_TRIANGLES: u64 = 20_480;

/// The most triangles of a ball: vertices are counted in 32 bits, and there are half as many.
pub const MOST_SPHERE_TRIANGLES: u64 = 1 << 32;

/// A ball of radius 1 around the origin: `count` disks on a spherical Fibonacci lattice, as large as those of
/// [`super::relief`], facing outward.
pub fn sphere(count: usize) -> Object {
    let directions = || (0..count).map(|i| fibonacci_direction(i, count));
    let splats = Splats::new(
        directions().collect(),
        Shapes::Disks {
            normals: directions().map(|direction| direction.as_vec3()).collect(),
            radii: vec![super::radius_on_unit_sphere(count); count],
        },
        Colors::unknown(),
    );
    Object { name: "built-in sphere".to_owned(), splats, closed: true }
}

/// The corners of the icosahedron, but for their length.
const PHI: f64 = 1.618_033_988_749_895;
const CORNERS: [[f64; 3]; 12] = [
    [-1.0, PHI, 0.0],
    [1.0, PHI, 0.0],
    [-1.0, -PHI, 0.0],
    [1.0, -PHI, 0.0],
    [0.0, -1.0, PHI],
    [0.0, 1.0, PHI],
    [0.0, -1.0, -PHI],
    [0.0, 1.0, -PHI],
    [PHI, 0.0, -1.0],
    [PHI, 0.0, 1.0],
    [-PHI, 0.0, -1.0],
    [-PHI, 0.0, 1.0],
];
/// Its faces, counterclockwise seen from outside.
const FACES: [[usize; 3]; 20] = [
    [0, 11, 5],
    [0, 5, 1],
    [0, 1, 7],
    [0, 7, 10],
    [0, 10, 11],
    [1, 5, 9],
    [5, 11, 4],
    [11, 10, 2],
    [10, 7, 6],
    [7, 1, 8],
    [3, 9, 4],
    [3, 4, 2],
    [3, 2, 6],
    [3, 6, 8],
    [3, 8, 9],
    [4, 9, 5],
    [2, 4, 11],
    [6, 2, 10],
    [8, 6, 7],
    [9, 8, 1],
];

/// The ball as a mesh with exact normals: an icosahedron, the edges of which are cut into `n` parts, the smallest `n` for
/// which there are at least `triangles` (there are `20 n²`; [`MOST_SPHERE_TRIANGLES`] are made of a larger number). All
/// corners lie on the ball.
pub fn sphere_mesh(triangles: u64) -> Mesh {
    let cuts = cuts(triangles);
    let mut ball = Ball { cuts, vertices: HashMap::new(), positions: Vec::new() };
    let mut faces = Vec::new();
    for face in FACES {
        for row in 0..cuts {
            for column in 0..cuts - row {
                let mut vertex = |b: u32, c: u32| ball.vertex(face, [cuts - b - c, b, c]);
                let (here, right, above) =
                    (vertex(column, row), vertex(column + 1, row), vertex(column, row + 1));
                faces.push([here, right, above]);
                if column + row + 1 < cuts {
                    faces.push([right, vertex(column + 1, row + 1), above]);
                }
            }
        }
    }
    let normals = ball.positions.iter().map(|position| position.as_vec3()).collect::<Vec<Vec3>>();
    Mesh { positions: ball.positions, normals: Some(normals), colors: Colors::unknown(), triangles: faces }
}

/// 20 times its square is the first number above [`MOST_SPHERE_TRIANGLES`].
const MOST_CUTS: u32 = 14_655;

/// Into how many parts edges are cut for so many triangles.
fn cuts(triangles: u64) -> u32 {
    let enough = |cuts: &u32| 20 * u64::from(*cuts).pow(2) >= triangles;
    (1..MOST_CUTS).find(enough).unwrap_or(MOST_CUTS)
}

/// The vertices so far.
struct Ball {
    cuts: u32,
    /// By the corners that a vertex lies between and its weights: neighboring faces find the same.
    vertices: HashMap<[(usize, u32); 3], u32>,
    positions: Vec<DVec3>,
}

impl Ball {
    /// The vertex with these weights, which sum to `cuts`, of a face's corners.
    fn vertex(&mut self, face: [usize; 3], weights: [u32; 3]) -> u32 {
        let mut key = [0, 1, 2].map(|i| if weights[i] == 0 { (0, 0) } else { (face[i], weights[i]) });
        key.sort_unstable();
        let positions = &mut self.positions;
        *self.vertices.entry(key).or_insert_with(|| {
            let corner = |(corner, weight): (usize, u32)| f64::from(weight) * DVec3::from(CORNERS[corner]);
            let sum = key.map(corner).into_iter().sum::<DVec3>() / f64::from(self.cuts);
            positions.push(sum.normalize());
            (positions.len() - 1) as u32
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splats_lie_on_the_unit_ball_face_outward_and_leave_no_hole() {
        let mut object = sphere(3000);
        assert!(object.closed && object.splats.drop_defective().total() == 0);
        let Shapes::Disks { normals, radii } = &object.splats.shapes else { panic!("ellipses") };
        for (position, normal) in object.splats.positions.iter().zip(normals) {
            assert!((position.length() - 1.0).abs() < 1e-15);
            assert!(normal.as_dvec3().distance(*position) < 1e-7);
        }
        for i in 0..2000 {
            let direction = fibonacci_direction(i, 2000);
            let nearest = object.splats.positions.iter().map(|p| p.distance(direction)).fold(9.0, f64::min);
            assert!(nearest < f64::from(radii[0]), "a hole at {direction}");
        }
        for count in [0, 1, 2] {
            let mut few = sphere(count).splats;
            assert_eq!((few.len(), few.drop_defective().total()), (count, 0));
        }
    }

    #[test]
    fn the_mesh_is_closed_round_and_counterclockwise_from_outside() {
        for (asked, triangles) in [(0, 20), (20, 20), (21, 80), (1000, 1280), (20_480, 20_480)] {
            let mesh = sphere_mesh(asked);
            assert_eq!(mesh.triangles.len(), triangles);
            // Euler: two more corners and faces than edges, of which each face has one and a half.
            assert_eq!(mesh.positions.len(), triangles / 2 + 2);
            let mut edges = HashMap::new();
            for &[a, b, c] in &mesh.triangles {
                let [pa, pb, pc] = [a, b, c].map(|vertex| mesh.positions[vertex as usize]);
                assert!((pb - pa).cross(pc - pa).dot(pa) > 0.0);
                for edge in [(a, b), (b, c), (c, a)] {
                    assert_eq!(edges.insert(edge, ()), None, "each direction of an edge once");
                }
            }
            assert!(edges.keys().all(|(a, b)| edges.contains_key(&(*b, *a))), "no boundary");
            let normals = mesh.normals.unwrap();
            for (position, normal) in mesh.positions.iter().zip(normals) {
                assert!((position.length() - 1.0).abs() < 1e-15);
                assert!(normal.as_dvec3().distance(*position) < 1e-7);
            }
        }
        assert_eq!((cuts(u64::MAX), cuts(MOST_SPHERE_TRIANGLES)), (MOST_CUTS, MOST_CUTS));
    }
}
