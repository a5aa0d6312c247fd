//! Lists of the splats that may be seen: what is drawn from them is what is drawn without.

use crate::common::{ALL, PICTURE, assert_same_bits, passes, render_as, scenes, shared, with};
use glam::DVec3;
use surfel::{
    graph::execute::Profile,
    hard_scenes::{Hard, sphere, transparent},
    renderer::{Frame, Headless, Wanted},
    scene::{
        Accumulate, Backfaces, Cull, Epsilon, Filter, Object, Rasterizer, Scene, Settings, TileInvocations,
        Transition,
    },
};

fn draw(headless: &mut Headless, hard: &Hard, cull: Cull, wanted: Wanted) -> Frame {
    render_as(headless, &with(hard, |settings| settings.cull = cull), wanted)
}

/// A small picture of the scene as it is seen, and one through a window that its splats stick out of on all sides.
fn views(hard: &Hard, rasterizer: Rasterizer) -> [Hard; 2] {
    let mut whole = hard.clone();
    (whole.settings.size_px, whole.settings.rasterizer) = ([64, 48], rasterizer);
    let mut narrow = whole.clone();
    narrow.camera.fov_y_rad *= 0.2;
    narrow.camera.orthographic_height = narrow.camera.orthographic_height.map(|height| 0.2 * height);
    [whole, narrow]
}

/// Points of a list are the same primitives in the same order, so that not a bit may differ.
#[test]
fn points_of_a_list_are_the_same_bits_on_every_hard_scene_and_with_every_filter() {
    let mut headless = shared();
    let any_filter = [scenes::random_ellipses(Filter::None), scenes::subpixel_filtered()];
    let filters = Filter::NAMES.iter().flat_map(|(_, filter)| {
        any_filter.each_ref().map(|hard| with(hard, |settings| settings.filter = *filter))
    });
    let filters = filters.filter(|hard| hard.settings.check_scene(&hard.scene).is_ok());
    let mut listed = 0;
    for scene in scenes::all().into_iter().chain(filters).chain(transparent::all()) {
        let prepared = headless.prepare(&scene.scene, &|_, _| {}).unwrap();
        for Hard { name, camera, settings, .. } in views(&scene, Rasterizer::Perspective) {
            let what = format!("{name}, {}", settings.filter.name());
            let [all, kept, seen] = [Cull::Setup, Cull::List, Cull::Hidden].map(|cull| {
                let settings = Settings { cull, ..settings.clone() };
                headless.render(&prepared, &camera, &settings, ALL).unwrap()
            });
            assert!(!passes(&all).contains(&"list visible splats"), "{what}");
            listed += usize::from(passes(&kept).contains(&"list visible splats"));
            assert_same_bits(&all, &kept, &what);
            assert_same_bits(&all, &seen, &format!("{what}, hidden"));
        }
    }
    assert!(listed > 30, "{listed}");
}

/// With the paper's transition a fragment up to twice ε behind counts beside polygons: more than visibility lets through.
#[test]
fn what_the_papers_transition_sums_is_not_hidden() {
    let mut headless = shared();
    for transition in [Transition::Paper, Transition::Color] {
        let mut hard = transparent::hybrid(transition);
        let epsilon = 0.02;
        hard.settings = Settings {
            rasterizer: Rasterizer::Perspective,
            epsilon: Epsilon::Length(epsilon),
            backfaces: Backfaces::Cull,
            ..hard.settings
        };
        // A second surface behind the first, between ε and twice that.
        let mut behind = hard.scene.objects[0].clone();
        behind.splats.positions.iter_mut().for_each(|position| position.z -= 1.5 * epsilon);
        hard.scene.objects.push(behind);
        let all = draw(&mut headless, &hard, Cull::Setup, ALL);
        let seen = draw(&mut headless, &hard, Cull::Hidden, ALL);
        assert_same_bits(&all, &seen, transition.name());
        assert_eq!(passes(&seen).contains(&"list unhidden splats"), transition == Transition::Color);
        // By tiles, which know what they hide.
        hard.settings.rasterizer = Rasterizer::Compute;
        let [all, seen] = [Cull::List, Cull::Hidden].map(|cull| draw(&mut headless, &hard, cull, PICTURE));
        assert!(passes(&seen).contains(&"see, sum and shade tiles"));
        assert_same_bits(&all, &seen, transition.name());
    }
}

/// What is left out of a tile's list would have had no weight in its sums, which go on in the same order.
#[test]
fn tiles_without_what_is_hidden_are_the_same_bits_on_every_hard_scene() {
    let mut headless = shared();
    let mut behind = balls(Settings::default());
    behind.camera = scenes::builder::camera([6.0, 0.0, 0.0], [0.0; 3]);
    let by = |invocations| with(&behind, |settings| settings.tile_invocations = invocations);
    let behind = [by(TileInvocations::Column), by(TileInvocations::ShortColumn)];
    for scene in scenes::all().into_iter().chain(behind) {
        let prepared = headless.prepare(&scene.scene, &|_, _| {}).unwrap();
        for Hard { name, camera, settings, .. } in views(&scene, Rasterizer::Compute) {
            let [kept, seen] = [Cull::List, Cull::Hidden].map(|cull| {
                let settings = Settings { cull, ..settings.clone() };
                headless.render(&prepared, &camera, &settings, ALL).unwrap()
            });
            assert_same_bits(&kept, &seen, &format!("{name} {:?}", settings.tile_invocations));
        }
    }
    drop(headless);
    // A renderer of its own: others have drawn so, too.
    let mut own = crate::common::headless();
    draw(
        &mut own,
        &with(&by(TileInvocations::Column), |s| s.rasterizer = Rasterizer::Compute),
        Cull::Hidden,
        ALL,
    );
    let pipelines = own.renderer.shaders().pipeline_names();
    assert!(pipelines.iter().any(|name| name.ends_with("column_hidden.comp")), "{pipelines:?}");
}

