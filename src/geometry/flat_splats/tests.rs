//! How far splats stand off their mesh, whether they cover it, and what stays round.

mod off;

use super::*;
use crate::{
    geometry::{DEFAULT_OVERLAP, radii::hole_free_radii, seams::sphere, splats_from_mesh},
    scene::{Colors, Splats},
};
use glam::Vec3;
use off::Distances;

/// A cube from −1 to 1 whose sides are cut into `n`² squares of two triangles each; its vertices are shared.
pub(crate) fn cube(n: u32) -> Mesh {
    let mut numbers = std::collections::HashMap::new();
    let mut mesh = Mesh::default();
    let at = |i: u32| 2.0 * f64::from(i) / f64::from(n) - 1.0;
    for side in 0..6 {
        let (axis, sign) = (side / 2, if side % 2 == 0 { 1.0 } else { -1.0 });
        let mut vertex = |i: u32, j: u32| {
            let mut p = [0.0; 3];
            (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (sign, at(i), at(j));
            *numbers.entry(p.map(|x| (x * 1e6) as i64)).or_insert_with(|| {
                mesh.positions.push(p.into());
                mesh.positions.len() as u32 - 1
            })
        };
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| vertex(i, j));
            let quad = if sign > 0.0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
            mesh.triangles.extend(quad);
        }
    }
    mesh
}

/// A torus of radii 1 and 0.4 of `n` times `m` vertices.
pub(crate) fn torus(n: u32, m: u32) -> Mesh {
    let angle = |i: u32, n: u32| std::f64::consts::TAU * f64::from(i) / f64::from(n);
    let place = |i: u32, j: u32| {
        let ((y, x), (h, r)) = (angle(i, n).sin_cos(), angle(j, m).sin_cos());
        let from_axis = 1.0 + 0.4 * r;
        DVec3::new(from_axis * x, from_axis * y, 0.4 * h)
    };
    let cells = || (0..n).flat_map(|i| (0..m).map(move |j| (i, j)));
    let number = |i: u32, j: u32| (i % n) * m + j % m;
    let quad = |(i, j)| [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
    let triangles = cells().map(quad).flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Mesh {
        positions: cells().map(|(i, j)| place(i, j)).collect(),
        triangles: triangles.collect(),
        ..Mesh::default()
    }
}

/// A cone of so many sides whose tip has no crease, of height 2 over a circle of radius 1.
fn cone(sides: u32) -> Mesh {
    let rim = (0..sides).map(|i| {
        let (y, x) = (std::f64::consts::TAU * f64::from(i) / f64::from(sides)).sin_cos();
        DVec3::new(x, y, 0.0)
    });
    let sides_of = (0..sides).map(|i| (2 + i, 2 + (i + 1) % sides));
    let triangles = sides_of.flat_map(|(a, b)| [[0, a, b], [1, b, a]]);
    Mesh {
        positions: [2.0 * DVec3::Z, DVec3::ZERO].into_iter().chain(rim).collect(),
        triangles: triangles.collect(),
        ..Mesh::default()
    }
}

/// Center and tangent vectors of each splat.
fn tangents(splats: &Splats) -> Vec<[DVec3; 3]> {
    let tangents = |i: usize| match &splats.shapes {
        Shapes::Disks { normals, radii } => {
            let (s, t) = basis(normals[i].as_dvec3());
            [f64::from(radii[i]) * s, f64::from(radii[i]) * t]
        }
        Shapes::Ellipses { s, t } => [s[i].as_dvec3(), t[i].as_dvec3()],
    };
    (0..splats.len()).map(|i| (splats.positions[i], tangents(i))).map(|(p, [s, t])| [p, s, t]).collect()
}

/// The splats as they were before any was an ellipse.
fn round(mesh: &Mesh) -> Splats {
    let surface = Surface::of(mesh, || {});
    let radii = hole_free_radii(mesh, &surface.normals);
    Splats::new(
        mesh.positions.clone(),
        Shapes::Disks {
            normals: surface.normals.iter().map(|normal| normal.as_vec3()).collect(),
            radii: radii.iter().map(|radius| (DEFAULT_OVERLAP * radius) as f32).collect(),
        },
        Colors::unknown(),
    )
}

/// How far rims stand off the mesh, in thousandths of its size: the 99th hundredth and the most.
fn off(mesh: &Mesh, splats: &Splats) -> [f64; 2] {
    let distances = Distances::of(mesh);
    let mut all = Vec::new();
    // Of large models a share is enough.
    for [center, s, t] in tangents(splats).into_iter().step_by(1 + splats.len() / 20_000) {
        for i in 0..24 {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 24.0).sin_cos();
            all.push(1000.0 * distances.to(center + cos * s + sin * t) / distances.size);
        }
    }
    all.sort_by(f64::total_cmp);
    [all[all.len() * 99 / 100], all[all.len() - 1]]
}

