//! Whole conversions.

mod colors;
mod cut_apart;
mod distances;
mod gaps;
mod rival;
mod standing;

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::{Clipping, SharpOptions, sharp_splats};
use crate::{
    geometry::clip::removes,
    hard_scenes::parts::{bored_block, cube, cylinder},
    scene::{Clip, Mesh, Shapes, Splats},
};

fn few(count: u64, clipping: Clipping) -> SharpOptions {
    SharpOptions { splats: Some(count), clipping, ..SharpOptions::default() }
}

/// Places of splats that are not cut off, on a grid of their own, with the splats' numbers.
fn places(splats: &Splats) -> Vec<(usize, DVec3)> {
    let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
    let mut places = Vec::new();
    for i in 0..splats.len() {
        for x in -20..=20 {
            for y in -20..=20 {
                let uv = DVec2::new(f64::from(x), f64::from(y)) / 20.0;
                if uv.length() <= 1.0 && !removes(&splats.clips.get(i), uv) {
                    places.push((i, splats.positions[i] + uv.x * s[i].as_dvec3() + uv.y * t[i].as_dvec3()));
                }
            }
        }
    }
    places
}

/// All triangles of a fan meet in one corner, where an ellipse touches each of them: no ridge beyond these cuts it.
#[test]
fn a_fan_is_a_splat_for_each_of_its_triangles() {
    for sides in [60, 512, 3000] {
        let mut positions = vec![DVec3::ZERO];
        let rim = |i: u32| DVec2::from_angle(TAU * f64::from(i) / f64::from(sides)).extend(0.0);
        positions.extend((0..sides).map(rim));
        let triangles = (0..sides).map(|i| [0, 1 + i, 1 + (i + 1) % sides]).collect();
        let mesh = Mesh { positions, triangles, ..Mesh::default() };
        let (splats, report) = sharp_splats(&mesh, &SharpOptions::default(), &()).unwrap();
        assert_eq!((splats.len(), report.cut_triangles, report.crowded), (sides as usize, 0, 0), "{sides}");
    }
}

#[test]
fn a_box_of_few_splats_has_no_ears_and_no_holes() {
    for count in [12, 30, 100] {
        let (splats, report) = sharp_splats(&cube(8), &few(count, Clipping::Shared), &()).unwrap();
        println!("{count}: {} splats, {report:?}", splats.len());
        assert!(report.closed && report.ridges == 12 && report.repairs.welded > 0);
        let worst = places(&splats).iter().map(|(_, p)| p.abs().max_element() - 1.0).fold(0.0, f64::max);
        assert!(worst < 1e-4, "{count}: sticks out by {worst}");
        assert_eq!(report.crowded, 0);
        // Each side is covered.
        let on_top: Vec<DVec3> =
            places(&splats).into_iter().map(|(_, p)| p).filter(|p| p.z > 1.0 - 1e-9).collect();
        for x in -9..=9 {
            for y in -9..=9 {
                let at = DVec3::new(f64::from(x) / 9.2, f64::from(y) / 9.2, 1.0);
                assert!(on_top.iter().any(|p| p.distance(at) < 0.15), "{count}: hole at {at}");
            }
        }
    }
    let (_, report) = sharp_splats(&cube(8), &few(100, Clipping::None), &()).unwrap();
    assert_eq!(report.clipped, 0);
}

/// The rims of a cylinder are circles to the bit of f32 on its caps.
#[test]
fn rims_of_a_cylinder_are_arcs() {
    for clipping in [Clipping::Shared, Clipping::Own, Clipping::Lines, Clipping::None] {
        let (splats, report) = sharp_splats(&cylinder(96, 20, 2.0), &few(300, clipping), &()).unwrap();
        println!("{clipping:?}: {} splats, {report:?}", splats.len());
        let (mut caps, mut worst) = (0, 0.0_f64);
        let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
        for (i, p) in places(&splats) {
            let normal = s[i].cross(t[i]).normalize();
            if normal.z.abs() > 0.999 {
                caps += 1;
                worst = worst.max(p.truncate().length() - 1.0);
            }
        }
        println!("  caps stick out by {worst:e} at {caps} places");
        assert_eq!((report.ridges, report.closed), (2, true));
        match clipping {
            Clipping::Shared => assert!(worst < 2e-6, "{worst:e}"),
            Clipping::Own => assert!(worst < 5e-3, "{worst:e}"),
            Clipping::Lines => assert!(worst < 2e-6, "chords are within: {worst:e}"),
            Clipping::None => assert!(worst > 0.02, "{worst:e}"),
        }
        let arcs = (0..splats.len()).filter(|&i| match splats.clips.get(i) {
            Clip::One(curve) => curve.weight > 0.5 && curve.weight < 0.999,
            _ => false,
        });
        assert!(clipping != Clipping::Shared || arcs.count() > 10);
    }
}

