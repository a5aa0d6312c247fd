//! The GPU path against the f64 oracle: settings that change the picture. Every method on the hard scenes is the self-test's.

use crate::common::{
    against_oracle, assert_agrees,
    compare::F32,
    oracle_of, render,
    scenes::{self, Hard},
    shared,
};
use glam::DVec3;
use surfel::{
    math::random::SplitMix,
    reference::Picture,
    renderer::Frame,
    scene::{
        Accumulate, Backfaces, Colors, Epsilon, Filter, Kernel, KernelEval, LastLayer, Layers, Object, Order,
        Rasterizer, Settings, Shading, Shapes, Splats, Storage,
    },
    selftest::{light::compare_light, tolerance},
};

const PSI_E: Kernel = Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 };
/// Its weight falls to 2⁻²⁴ at r = 0.58, inside the rim.
const NARROW: Kernel = Kernel::Gaussian { sigma: 0.1 };

fn with(hard: Hard, name: &'static str, change: impl FnOnce(&mut Settings)) -> Hard {
    let mut settings = hard.settings.clone();
    change(&mut settings);
    Hard { name, settings, ..hard }
}

#[test]
fn what_is_broken_is_counted_as_by_the_oracle() {
    let (headless, hard) = (shared(), scenes::degenerate());
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    assert!(prepared.defects.total() > 300);
    assert_eq!(prepared.defects, oracle_of(&hard).defects);
}

/// Its texels show, but no more than they may.
#[test]
fn kernels_from_a_texture_are_read_from_it() {
    let mut headless = shared();
    let hard = with(scenes::sphere_of_disks(), "narrow Gaussian from a texture", |s| {
        (s.kernel, s.kernel_eval) = (NARROW, KernelEval::Texture);
    });
    let (_, _, errors) = against_oracle(&mut headless, &hard);
    let beyond = errors.beyond(&tolerance::of(&hard));
    assert!(beyond.is_empty() && errors.weight > 1e-5, "{beyond:?}, {}", errors.weight);
    // Tiles find kernels by arithmetic.
    for (_, rasterizer) in Rasterizer::METHODS.iter().filter(|(_, r)| *r != Rasterizer::Compute) {
        let [formula, texture] = [KernelEval::Analytic, KernelEval::Texture].map(|eval| {
            let small = |s: &mut Settings| {
                (s.kernel_eval, s.rasterizer, s.size_px) = (eval, *rasterizer, [64, 64]);
            };
            render(&mut headless, &with(hard.clone(), "a texture is read", small)).weight
        });
        assert_ne!(formula, texture, "{rasterizer:?}");
    }
}

#[test]
fn the_order_on_the_device_changes_the_picture_by_rounding_alone() {
    let mut headless = shared();
    let mut drawn = |order, accumulate| {
        let mut hard = with(scenes::random_ellipses(Filter::Adjust), "order", |s| s.accumulate = accumulate);
        hard.scene.storage = Storage { order, ..Storage::default() };
        render(&mut headless, &hard)
    };
    let frames = |accumulate, drawn: &mut dyn FnMut(_, _) -> Frame| {
        [Order::Morton, Order::Input].map(|order| drawn(order, accumulate))
    };
    let [morton, input] = frames(Accumulate::F32, &mut drawn);
    for (a, b) in [(&morton.weight, &input.weight), (&morton.depth, &input.depth)] {
        for (i, (a, b)) in a.iter().zip(b).enumerate() {
            // What is seen is found by a minimum, which knows no order: the same fragments are summed, some tens of them,
            // each time rounded to 2⁻²⁴ of the sum.
            let limit = 64.0 * 0.5 * f32::EPSILON * a.abs();
            assert!(a == b || (a - b).abs() <= limit, "pixel {i}: {a} and {b}");
        }
    }
    // An order that nothing follows would draw the same twice: with 16 bits rounding shows.
    let [morton, input] = frames(Accumulate::F16, &mut drawn);
    assert_ne!(morton.weight, input.weight);
}