/// Points of every triangle that no splat covers, seen along the triangle's normal; and how many were tried.
fn holes(mesh: &Mesh, splats: &Splats, per_triangle: usize) -> (usize, usize) {
    let tangents = tangents(splats);
    let reach = |[_, s, t]: [DVec3; 3]| s.length().max(t.length());
    let step = 2.0 * tangents.iter().copied().map(reach).sum::<f64>() / tangents.len() as f64;
    let key = |p: DVec3| (p / step).floor().as_ivec3();
    let mut grid = std::collections::HashMap::<_, Vec<usize>>::new();
    for (i, &splat) in tangents.iter().enumerate() {
        let (from, to) = (key(splat[0] - reach(splat)), key(splat[0] + reach(splat)));
        for (x, y) in (from.x..=to.x).flat_map(|x| (from.y..=to.y).map(move |y| (x, y))) {
            (from.z..=to.z).for_each(|z| grid.entry(glam::IVec3::new(x, y, z)).or_default().push(i));
        }
    }
    let covers = |q: DVec3, face: DVec3, i: usize| {
        let [center, s, t] = tangents[i];
        let normal = s.cross(t).normalize();
        if face.dot(normal).abs() < 0.4 {
            return false;
        }
        let away = q - center;
        // A splat of another sheet is no cover.
        let along = away.dot(normal) / face.dot(normal);
        let seen = away - face * along;
        let (u, v) = (seen.dot(s) / s.length_squared(), seen.dot(t) / t.length_squared());
        u * u + v * v <= 1.0 + 1e-5 && along.abs() <= s.length().max(t.length())
    };
    let (mut holes, mut tried) = (0, 0);
    for (i, &triangle) in mesh.triangles.iter().enumerate().step_by(1 + mesh.triangles.len() / 50_000) {
        let Some(p) = corners(mesh, triangle) else { continue };
        let face = (p[1] - p[0]).cross(p[2] - p[0]).normalize();
        for j in 0..per_triangle {
            let random = |g: f64| (0.5 + g * (i * per_triangle + j) as f64).fract();
            let (u, v) = (random(0.754_877_666_246_693), random(0.569_840_290_998_053));
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let q = p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]);
            let covered = grid.get(&key(q)).is_some_and(|near| near.iter().any(|&i| covers(q, face, i)));
            tried += 1;
            holes += usize::from(!covered);
        }
    }
    (holes, tried)
}

/// What is off before and after, what is not covered.
fn measure(name: &str, mesh: &Mesh) -> [[f64; 2]; 2] {
    let (splats, _) = splats_from_mesh(mesh, DEFAULT_OVERLAP, &());
    let ellipses = matches!(splats.shapes, Shapes::Ellipses { .. });
    let [before, after] = [off(mesh, &round(mesh)), off(mesh, &splats)];
    let (holes, tried) = holes(mesh, &splats, 10);
    println!(
        "{name}: {} vertices, {} splats{}; off p99 {:.2} -> {:.2}, most {:.2} -> {:.2} thousandths of the size; \
         {holes} of {tried} points not covered",
        mesh.positions.len(),
        splats.len(),
        if ellipses { "" } else { ", all round" },
        before[0],
        after[0],
        before[1],
        after[1],
    );
    assert_eq!(holes, 0, "{name}");
    [before, after]
}

#[test]
fn splats_stand_less_off_where_a_mesh_turns_and_cover_all_of_it() {
    let cube = measure("cube of 12² squares a side", &cube(12));
    assert!(3.0 * cube[1][1] < cube[0][1] && 3.0 * cube[1][0] < cube[0][0], "{cube:?}");
    let cone = measure("cone of 24 sides", &cone(24));
    assert!(cone[1][1] < 0.7 * cone[0][1], "{cone:?}");
    measure("torus of 96 times 48", &torus(96, 48));
}

#[cfg(feature = "files")]
#[test]
fn real_meshes_are_covered_and_stand_less_off() {
    for name in ["fandisk.obj", "igea.ply"] {
        let Some(mesh) = crate::load::real::real_mesh(name) else { continue };
        let found = measure(name, &mesh);
        let bound = if name.starts_with("fandisk") { 0.5 } else { 1.0 };
        assert!(found[1][1] <= bound * found[0][1], "{found:?}");
    }
}

#[test]
fn what_goes_on_stays_round_to_the_bit() {
    for mesh in [sphere(4), torus(96, 48)] {
        let (splats, _) = splats_from_mesh(&mesh, DEFAULT_OVERLAP, &());
        let (Shapes::Disks { normals, radii }, Shapes::Disks { normals: n, radii: r }) =
            (&splats.shapes, &round(&mesh).shapes)
        else {
            panic!("ellipses")
        };
        assert_eq!((normals, radii), (n, r));
    }
}

/// Normals of the file are kept: a cube with the normals of a ball has one splat a vertex.
#[test]
fn the_files_normals_are_not_split() {
    let mut mesh = cube(6);
    mesh.normals = Some(mesh.positions.iter().map(|p| p.normalize().as_vec3()).collect::<Vec<Vec3>>());
    let (splats, _) = splats_from_mesh(&mesh, DEFAULT_OVERLAP, &());
    assert_eq!(splats.len(), mesh.positions.len());
}
