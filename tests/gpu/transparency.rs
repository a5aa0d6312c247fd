//! Transparency, polygons and hybrid scenes: GPU against the oracle's exact A-buffer, and what must hold of layers whatever
//! the scene.

use crate::common::{
    assert_same_bits, builder, render,
    scenes::{self, Hard, transparent},
    shared, with_limits,
};
use glam::{DQuat, DVec3};
use surfel::{
    reference::{self, Picture},
    renderer::{Frame, Headless, Wanted},
    scene::{
        Accumulate, Colors, Epsilon, Filter, KernelEval, LastLayer, Layers, Object, Order, Rasterizer, Scene,
        Settings, Shapes, Storage, Transition,
    },
    selftest::{
        light::{LightErrors, compare_light},
        tolerance::{LIGHT, LIGHT_RMS_OF_ALL},
    },
};

/// One for the tests and the self-test.
const COLOR: f64 = LIGHT;

fn oracle_of(hard: &Hard) -> Picture {
    reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap()
}

fn against_oracle(headless: &mut Headless, hard: &Hard) -> LightErrors {
    let errors = compare_light(&render(headless, hard), &oracle_of(hard));
    println!("{}", errors.row(hard.name));
    errors
}

fn with(hard: &Hard, change: impl FnOnce(&mut Settings)) -> Hard {
    let mut hard = hard.clone();
    change(&mut hard.settings);
    hard
}

/// Ellipses any way round, of every alpha, in every depth: surfaces touch, cross and hide each other without any order.
fn random_transparent(epsilon: Epsilon) -> Hard {
    let mut random = builder::Random(5);
    let mut builder = builder::Builder::default();
    for _ in 0..250 {
        let rotation = DQuat::from_axis_angle(random.direction(), random.between(0.0, 3.0));
        let (radius, aspect) = (random.between(0.1, 0.5), random.between(1.0, 5.0));
        let place = |random: &mut builder::Random| random.between(-1.0, 1.0);
        let position = DVec3::new(place(&mut random), place(&mut random), place(&mut random));
        let [red, green, blue, _] = random.color();
        builder.ellipse(
            position.as_vec3().as_dvec3(),
            rotation * DVec3::X * radius,
            rotation * DVec3::Y * radius / aspect,
            [red, green, blue, random.between(0.0, 1.0) as f32],
        );
    }
    let settings = Settings { layers: Layers::Fixed(96), epsilon, ..transparent::all_layers() };
    let camera = builder::camera([0.3, 0.2, 3.5], [0.0; 3]);
    Hard { name: "random transparent ellipses", scene: builder.scene(false), camera, settings }
}

