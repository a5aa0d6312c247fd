//! Meshes with edges at which no two triangles belong together.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::{
    distances::{to_mesh, to_splats},
    few, places,
};
use crate::{
    geometry::{
        clip::removes,
        sharp::{Clipping, SharpReport, sharp_splats},
    },
    hard_scenes::parts::cube,
    scene::{Mesh, Shapes, Splats},
};

fn made(mesh: &Mesh, count: u64) -> (Splats, SharpReport) {
    let (splats, report) = sharp_splats(mesh, &few(count, Clipping::Shared), &()).unwrap();
    println!("{count}: {} splats, {report:?}", splats.len());
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let (again, _) = one_thread.install(|| sharp_splats(mesh, &few(count, Clipping::Shared), &()).unwrap());
    assert_eq!((&again.positions, &again.clips), (&splats.positions, &splats.clips));
    assert!(splats.len() as u64 <= count && report.crowded == 0);
    (splats, report)
}

/// A grid of `columns` × `rows` quads, each of whose places is given by its column and row.
fn sheet(columns: u32, rows: u32, at: impl Fn(u32, u32) -> DVec3) -> Mesh {
    let places = (0..=columns).flat_map(|i| (0..=rows).map(move |j| (i, j)));
    let positions = places.map(|(i, j)| at(i, j)).collect();
    let vertex = |i: u32, j: u32| i * (rows + 1) + j;
    let quads = (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j)));
    let triangles = quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    Mesh { triangles: triangles.collect(), positions, ..Mesh::default() }
}

fn together(meshes: &[Mesh]) -> Mesh {
    let mut all = Mesh::default();
    for mesh in meshes {
        let first = all.positions.len() as u32;
        all.positions.extend(&mesh.positions);
        all.triangles.extend(mesh.triangles.iter().map(|triangle| triangle.map(|vertex| vertex + first)));
    }
    all
}

/// Along half of a circle around y: one to each side of it, and a flat one around it.
fn arc_sheets() -> [Mesh; 3] {
    const COLUMNS: u32 = 64;
    let around = |i: u32, radius: f64, y: f64| {
        let (sin, cos) = (PI * f64::from(i) / f64::from(COLUMNS)).sin_cos();
        DVec3::new(radius * cos, y, radius * sin)
    };
    let far = |j: u32| f64::from(j) / 8.0;
    [
        sheet(COLUMNS, 8, |i, j| around(i, 1.0, -far(j))),
        sheet(COLUMNS, 8, |i, j| around(i, 1.0, far(j))),
        sheet(COLUMNS, 8, |i, j| around(i, 1.0 + far(j), 0.0)),
    ]
}

#[test]
fn three_sheets_at_an_arc_end_there_all() {
    let mesh = together(&arc_sheets());
    for count in [200, 500, 10_000] {
        let (splats, report) = made(&mesh, count);
        assert_eq!((report.repairs.crowded, report.repairs.one_way, report.closed), (64, 0, false));
        // The arc, two borders with two sides each, and the flat sheet's.
        assert_eq!(report.ridges, 10);
        let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
        // How far those of the flat sheet reach beyond the arc, and where each sheet is on it.
        let (mut beyond, mut near) = (0.0_f64, [[false; 3]; 40]);
        for (i, p) in places(&splats) {
            let is_flat = s[i].cross(t[i]).normalize().y.abs() > 0.999;
            let sheet = if is_flat { 2 } else { usize::from(splats.positions[i].y < 0.0) };
            beyond = beyond.max([-p.y, p.y, 1.0 - p.x.hypot(p.z)][sheet]);
            if p.distance(DVec3::new(p.x, 0.0, p.z).normalize()) < 0.12 && p.z >= 0.0 {
                near[((p.z.atan2(p.x) / PI * 40.0) as usize).min(39)][sheet] = true;
            }
        }
        println!("  beyond the arc by {beyond:.2e}");
        assert!(beyond < 3e-3, "{beyond}");
        assert!(near.iter().all(|sheets| *sheets == [true; 3]), "{near:?}");
        let there = to_mesh(&splats, &mesh).most;
        println!("  off by {there:.2e}");
        assert!(there < 0.03 && holes(&splats, &mesh).is_empty(), "{:?}", holes(&splats, &mesh));
    }
}

