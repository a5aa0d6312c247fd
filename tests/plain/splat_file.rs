//! Splats that are written to a file and read back are the same splats.

use glam::{DVec3, Vec2, Vec3, Vec3Swizzles as _};
use surfel::{
    load::{LoadOptions, Model, builtin, load},
    math::{random::SplitMix, srgb::linear_from_srgb},
    save::{self, WrittenSplats},
    scene::{Clip, ClipCurve, Clips, Colors, Shapes, Splats},
};

/// Written, and read again.
fn round_trip(splats: &Splats, closed: bool) -> (Splats, WrittenSplats, String) {
    let folder = temp_dir::TempDir::new().unwrap();
    let path = folder.path().join("a.ply");
    let written = save::splats(&path, splats, closed, None, &()).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    assert_eq!(written.bytes, bytes.len() as u64);
    let text = String::from_utf8_lossy(&bytes);
    let header = text.split("end_header").next().unwrap().to_owned();
    match load(&path, &LoadOptions::default(), &()).unwrap().model {
        Model::Splats { splats, closed: read } => {
            assert_eq!(read, closed);
            (splats, written, header)
        }
        _ => panic!("no splats"),
    }
}

fn vectors(values: &[Vec3]) -> Vec<u32> {
    values.iter().flat_map(|v| v.to_array().map(f32::to_bits)).collect()
}

/// All but positions and colors, as bits.
fn shape_bits(splats: &Splats) -> Vec<u32> {
    match &splats.shapes {
        Shapes::Disks { normals, radii } => {
            [vectors(normals), radii.iter().map(|r| r.to_bits()).collect()].concat()
        }
        Shapes::Ellipses { s, t } => [vectors(s), vectors(t)].concat(),
    }
}

fn position_bits(splats: &Splats) -> Vec<u64> {
    splats.positions.iter().flat_map(|p| p.to_array().map(f64::to_bits)).collect()
}

fn color_bits(splats: &Splats) -> Vec<[u32; 4]> {
    (0..splats.len()).map(|i| splats.color(i).map(f32::to_bits)).collect()
}

fn disks(positions: Vec<DVec3>, colors: Colors) -> Splats {
    let mut random = SplitMix(1);
    let mut value = || random.unit() as f32 - 0.5;
    let normals = positions.iter().map(|_| Vec3::new(value(), value(), value()) * 1e3).collect();
    let radii = positions.iter().map(|_| value().abs() + 0.1).collect();
    Splats::new(positions, Shapes::Disks { normals, radii }, colors)
}

/// Positions that `float` has.
fn near(count: usize) -> Vec<DVec3> {
    let mut random = SplitMix(2);
    (0..count).map(|_| Vec3::new(random.unit() as f32, -random.unit() as f32, 1e-30).as_dvec3()).collect()
}

#[test]
fn disks_come_back_bit_by_bit_with_colors_of_every_type() {
    let mut random = SplitMix(3);
    for (kind, steps) in [("uchar", 255.0), ("ushort", 65_535.0), ("float", 16_777_216.0)] {
        let mut value = || (random.unit() * (steps + 1.0)).floor() / steps;
        // As a reader makes them of the file's values.
        let mut color = |_| {
            let [red, green, blue] = [value(), value(), value()].map(|v| linear_from_srgb(v as f32));
            [red, green, blue, value() as f32]
        };
        let colors = Colors::Each((0..3000).map(&mut color).collect());
        let splats = disks(near(3000), colors);
        let (read, written, header) = round_trip(&splats, false);
        assert!(!written.double_positions);
        assert_eq!(position_bits(&read), position_bits(&splats));
        assert_eq!(shape_bits(&read), shape_bits(&splats));
        for property in ["red", "green", "blue", "alpha"] {
            assert!(header.contains(&format!("property {kind} {property}\n")), "{header}");
        }
        let different = (0..3000).filter(|&i| color_bits(&read)[i] != color_bits(&splats)[i]).count();
        assert_eq!(different, 0, "{kind}");
    }
}

#[test]
fn ellipses_come_back_bit_by_bit_and_on_their_side() {
    let Shapes::Disks { normals: s, .. } = disks(near(500), Colors::unknown()).shapes else { unreachable!() };
    let t = s.iter().map(|s| s.zxy() * Vec3::new(1.0, -2.0, 1e-3)).collect();
    let splats = Splats::new(
        near(500),
        Shapes::Ellipses { s, t },
        Colors::Uniform([1.0, 0.0, linear_from_srgb(0.2), 0.5]),
    );
    let (read, _, _) = round_trip(&splats, true);
    assert_eq!(shape_bits(&read), shape_bits(&splats));
    assert_eq!(color_bits(&read), color_bits(&splats));
}

#[test]
fn clip_curves_come_back_bit_by_bit_and_only_what_is_needed_is_written() {
    let curve = |x: f32| ClipCurve {
        start_rad: x,
        end_rad: x + 1.0 / 3.0,
        middle: Vec2::new(-x, 0.1 * x),
        weight: x * x,
    };
    let (one, both) = (Clip::One(curve(0.3)), Clip::Both(curve(1e-20), curve(-3.0)));
    for (clips, columns) in [
        (vec![Clip::None; 2], 0),
        (vec![Clip::None, one], 5),
        (vec![Clip::Either(curve(2.0), curve(0.0)), one], 10),
        (vec![both, Clip::None, one], 11),
    ] {
        let count = clips.len();
        let shapes = Shapes::Ellipses { s: vec![Vec3::X; count], t: vec![Vec3::Y; count] };
        let plain = Splats::new(near(count), shapes, Colors::unknown());
        let splats = Splats { clips: Clips::of(clips), ..plain };
        let (read, _, header) = round_trip(&splats, false);
        assert_eq!(read.clips, splats.clips);
        assert_eq!(header.matches(" clip").count(), columns, "{header}");
    }
}

