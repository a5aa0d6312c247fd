//! How many times its spread a node's size is, by the definition over all disks below it, in two passes.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

use super::models::plate;
use crate::{
    geometry::hierarchy::{Hierarchy, disks::Disk},
    scene::{Colors, Shapes, Splats},
};

/// Of some disks with these colors, linear and straight alpha.
pub fn factor_of(disks: &[Disk], colors: &Colors) -> f64 {
    let of_disk = |disk: &Disk| {
        let [r, g, b, alpha] = colors.get(disk.number as usize).unwrap_or_default().map(f64::from);
        let area = disk.area_normal().length();
        (area, disk.area_normal() / area, alpha * DVec3::new(r, g, b))
    };
    let (mut area, mut normal, mut color) = (0.0, DVec3::ZERO, DVec3::ZERO);
    for disk in disks {
        let (of_one, its_normal, its_color) = of_disk(disk);
        (area, normal, color) = (area + of_one, normal + of_one * its_normal, color + of_one * its_color);
    }
    let (normal, color) = (normal / area, color / area);
    let (mut normals, mut colors) = (0.0, 0.0);
    for disk in disks {
        let (of_one, its_normal, its_color) = of_disk(disk);
        normals += of_one / area * its_normal.distance_squared(normal);
        colors += of_one / area * its_color.distance_squared(color);
    }
    let of_roots = if color.element_sum() > 0.0 { colors / (4.0 * color.element_sum()) } else { 0.0 };
    1.0 + ((normals + 6.0 * of_roots).sqrt() / 0.2).min(1.0)
}

/// A square of disks, whose normals and colors follow from where they are.
fn square(normal: impl Fn(f64, f64) -> Vec3, color: impl Fn(usize) -> [f32; 4]) -> Splats {
    const SIDE: usize = 16;
    let at = |i: usize| (i as f64 + 0.5) / SIDE as f64 - 0.5;
    let places = || (0..SIDE * SIDE).map(|i| (at(i / SIDE), at(i % SIDE)));
    Splats::new(
        places().map(|(x, y)| DVec3::new(x, y, 0.0)).collect(),
        Shapes::Disks {
            normals: places().map(|(x, y)| normal(x, y)).collect(),
            radii: vec![0.05; SIDE * SIDE],
        },
        Colors::Each((0..SIDE * SIDE).map(color).collect()),
    )
}

/// The root's spread over that of the same disks all alike.
fn root_factor(splats: &Splats) -> f64 {
    let spread = |splats: &Splats| f64::from(Hierarchy::build(splats, &()).unwrap().bounds[0].error.spread);
    spread(splats) / spread(&square(|_, _| Vec3::Z, |_| [0.5; 4]))
}

#[test]
fn a_node_is_the_larger_the_more_what_is_below_differs() {
    let up = |_: f64, _: f64| Vec3::Z;
    // Tilted by up to this angle, half to each side: the root of the mean square is its sine over √3, nearly.
    let bent = |angle: f64| {
        move |x: f64, _: f64| {
            let (sin, cos) = (2.0 * x * angle).sin_cos();
            Vec3::new(sin as f32, 0.0, cos as f32)
        }
    };
    let of_bend = |angle: f64| root_factor(&square(bent(angle), |_| [0.5, 0.5, 0.5, 1.0]));
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-2, "{a}, not {b}");
    close(of_bend(0.0), 1.0);
    close(of_bend(0.1), 1.0 + 0.1 / 3_f64.sqrt() / 0.2);
    close(of_bend(0.3), 1.0 + 0.3 / 3_f64.sqrt() / 0.2);
    close(of_bend(0.5 * TAU / 4.0), 2.0);
    // Grays 0.5 ± d: roots differ from their mean by d / 2 √0.5 each, of three components that are alike.
    let of_grays = |d: f32| {
        let gray = move |i: usize| if i.is_multiple_of(2) { 0.5 - d } else { 0.5 + d };
        root_factor(&square(up, move |i| [gray(i), gray(i), gray(i), 1.0]))
    };
    let of_roots = |d: f64| 3.0 * d * d / (4.0 * 1.5);
    close(of_grays(0.05), 1.0 + (6.0 * of_roots(0.05)).sqrt() / 0.2);
    close(of_grays(0.5), 2.0);
    // Nothing is seen of the color of what lets all light through.
    close(root_factor(&square(up, |i| [(i % 2) as f32, 0.0, 0.0, 0.0])), 1.0);
}

/// Its sides have the normals z and −z, one of each for all.
#[test]
fn two_sides_in_one_node_differ_as_much_as_anything() {
    let hierarchy = Hierarchy::build(&plate(20, 0.0), &()).unwrap();
    let root = hierarchy.bounds[0].error.spread;
    let squares: f64 = plate(20, 0.0).positions.iter().map(|at| at.length_squared()).sum::<f64>() / 800.0;
    assert!((f64::from(root) - 2.0 * squares.sqrt()).abs() < 1e-3 * squares.sqrt(), "{root}");
}
