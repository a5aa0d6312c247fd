mod radii;

use super::*;
use crate::{error::ErrorKind, geometry::seams::sphere, math::srgb::linear_from_srgb};

fn samples(mesh: &Mesh, count: u64, seed: u64) -> (Splats, MeshReport) {
    resample(mesh, count, seed, &()).unwrap()
}

fn disks(splats: &Splats) -> (&[Vec3], &[f32]) {
    match &splats.shapes {
        Shapes::Disks { normals, radii } => (normals, radii),
        Shapes::Ellipses { .. } => panic!("disks"),
    }
}

/// Right triangles one beside the other, triangle k between x = k and k + 1 with a height of 2⁻ᵏ.
fn unequal() -> Mesh {
    let mut mesh = Mesh::default();
    for k in 0..12_u32 {
        let x = f64::from(k);
        let corners = [DVec3::X * x, DVec3::X * (x + 1.0), DVec3::new(x, 0.5_f64.powf(x), 0.0)];
        mesh.positions.extend(corners);
        mesh.triangles.push([3 * k, 3 * k + 1, 3 * k + 2]);
    }
    mesh
}

fn one_triangle() -> Mesh {
    let positions = vec![DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 2.0, 2.0), DVec3::new(0.0, 5.0, 3.5)];
    Mesh { positions, triangles: vec![[0, 1, 2]], ..Mesh::default() }
}

/// u and v with p = a + u (b − a) + v (c − a).
fn barycentric([a, b, c]: [DVec3; 3], p: DVec3) -> [f64; 2] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let normal = ab.cross(ac);
    let along = |x: DVec3, y: DVec3| x.cross(y).dot(normal) / normal.length_squared();
    [along(ap, ac), along(ab, ap)]
}

/// Σ (found − expected)²/expected.
fn chi_square(found: &[f64], expected: &[f64]) -> f64 {
    found.iter().zip(expected).map(|(f, e)| (f - e) * (f - e) / e).sum()
}

/// 5 standard deviations above the mean of χ² of independent samples in so many classes.
fn most_chi_square(classes: usize) -> f64 {
    let freedom = (classes - 1) as f64;
    freedom + 5.0 * (2.0 * freedom).sqrt()
}

#[test]
fn triangles_get_samples_by_their_area() {
    let mesh = unequal();
    let shares: Vec<f64> = (0..12).map(|k| 0.5_f64.powi(k) / (2.0 - 0.5_f64.powi(11))).collect();
    let counts = |count: u64, seed: u64| {
        let mut counts = [0.0; 12];
        for position in samples(&mesh, count, seed).0.positions {
            // The last corner is above the first: no sample but a corner lies on two triangles' border.
            counts[position.x.floor().clamp(0.0, 11.0) as usize] += 1.0;
        }
        counts
    };
    // Many samples: a run of triangles has its share to within one at each end.
    for (found, share) in counts(100_000, 1).iter().zip(&shares) {
        assert!((found - share * 1e5).abs() < 2.0, "{found}, expected {}", share * 1e5);
    }
    // Few: over many seeds, also the triangle that has its turn once in 41 seeds.
    let mut sums = [0.0; 12];
    for seed in 0..4000 {
        sums.iter_mut().zip(counts(100, seed)).for_each(|(sum, count)| *sum += count);
    }
    let expected: Vec<f64> = shares.iter().map(|share| share * 4e5).collect();
    let chi_square = chi_square(&sums, &expected);
    println!("chi square by triangle: {chi_square:.2}");
    assert!(chi_square < most_chi_square(12), "{sums:?}, expected {expected:?}");
}

/// How many of the points are in each of `n²` equal triangles of the triangle.
fn by_cell(corners: [DVec3; 3], points: impl Iterator<Item = DVec3>, n: usize) -> Vec<f64> {
    let mut counts = vec![0.0; n * n];
    for point in points {
        let [u, v] = barycentric(corners, point).map(|w| w * n as f64);
        assert!(u >= -1e-9 && v >= -1e-9 && u + v <= n as f64 + 1e-9, "outside: {point}");
        let (row, column) = (v.clamp(0.0, n as f64 - 1e-9).floor(), u.clamp(0.0, n as f64 - 1e-9).floor());
        // Row r has 2 (n − r) − 1 cells, an upright one and then one upside down.
        let down = u - column + v - row > 1.0;
        let before = 2 * n * row as usize - (row * row) as usize;
        counts[(before + 2 * column as usize + usize::from(down)).min(n * n - 1)] += 1.0;
    }
    counts
}

