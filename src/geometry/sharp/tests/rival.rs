//! The triangles that are left, beside those that meshoptimizer leaves: as many of the same mesh.

use glam::DVec3;
use rayon::prelude::*;

use super::distances::{Distance, distance, to_triangle};
use crate::{
    geometry::sharp::{
        collapse::{Goal, State},
        edges::Sound,
        normals_of,
        ridges::Ridges,
    },
    hard_scenes::parts::bored_block,
    load::real::real_mesh,
    scene::Mesh,
};

/// Of triangles, with their normals.
type Triangles = Vec<([DVec3; 3], DVec3)>;

fn triangles(mesh: &Mesh, indices: &[[u32; 3]]) -> Triangles {
    let corners = indices.iter().map(|triangle| triangle.map(|vertex| mesh.positions[vertex as usize]));
    let with_normal = corners.map(|p| (p, (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero()));
    with_normal.filter(|(_, normal)| *normal != DVec3::ZERO).collect()
}

fn ours(mesh: &Mesh, count: usize) -> Vec<[u32; 3]> {
    let normals = normals_of(mesh);
    let Sound { edges, .. } = Sound::of(mesh).unwrap();
    let ridges = Ridges::of(mesh, &edges, &normals, 30_f64.to_radians());
    let mut state = State::new(&mesh.positions, mesh.triangles.clone(), &normals, &ridges, None);
    state.collapse(Goal { triangles: count, most_error: f64::INFINITY }, &());
    state.triangles
}

fn theirs(mesh: &Mesh, count: usize) -> Vec<[u32; 3]> {
    let positions: Vec<[f32; 3]> = mesh.positions.iter().map(|p| p.as_vec3().to_array()).collect();
    let vertices = meshopt::VertexDataAdapter::new(bytemuck::cast_slice(&positions), 12, 0).unwrap();
    let indices = mesh.triangles.as_flattened();
    let options = meshopt::SimplifyOptions::None;
    let left = meshopt::simplify(indices, &vertices, 3 * count, 1.0, options, None);
    left.chunks_exact(3).map(|triangle| [triangle[0], triangle[1], triangle[2]]).collect()
}

/// Corners, middles of sides, and the middle of each triangle.
fn places(of: &Triangles) -> Vec<(DVec3, DVec3)> {
    let weights =
        [[1.0, 0.0, 0.0], [0.0, 0.5, 0.5], [1.0 / 3.0; 3], [0.6, 0.2, 0.2], [0.2, 0.2, 0.6], [0.5, 0.0, 0.5]];
    let place = |p: &[DVec3; 3], w: [f64; 3]| w[0] * p[0] + w[1] * p[1] + w[2] * p[2];
    of.iter().flat_map(|(p, normal)| weights.map(|w| (place(p, w), *normal))).collect()
}

/// From places of one mesh to the other, and the mean angle between the normals at inner places; degrees.
fn from_to(from: &Triangles, to: &Triangles) -> (Distance, f64) {
    let balls: Vec<(DVec3, f64)> = to
        .iter()
        .map(|(p, _)| {
            let center = (p[0] + p[1] + p[2]) / 3.0;
            (center, p.iter().map(|p| p.distance(center)).fold(0.0, f64::max))
        })
        .collect();
    let nearest = |(place, normal): &(DVec3, DVec3)| {
        let mut best = (f64::INFINITY, 0.0);
        for ((p, own), (center, reach)) in to.iter().zip(&balls) {
            if place.distance(*center) - reach < best.0 {
                let far = to_triangle(*place, *p);
                if far < best.0 {
                    best = (far, normal.dot(*own).clamp(-1.0, 1.0).acos().to_degrees());
                }
            }
        }
        best
    };
    let all: Vec<(f64, f64)> = places(from).par_iter().map(nearest).collect();
    let inner: Vec<f64> = all.chunks(6).flat_map(|each| each[2..5].iter().map(|one| one.1)).collect();
    let far: Vec<f64> = all.iter().map(|one| one.0).collect();
    (distance(&far), inner.iter().sum::<f64>() / inner.len() as f64)
}

/// Both ways: the larger of the largest distances, in parts of the bounding box's diagonal, and the mean angle.
fn measured(name: &str, mesh: &Mesh, count: usize) -> [(f64, f64); 2] {
    let mesh = Sound::of(mesh).unwrap().mesh;
    let size = 2.0 * mesh.bounds().unwrap().radius();
    let whole = triangles(&mesh, &mesh.triangles);
    [("ours", ours(&mesh, count)), ("meshoptimizer", theirs(&mesh, count))].map(|(who, left)| {
        let left = triangles(&mesh, &left);
        let ((to, to_deg), (back, back_deg)) = (from_to(&whole, &left), from_to(&left, &whole));
        let (most, rms) = (to.most.max(back.most) / size, to.rms.max(back.rms) / size);
        let angle = 0.5 * (to_deg + back_deg);
        println!("{name}, {who}: {} triangles, {most:.2e} at most, {rms:.2e} root mean square, normals {angle:.2} degrees", left.len());
        (most, angle)
    })
}

/// What curves add along ridges is not counted here.
#[test]
fn as_few_triangles_are_as_near_as_those_of_meshoptimizer() {
    let mut meshes = vec![("bored block", bored_block(96, 6), [2500, 600])];
    meshes.extend(real_mesh("fandisk.obj").map(|mesh| ("fandisk", mesh, [2500, 1000])));
    for (name, mesh, counts) in meshes {
        for count in counts {
            let [ours, theirs] = measured(name, &mesh, count);
            assert!(ours.0 < 1.2 * theirs.0, "{name}: {:.2e} and {:.2e}", ours.0, theirs.0);
            assert!(count == 600 || ours.1 < theirs.1, "{name}: {:.2} and {:.2} degrees", ours.1, theirs.1);
        }
    }
}
