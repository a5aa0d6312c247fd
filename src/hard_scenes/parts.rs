//! Meshes of machine parts: closed, counterclockwise seen from outside, with ridges that are known.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;

use crate::scene::Mesh;

/// A closed cylinder of radius 1 around z from −height/2 on: `sides` around, `rows` along it.
pub fn cylinder(sides: u32, rows: u32, height: f64) -> Mesh {
    let mut positions = Vec::new();
    for row in 0..=rows {
        for side in 0..sides {
            let (y, x) = (TAU * f64::from(side) / f64::from(sides)).sin_cos();
            positions.push(DVec3::new(x, y, height * (f64::from(row) / f64::from(rows) - 0.5)));
        }
    }
    let at = |row: u32, side: u32| row * sides + side % sides;
    let mut triangles = Vec::new();
    for row in 0..rows {
        for side in 0..sides {
            let [a, b] = [at(row, side), at(row, side + 1)];
            let [c, d] = [at(row + 1, side), at(row + 1, side + 1)];
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    // Caps in rings toward the center, so that they are as fine as the side.
    for (row, up) in [(0, false), (rows, true)] {
        let mut outer: Vec<u32> = (0..sides).map(|side| at(row, side)).collect();
        let z = positions[outer[0] as usize].z;
        let rings = sides / 8;
        for ring in 1..rings {
            let radius = 1.0 - f64::from(ring) / f64::from(rings);
            let first = positions.len() as u32;
            for side in 0..sides {
                let (y, x) = (TAU * f64::from(side) / f64::from(sides)).sin_cos();
                positions.push(DVec3::new(radius * x, radius * y, z));
            }
            let inner: Vec<u32> = (0..sides).map(|side| first + side).collect();
            for side in 0..sides as usize {
                let next = (side + 1) % sides as usize;
                let [a, b, c, d] = [outer[side], outer[next], inner[side], inner[next]];
                let faces = [[a, b, d], [a, d, c]];
                triangles.extend(faces.map(|[a, b, c]| if up { [a, b, c] } else { [a, c, b] }));
            }
            outer = inner;
        }
        let middle = positions.len() as u32;
        positions.push(DVec3::new(0.0, 0.0, z));
        for side in 0..sides as usize {
            let [a, b] = [outer[side], outer[(side + 1) % sides as usize]];
            triangles.push(if up { [a, b, middle] } else { [b, a, middle] });
        }
    }
    Mesh { positions, triangles, ..Mesh::default() }
}

/// A closed box from −1 to 1, each side a grid of `count` squared quads.
pub fn cube(count: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let first = mesh.positions.len() as u32;
            for i in 0..=count {
                for j in 0..=count {
                    let [u, v] = [i, j].map(|k| 2.0 * f64::from(k) / f64::from(count) - 1.0);
                    let mut p = [0.0; 3];
                    (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (sign, u, v);
                    mesh.positions.push(DVec3::from(p));
                    if i > 0 && j > 0 {
                        let at = |i: u32, j: u32| first + i * (count + 1) + j;
                        let [a, b, c, d] = [at(i - 1, j - 1), at(i, j - 1), at(i, j), at(i - 1, j)];
                        let faces = [[a, b, c], [a, c, d]];
                        mesh.triangles
                            .extend(faces.map(|[a, b, c]| if sign > 0.0 { [a, b, c] } else { [a, c, b] }));
                    }
                }
            }
        }
    }
    mesh
}

/// A block with a bore: a ring around z whose bore is a circle of radius ½, whose outline is a square from −1 to 1 with corners rounded by
/// 0.3, from z = 0 to 0.6, with a fillet of 0.2 where the top meets the outer side. `sides` around it, a multiple of 8; the fillet has
/// `steps`. Its ridges are both rims of the bore and the lower edge of the outer side.
pub fn bored_block(sides: u32, steps: u32) -> Mesh {
    const HEIGHT: f64 = 0.6;
    const FILLET: f64 = 0.2;
    let rows_of = |length: f64| (length / (FILLET * FRAC_PI_2) * f64::from(steps)).ceil().max(1.0) as u32;
    // Each: how far from the bore to the outline, 0 to 1; by how much inside of the outline; z.
    let mut profile: Vec<[f64; 3]> = Vec::new();
    let mut go = |from: [f64; 3], to: [f64; 3], rows: u32| {
        for row in 0..rows {
            let at = f64::from(row) / f64::from(rows);
            profile.push(std::array::from_fn(|i| from[i] + at * (to[i] - from[i])));
        }
    };
    go([0.0, 0.0, 0.0], [0.0, 0.0, HEIGHT], rows_of(HEIGHT));
    go([0.0, 0.0, HEIGHT], [1.0, FILLET, HEIGHT], rows_of(0.4));
    for step in 0..steps {
        let (sin, cos) = (FRAC_PI_2 * f64::from(step) / f64::from(steps)).sin_cos();
        go([1.0, FILLET * (1.0 - sin), HEIGHT - FILLET * (1.0 - cos)], [0.0; 3], 1);
    }
    go([1.0, 0.0, HEIGHT - FILLET], [1.0, 0.0, 0.0], rows_of(HEIGHT - FILLET));
    go([1.0, 0.0, 0.0], [0.0, 0.0, 0.0], rows_of(0.5));
    let rows = profile.len() as u32;
    let mut mesh = Mesh::default();
    for side in 0..sides {
        let angle = TAU * f64::from(side) / f64::from(sides);
        let (sin, cos) = angle.sin_cos();
        for [out, within, z] in &profile {
            let (radius, outline) = (0.5, rounded_square(angle, 1.0 - within, 0.3 - within));
            let reach = (1.0 - out) * radius + out * outline;
            mesh.positions.push(DVec3::new(reach * cos, reach * sin, *z));
        }
    }
    let at = |side: u32, row: u32| side % sides * rows + row % rows;
    for side in 0..sides {
        for row in 0..rows {
            let [a, b, c, d] = [at(side, row), at(side + 1, row), at(side + 1, row + 1), at(side, row + 1)];
            mesh.triangles.extend([[a, d, c], [a, c, b]]);
        }
    }
    mesh
}

/// How far a square of half side `half`, with corners rounded by `corner`, reaches at an angle.
fn rounded_square(angle: f64, half: f64, corner: f64) -> f64 {
    let (y, x) = angle.sin_cos();
    let (x, y) = (x.abs().max(y.abs()), x.abs().min(y.abs()));
    let straight = half / x;
    let inner = half - corner;
    if straight * y <= inner {
        return straight;
    }
    // |r (x, y) − (inner, inner)| = corner.
    let along = inner * (x + y);
    along + (along * along - 2.0 * inner * inner + corner * corner).max(0.0).sqrt()
}
