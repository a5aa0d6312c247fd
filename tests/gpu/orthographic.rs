//! Orthographic cameras: every method that has a meaning under parallel rays against the oracle, where an orthographic picture is that of an
//! eye far away.

use crate::{
    common::{
        ALL, PICTURE, assert_agrees, assert_same_bits, compare, moves_corners, oracle_of, passes, render_as,
        scenes, shared, with,
    },
    samples::errors,
};
use glam::DVec3;
use surfel::{
    hard_scenes::{Hard, transparent},
    math::random::SplitMix,
    reference::ground_truth,
    scene::{
        Accumulate, Camera, Crop, Cull, Edges, Filter, Rasterizer, Settings, Shading, TileInvocations,
        Transition,
    },
    selftest::{light::compare_light, tolerance},
};

/// The same scene by parallel rays, about as large; not so near that a depth of nothing would have to be right.
pub fn parallel(hard: &Hard) -> Hard {
    let camera = Camera { near: Some(hard.camera.near.unwrap_or(0.0).max(0.2)), ..hard.camera };
    let height = 2.0 * (0.5 * camera.fov_y_rad).tan() * camera.eye.distance(camera.target);
    Hard { camera: Camera { orthographic_height: Some(height), ..camera }, ..hard.clone() }
}

const METHODS: [Rasterizer; 5] = [
    Rasterizer::Perspective,
    Rasterizer::Quad,
    Rasterizer::Raycast,
    Rasterizer::Triangle,
    Rasterizer::Compute,
];

/// Every hard scene, also those that are hard by where a pinhole camera is: they are others then.
#[test]
fn every_rasterizer_agrees_with_the_oracle_on_every_hard_scene() {
    let mut headless = shared();
    for hard in scenes::all().iter().map(parallel) {
        for rasterizer in METHODS {
            let hard = with(&hard, |settings| settings.rasterizer = rasterizer);
            if hard.settings.validate().is_err() || hard.settings.check_scene(&hard.scene).is_err() {
                continue;
            }
            let (frame, oracle) = (render_as(&mut headless, &hard, ALL), oracle_of(&hard));
            let errors = compare::compare(&frame, &oracle);
            println!("{}", errors.row(&format!("{}, {}", hard.name, rasterizer.name())));
            if rasterizer == Rasterizer::Triangle && moves_corners(headless.device()) {
                continue;
            }
            let beyond = errors.beyond(&tolerance::of(&hard));
            assert!(beyond.is_empty(), "{}, {rasterizer:?}: {beyond:#?}", hard.name);
        }
    }
}

#[test]
fn every_filter_agrees_with_the_oracle() {
    let mut headless = shared();
    for hard in [scenes::parallel_rays(), parallel(&scenes::subpixel_filtered())] {
        for filter in [Filter::Adjust, Filter::None, Filter::Max, Filter::Ewa] {
            for rasterizer in METHODS {
                let hard = with(&hard, |settings| {
                    (settings.filter, settings.rasterizer) = (filter, rasterizer);
                });
                if hard.settings.validate().is_err() {
                    continue;
                }
                let errors = compare::compare(&render_as(&mut headless, &hard, ALL), &oracle_of(&hard));
                println!(
                    "{}",
                    errors.row(&format!("{}, {}, {}", hard.name, filter.name(), rasterizer.name()))
                );
                if rasterizer == Rasterizer::Triangle && moves_corners(headless.device()) {
                    continue;
                }
                let beyond = errors.beyond(&tolerance::of(&hard));
                assert!(beyond.is_empty(), "{}, {filter:?}, {rasterizer:?}: {beyond:#?}", hard.name);
            }
        }
    }
}

/// Layers, polygons, edges that cover in part, eye-dome lighting, lights: what is shaded.
#[test]
fn all_that_is_shaded_agrees_with_the_oracle() {
    let mut headless = shared();
    let covering = |settings: &mut Settings| {
        (settings.edges, settings.rasterizer) = (Edges::Coverage, Rasterizer::Compute);
    };
    let mut all = vec![
        with(&scenes::sphere_of_disks(), covering),
        with(&scenes::sphere_of_disks(), |settings| settings.shading = Shading::EyeDome),
        with(&scenes::sphere_of_disks(), |settings| {
            (settings.shading, settings.rasterizer) = (Shading::EyeDome, Rasterizer::Compute);
        }),
        with(&transparent::spheres(), covering),
        with(&transparent::hybrid(Transition::Color), covering),
    ];
    for rasterizer in [Rasterizer::Perspective, Rasterizer::Triangle, Rasterizer::Compute] {
        for hard in [
            transparent::spheres(),
            transparent::hybrid(Transition::Color),
            transparent::hybrid(Transition::Paper),
        ] {
            all.push(with(&hard, |settings| {
                settings.rasterizer = rasterizer;
                if rasterizer == Rasterizer::Triangle {
                    settings.filter = Filter::None;
                }
            }));
        }
    }
    for hard in all.iter().map(parallel) {
        let (frame, oracle) = (render_as(&mut headless, &hard, PICTURE), oracle_of(&hard));
        let light = compare_light(&frame, &oracle);
        let [mean, beyond] = errors(&frame.linear, oracle.pixels.iter().map(|pixel| pixel.color));
        println!("{}, mean {mean:.1e}, beyond {beyond:.1e}", light.row(hard.name));
        assert!(mean < 1e-4 && beyond < 5e-3, "{}: {mean:e}, {beyond}", hard.name);
        let is_known = hard.settings.rasterizer == Rasterizer::Triangle && moves_corners(headless.device());
        assert!(
            (light.worst <= tolerance::LIGHT || is_known) && light.seen > 1000,
            "{}: {light:?}",
            hard.name
        );
    }
}