#[test]
fn every_scene_agrees_with_the_oracle_in_32_bits() {
    let mut headless = shared();
    let mut failures = Vec::new();
    let random = [Epsilon::Radii(1.0), Epsilon::Radii(0.1), Epsilon::Length(0.0)].map(random_transparent);
    for hard in transparent::all().iter().chain(&random) {
        let errors = against_oracle(&mut headless, hard);
        if errors.worst > COLOR || errors.not_finite > 0 || errors.seen < 3000 || errors.compared < 40_000 {
            failures.push(format!("{}: {errors:?}", hard.name));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn every_rasterizer_and_filter_peels_the_same_layers_as_its_oracle() {
    let mut headless = shared();
    let mut failures = Vec::new();
    let mut checked = 0;
    for hard in [
        transparent::interpenetrating(),
        transparent::transparent_hybrid(Transition::Color),
        transparent::blended(),
    ] {
        for (_, rasterizer) in Rasterizer::METHODS {
            for (_, filter) in Filter::NAMES {
                let hard = with(&hard, |settings| {
                    (settings.rasterizer, settings.filter) = (*rasterizer, *filter);
                    settings.size_px = [128, 128];
                    // Each option of accumulation meets some of the methods.
                    settings.kernel_eval =
                        [KernelEval::Analytic, KernelEval::Texture][usize::from(checked % 3 == 0)];
                });
                if hard.settings.validate().is_err() {
                    continue;
                }
                checked += 1;
                let errors = against_oracle(&mut headless, &hard);
                // A kernel's texture is off by 1e-3 of a weight by itself.
                let factor = if hard.settings.kernel_eval == KernelEval::Texture { 4.0 } else { 1.0 };
                if errors.worst > factor * COLOR || errors.compared < 10_000 {
                    failures.push(format!("{} {rasterizer:?} {filter:?}: {errors:?}", hard.name));
                }
            }
        }
    }
    assert!(checked > 80, "{checked}");
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn large_transparent_splats_are_listed_and_drawn_as_quads() {
    let mut headless = shared();
    let hard = with(&transparent::interpenetrating(), |settings| settings.layers = Layers::Auto(12));
    let plain = render(&mut headless, &hard);
    let listed = with_limits(
        &mut headless,
        |limits| limits.point_size_range[1] = 12.0,
        |headless| render(headless, &hard),
    );
    assert!(listed.plan.passes.iter().any(|pass| pass.name == "list large transparent splats"));
    let errors = compare_light(&listed, &oracle_of(&hard));
    println!("{}", errors.row("interpenetrating shells, all large"));
    assert!(errors.worst <= COLOR && errors.compared > 40_000, "{errors:?}");
    assert_ne!(plain.linear, listed.linear, "nothing was drawn in another way");
}

/// The four scenes whose layers are all told apart.
fn the_four() -> [Hard; 4] {
    [
        transparent::spheres(),
        transparent::interpenetrating(),
        transparent::glass(),
        transparent::coincident_sheets(),
    ]
}

#[test]
fn with_layers_enough_the_picture_is_that_of_an_exact_a_buffer() {
    let mut headless = shared();
    for hard in the_four() {
        let exact = oracle_of(&with(&hard, |settings| settings.layers = Layers::Fixed(256)));
        for accumulate in [Accumulate::F16, Accumulate::F32] {
            for layers in [transparent::ALL_LAYERS, Layers::Auto(64)] {
                let hard = with(&hard, |settings| {
                    settings.accumulate = accumulate;
                    settings.layers = layers;
                    settings.last_layer = LastLayer::Blend;
                });
                let errors = compare_light(&render(&mut headless, &hard), &exact);
                println!("{}", errors.row(&format!("{}, {accumulate:?}, {layers}", hard.name)));
                // Of all pixels, those that rounding may turn too.
                assert!(errors.rms_of_all <= LIGHT_RMS_OF_ALL, "{}: {errors:?}", hard.name);
            }
        }
    }
}

#[test]
fn blending_what_is_left_into_the_last_layer_helps() {
    let mut headless = shared();
    for hard in the_four() {
        let exact = oracle_of(&with(&hard, |settings| settings.layers = Layers::Fixed(256)));
        let mut rms = Vec::new();
        for last_layer in [LastLayer::Drop, LastLayer::Blend, LastLayer::Stack] {
            let hard = with(&hard, |settings| {
                settings.layers = Layers::Fixed(3);
                settings.last_layer = last_layer;
            });
            let errors = compare_light(&render(&mut headless, &hard), &exact);
            println!("{}", errors.row(&format!("{}, 3 layers, {last_layer:?}", hard.name)));
            rms.push(errors.rms_of_all);
        }
        let [dropped, blended, stacked] = rms[..] else { panic!("{rms:?}") };
        // Where three layers are all there are, nothing is left to be blended or dropped.
        assert!(stacked <= dropped && stacked <= blended, "{}: {rms:?}", hard.name);
        // The paper's own heuristic does not help everywhere: blended surfaces hide no more than one of them.
        if blended > dropped {
            println!("{}: the paper's blending does not help", hard.name);
        }
    }
}

#[test]
fn a_ball_of_fine_splats_lets_as_much_light_through_as_one_of_polygons_from_near_and_far() {
    let mut headless = shared();
    let color = [0.8, 0.5, 0.2, 0.4];
    let splats = Scene {
        objects: vec![transparent::tinted(scenes::sphere(20_000, DVec3::ZERO), color)],
        ..Scene::default()
    };
    let polygons = Scene {
        meshes: vec![scenes::builder::ball_of_polygons(DVec3::ZERO, 1.0, 60, color)],
        ..Scene::default()
    };
    // The last layer's alpha of several surfaces must not make more of two.
    for (layers, last_layer) in [(24, LastLayer::Drop), (3, LastLayer::Stack)] {
        // Below a pixel a splat, the filter makes the ball larger by a part of a pixel, and its silhouette thicker.
        for (side_px, limit) in [(512, 0.005), (256, 0.005), (128, 0.01), (64, 0.03)] {
            let settings = Settings {
                size_px: [side_px; 2],
                layers: Layers::Fixed(layers),
                last_layer,
                background: None,
                ..transparent::all_layers()
            };
            let camera = builder::camera([0.0, 0.0, 3.2], [0.0; 3]);
            let [of_splats, of_polygons] = [&splats, &polygons].map(|scene| {
                let hard = Hard { name: "", scene: scene.clone(), camera, settings: settings.clone() };
                render(&mut headless, &hard)
            });
            let inside: Vec<usize> =
                (0..of_polygons.linear.len()).filter(|i| of_polygons.linear[*i][3] > 0.6).collect();
            let mean = |frame: &Frame| {
                inside.iter().map(|i| f64::from(1.0 - frame.linear[*i][3])).sum::<f64>() / inside.len() as f64
            };
            let (got, expected) = (mean(&of_splats), mean(&of_polygons));
            println!(
                "{side_px} px, {layers} layers {last_layer:?}: {got:.4} passes, through polygons {expected:.4}"
            );
            assert!((expected - 0.36).abs() < 1e-3, "two surfaces: {expected}");
            assert!((got / expected - 1.0).abs() < limit, "{side_px} px: {got} passes, expected {expected}");
        }
    }
}

#[test]
fn as_many_layers_as_the_scene_needs_give_the_same_bits_as_more() {
    let mut headless = shared();
    let hybrid = transparent::transparent_hybrid(Transition::Color);
    for hard in [transparent::spheres(), transparent::glass(), hybrid, transparent::meshes_only()] {
        let fixed = with(&hard, |settings| settings.layers = Layers::Fixed(40));
        let auto = with(&hard, |settings| settings.layers = Layers::Auto(40));
        assert_same_bits(&render(&mut headless, &fixed), &render(&mut headless, &auto), hard.name);
        // And what is left is blended in the last one just the same.
        let [fixed, auto] = [Layers::Fixed(3), Layers::Auto(3)].map(|layers| {
            with(&hard, |settings| (settings.layers, settings.last_layer) = (layers, LastLayer::Blend))
        });
        assert_same_bits(&render(&mut headless, &fixed), &render(&mut headless, &auto), hard.name);
    }
}

#[test]
fn layers_that_are_not_there_draw_nothing() {
    let mut headless = shared();
    let hard = with(&transparent::glass(), |settings| settings.layers = Layers::Auto(12));
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let wanted = Wanted { profile: Some(surfel::graph::execute::Profile::Counts), ..Wanted::default() };
    let frame = headless.render(&prepared, &hard.camera, &hard.settings, wanted).unwrap();
    let counts = |name: &str| {
        let passes = frame.profile.iter().flat_map(|profile| &profile.passes);
        let of_name = passes.filter(|pass| pass.name == name).filter_map(|pass| pass.counts);
        of_name.map(|counts| (counts.vertices, counts.fragments)).next().unwrap()
    };
    let most = oracle_of(&hard).pixels.iter().map(|pixel| pixel.layers).max().unwrap();
    assert!((1..8).contains(&most), "{most}");
    // One layer more finds that there is none, the others draw no vertex.
    for layer in 1..=12 {
        let drawn = layer <= most + 1;
        assert_eq!(counts(&format!("accumulate of layer {layer}")).0 > 0, drawn, "layer {layer} of {most}");
        assert_eq!(counts(&format!("compose of layer {layer}")).0 > 0, drawn, "layer {layer} of {most}");
    }
}

#[test]
fn the_order_of_the_input_changes_nothing_but_the_rounding_of_sums() {
    let mut headless = shared();
    let mut hard = transparent::spheres();
    hard.settings.layers = Layers::Fixed(24);
    let in_order = render(&mut headless, &hard);
    // One object each, so that both have the same local space.
    let [merged, shuffled] = [false, true].map(|shuffle| merged(&hard.scene, shuffle));
    // Steps of the sums: 2⁻²³ or 2⁻¹⁰ of a sum each; some 20 splats overlap, and few of their roundings add up.
    for (accumulate, limit) in [(Accumulate::F32, 1e-5), (Accumulate::F16, 2.0 / 255.0)] {
        let change = |settings: &mut Settings| settings.accumulate = accumulate;
        let [a, b] = [&merged, &shuffled].map(|scene| {
            render(&mut headless, &with(&Hard { scene: scene.clone(), ..hard.clone() }, change))
        });
        let differences =
            a.linear.iter().flatten().zip(b.linear.iter().flatten()).map(|(a, b)| (a - b).abs());
        let worst = differences.fold(0.0, f32::max);
        println!("{accumulate:?}: {worst:.1e} between two orders");
        assert!(worst > 0.0 && f64::from(worst) <= limit, "{accumulate:?}: {worst}");
    }
    // The same order gives the same bits.
    assert_same_bits(&in_order, &render(&mut headless, &hard), "the same order twice");
}

/// The splats of all objects as one object, drawn in their order or in a random one.
fn merged(scene: &Scene, shuffle: bool) -> Scene {
    let mut all = Vec::new();
    for object in &scene.objects {
        let Shapes::Disks { normals, radii } = &object.splats.shapes else { panic!("disks") };
        for i in 0..object.splats.len() {
            all.push((object.splats.positions[i], normals[i], radii[i], object.splats.color(i)));
        }
    }
    let mut random = builder::Random(9);
    for i in (1..if shuffle { all.len() } else { 0 }).rev() {
        all.swap(i, (random.unit() * (i + 1) as f64) as usize);
    }
    let splats = surfel::scene::Splats {
        positions: all.iter().map(|splat| splat.0).collect(),
        shapes: Shapes::Disks {
            normals: all.iter().map(|splat| splat.1).collect(),
            radii: all.iter().map(|splat| splat.2).collect(),
        },
        colors: Colors::Each(all.iter().map(|splat| splat.3).collect()),
    };
    let closed = scene.objects.iter().all(|object| object.closed);
    let storage = Storage { order: Order::Input, ..Storage::default() };
    Scene { objects: vec![Object { name: "all".to_owned(), splats, closed }], storage, ..Scene::default() }
}

fn passes(frame: &Frame) -> Vec<&str> {
    let names = frame.plan.passes.iter().map(|pass| pass.name.as_str());
    names.filter(|name| !name.starts_with("read back") && *name != "export").collect()
}

#[test]
fn a_scene_has_the_passes_of_what_it_has_and_no_others() {
    let mut headless = shared();
    let opaque = scenes::sphere_of_disks();
    let mut invisible = opaque.clone();
    invisible.scene.objects.push(transparent::tinted(scenes::sphere(100, DVec3::ZERO), [1.0, 0.0, 0.0, 0.0]));
    invisible.settings.layers = Layers::Auto(64);
    let three = ["visibility", "accumulate", "finalize"];
    for hard in [&opaque, &invisible] {
        assert_eq!(passes(&render(&mut headless, hard)), three);
    }
    assert_same_bits(
        &render(&mut headless, &opaque),
        &render(&mut headless, &invisible),
        "an invisible object",
    );

    let mut meshes = transparent::meshes_only();
    meshes.scene.lights.clear();
    meshes.scene.meshes.truncate(1);
    assert_eq!(passes(&render(&mut headless, &meshes)), ["polygons", "finalize"]);
    assert_eq!(
        passes(&render(&mut headless, &transparent::hybrid(Transition::Color))),
        ["visibility", "begin depth with polygons", "polygons", "accumulate", "finalize"]
    );
    let layered = with(&transparent::interpenetrating(), |settings| {
        (settings.layers, settings.last_layer) = (Layers::Fixed(2), LastLayer::Blend);
    });
    assert_eq!(
        passes(&render(&mut headless, &layered)),
        [
            "visibility of layer 1",
            "accumulate of layer 1",
            "compose of layer 1",
            "accumulate of layer 2",
            "compose of layer 2",
            "finalize"
        ]
    );
    let nothing = Hard { scene: Scene::default(), ..opaque };
    assert_eq!(passes(&render(&mut headless, &nothing)), ["finalize"]);
}

#[test]
fn the_memory_of_layers_does_not_grow_with_their_number() {
    let mut headless = shared();
    let bytes = [2, 3, 8, 64].map(|layers| {
        let hard = with(&transparent::spheres(), |settings| settings.layers = Layers::Fixed(layers));
        render(&mut headless, &hard);
        headless.transient_bytes()
    });
    println!("transients of 2, 3, 8, 64 layers: {bytes:?} bytes");
    assert_eq!(bytes[1..], [bytes[1]; 3]);
}

#[test]
fn what_is_not_covered_stays_transparent_without_a_background() {
    let mut headless = shared();
    for hard in [transparent::spheres(), transparent::meshes_only(), transparent::blended()] {
        let hard = with(&hard, |settings| settings.background = None);
        let errors = against_oracle(&mut headless, &hard);
        assert!(errors.worst <= COLOR, "{}: {errors:?}", hard.name);
        let frame = render(&mut headless, &hard);
        let partly = frame.linear.iter().filter(|pixel| pixel[3] > 0.05 && pixel[3] < 0.95).count();
        assert!(partly > 3000, "{}: {partly}", hard.name);
    }
}

#[test]
fn transitions_differ_where_splats_and_polygons_meet_and_nowhere_else() {
    let mut headless = shared();
    let pictures =
        [Transition::Color, Transition::Attributes, Transition::None, Transition::Paper].map(|transition| {
            // A wide overlap, so that much of it is seen.
            let mut hard = with(&transparent::hybrid(transition), |settings| {
                settings.shading = surfel::scene::Shading::Phong
            });
            if let Shapes::Disks { radii, .. } = &mut hard.scene.objects[0].splats.shapes {
                radii.iter_mut().for_each(|radius| *radius *= 2.0);
            }
            let frame = render(&mut headless, &hard);
            let errors = compare_light(&frame, &oracle_of(&hard));
            println!("{}", errors.row(&format!("{transition:?}")));
            assert!(errors.worst <= COLOR, "{transition:?}: {errors:?}");
            frame
        });
    let differing = |a: &Frame, b: &Frame| a.linear.iter().zip(&b.linear).filter(|(a, b)| a != b).count();
    let counts = [1, 2, 3].map(|other| differing(&pictures[0], &pictures[other]));
    println!("pixels that differ from color: attributes, none, paper: {counts:?}");
    assert!(counts.iter().all(|count| (50..8000).contains(count)), "{counts:?}");
}
