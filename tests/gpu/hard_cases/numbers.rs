//! Values at the ends of their ranges and beyond: N10–N12, N14, N26, N30.

use glam::{DVec3, Vec3};
use surfel::{
    renderer::{Frame, Wanted},
    scene::{Camera, Colors, Filter, Kernel, Object, Scene, Settings, Shading, Shapes, Splats},
};

use super::{GRAY, hard, of_size};
use crate::common::{
    assert_agrees, assert_same_bits,
    builder::{Builder, Random, camera, settings},
    oracle_of, render, render_as,
    scenes::Hard,
    shared,
};

pub(super) fn assert_finite(frame: &Frame, what: &str) {
    let vectors = frame.albedo.iter().chain(&frame.normal).chain(&frame.linear).flatten();
    assert!(vectors.chain(&frame.weight).all(|value| value.is_finite()), "{what}");
    assert!(frame.depth.iter().zip(&frame.weight).all(|(z, w)| z.is_finite() == (*w > 0.0)), "{what}");
}

#[test]
fn n10_one_point_and_points_at_one_place_are_fitted_and_drawn() {
    let mut headless = shared();
    for (count, radius) in [(1, 0.5), (1, 1e-30), (50, 0.5), (50, 1e-12)] {
        for place in [DVec3::ZERO, DVec3::new(500_000.0, 4_600_000.0, 300.0)] {
            let mut builder = Builder::default();
            (0..count).for_each(|_| builder.disk(place, DVec3::Z, radius, GRAY));
            let scene = builder.scene(false);
            let camera = Camera::fit(&scene.ball().unwrap(), [64, 64], Camera::DEFAULT_FOV_Y_RAD);
            let hard = Hard { name: "one place", scene, camera, settings: of_size(64) };
            // The ε of several tiny disks is below the margin within which a fragment exempts its pixel.
            let compared = if count > 1 && radius < 1e-6 { 0 } else { 1 };
            let (frame, _) = assert_agrees(&mut headless, &hard, compared);
            assert_finite(&frame, "one place");
            assert!(frame.weight.iter().any(|weight| *weight > 0.0), "{count} of {radius} at {place}");
        }
    }
}

#[test]
fn n11_normals_along_axes_and_diagonals_of_every_length_agree() {
    let mut headless = shared();
    let mut frames = Vec::new();
    for length in [1e-38_f32, 1.0, 1e38] {
        let mut normals = Vec::new();
        for x in [-1.0_f32, -0.0, 0.0, 1.0] {
            for y in [-1.0, -0.0, 0.0, 1.0] {
                for z in [-1.0, -0.0, 0.0, 1.0] {
                    normals.push(Vec3::new(x, y, z) * length);
                }
            }
        }
        normals.retain(|n| *n != Vec3::ZERO);
        let count = normals.len();
        let at = |i: usize| DVec3::new((i % 8) as f64 - 3.5, (i / 8) as f64 - 3.5, 0.0) * 0.28;
        let splats = Splats::new(
            (0..count).map(at).map(|p| p.as_vec3().as_dvec3()).collect(),
            Shapes::Disks { normals, radii: vec![0.12; count] },
            Colors::Uniform(GRAY),
        );
        let objects = vec![Object { name: "normals".to_owned(), splats, closed: false }];
        let hard = Hard {
            scene: Scene { objects, ..Default::default() },
            ..hard("26 normals", Builder::default(), settings())
        };
        let (frame, _) = assert_agrees(&mut headless, &hard, 1000);
        assert_finite(&frame, "26 normals");
        frames.push(frame);
    }
    for frame in &frames[1..] {
        assert_same_bits(&frames[0], frame, "a normal's length changes the picture");
    }
}

#[test]
fn n12_a_splat_with_a_value_that_is_not_finite_leaves_no_trace() {
    let mut headless = shared();
    let good = || {
        let mut random = Random(12);
        let mut builder = Builder::default();
        for _ in 0..20 {
            let p = DVec3::new(random.between(-0.8, 0.8), random.between(-0.8, 0.8), 0.0);
            builder.disk(p.as_vec3().as_dvec3(), random.direction(), 0.3, random.color());
        }
        builder
    };
    let expected = render(&mut headless, &hard("good", good(), of_size(64)));
    let mut bad = 0;
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for field in 0..11 {
            let set = |own: usize, usual: f64| if field == own { value } else { usual };
            let position = DVec3::new(set(0, 0.0), set(1, 0.0), set(2, 1.0));
            let normal = DVec3::new(set(3, 0.0), set(4, 0.0), set(5, 1.0));
            let color = [set(7, 0.5), set(8, 0.5), set(9, 0.5), set(10, 1.0)].map(|c| c as f32);
            let mut builder = good();
            builder.disk(position, normal, set(6, 0.5), color);
            let hard = hard("not finite", builder, of_size(64));
            let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
            assert_eq!(prepared.defects.total(), 1, "field {field}: {value}");
            assert_same_bits(&expected, &render(&mut headless, &hard), &format!("field {field}: {value}"));
            bad += 1;
        }
    }
    for radius in [0.0, -0.0, -1.0] {
        let mut builder = good();
        builder.disk(DVec3::Z, DVec3::Z, radius, GRAY);
        let frame = render(&mut headless, &hard("no radius", builder, of_size(64)));
        assert_same_bits(&expected, &frame, &format!("radius {radius}"));
    }
    assert_eq!(bad, 33);
}