/// A slanted plane of disks at known places: its picture is what a ruler says, and its depth what a pencil does.
#[test]
fn lengths_and_depths_are_those_of_the_scene() {
    let mut builder = scenes::builder::Builder::default();
    let normal = DVec3::new(0.0, -0.6, 0.8);
    for x in -20..=20 {
        for y in -20..=20 {
            let place = DVec3::new(f64::from(x), 0.8 * f64::from(y), 0.6 * f64::from(y)) * 0.05;
            builder.disk(place, normal, 0.08, [0.5, 0.6, 0.7, 1.0]);
        }
    }
    let mut hard = Hard::seen_from([0.0, 0.0, 7.0], "plate", builder.scene(false));
    hard.camera.orthographic_height = Some(4.0);
    hard.settings.filter = Filter::None;
    let mut headless = shared();
    for rasterizer in METHODS {
        for near in [None, Some(2.0)] {
            let mut hard = with(&hard, |settings| settings.rasterizer = rasterizer);
            hard.camera.near = near;
            let (frame, _) = assert_agrees(&mut headless, &hard, 1000);
            let [width, height] = hard.settings.size_px;
            let unit_px = f64::from(height) / 4.0;
            let mut seen = 0;
            for row in 0..height {
                let y = -(f64::from(row) + 0.5 - 0.5 * f64::from(height)) / unit_px;
                let depth = f64::from(frame.depth[(row * width + width / 2) as usize]);
                // The plate ends at 0.8 and half a disk more.
                assert_eq!(depth.is_finite(), y.abs() < 0.8 + 0.064, "{rasterizer:?}, row {row}");
                if depth.is_finite() {
                    seen += 1;
                    assert!((depth - (7.0 - 0.75 * y)).abs() < 1e-5, "{rasterizer:?}, row {row}: {depth}");
                }
            }
            assert!(seen > 80, "{seen}");
        }
    }
}

/// However far away the eye is, and wherever in the world: depth begins where the scene does.
#[test]
fn an_eye_that_is_far_away_costs_no_digits() {
    let mut headless = shared();
    let hard =
        with(&parallel(&scenes::far_from_the_origin()), |settings| settings.rasterizer = Rasterizer::Compute);
    let near = render_as(&mut headless, &hard, PICTURE);
    let back = hard.camera.eye - hard.camera.target;
    let mut far = hard.clone();
    far.camera.eye = far.camera.target + 1e6 * back;
    let frame = render_as(&mut headless, &far, PICTURE);
    let light = compare_light(&frame, &oracle_of(&far));
    assert!(light.worst <= tolerance::LIGHT && light.seen > 1000, "{light:?}");
    let worst = near.linear.iter().zip(&frame.linear).flat_map(|(a, b)| (0..4).map(|i| (a[i] - b[i]).abs()));
    assert!(worst.fold(0.0, f32::max) < 1e-3);
}

