//! What hierarchies are made of here: surfaces that are smooth, sharp, thin, or none.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

use crate::{
    load::builtin::{relief, sphere},
    math::random::SplitMix,
    scene::{Colors, Shapes, Splats},
};

/// All models, by name.
pub fn models() -> Vec<(&'static str, Splats)> {
    let mut models = vec![
        ("relief", relief(6000).splats),
        ("sphere", sphere(3000).splats),
        ("plate", plate(40, 0.02)),
        ("sheet of two sides", plate(40, 0.0)),
        ("random", random_ellipses(4000, 1.0, 5)),
        ("random far away", moved(random_ellipses(2000, 1.0, 6), DVec3::splat(1e7))),
        ("line", line(1000)),
        ("all in one place", one_place(500)),
        ("powers of two", powers_of_two(400)),
        ("two", random_ellipses(2, 1.0, 7)),
    ];
    #[cfg(feature = "files")]
    for name in ["igea.ply", "fandisk.obj"] {
        models.extend(real_model(name).map(|splats| (name, splats)));
    }
    models
}

/// A real model, where it is there.
#[cfg(feature = "files")]
pub fn real_model(name: &str) -> Option<Splats> {
    use crate::{geometry, load::real::real_mesh};
    let mesh = real_mesh(name)?;
    let (mut splats, _) = geometry::splats_from_mesh(&mesh, geometry::DEFAULT_OVERLAP, &());
    splats.drop_defective();
    Some(splats)
}

/// Disks on a grid of both sides of a plate of 2 × 2, `thickness` apart, and along its rim where it has one. The sides are red and green.
pub fn plate(side: usize, thickness: f64) -> Splats {
    let step = 2.0 / side as f64;
    let at = |i: usize| (i as f64 + 0.5) * step - 1.0;
    let mut disks = Vec::new();
    for i in 0..side {
        for j in 0..side {
            disks.push((DVec3::new(at(i), at(j), 0.5 * thickness), Vec3::Z, [1.0, 0.0, 0.0, 1.0]));
            disks.push((DVec3::new(at(i), at(j), -0.5 * thickness), Vec3::NEG_Z, [0.0, 1.0, 0.0, 1.0]));
        }
        if thickness > 0.0 {
            let sides = [(1.0, Vec3::X), (-1.0, Vec3::NEG_X)];
            for (x, normal) in sides {
                disks.push((DVec3::new(x, at(i), 0.0), normal, [0.0, 0.0, 1.0, 1.0]));
            }
        }
    }
    Splats::new(
        disks.iter().map(|disk| disk.0).collect(),
        Shapes::Disks {
            normals: disks.iter().map(|disk| disk.1).collect(),
            radii: vec![(0.75 * step) as f32; disks.len()],
        },
        Colors::Each(disks.iter().map(|disk| disk.2).collect()),
    )
}

/// Skew ellipses with every normal, in a ball of this radius.
pub fn random_ellipses(count: usize, radius: f64, seed: u64) -> Splats {
    let mut random = SplitMix(seed);
    let mut vector = || {
        let (z, angle) = (2.0 * random.unit() - 1.0, TAU * random.unit());
        random.unit().cbrt()
            * DVec3::new((1.0 - z * z).sqrt() * angle.cos(), (1.0 - z * z).sqrt() * angle.sin(), z)
    };
    let positions: Vec<DVec3> = (0..count).map(|_| radius * vector()).collect();
    let mut tangents = || (0..count).map(|_| (0.1 * radius * vector()).as_vec3()).collect();
    let (s, t) = (tangents(), tangents());
    let colors = Colors::Each((0..count).map(|_| vector().abs().as_vec3().extend(0.5).to_array()).collect());
    let mut splats = Splats::new(positions, Shapes::Ellipses { s, t }, colors);
    splats.drop_defective();
    splats
}

fn moved(mut splats: Splats, by: DVec3) -> Splats {
    splats.positions.iter_mut().for_each(|position| *position += by);
    splats
}

fn line(count: usize) -> Splats {
    disks((0..count).map(|i| i as f64 * DVec3::new(0.1, 0.2, -0.3)).collect())
}

fn one_place(count: usize) -> Splats {
    disks(vec![DVec3::new(1.0, 2.0, 3.0); count])
}

/// The mean leaves nearly all of them on one side, time and again.
pub fn powers_of_two(count: i32) -> Splats {
    disks((0..count).map(|i| DVec3::new(2.0_f64.powi(i / 4 - 50), 0.0, 0.0)).collect())
}

/// Of two sizes, with normals all around.
fn disks(positions: Vec<DVec3>) -> Splats {
    let turn = |i: usize| Vec3::new((i as f32).sin(), (i as f32).cos(), 0.3 * (0.7 * i as f32).sin());
    let count = positions.len();
    Splats::new(
        positions,
        Shapes::Disks {
            normals: (0..count).map(turn).collect(),
            radii: (0..count).map(|i| if i % 3 == 0 { 0.5 } else { 0.05 }).collect(),
        },
        Colors::unknown(),
    )
}