#[test]
fn samples_are_even_within_a_triangle() {
    let mesh = one_triangle();
    let corners: [DVec3; 3] = mesh.positions.clone().try_into().unwrap();
    // Many samples of one seed, and one sample of many seeds.
    let many = by_cell(corners, samples(&mesh, 16_000, 3).0.positions.into_iter(), 8);
    let single = (0..16_000).map(|seed| samples(&mesh, 1, seed).0.positions[0]);
    let single = by_cell(corners, single, 8);
    let [many, single] = [many, single].map(|counts| chi_square(&counts, &[250.0; 64]));
    println!("chi square in a triangle: {many:.2} of one seed, {single:.2} of 16000 seeds");
    assert!(single < most_chi_square(64), "{single}");
    // A lattice is far more even than independent samples, of which the mean is 63.
    assert!(many < 6.3, "{many}");
}

/// The mean distance to the nearest neighbor, in units of the square root of a sample's share of the area.
fn clumping(mesh: &Mesh, count: u64) -> f64 {
    let (splats, _) = samples(mesh, count, 0);
    let area = Areas::of(mesh, &|_| 1.0).unwrap().total;
    let points = (0_u32..).zip(&splats.positions);
    let points = points.map(|(number, &position)| super::super::neighbors::Point { position, number });
    let mut sum = 0.0;
    Tree::new(points.collect()).distances(|_, nearest| sum += nearest[0], |_| {});
    sum / count as f64 / (area / count as f64).sqrt()
}

#[test]
fn samples_clump_less_than_independent_ones() {
    // For those it is 0.5.
    let large = clumping(&one_triangle(), 20_000);
    let sphere = sphere(4);
    let [many, few] = [10, 1].map(|per_face| clumping(&sphere, per_face * sphere.triangles.len() as u64));
    println!("nearest neighbor: {large:.3} in one triangle; {many:.3} with 10, {few:.3} with 1 a triangle");
    assert!(large > 0.60 && many > 0.55 && few > 0.50, "{large} {many} {few}");
}

#[test]
fn samples_lie_on_the_surface_with_its_normals_and_colors() {
    let mut mesh = sphere(3);
    // Colors that are linear in the position: so are those interpolated in a triangle.
    let color =
        |p: DVec3| (0.5 * (p + DVec3::ONE)).as_vec3().extend(0.25 + 0.5 * p.x.abs() as f32).to_array();
    mesh.colors = Colors::Each(mesh.positions.iter().map(|&p| color(p)).collect());
    mesh.normals = Some(mesh.positions.iter().map(|p| 3.0 * p.as_vec3()).collect());
    let (splats, report) = samples(&mesh, 5000, 0);
    assert!(report.closed);
    let mut triangle = 0;
    for (i, &position) in splats.positions.iter().enumerate() {
        // In the order of the triangles.
        loop {
            let corners = mesh.triangles[triangle].map(|vertex| mesh.positions[vertex as usize]);
            let [u, v] = barycentric(corners, position);
            let height = (position - corners[0])
                .dot((corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize());
            if u.min(v).min(1.0 - u - v) > -1e-12 && height.abs() < 1e-15 {
                break;
            }
            triangle += 1;
        }
        let normal = disks(&splats).0[i];
        assert!((normal.length() - 1.0).abs() < 1e-6);
        // The corners' normals are their positions, blended by the same weights; f32 holds 6e-8.
        assert!((normal.as_dvec3() - position.normalize()).length() < 2e-7, "{normal}");
        let [red, green, blue, alpha] = splats.color(i);
        let expected = color(position);
        for (found, expected) in [red, green, blue].into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{found} {expected}");
        }
        // All corners of a face have x of one sign.
        assert!((alpha - expected[3]).abs() < 1e-6);
    }
    assert!(triangle > mesh.triangles.len() - 5, "all triangles");
}

/// A cube, whose corners have three faces each, and an octagonal tube: without normals of the file each face has its own.
#[test]
fn faces_of_a_part_are_flat() {
    let corner = |i: u32| DVec3::new((i & 1).into(), (i >> 1 & 1).into(), (i >> 2).into());
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut cube = Mesh {
        positions: (0..8).map(corner).collect(),
        triangles: sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        ..Mesh::default()
    };
    let flat = |mesh: &Mesh| {
        let (splats, report) = samples(mesh, 600, 0);
        assert!(report.closed);
        let (normals, _) = disks(&splats);
        normals.iter().filter(|normal| normal.abs().max_element() > 0.9999).count()
    };
    assert_eq!(flat(&cube), 600);
    // What the file says stays, and so does what is inside out.
    cube.normals = Some(cube.positions.iter().map(|p| (*p - 0.5).as_vec3()).collect());
    assert!(flat(&cube) < 10);
    cube.normals = None;
    cube.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    assert_eq!(flat(&cube), 600);
    let (splats, _) = samples(&cube, 600, 0);
    let outward = |i: &usize| disks(&splats).0[*i].as_dvec3().dot(splats.positions[*i] - 0.5) > 0.0;
    assert_eq!((0..600).filter(outward).count(), 600);
}

