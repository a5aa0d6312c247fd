//! What of a mesh's colors its splats have.

use glam::{DVec2, DVec3, Vec4};

use crate::{
    geometry::{
        clip::removes,
        sharp::{SharpOptions, SharpReport, sharp_splats},
    },
    hard_scenes::parts::cube,
    scene::{Colors, Mesh, Shapes, Splats},
};

/// A color at each place of a square from 0 to 1.
type Painted = fn(f64, f64) -> Vec4;

fn mix(red: f64) -> Vec4 {
    Vec4::new(red as f32, 0.2, 1.0 - red as f32, 1.0)
}

fn board(x: f64, y: f64) -> Vec4 {
    mix(f64::from(((4.0 * x).floor() as i32 + (4.0 * y).floor() as i32) & 1))
}

fn gradient(x: f64, _: f64) -> Vec4 {
    mix(x)
}

/// A square of `count` squared quads.
fn square(count: u32, color: impl Fn(f64, f64) -> Vec4) -> Mesh {
    let (mut mesh, mut colors) = (Mesh::default(), Vec::new());
    for i in 0..(count + 1) * (count + 1) {
        let [x, y] = [i % (count + 1), i / (count + 1)].map(|i| f64::from(i) / f64::from(count));
        mesh.positions.push(DVec3::new(x, y, 0.0));
        colors.push(color(x, y).to_array());
    }
    for i in 0..count * count {
        let a = i / count * (count + 1) + i % count;
        let [b, c, d] = [a + 1, a + count + 1, a + count + 2];
        mesh.triangles.extend([[a, b, d], [a, d, c]]);
    }
    Mesh { colors: Colors::Each(colors), ..mesh }
}

fn made(mesh: &Mesh, splats: Option<u64>, max_error: Option<f64>) -> (Splats, SharpReport) {
    sharp_splats(mesh, &SharpOptions { splats, max_error, ..SharpOptions::default() }, &()).unwrap()
}

/// What splats show at a place of the square: all that are there, those most whose middle is near.
fn shown(splats: &Splats, place: DVec3) -> Vec4 {
    let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
    let (mut sum, mut weights) = (Vec4::ZERO, 0.0);
    for i in 0..splats.len() {
        let away = place - splats.positions[i];
        let along = |axis: DVec3| away.dot(axis) / axis.length_squared();
        let uv = DVec2::new(along(s[i].as_dvec3()), along(t[i].as_dvec3()));
        if uv.length() <= 1.0 && !removes(&splats.clips.get(i), uv) {
            let weight = (-2.0 * uv.length_squared()).exp() as f32;
            (sum, weights) = (sum + weight * Vec4::from(splats.color(i)), weights + weight);
        }
    }
    sum / weights
}

/// Root mean square difference to the colors of a square, at places that are at least half a quad of 40 from where a board of 4 steps.
fn off(splats: &Splats, color: Painted) -> f64 {
    let places = (0..40 * 40).map(|i| [i % 40, i / 40]).filter(|at| at.iter().all(|i| i % 10 != 9));
    let differences = places.map(|at| {
        let [x, y] = at.map(|i| (f64::from(i) + 0.5) / 40.0);
        let difference = shown(splats, DVec3::new(x, y, 0.0)) - color(x, y);
        f64::from(if difference.is_finite() { difference.length_squared() } else { 0.0 })
    });
    let all: Vec<f64> = differences.collect();
    (all.iter().sum::<f64>() / all.len() as f64).sqrt()
}

