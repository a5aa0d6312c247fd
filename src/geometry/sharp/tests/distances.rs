//! How far splats are from the mesh that they stand for, and the mesh from them.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::few;
use crate::{
    geometry::{
        clip::removes,
        sharp::{Clipping, sharp_splats},
    },
    hard_scenes::parts::bored_block,
    load::real::real_mesh,
    scene::{Mesh, Shapes, Splats},
};

/// Largest and root mean square distance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Distance {
    pub most: f64,
    pub rms: f64,
}

pub(super) fn distance(all: &[f64]) -> Distance {
    let most = all.iter().copied().fold(0.0, f64::max);
    Distance { most, rms: (all.iter().map(|d| d * d).sum::<f64>() / all.len() as f64).sqrt() }
}

/// From places of splats that are not cut off to the mesh, by area alike on each splat.
pub(super) fn to_mesh(splats: &Splats, mesh: &Mesh) -> Distance {
    let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
    let triangles: Vec<([DVec3; 3], DVec3, f64)> = (0..mesh.triangles.len())
        .map(|i| {
            let p = mesh.corners(i).unwrap();
            let center = (p[0] + p[1] + p[2]) / 3.0;
            (p, center, p.iter().map(|p| p.distance(center)).fold(0.0, f64::max))
        })
        .collect();
    let places: Vec<DVec3> = (0..splats.len())
        .flat_map(|i| {
            (0..24).map(move |k| (i, (f64::from(k) / 24.0).sqrt() * DVec2::from_angle(2.4 * f64::from(k))))
        })
        .filter(|(i, uv)| !removes(&splats.clips.get(*i), *uv))
        .map(|(i, uv)| splats.positions[i] + uv.x * s[i].as_dvec3() + uv.y * t[i].as_dvec3())
        .collect();
    let nearest = |place: &DVec3| {
        triangles.iter().fold(f64::INFINITY, |best, (p, center, reach)| {
            if place.distance(*center) - reach >= best { best } else { best.min(to_triangle(*place, *p)) }
        })
    };
    distance(&places.par_iter().map(nearest).collect::<Vec<_>>())
}

pub(super) fn to_triangle(place: DVec3, p: [DVec3; 3]) -> f64 {
    let normal = (p[1] - p[0]).cross(p[2] - p[0]);
    let inside = (0..3).all(|i| normal.dot((p[(i + 1) % 3] - p[i]).cross(place - p[i])) >= 0.0);
    if inside {
        return ((place - p[0]).dot(normal) / normal.length()).abs();
    }
    let side = |i: usize| {
        let (a, side) = (p[i], p[(i + 1) % 3] - p[i]);
        let share = ((place - a).dot(side) / side.length_squared()).clamp(0.0, 1.0);
        place.distance(a + share * side)
    };
    side(0).min(side(1)).min(side(2))
}

/// From the vertices and the middles of triangles to the nearest splat above or below which they are, by its plane; where they are on none, to
/// the nearest place of one.
pub(super) fn to_splats(mesh: &Mesh, splats: &Splats) -> Distance {
    let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
    let middles = (0..mesh.triangles.len()).map(|i| mesh.corners(i).unwrap().iter().sum::<DVec3>() / 3.0);
    let places: Vec<DVec3> = mesh.positions.iter().copied().chain(middles).collect();
    let nearest = |place: &DVec3| {
        (0..splats.len()).fold(f64::INFINITY, |best, i| {
            let (s, t) = (s[i].as_dvec3(), t[i].as_dvec3());
            let away = *place - splats.positions[i];
            if away.length() - splats.major_radius(i) >= best {
                return best;
            }
            let mut uv = DVec2::new(away.dot(s) / s.length_squared(), away.dot(t) / t.length_squared());
            uv = uv.clamp_length_max(1.0);
            // From a place that is cut off toward the center, until it is not.
            for _ in 0..20 {
                if removes(&splats.clips.get(i), uv) {
                    uv *= 0.9;
                }
            }
            if removes(&splats.clips.get(i), uv) {
                return best;
            }
            best.min((away - uv.x * s - uv.y * t).length())
        })
    };
    distance(&places.par_iter().map(nearest).collect::<Vec<_>>())
}

fn measured(name: &str, mesh: &Mesh, count: u64) -> [Distance; 2] {
    let bounds = mesh.bounds().unwrap();
    let size = 2.0 * bounds.radius();
    let (splats, report) = sharp_splats(mesh, &few(count, Clipping::Shared), &()).unwrap();
    let scaled = |d: Distance| Distance { most: d.most / size, rms: d.rms / size };
    let both = [scaled(to_mesh(&splats, mesh)), scaled(to_splats(mesh, &splats))];
    println!(
        "{name}: {} splats of {} triangles, error {:.2e}",
        splats.len(),
        mesh.triangles.len(),
        report.error / size
    );
    for (way, Distance { most, rms }) in ["to the mesh", "from it"].into_iter().zip(both) {
        println!("  {way}: {most:.2e} at most, {rms:.2e} root mean square (of the bounding box's diagonal)");
    }
    both
}

#[test]
fn few_splats_are_near_the_mesh_and_it_to_them() {
    for (count, most) in [(600, 2e-2), (2500, 8e-3)] {
        let both = measured("bored block", &bored_block(96, 6), count);
        assert!(both.iter().all(|d| d.most < most && d.rms < most / 8.0), "{both:?}");
    }
    if let Some(mesh) = real_mesh("fandisk.obj") {
        let both = measured("fandisk", &mesh, 2500);
        assert!(both.iter().all(|d| d.most < 1e-2 && d.rms < 1e-3), "{both:?}");
    }
}