#[test]
fn a_mesh_without_colors_gets_the_color_of_surfaces_without_any() {
    let gray = linear_from_srgb(204.0 / 255.0);
    let (splats, _) = samples(&one_triangle(), 3, 0);
    assert!(matches!(splats.colors, Colors::Uniform(color) if color == [gray, gray, gray, 1.0]));
}

#[test]
fn where_normals_cancel_the_face_gives_its_own() {
    let mut mesh = one_triangle();
    let face =
        (mesh.positions[1] - mesh.positions[0]).cross(mesh.positions[2] - mesh.positions[0]).normalize();
    let along = (mesh.positions[1] - mesh.positions[0]).as_vec3();
    // All corners' normals lie in the face and two cancel the third where the weights are right; none is up or down.
    mesh.normals = Some(vec![along, -along, along]);
    for normal in disks(&samples(&mesh, 1000, 0).0).0 {
        assert!((normal.length() - 1.0).abs() < 1e-6, "{normal}");
    }
    let normals = mesh.normals.as_ref().unwrap().iter().map(|n| n.as_dvec3()).collect::<Vec<_>>();
    let found = unit_or_face(DVec3::splat(1e-9), &mesh, [0, 1, 2], &normals);
    assert!(found.as_dvec3().dot(face).abs() > 1.0 - 1e-6);
    let inward = vec![-face; 3];
    assert!(unit_or_face(DVec3::ZERO, &mesh, [0, 1, 2], &inward).as_dvec3().dot(face) < -1.0 + 1e-6);
}

#[test]
fn degenerate_triangles_get_no_sample_and_a_mesh_of_them_is_an_error() {
    let mut mesh = one_triangle();
    mesh.positions.extend([DVec3::NAN, DVec3::splat(1e9), DVec3::splat(2e9), DVec3::splat(3e9)]);
    let bad = [[0, 1, 3], [0, 0, 1], [4, 5, 6], [0, 1, 99], [0, 1, u32::MAX]];
    mesh.triangles = [&bad[..], &[[0, 1, 2]], &bad[..]].concat();
    let (splats, report) = samples(&mesh, 1000, 0);
    assert_eq!((splats.len(), report.degenerate_faces), (1000, 10));
    let corners: [DVec3; 3] = mesh.positions[..3].try_into().unwrap();
    assert_eq!(by_cell(corners, splats.positions.iter().copied(), 1), [1000.0]);
    assert!((0..1000).all(|i| splats.defect(i).is_none()));

    mesh.triangles = bad.to_vec();
    for triangles in [bad.to_vec(), Vec::new()] {
        mesh.triangles = triangles;
        let error = resample(&mesh, 5, 0, &()).unwrap_err();
        assert!(
            matches!(error.kind(), ErrorKind::Input { problem, .. } if problem.contains("no area")),
            "{error}"
        );
    }
    // An area beyond f64, of corners within it.
    mesh.positions[..3].iter_mut().for_each(|p| *p *= 1e100);
    mesh.triangles = vec![[0, 1, 2]];
    assert!(resample(&mesh, 5, 0, &()).is_err());
}

#[test]
fn counts_out_of_range_are_refused() {
    for count in [0, MOST_SAMPLES + 1, u64::MAX] {
        let error = resample(&one_triangle(), count, 0, &()).unwrap_err().to_string();
        assert_eq!(error, format!("--resample: {count} samples, expected 1 to 4294967295"));
    }
}

#[test]
fn a_seed_gives_the_same_samples_everywhere() {
    let checksum = |seed| {
        let bits = |p: DVec3| p.to_array().map(f64::to_bits);
        let all = samples(&sphere(2), 1000, seed).0.positions.into_iter().flat_map(bits);
        all.fold(0_u64, |sum, bits| sum.wrapping_mul(31).wrapping_add(bits))
    };
    let found = [checksum(0), checksum(1), checksum(u64::MAX)];
    let written = [0x257b_8491_d108_71aa, 0x649e_1be0_880f_9722, 0x908d_8481_bd0f_cf67];
    assert_eq!(found, written, "{found:#x?}");
}