#[test]
fn both_kernels_agree_with_the_oracle_where_they_end_inside_the_rim() {
    let mut headless = shared();
    let kernels = [
        with(scenes::sphere_of_disks(), "sphere, psi_e", |s| s.kernel = PSI_E),
        with(scenes::random_ellipses(Filter::Adjust), "ellipses, psi_e", |s| s.kernel = PSI_E),
        with(scenes::ground(), "ground, psi_e", |s| s.kernel = PSI_E),
        with(scenes::sphere_of_disks(), "sphere, psi_e n = 1", |s| {
            s.kernel = Kernel::PsiE { a: 1.0, b: 1.0, n: 1.0 };
        }),
        with(scenes::sphere_of_disks(), "sphere, narrow Gaussian", |s| s.kernel = NARROW),
        with(scenes::random_ellipses(Filter::Adjust), "ellipses, narrow Gaussian", |s| s.kernel = NARROW),
    ];
    for hard in kernels {
        assert_agrees(&mut headless, &hard, 1000);
    }
    // Unfiltered ellipses get as thin as 0.1 px. A center is placed to half a step of f32 in pixels, 7.6e-6 at 128 px,
    // which is 1e-4 of such an axis; both coordinates together shift r² by up to 2e-4. The default's |d ln w / d r²| is
    // 2, that of psi_e up to 10 where its weight counts (above e⁻²): 5 times the error.
    let thin =
        with(scenes::random_ellipses(Filter::None), "unfiltered ellipses, psi_e", |s| s.kernel = PSI_E);
    // Normals of disks at grazing angles nearly cancel, which magnifies errors of weights; the narrow kernel's are 25
    // times the default's, as is its slope: 50 everywhere.
    let grazing = with(scenes::edge_on(), "edge-on disks, narrow Gaussian", |s| s.kernel = NARROW);
    for (hard, factor) in [(thin, 5.0), (grazing, 25.0)] {
        let (_, _, errors) = against_oracle(&mut headless, &hard);
        let beyond = errors.beyond(&F32.times(factor));
        assert!(beyond.is_empty(), "{}: {beyond:#?}", hard.name);
    }
}

#[test]
fn all_shadings_agree_with_the_oracle() {
    let mut headless = shared();
    let shadings = [
        ("sphere, Phong", Shading::Phong),
        ("sphere, Lambert", Shading::Lambert),
        ("sphere, normals", Shading::Normals),
        ("sphere, albedo", Shading::Albedo),
    ];
    for (name, shading) in shadings {
        for (name, background) in [(name, Some([0.2, 0.5, 1.0])), (name, None)] {
            let hard = with(scenes::sphere_of_disks(), name, |s| {
                s.shading = shading;
                s.background = background;
            });
            let (frame, oracle) = assert_agrees(&mut headless, &hard, 1000);
            let empty = oracle.pixels.iter().enumerate().filter(|(_, p)| !p.is_covered() && !p.rim);
            let mut seen = 0;
            for (i, expected) in empty {
                for c in 0..4 {
                    assert!((f64::from(frame.linear[i][c]) - expected.color[c]).abs() < 1e-6, "{name}: {i}");
                }
                seen += 1;
            }
            assert!(seen > 1000, "{name}: {seen} empty pixels");
        }
    }
}

#[test]
fn each_rule_for_back_faces_agrees_with_the_oracle() {
    let mut headless = shared();
    let mut weights = Vec::new();
    for (name, backfaces, closed) in [
        ("closed sphere, back faces auto", Backfaces::Auto, true),
        ("open sphere, back faces auto", Backfaces::Auto, false),
        ("open sphere, back faces culled", Backfaces::Cull, false),
        ("closed sphere, back faces flipped", Backfaces::Flip, true),
    ] {
        let mut hard = with(scenes::sphere_of_disks(), name, |s| {
            s.backfaces = backfaces;
            // So large that the far side belongs to the surface wherever it is drawn.
            s.epsilon = Epsilon::Length(3.0);
        });
        hard.scene.objects[0].closed = closed;
        let (frame, _) = assert_agrees(&mut headless, &hard, 1000);
        weights.push(frame.weight.iter().map(|w| f64::from(*w)).sum::<f64>());
    }
    // Culled or not is seen: the far side adds its weight.
    assert!(weights[0] < 0.8 * weights[1] && weights[2] < 0.8 * weights[3], "{weights:?}");
    assert!(weights[0] == weights[2] && weights[1] == weights[3], "{weights:?}");
}

#[test]
fn every_epsilon_agrees_with_the_oracle_and_zero_leaves_no_pixel_empty() {
    let mut headless = shared();
    for (name, epsilon) in [
        ("epsilon that fits", Epsilon::Auto),
        ("epsilon 0", Epsilon::Radii(0.0)),
        ("epsilon of length 0", Epsilon::Length(0.0)),
        ("epsilon 3 r", Epsilon::Radii(3.0)),
        ("epsilon of length 0.07", Epsilon::Length(0.07)),
        ("epsilon above every depth", Epsilon::Length(50.0)),
    ] {
        let shapes = [
            scenes::sphere_of_disks(),
            scenes::random_ellipses(Filter::Adjust),
            scenes::random_ellipses(Filter::None),
            scenes::cut_by_the_near_plane(),
        ];
        for scene in shapes {
            let hard = with(scene, name, |s| s.epsilon = epsilon);
            let (frame, oracle) = assert_agrees(&mut headless, &hard, 1000);
            // The nearest fragment belongs to the surface only if both passes find the same depth, to the last bit.
            for (i, expected) in oracle.pixels.iter().enumerate() {
                let empty = expected.is_covered() && !expected.rim && frame.weight[i] == 0.0;
                assert!(!empty, "{name}: pixel {i} is empty");
            }
        }
    }
}