/// Three balls, of numbers of splats that fill no word of bits, the outer ones cut by the sides of the view.
fn balls(settings: Settings) -> Hard {
    let ball = |i: usize| sphere(3001 + 7 * i, DVec3::new(1.6 * (i as f64 - 1.0), 0.0, 0.0));
    let scene = Scene { objects: (0..3).map(ball).collect(), ..Scene::default() };
    let settings = Settings { size_px: [200, 200], accumulate: Accumulate::F32, ..settings };
    Hard { name: "balls", scene, camera: scenes::builder::camera([0.0, 0.0, 4.5], [0.0; 3]), settings }
}

/// By tiles the sums' order is another: of 32 bits each is off by a few roundings. Large splats, too, come from the list.
#[test]
fn tiles_of_a_list_are_the_same_within_rounding() {
    let mut headless = shared();
    let mut near = balls(Settings::default());
    near.camera = scenes::builder::camera([0.0, 0.0, 1.1], [0.4, 0.1, 0.0]);
    for (hard, large) in [(balls(Settings::default()), false), (near, true)] {
        let hard =
            Hard { settings: Settings { rasterizer: Rasterizer::Compute, ..hard.settings.clone() }, ..hard };
        let all = draw(&mut headless, &hard, Cull::Setup, ALL);
        let kept = draw(&mut headless, &hard, Cull::Auto, ALL);
        assert!(
            passes(&kept).contains(&"list visible splats") && !passes(&all).contains(&"list visible splats")
        );
        assert_eq!(passes(&kept).contains(&"sum large splats"), large);
        assert!(all.weight.iter().any(|weight| *weight > 0.0));
        for (a, b) in all.weight.iter().zip(&kept.weight) {
            // 30 splats a pixel at most, each addition off by 2^-24.
            assert!((a - b).abs() <= 4e-6 * a, "{a} {b}");
        }
        let again = draw(&mut headless, &hard, Cull::Auto, ALL);
        assert_same_bits(&kept, &again, "again");
    }
}

/// What faces away or lies outside of the view never reaches the vertex stage.
#[test]
fn points_that_are_not_seen_are_no_vertices() {
    let mut headless = shared();
    let hard = balls(Settings { rasterizer: Rasterizer::Perspective, ..Settings::default() });
    let counted = Wanted { profile: Some(Profile::Counts), ..Wanted::default() };
    let mut vertices = |hard: &Hard, cull| {
        let frame = draw(&mut headless, hard, cull, counted);
        let profile = frame.profile.unwrap();
        ["visibility", "accumulate"].map(|name| {
            let pass = profile.passes.iter().find(|pass| pass.name == name).unwrap();
            pass.counts.unwrap().vertices
        })
    };
    let all = 3001 + 3008 + 3015;
    assert_eq!(vertices(&hard, Cull::Setup), [all, all]);
    // Nearly half of the middle ball faces the eye, and a part of half of each outer one is within the sides.
    let kept = vertices(&hard, Cull::List);
    assert!((all / 5..all / 3).contains(&kept[0]) && kept[0] == kept[1], "{kept:?} of {all}");
    let mut away = hard.clone();
    away.camera = scenes::builder::camera([0.0, 0.0, 4.5], [0.0, 0.0, 9.0]);
    assert_eq!(vertices(&away, Cull::List), [0, 0]);
    // One behind the other: in front of the eye is one ball, from which the others stick out on no side.
    let mut behind = hard.clone();
    behind.camera = scenes::builder::camera([6.0, 0.0, 0.0], [0.0; 3]);
    let listed = vertices(&behind, Cull::List);
    let seen = vertices(&behind, Cull::Hidden);
    assert_eq!(seen[0], listed[0]);
    assert!(seen[1] > 500 && seen[1] < listed[1] / 2, "{seen:?} of {listed:?}");
}

#[test]
fn where_nothing_is_left_out_there_is_no_list() {
    let mut headless = shared();
    let open = |objects: Vec<Object>| {
        objects.into_iter().map(|object| Object { closed: false, ..object }).collect::<Vec<_>>()
    };
    for rasterizer in [Rasterizer::Perspective, Rasterizer::Compute] {
        let mut hard = balls(Settings { rasterizer, ..Settings::default() });
        hard.scene.objects = open(vec![hard.scene.objects.swap_remove(1)]);
        let lists = |headless: &mut Headless, hard: &Hard| {
            passes(&draw(headless, hard, Cull::List, ALL)).contains(&"mark visible splats")
        };
        assert!(!lists(&mut headless, &hard));
        let culled = Settings { backfaces: Backfaces::Cull, ..hard.settings.clone() };
        assert!(lists(&mut headless, &Hard { settings: culled, ..hard.clone() }));
        hard.camera.fov_y_rad *= 0.2;
        assert!(lists(&mut headless, &hard));
    }
}