#[test]
fn n14_a_pixel_covered_by_rims_alone_has_its_color() {
    let mut headless = shared();
    let mut random = Random(14);
    let mut builder = Builder::default();
    for _ in 0..400 {
        let p = DVec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-0.3, 0.3));
        let radius = random.between(0.02, 0.2);
        builder.disk(p.as_vec3().as_dvec3(), (DVec3::Z + 0.5 * random.direction()).normalize(), radius, GRAY);
    }
    let kernel = Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 };
    let (frame, _) =
        assert_agrees(&mut headless, &hard("rims", builder, Settings { kernel, ..settings() }), 1000);
    assert_finite(&frame, "rims");
    let rims: Vec<_> =
        (0..frame.weight.len()).filter(|i| frame.weight[*i] > 0.0 && frame.weight[*i] < 1e-4).collect();
    println!("{} pixels of weight below 1e-4", rims.len());
    assert!(rims.len() > 100);
    for i in rims {
        assert!(frame.albedo[i][..3].iter().all(|c| (c - 0.5).abs() < 1e-4), "{:?}", frame.albedo[i]);
        let normal = Vec3::from_slice(&frame.normal[i][..3]);
        assert!((normal.length() - 1.0).abs() < 1e-5, "{normal}");
    }
}

#[test]
fn n26_scenes_and_splats_at_the_ends_of_f32_agree() {
    let mut headless = shared();
    // The whole scene so small that radii are denormal, or so large that they nearly overflow.
    for (name, unit) in [("unit 1e-38", 1e-38), ("unit 1e-30", 1e-30), ("unit 1e37", 1e37)] {
        let mut random = Random(26);
        let mut builder = Builder::default();
        for _ in 0..100 {
            let p =
                DVec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-0.2, 0.2));
            builder.disk(p.as_vec3().as_dvec3() * unit, random.direction(), 0.3 * unit, random.color());
        }
        let camera = camera([0.0, 0.0, 3.0 * unit], [0.0; 3]);
        let mut hard = Hard { camera, ..hard(name, builder, settings()) };
        hard.settings.filter = Filter::Adjust;
        // Depth is written in world units, which f32 may not hold there.
        let (frame, oracle) = (render(&mut headless, &hard), oracle_of(&hard));
        assert!(frame.albedo.iter().flatten().all(|value| value.is_finite()), "{name}");
        let mut compared = 0;
        for (i, expected) in oracle.pixels.iter().enumerate() {
            if expected.rim || expected.epsilon_margin < 1e-4 {
                continue;
            }
            assert_eq!(frame.weight[i] > 0.0, expected.is_covered(), "{name}: pixel {i}");
            if expected.is_covered() {
                assert!(
                    (f64::from(frame.weight[i]) / expected.weight - 1.0).abs() < 1e-3,
                    "{name}: pixel {i}"
                );
                for c in 0..3 {
                    assert!((f64::from(frame.albedo[i][c]) - expected.albedo[c]).abs() < 1e-3, "{name}: {i}");
                }
                compared += 1;
            }
        }
        assert!(compared > 1000, "{name}: {compared}");
    }
    // Tiny splats beside a usual one: their products underflow.
    for radius in [1e-20, 1e-30, 1e-38, 1e-45] {
        for filter in [Filter::Adjust, Filter::None] {
            let mut disks = Builder::default();
            disks.disk(DVec3::ZERO, DVec3::Z, 0.4, GRAY);
            let mut ellipses = Builder::default();
            for i in 0..8 {
                let p = DVec3::new(0.125 * f64::from(i) - 0.5, 0.5, 0.0);
                disks.disk(p, DVec3::new(0.6, 0.0, 0.8), radius, GRAY);
                ellipses.ellipse(p - DVec3::Y, DVec3::X * radius, DVec3::Y * radius, GRAY);
            }
            let settings = Settings { filter, ..settings() };
            let mut hard = hard("tiny splats", disks, settings);
            hard.scene.objects.push(ellipses.object(false));
            let (frame, _) = assert_agrees(&mut headless, &hard, 1000);
            assert_finite(&frame, "tiny splats");
        }
    }
}

#[test]
fn n30_colors_at_the_ends_of_their_range_come_back() {
    let mut headless = shared();
    let byte = 1.0 / 255.0;
    let wanted = Wanted { picture: true, linear: false, surface: true, profile: None };
    for value in [0.0_f32, 1.0 / 65535.0, byte, 0.5, 1.0 - byte, 1.0 - 1.0 / 65535.0, 1.0] {
        for uniform in [true, false] {
            let mut builder = Builder::default();
            builder.disk(DVec3::ZERO, DVec3::Z, 10.0, [value, 1.0 - value, value, 1.0]);
            let settings = Settings { shading: Shading::Albedo, ..of_size(16) };
            let mut hard = hard("colors", builder, settings);
            if uniform {
                hard.scene.objects[0].splats.colors = Colors::Uniform([value, 1.0 - value, value, 1.0]);
            }
            let frame = render_as(&mut headless, &hard, wanted);
            for (albedo, srgb) in frame.albedo.iter().zip(&frame.srgb) {
                for (c, expected) in [value, 1.0 - value, value].into_iter().enumerate() {
                    // 16-bit fractions: half a step, and f32.
                    assert!((albedo[c] - expected).abs() < 8e-6, "{value}: {albedo:?}");
                    let encoded = 255.0 * surfel::math::srgb::srgb_from_linear(expected);
                    assert!((f32::from(srgb[c]) - encoded).abs() < 0.6, "{value}: {srgb:?}");
                    if expected == 0.0 || expected == 1.0 {
                        assert_eq!(f32::from(srgb[c]), 255.0 * expected, "the ends are exact");
                    }
                }
            }
        }
    }
}