/// By positions and curves alone they were off by 0.39, 1.00, 1.00, 0.035, 0.31 and 0.31.
#[test]
fn triangles_stay_where_the_color_varies() {
    let cases: [(&str, Painted, _, _, f64); 6] = [
        ("board", board, Some(400), None, 0.04),
        ("board", board, None, Some(0.02), 0.09),
        ("board", board, None, Some(0.005), 0.03),
        ("gradient", gradient, Some(150), None, 0.02),
        ("gradient", gradient, None, Some(0.03), 0.06),
        ("gradient", gradient, None, Some(0.01), 0.03),
    ];
    for (name, color, count, max_error, most) in cases {
        let mesh = square(40, color);
        let (splats, report) = made(&mesh, count, max_error);
        let off = off(&splats, color);
        println!(
            "{name} {count:?} {max_error:?}: {} splats, colors off by {off:.4}; {report:?}",
            splats.len()
        );
        assert!(off < most, "{name} {count:?} {max_error:?}: {off}");
        assert!(count.is_none_or(|count| splats.len() as u64 <= count) && splats.len() < 2000);
        assert!(max_error.is_none_or(|most| report.colors_off <= most), "{report:?}");
        let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let (again, _) = one_thread.install(|| made(&mesh, count, max_error));
        let [Colors::Each(colors), Colors::Each(others)] = [splats.colors, again.colors] else {
            panic!("one")
        };
        assert_eq!((again.positions, others), (splats.positions, colors));
    }
}

/// They were as many as the file has triangles.
#[test]
fn triangles_are_split_where_their_color_varies_and_there_may_be_more() {
    let mesh = square(1, gradient);
    for (count, max_error, least, most) in
        [(Some(100), None, 90, 0.04), (Some(1000), None, 900, 0.015), (None, Some(0.01), 20, 0.05)]
    {
        let (splats, report) = made(&mesh, count, max_error);
        let off = off(&splats, gradient);
        println!("{count:?} {max_error:?}: {} splats, colors off by {off:.4}; {report:?}", splats.len());
        assert!((least..=1000).contains(&splats.len()) && off < most, "{} splats, {off}", splats.len());
    }
    // What is not asked for, and what one color is enough for, is not split.
    assert_eq!(made(&mesh, None, None).0.len(), 2);
    assert_eq!(made(&square(1, |_, _| Vec4::ONE), Some(100), None).0.len(), 2);
}

/// A splat for several hundred vertices of any color is gray, as they are together. It had the mean color of three, off by 0.2.
#[test]
fn a_splat_has_the_mean_color_of_the_surface_that_it_stands_for() {
    let noise = |x: f64, y: f64| mix((1e4 * (12.9898 * x + 78.233 * y + 1.0).sin()).fract().abs());
    let (splats, _) = made(&square(60, noise), Some(20), None);
    let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
    let (mut sum, mut area) = (0.0, 0.0);
    for i in 0..splats.len() {
        let own = s[i].cross(t[i]).length();
        (sum, area) = (sum + own * (splats.color(i)[0] - 0.5).powi(2), area + own);
    }
    let off = (sum / area).sqrt();
    assert!(splats.len() <= 20 && off < 0.05, "{off}");
}

/// Vertices at one place with a color for each side: all had that of the first.
#[test]
fn sides_keep_their_own_colors_at_vertices_that_become_one() {
    let mut mesh = cube(4);
    let (mut positions, mut colors, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    let side_of = |normal: DVec3| 0.5 * normal.normalize().as_vec3().extend(1.0) + 0.5;
    for i in 0..mesh.triangles.len() {
        let p = mesh.corners(i).unwrap();
        let first = positions.len() as u32;
        positions.extend(p);
        colors.extend([side_of((p[1] - p[0]).cross(p[2] - p[0])).to_array(); 3]);
        triangles.push([first, first + 1, first + 2]);
    }
    mesh = Mesh { positions, triangles, colors: Colors::Each(colors), ..mesh };
    for count in [None, Some(12)] {
        let (splats, report) = made(&mesh, count, None);
        assert!(
            report.repairs.welded > 0
                && report.closed
                && count.is_none_or(|count| splats.len() as u64 == count)
        );
        let Shapes::Ellipses { s, t } = &splats.shapes else { panic!("ellipses") };
        for i in 0..splats.len() {
            let side = side_of(s[i].as_dvec3().cross(t[i].as_dvec3()));
            assert!(Vec4::from(splats.color(i)).distance(side) < 1e-5, "{i}: {:?}, {side}", splats.color(i));
        }
    }
}