/// The middles of triangles that no splat covers within a 50th of the unit.
fn holes(splats: &Splats, mesh: &Mesh) -> Vec<DVec3> {
    let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
    let covers = |i: usize, place: DVec3| {
        let (s, t, away) = (s[i].as_dvec3(), t[i].as_dvec3(), place - splats.positions[i]);
        let uv = DVec2::new(away.dot(s) / s.length_squared(), away.dot(t) / t.length_squared());
        let off = away.dot(s.cross(t).normalize()).abs();
        uv.length() <= 1.0 && off < 0.02 && !removes(&splats.clips.get(i), uv)
    };
    let middles = (0..mesh.triangles.len()).map(|i| mesh.corners(i).unwrap().iter().sum::<DVec3>() / 3.0);
    middles.filter(|middle| !(0..splats.len()).any(|i| covers(i, *middle))).collect()
}

/// Triangles at an arc that one splat can't stand for are cut at the arc, which bulges beyond their sides.
#[test]
fn what_is_cut_at_an_arc_reaches_it() {
    let sheets = arc_sheets();
    let mesh = together(&sheets[1..]);
    for count in [90, 110, 130, 160] {
        let (splats, report) = made(&mesh, count);
        assert!(report.repairs.crowded == 0 && report.cut_triangles > 0);
        let holes = holes(&splats, &mesh);
        assert!(holes.is_empty(), "{count}: {holes:?}");
    }
}

/// As two bodies of one file that touch: their vertices there are welded.
#[test]
fn two_boxes_at_one_edge_are_closed() {
    let mut other = cube(8);
    other.positions.iter_mut().for_each(|p| *p += DVec3::new(2.0, 2.0, 0.0));
    let mesh = together(&[cube(8), other]);
    for count in [24, 100] {
        let (splats, report) = made(&mesh, count);
        assert_eq!((report.repairs.crowded, report.closed, report.ridges), (8, true, 23));
        let outside = |p: DVec3| {
            let of = |center: DVec3| (p - center).abs().max_element() - 1.0;
            of(DVec3::ZERO).min(of(DVec3::new(2.0, 2.0, 0.0)))
        };
        let worst = places(&splats).into_iter().map(|(_, p)| outside(p)).fold(0.0, f64::max);
        assert!(worst < 1e-4, "{count}: sticks out by {worst}");
    }
}

/// A box on which another one stands, whose faces there are one: what is between them is a third sheet around its border.
#[test]
fn two_boxes_at_one_side_keep_the_wall_between_them() {
    let mut other = cube(8);
    other.positions.iter_mut().for_each(|p| p.z += 2.0);
    let (splats, report) = made(&together(&[cube(8), other]), 100);
    assert_eq!((report.repairs.repeated, report.repairs.crowded, report.closed), (128, 32, false));
    let reach = places(&splats).into_iter().map(|(_, p)| p.truncate().abs().max_element());
    assert!(reach.fold(0.0, f64::max) < 1.0 + 1e-4);
    let wall = places(&splats).into_iter().filter(|(_, p)| (p.z - 1.0).abs() < 1e-6);
    assert!(wall.count() > 1000);
}

/// A strip with half a turn, whose ends meet with their sides changed; then with triangles that are turned around.
#[test]
fn a_strip_of_one_side_is_cut_once_across() {
    const COLUMNS: u32 = 96;
    let mut mesh = sheet(COLUMNS, 4, |i, j| {
        // The last column is the first one upside down, to the bit.
        let (i, side) = if i == COLUMNS { (0, -1.0) } else { (i, 1.0) };
        let angle = TAU * f64::from(i) / f64::from(COLUMNS);
        let ((sin, cos), (half_sin, half_cos)) = (angle.sin_cos(), (angle / 2.0).sin_cos());
        let across = side * (f64::from(j) - 2.0) / 8.0;
        DVec3::new((1.0 + across * half_cos) * cos, (1.0 + across * half_cos) * sin, across * half_sin)
    });
    let (splats, report) = made(&mesh, 200);
    assert_eq!((report.repairs.crowded, report.repairs.one_way, report.repairs.flipped), (0, 4, 0));
    assert!(!report.closed);
    let [there, back] = [to_mesh(&splats, &mesh).most, to_splats(&mesh, &splats).most];
    println!("  off by {there:.2e}, {back:.2e}");
    assert!(there < 0.03 && back < 0.03);
    for i in [19, 77, 78, 310, 500] {
        mesh.triangles[i].swap(1, 2);
    }
    let (turned, report) = made(&mesh, 200);
    assert_eq!((report.repairs.one_way, report.repairs.flipped), (4, 5));
    assert_eq!((turned.positions, turned.clips), (splats.positions, splats.clips));
}