/// Two sides of a plate half a radius thick, in two colors, bent; as disks or ellipses, opaque or not.
fn thin_plate(ellipses: bool, alpha: f32) -> Hard {
    let mut random = SplitMix(17);
    let mut splats = Splats::new(
        Vec::new(),
        Shapes::Disks { normals: Vec::new(), radii: Vec::new() },
        Colors::Each(Vec::new()),
    );
    let (mut all_s, mut all_t) = (Vec::new(), Vec::new());
    let (radius, half_thick) = (0.08, 0.02);
    for (side, color) in [(1.0, [0.9, 0.4, 0.1, alpha]), (-1.0, [0.1, 0.3, 0.9, alpha])] {
        for i in 0..900 {
            let mut jitter = || 0.02 * (random.unit() - 0.5);
            let [x, y] = [f64::from(i % 30), f64::from(i / 30)].map(|at| (at - 14.5) * 0.065 + jitter());
            let tangent = DVec3::new(1.0, 0.0, 0.6 * x);
            let normal = tangent.cross(DVec3::Y).normalize() * side;
            splats.positions.push(DVec3::new(x, y, 0.3 * x * x) + half_thick * normal);
            let Shapes::Disks { normals, radii } = &mut splats.shapes else { unreachable!() };
            normals.push(normal.as_vec3());
            radii.push(radius as f32);
            all_s.push((0.9 * radius * side * tangent.normalize()).as_vec3());
            all_t.push((radius * DVec3::Y).as_vec3());
            let Colors::Each(colors) = &mut splats.colors else { unreachable!() };
            colors.push(color);
        }
    }
    if ellipses {
        splats.shapes = Shapes::Ellipses { s: all_s, t: all_t };
    }
    let mut hard = scenes::sphere_of_disks();
    hard.name = "thin plate";
    hard.scene.objects = vec![Object { name: "thin plate".to_owned(), splats, closed: false }];
    hard.settings.backfaces = Backfaces::Auto;
    (hard.settings.layers, hard.settings.last_layer) = (Layers::Fixed(24), LastLayer::Drop);
    hard
}

#[test]
fn the_sides_of_a_thin_plate_stay_two_by_every_path() {
    let mut headless = shared();
    for (ellipses, alpha) in [(false, 1.0), (true, 1.0), (false, 0.5), (true, 0.5)] {
        for rasterizer in [Rasterizer::Perspective, Rasterizer::Compute, Rasterizer::Quad] {
            let of = |epsilon| {
                with(thin_plate(ellipses, alpha), "thin plate", |s| {
                    (s.epsilon, s.rasterizer, s.accumulate) = (epsilon, rasterizer, Accumulate::F32);
                })
            };
            if alpha < 1.0 {
                let hard = of(Epsilon::Auto);
                let errors = compare_light(&render(&mut headless, &hard), &oracle_of(&hard));
                assert!(errors.worst <= tolerance::LIGHT && errors.seen > 1000, "{rasterizer:?}: {errors:?}");
                // With two radii both sides would be one layer.
                let radii = oracle_of(&of(Epsilon::Radii(2.0)));
                let layers = |picture: &Picture| picture.pixels.iter().map(|pixel| pixel.layers).sum::<u32>();
                assert!(layers(&oracle_of(&hard)) > 3 * layers(&radii) / 2, "{rasterizer:?}");
                continue;
            }
            let (_, oracle, errors) = against_oracle(&mut headless, &of(Epsilon::Auto));
            let beyond = errors.beyond(&tolerance::of(&of(Epsilon::Auto)));
            assert!(beyond.is_empty(), "{ellipses} {alpha} {rasterizer:?}: {beyond:?}");
            // The oracle sees the difference, too.
            let mixed = |picture: &Picture| {
                let is = |pixel: &&surfel::reference::Pixel| {
                    pixel.is_covered() && (0.2..0.7).contains(&pixel.albedo[0])
                };
                picture.pixels.iter().filter(is).count()
            };
            let counts = [mixed(&oracle), mixed(&oracle_of(&of(Epsilon::Radii(1.0))))];
            assert!(10 * counts[0] < counts[1], "{counts:?}");
        }
    }
}

#[test]
fn an_object_has_an_epsilon_of_its_own() {
    let mut headless = shared();
    let picture = |headless: &mut _, own: Option<Epsilon>, of_frame| {
        let mut hard = with(thin_plate(false, 1.0), "own epsilon", |s| s.epsilon = of_frame);
        hard.scene.epsilons = vec![own];
        let (frame, _) = assert_agrees(headless, &hard, 1000);
        frame.albedo
    };
    let radius = picture(&mut headless, None, Epsilon::Radii(1.0));
    let auto = picture(&mut headless, None, Epsilon::Auto);
    assert_ne!(radius, auto);
    assert_eq!(picture(&mut headless, Some(Epsilon::Auto), Epsilon::Radii(1.0)), auto);
    assert_eq!(picture(&mut headless, Some(Epsilon::Radii(1.0)), Epsilon::Auto), radius);
}