/// Lists leave out nothing that is seen, in views through windows, of chunks and blocks of many places.
#[test]
fn lists_and_crops_have_the_picture_of_the_whole() {
    let mut headless = shared();
    let mut random = SplitMix(3);
    for round in 0..12 {
        let mut hard = scenes::parallel_rays();
        hard.scene.objects[1] = scenes::sphere(6000, DVec3::ZERO);
        let mut between = |lo: f64, hi: f64| lo + (hi - lo) * random.unit();
        hard.camera.eye = DVec3::new(between(-3.0, 3.0), between(-3.0, 3.0), between(-3.0, 3.0));
        hard.camera.target = DVec3::new(between(-0.5, 0.5), between(-0.5, 0.5), between(-0.5, 0.5));
        hard.camera.orthographic_height = Some(between(0.1, 4.0));
        hard.settings.rasterizer = Rasterizer::Perspective;
        let of = |cull| with(&hard, |settings| settings.cull = cull);
        let all = render_as(&mut headless, &of(Cull::Setup), ALL);
        for cull in [Cull::List, Cull::Hidden] {
            assert_same_bits(
                &all,
                &render_as(&mut headless, &of(cull), ALL),
                &format!("round {round}, {cull:?}"),
            );
        }
        let crop = Crop { corner_px: [37, 90], size_px: [70, 50] };
        let view = crop.view(hard.settings.size_px, &hard.camera).unwrap();
        let part = Hard {
            camera: view.camera,
            ..with(&of(Cull::Setup), |settings| settings.size_px = view.drawn_px)
        };
        let part = view.cut(&render_as(&mut headless, &part, ALL).linear);
        let whole = Crop { corner_px: [0; 2], ..crop };
        let [width, _] = hard.settings.size_px;
        for (i, pixel) in part.iter().enumerate() {
            let (x, y) = (i as u32 % whole.size_px[0] + 37, i as u32 / whole.size_px[0] + 90);
            // What the eye's plane cuts is a quad, which is expanded about the middle of what is seen of it.
            let off = (0..4)
                .map(|i| (pixel[i] - all.linear[(y * width + x) as usize][i]).abs())
                .fold(0.0, f32::max);
            assert!(off < 64.0 * f32::EPSILON, "round {round}: {x}, {y}: {off}");
        }
    }
}

/// Against what there is: the surface itself, low-passed.
#[test]
fn it_is_as_near_to_the_truth_as_a_perspective_from_afar() {
    let mut headless = shared();
    let hard = with(&scenes::sphere_of_disks(), |settings| {
        (settings.rasterizer, settings.accumulate) = (Rasterizer::Compute, Accumulate::F32);
        settings.size_px = [64, 64];
    });
    let camera = hard.camera;
    let away = 50.0;
    let eye = camera.target + away * (camera.eye - camera.target);
    let fov_y_rad = 2.0 * ((0.5 * camera.fov_y_rad).tan() / away).atan();
    let afar = Hard { camera: Camera { eye, fov_y_rad, ..camera }, ..hard.clone() };
    let rms = [afar, parallel(&hard)].map(|hard| {
        let truth = ground_truth(&hard.scene, &hard.camera, &hard.settings, 8, &|_, _| {}).unwrap();
        let frame = render_as(&mut headless, &hard, PICTURE);
        // Not at the silhouette, where the background has its part.
        let is_whole = |i: usize| truth.pixels[i].coverage > 0.999;
        let inside = (2 * 64..62 * 64)
            .filter(|i| [0, 1, 2, 64, 128].into_iter().all(|step| is_whole(i - step) && is_whole(i + step)));
        let squares: Vec<f64> = inside
            .flat_map(|i| (0..3).map(move |c| (i, c)))
            .map(|(i, c)| (f64::from(frame.linear[i][c]) - truth.pixels[i].color[c]).powi(2))
            .collect();
        assert!(squares.len() > 3000, "{}", squares.len());
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    });
    println!("{rms:?}");
    assert!((rms[1] / rms[0] - 1.0).abs() < 0.1, "{rms:?}");
}

/// What has no meaning is refused, by its name.
#[test]
fn methods_of_perspective_are_refused_by_name() {
    let headless = shared();
    let hard = scenes::parallel_rays();
    let refused =
        |settings: &Settings| headless.renderer.check(&hard.camera, settings).map_err(|e| e.to_string());
    for rasterizer in [
        Rasterizer::PerspectivePaper,
        Rasterizer::AffineCenter,
        Rasterizer::AffineContour,
        Rasterizer::RaycastApproximate,
    ] {
        let problem = refused(&Settings { rasterizer, ..hard.settings.clone() }).unwrap_err();
        assert!(problem.starts_with("--rasterizer") && problem.contains(rasterizer.name()), "{problem}");
        assert!(
            headless
                .renderer
                .check(&Camera::default(), &Settings { rasterizer, ..hard.settings.clone() })
                .is_ok()
        );
    }
    let problem = refused(&Settings { filter: Filter::AdjustPaper, ..hard.settings.clone() }).unwrap_err();
    assert!(problem.starts_with("--filter: adjust-paper"), "{problem}");
    let auto = Settings { tile_invocations: TileInvocations::Auto, ..Settings::default() };
    assert!(refused(&auto).is_ok());
}

/// A pinhole camera's frame knows nothing of it.
#[test]
fn a_perspective_has_the_same_passes() {
    let mut headless = shared();
    let hard = scenes::sphere_of_disks();
    let [pinhole, other] = [hard.clone(), parallel(&hard)].map(|hard| {
        let frame = render_as(&mut headless, &hard, PICTURE);
        passes(&frame).iter().map(|pass| (*pass).to_owned()).collect::<Vec<_>>()
    });
    assert_eq!(pinhole, other);
}