#[test]
fn a_bound_on_the_error_is_kept_and_the_same_mesh_gives_the_same_bytes() {
    let mesh = cylinder(200, 40, 2.0);
    let mut last = usize::MAX;
    for max_error in [1e-4, 1e-3, 1e-2] {
        let options = SharpOptions { max_error: Some(max_error), ..SharpOptions::default() };
        let (splats, report) = sharp_splats(&mesh, &options, &()).unwrap();
        assert!(report.error <= max_error && splats.len() < last, "{max_error}: {} {report:?}", splats.len());
        last = splats.len();
        let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let (again, _) = one_thread.install(|| sharp_splats(&mesh, &options, &()).unwrap());
        assert_eq!((again.positions, again.clips), (splats.positions, splats.clips));
    }
    let refused = |options: SharpOptions| sharp_splats(&mesh, &options, &()).err().unwrap().to_string();
    assert!(refused(few(0, Clipping::Shared)).contains("--splats"));
    let options = SharpOptions { max_error: Some(f64::NAN), ..SharpOptions::default() };
    assert!(refused(options).contains("--max-error"));
}

/// Its rims are circles, its lower edge lines and circles; its fillet is no ridge.
#[test]
fn a_bored_block_has_three_ridges_and_each_splat_is_cut_at_those_that_cross_it() {
    let mesh = bored_block(96, 6);
    for count in [400, 900, 2000] {
        let (splats, report) = sharp_splats(&mesh, &few(count, Clipping::Shared), &()).unwrap();
        println!("{count}: {} splats, {report:?}", splats.len());
        assert_eq!((report.ridges, report.closed, report.crowded), (3, true, 0));
        assert!(!report.repairs.turned);
        assert!(splats.len() as u64 <= count && report.clipped > 20);
        // On the flat sides nothing reaches into the bore, and nothing over the lower edge.
        let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
        for (i, p) in places(&splats) {
            let normal = s[i].cross(t[i]).normalize();
            if normal.z.abs() > 0.9999 {
                let (radius, reach) = (p.truncate().length(), p.truncate().abs().max_element());
                assert!(radius > 0.5 - 3e-3 && reach < 1.0 + 3e-3, "{count}: {p} of {i}");
            }
            assert!(p.z > -1e-2 && p.z < 0.62, "{count}: {p} of {i}");
        }
    }
}

/// So few that smooth corners are edges: ellipses end there, though no ridge is there, and do not stick out as far as they are long.
#[test]
fn where_few_splats_bend_by_much_they_have_no_ears_either() {
    let (splats, report) = sharp_splats(&bored_block(96, 6), &few(200, Clipping::Shared), &()).unwrap();
    let beyond =
        places(&splats).iter().map(|(_, p)| p.truncate().abs().max_element() - 1.0).fold(0.0, f64::max);
    println!("{} splats stick out by {beyond}; {report:?}", splats.len());
    assert!(beyond < 0.06, "{beyond}");
}

/// A square plate with a small hole near a corner, whose flat sides are slivers from the hole to the plate's corners: their ellipses reach over many sides of
/// the hole, and are cut in two until none does.
#[test]
fn slivers_around_a_hole_do_not_reach_into_it() {
    const SIDES: u32 = 40;
    let (hole, corners) =
        (DVec2::new(6.0, 6.0), [[10.0, 10.0], [-10.0, 10.0], [-10.0, -10.0], [10.0, -10.0]]);
    let mut mesh = Mesh::default();
    // Of each height the hole, then the corners.
    for z in [0.0, 1.0] {
        let rim = (0..SIDES).map(|i| hole + DVec2::from_angle(TAU * f64::from(i) / f64::from(SIDES)));
        mesh.positions.extend(rim.chain(corners.map(DVec2::from)).map(|p| p.extend(z)));
    }
    let corner_of = |i: u32| {
        (0..4).min_by(|a, b| {
            let middle = DVec2::from_angle(TAU * (f64::from(i) + 0.5) / f64::from(SIDES));
            let toward = |k: usize| -(DVec2::from(corners[k]) - hole).normalize().dot(middle);
            toward(*a).total_cmp(&toward(*b))
        })
    };
    let mut flat = Vec::new();
    for i in 0..SIDES {
        let (next, [own, other]) = ((i + 1) % SIDES, [i, i + 1].map(|i| corner_of(i).unwrap() as u32));
        flat.push([i, SIDES + own, next]);
        if own != other {
            flat.push([next, SIDES + own, SIDES + other]);
        }
    }
    let up = SIDES + 4;
    mesh.triangles.extend(flat.iter().map(|[a, b, c]| [a + up, b + up, c + up]));
    mesh.triangles.extend(flat.iter().map(|[a, b, c]| [*a, *c, *b]));
    let around = |first: u32, count: u32| (0..count).map(move |i| [first + i, first + (i + 1) % count]);
    for [a, b] in around(0, SIDES) {
        mesh.triangles.extend([[a, a + up, b + up], [a, b + up, b]]);
    }
    for [a, b] in around(SIDES, 4) {
        mesh.triangles.extend([[a, b, b + up], [a, b + up, a + up]]);
    }
    let (splats, report) = sharp_splats(&mesh, &SharpOptions::default(), &()).unwrap();
    println!("{} splats, {report:?}", splats.len());
    assert!(report.closed && report.crowded == 0 && splats.len() < 500, "{report:?}");
    let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
    for (i, p) in places(&splats) {
        if s[i].cross(t[i]).normalize().z.abs() > 0.9999 {
            let (radius, reach) = (p.truncate().distance(hole), p.truncate().abs().max_element());
            assert!(radius > 0.99 && reach < 10.01, "{p} of {i}");
        }
    }
}
