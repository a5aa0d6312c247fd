//! Transparency, polygons and hybrid scenes: GPU against the oracle's exact A-buffer, and what must hold of layers whatever
//! the scene.

use crate::common::{
    assert_same_bits, builder, oracle_of, passes, render, render_as,
    scenes::{self, Hard, transparent},
    shared, with, with_points_up_to,
};
use glam::{DQuat, DVec3};
use surfel::{
    graph::execute::Profile,
    renderer::{Frame, Headless, Wanted},
    scene::{Epsilon, LastLayer, Layers, Scene, Settings, Transition},
    selftest::{
        light::{LightErrors, compare_light},
        tolerance::LIGHT,
    },
};

fn against_oracle(headless: &mut Headless, hard: &Hard) -> LightErrors {
    let errors = compare_light(&render(headless, hard), &oracle_of(hard));
    println!("{}", errors.row(hard.name));
    errors
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
fn splats_in_no_order_agree_with_the_oracle() {
    let mut headless = shared();
    for epsilon in [Epsilon::Radii(1.0), Epsilon::Radii(0.1), Epsilon::Length(0.0)] {
        let errors = against_oracle(&mut headless, &random_transparent(epsilon));
        assert!(errors.worst <= LIGHT && errors.not_finite == 0, "{epsilon:?}: {errors:?}");
        assert!(errors.seen >= 3000 && errors.compared >= 40_000, "{epsilon:?}: {errors:?}");
    }
}

#[test]
fn large_transparent_splats_are_listed_and_drawn_as_quads() {
    let mut headless = shared();
    let hard = with(&transparent::interpenetrating(), |settings| settings.layers = Layers::Auto(12));
    let plain = render(&mut headless, &hard);
    let listed = with_points_up_to(&mut headless, 12.0, |headless| render(headless, &hard));
    assert!(passes(&listed).contains(&"list large transparent splats"));
    let errors = compare_light(&listed, &oracle_of(&hard));
    println!("{}", errors.row("interpenetrating shells, all large"));
    assert!(errors.worst <= LIGHT && errors.compared > 40_000, "{errors:?}");
    assert_ne!(plain.linear, listed.linear, "nothing was drawn in another way");
}

#[test]
fn blending_what_is_left_into_the_last_layer_helps() {
    let mut headless = shared();
    // Their layers are all told apart.
    for hard in [transparent::spheres(), transparent::interpenetrating(), transparent::glass()] {
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
    let polygons =
        Scene { meshes: vec![builder::ball_of_polygons(DVec3::ZERO, 1.0, 60, color)], ..Scene::default() };
    // The last layer's alpha of several surfaces must not make more of two.
    for (layers, last_layer) in [(24, LastLayer::Drop), (3, LastLayer::Stack)] {
        // Below a pixel a splat, the filter makes the ball larger by a part of a pixel, and its silhouette thicker.
        for (side_px, limit) in [(512, 0.005), (128, 0.01), (64, 0.03)] {
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
fn layers_that_are_not_there_draw_nothing() {
    let mut headless = shared();
    let hard = with(&transparent::glass(), |settings| settings.layers = Layers::Auto(12));
    let wanted = Wanted { profile: Some(Profile::Counts), ..Wanted::default() };
    let frame = render_as(&mut headless, &hard, wanted);
    let counts = |name: &str| {
        let passes = frame.profile.iter().flat_map(|profile| &profile.passes);
        let of_name = passes.filter(|pass| pass.name == name).filter_map(|pass| pass.counts);
        of_name.map(|counts| (counts.vertices, counts.fragments)).next().unwrap()
    };
    let most = oracle_of(&hard).pixels.iter().map(|pixel| pixel.layers).max().unwrap();
    assert!((1..8).contains(&most), "{most}");
    let drawn: Vec<_> = (1..=12)
        .map(|layer| ["accumulate", "compose"].map(|pass| counts(&format!("{pass} of layer {layer}"))))
        .collect();
    println!("vertices and fragments of each layer: {drawn:?}");
    // One layer more finds that there is none, the others draw no vertex.
    for layer in 1..=12 {
        let drawn = layer <= most + 1;
        assert_eq!(counts(&format!("accumulate of layer {layer}")).0 > 0, drawn, "layer {layer} of {most}");
        assert_eq!(counts(&format!("compose of layer {layer}")).0 > 0, drawn, "layer {layer} of {most}");
    }
}

/// Without those that read back.
fn own_passes(frame: &Frame) -> Vec<&str> {
    let mut names = passes(frame);
    names.retain(|name| !name.starts_with("read back") && *name != "export");
    names
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
        assert_eq!(own_passes(&render(&mut headless, hard)), three);
    }
    assert_same_bits(
        &render(&mut headless, &opaque),
        &render(&mut headless, &invisible),
        "an invisible object",
    );

    let mut meshes = transparent::meshes_only();
    meshes.scene.lights.clear();
    meshes.scene.meshes.truncate(1);
    assert_eq!(own_passes(&render(&mut headless, &meshes)), ["polygons", "finalize"]);
    assert_eq!(
        own_passes(&render(&mut headless, &transparent::hybrid(Transition::Color))),
        ["visibility", "begin depth with polygons", "polygons", "accumulate", "finalize"]
    );
    let layered = with(&transparent::interpenetrating(), |settings| {
        (settings.layers, settings.last_layer) = (Layers::Fixed(2), LastLayer::Blend);
    });
    assert_eq!(
        own_passes(&render(&mut headless, &layered)),
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
    assert_eq!(own_passes(&render(&mut headless, &nothing)), ["finalize"]);
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
    for hard in [transparent::interpenetrating(), transparent::meshes_only(), transparent::blended()] {
        let hard = with(&hard, |settings| settings.background = None);
        let errors = against_oracle(&mut headless, &hard);
        assert!(errors.worst <= LIGHT, "{}: {errors:?}", hard.name);
        let frame = render(&mut headless, &hard);
        let partly = frame.linear.iter().filter(|pixel| pixel[3] > 0.05 && pixel[3] < 0.95).count();
        assert!(partly > 3000, "{}: {partly}", hard.name);
    }
}