#[test]
fn the_color_of_surfaces_without_any_takes_no_column() {
    let (read, _, header) = round_trip(&disks(near(5), Colors::unknown()), true);
    assert!(
        !header.contains("red") && !header.contains("alpha") && header.contains("comment surfel closed\n")
    );
    assert!(matches!(read.colors, Colors::Uniform(_)));
    assert_eq!(color_bits(&read), color_bits(&disks(near(5), Colors::unknown())));
}

#[test]
fn positions_are_64_bits_where_32_would_move_a_splat_and_only_there() {
    let at = |offset: f64, radius: f32| {
        let mut splats = disks(near(200).iter().map(|p| *p / 3.0 + offset).collect(), Colors::unknown());
        if let Shapes::Disks { radii, .. } = &mut splats.shapes {
            radii.fill(radius);
        }
        let (read, written, _) = round_trip(&splats, false);
        let shifts = splats.positions.iter().zip(&read.positions).map(|(a, b)| a.distance(*b));
        (written.double_positions, shifts.fold(0.0, f64::max) / f64::from(radius))
    };
    // Near the origin a rounding is 2⁻²⁵ of a coordinate below 1/3, in each of three axes at most.
    let (double, shift) = at(0.0, 1e-3);
    assert!(!double && shift > 0.0 && shift < 3e-5, "{double} {shift}");
    // Where it reaches 1/1024 of the radius: a scan in UTM metres, and splats that are tiny.
    assert_eq!(at(4_600_000.0, 0.01), (true, 0.0));
    assert_eq!(at(0.0, 1e-6), (true, 0.0));
    // The rule's own limit.
    for radius in [1e-4, 3e-5, 2e-5, 1e-5, 5e-6] {
        let (double, shift) = at(0.0, radius);
        assert!(double == (shift == 0.0) && shift <= 1.0 / 1024.0, "{radius}: {double} {shift}");
    }
    // Beyond the range of 32 bits.
    assert_eq!(at(1e300, 1.0), (true, 0.0));
}

#[test]
fn what_cannot_be_drawn_is_written_as_it_is() {
    let mut splats = disks(near(4), Colors::Each(vec![[f32::NAN, 0.0, 0.5, 1.0]; 4]));
    splats.positions[0].x = f64::NAN;
    splats.positions[1].y = f64::NEG_INFINITY;
    if let Shapes::Disks { normals, radii } = &mut splats.shapes {
        (normals[2].z, radii[3]) = (f32::INFINITY, f32::NAN);
    }
    let (read, written, _) = round_trip(&splats, false);
    assert!(!written.double_positions);
    for i in 0..4 {
        assert_eq!(read.defect(i), splats.defect(i), "{i}");
        assert!(read.color(i)[0].is_nan());
    }
}

#[test]
fn a_file_of_no_splats_is_written_and_refused_when_it_is_read() {
    let folder = temp_dir::TempDir::new().unwrap();
    let path = folder.path().join("none.ply");
    save::splats(&path, &disks(Vec::new(), Colors::unknown()), true, None, &()).unwrap();
    let refused = load(&path, &LoadOptions::default(), &()).unwrap_err().to_string();
    assert!(refused.ends_with("file without splats; expected some"), "{refused}");
}

#[test]
fn colors_of_no_file_are_off_by_units_of_the_last_place() {
    let splats = builtin::relief(20_000).splats;
    let (read, _, header) = round_trip(&splats, true);
    assert!(header.contains("property float red"));
    let mut worst = 0.0_f32;
    for i in 0..splats.len() {
        for (a, b) in splats.color(i).into_iter().zip(read.color(i)) {
            worst = worst.max((a - b).abs() / a.max(f32::MIN_POSITIVE));
        }
    }
    println!("colors off by {worst:e} of themselves");
    // Where the transfer function is steepest in relative terms (2.4 times), a step of f32 becomes 2.4 steps.
    assert!(worst <= 2.5 * f32::EPSILON, "{worst:e}");
}

#[test]
fn which_direction_is_up_stays_so() {
    let folder = temp_dir::TempDir::new().unwrap();
    let path = folder.path().join("a.ply");
    let up = |path: &std::path::Path| load(path, &LoadOptions::default(), &()).unwrap().up;
    for told in [None, Some(DVec3::Z), Some(DVec3::new(0.25, -1e-7, 3.0))] {
        save::splats(&path, &disks(near(3), Colors::unknown()), false, told, &()).unwrap();
        assert_eq!(up(&path), told);
    }
    for none in ["0 0 0", "0 1", "0 0 1 0", "0 0 nan", "z"] {
        let header = format!("ply\nformat ascii 1.0\ncomment surfel up {none}\nelement vertex 1\n");
        std::fs::write(
            &path,
            header + "property float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n",
        )
        .unwrap();
        assert_eq!(up(&path), None, "{none}");
    }
}
