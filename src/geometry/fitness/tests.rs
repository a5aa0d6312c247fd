use super::*;
use crate::geometry::{DEFAULT_OVERLAP, fitting_splats, seams::sphere};

fn fitness(mesh: &Mesh) -> Fitness {
    fitting_splats(mesh, DEFAULT_OVERLAP, &()).2
}

/// `n`² squares of two triangles each from 0 to 1, with these heights.
fn field(n: u32, height: impl Fn(f64, f64) -> f64) -> Mesh {
    let at = |i: u32| f64::from(i) / f64::from(n);
    let vertices = (0..=n).flat_map(|y| (0..=n).map(move |x| (at(x), at(y))));
    let corners = (0..n).flat_map(|row| (0..n).map(move |column| row * (n + 1) + column));
    let triangles = corners.flat_map(|a| [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]);
    Mesh {
        positions: vertices.map(|(x, y)| DVec3::new(x, y, height(x, y))).collect(),
        triangles: triangles.collect(),
        ..Mesh::default()
    }
}

/// Eight corners, twelve triangles.
fn cube() -> Mesh {
    let corner = |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2));
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Mesh { positions: (0..8).map(corner).collect(), triangles, ..Mesh::default() }
}

/// Each triangle with corners of its own.
fn unwelded(mesh: &Mesh) -> Mesh {
    let corners = mesh.triangles.iter().flatten().map(|&vertex| mesh.positions[vertex as usize]).collect();
    let triangles = (0..mesh.triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh { positions: corners, triangles, ..Mesh::default() }
}

#[test]
fn round_and_dense_is_disks_and_coarse_or_folded_is_triangles() {
    for levels in 0..=6 {
        let mesh = sphere(levels);
        let expected = if levels < 5 { Suited::Triangles } else { Suited::VertexDisks };
        assert_eq!(fitness(&mesh).suited(), expected, "{} vertices", mesh.positions.len());
    }
    assert_eq!(fitness(&cube()).suited(), Suited::Triangles);
    // A room of five walls.
    let mut open = cube();
    open.triangles.truncate(10);
    assert_eq!(fitness(&open).suited(), Suited::Triangles);
    // Nothing but borders, and the same so fine that they are not seen.
    assert_eq!(fitness(&unwelded(&sphere(5))).suited(), Suited::Triangles);
    assert_eq!(fitness(&unwelded(&field(600, |_, _| 0.0))).suited(), Suited::VertexDisks);
}

#[test]
fn the_border_of_a_sheet_counts_as_much_as_it_is_seen() {
    assert_eq!(fitness(&field(20, |_, _| 0.0)).suited(), Suited::Triangles);
    assert_eq!(fitness(&field(600, |_, _| 0.0)).suited(), Suited::VertexDisks);
    let hills = |x: f64, y: f64| 0.05 * (9.0 * x).sin() * (7.0 * y).cos();
    assert_eq!(fitness(&field(600, hills)).suited(), Suited::VertexDisks);
}

#[test]
fn smooth_and_uneven_is_spread_disks_of_a_bounded_number() {
    // A ball whose meridians are 1° apart on two thirds of it, and 10° on the last.
    let mesh = globe(1.0);
    let both = fitness(&mesh);
    assert!(both.rough > MOST_ROUGH && both.rough < MOST_SPREAD && both.folded <= MOST_ROUGH, "{both:?}");
    let Suited::SpreadDisks(count) = both.suited() else { panic!("{both:?}") };
    // 4π / 12 squares of the size, in squares of a 750th of it.
    let expected = 4.0 * std::f64::consts::PI / 12.0 * 750.0 * 750.0;
    assert!((count as f64 / expected - 1.0).abs() < 0.02, "{count}");
    // Twice the area in the same box would be more than a million.
    let mut shells = mesh;
    let outer = shells.positions.len() as u32;
    let inner = globe(0.999);
    shells.positions.extend(inner.positions);
    shells.triangles.extend(inner.triangles.iter().map(|triangle| triangle.map(|vertex| vertex + outer)));
    assert_eq!(fitness(&shells).suited(), Suited::SpreadDisks(1_000_000));
    // A statue on a floor of two triangles: the floor is what is coarse, and has edges.
    let ends = [DVec3::new(-3.0, -1.0, -3.0), DVec3::new(3.0, -1.0, -3.0), DVec3::new(3.0, -1.0, 3.0)];
    let floor = [ends, [ends[0], ends[2], DVec3::new(-3.0, -1.0, 3.0)]];
    let mut statue = sphere(5);
    for corners in floor {
        let first = statue.positions.len() as u32;
        statue.positions.extend(corners);
        statue.triangles.push([first, first + 1, first + 2]);
    }
    assert_eq!(fitness(&statue).suited(), Suited::Triangles);
}

/// A ball with 90 circles of latitude; seen from outside its triangles are counterclockwise.
fn globe(radius: f64) -> Mesh {
    let degrees = (0..240).map(f64::from).chain((0..12).map(|i| 240.0 + 10.0 * f64::from(i)));
    let meridians: Vec<f64> = degrees.map(f64::to_radians).collect();
    let count = meridians.len() as u32;
    let mut mesh = Mesh { positions: vec![DVec3::Y * radius, DVec3::NEG_Y * radius], ..Mesh::default() };
    for circle in 1..=90_u32 {
        let (sin, cos) = (f64::from(circle) * std::f64::consts::PI / 91.0).sin_cos();
        let places = meridians.iter().map(|along| DVec3::new(sin * along.sin(), cos, sin * along.cos()));
        mesh.positions.extend(places.map(|place| radius * place));
        let (here, above) = (2 + (circle - 1) * count, 2 + circle.saturating_sub(2) * count);
        for (a, b) in (0..count).map(|i| (i, (i + 1) % count)) {
            match circle {
                1 => mesh.triangles.push([0, here + a, here + b]),
                _ => {
                    mesh.triangles.extend([[above + a, here + a, here + b], [above + a, here + b, above + b]])
                }
            }
            if circle == 90 {
                mesh.triangles.push([1, here + b, here + a]);
            }
        }
    }
    mesh
}

#[test]
fn what_has_no_surface_is_left_to_what_says_so() {
    assert_eq!(fitness(&Mesh::default()).suited(), Suited::VertexDisks);
    let flat = Mesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::NAN],
        triangles: vec![[0, 1, 2], [0, 1, 7], [0, 0, 1]],
        ..Mesh::default()
    };
    assert_eq!(fitness(&flat), Fitness::default());
}
