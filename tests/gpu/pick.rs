//! Picking against the oracle: what is seen in a pixel, and where it is.

use crate::common::{ALL, render_as, scenes, shared, with};
use glam::DVec3;
use surfel::{
    hard_scenes::{Hard, transparent},
    load::builtin,
    passes::{Picked, PickedPart},
    reference::{Candidate, Picker},
    renderer::Headless,
    scene::{
        Camera, ClipPlanes, Edges, Epsilon, Filter, Lod, Object, Order, Rasterizer, Scene, Settings,
        SplatFormat, Storage, Transition,
    },
};

/// Pixels along a side of the grid that is picked.
const GRID: u32 = 9;

fn grid(hard: &Hard) -> impl Iterator<Item = [u32; 2]> {
    let [width, height] = hard.settings.size_px;
    (0..GRID * GRID)
        .map(move |i| [(2 * (i % GRID) + 1) * width / (2 * GRID), (2 * (i / GRID) + 1) * height / (2 * GRID)])
}

/// The larger part of the distance by which a place is off, and how many pixels saw something. Fails where another thing is picked than
/// what is nearest, or may be for all that rounding leaves open.
fn worst(headless: &mut Headless, hard: &Hard) -> (f64, u32) {
    let scene = Scene { numbered: true, ..hard.scene.clone() };
    let prepared = headless.prepare(&scene, &|_, _| {}).unwrap();
    let picker = Picker::new(&scene, &hard.camera, &hard.settings).unwrap();
    let (mut worst, mut seen) = (0.0_f64, 0);
    for pixel in grid(hard) {
        let picked = headless.pick(&prepared, &hard.camera, &hard.settings, pixel).unwrap();
        let candidates = picker.at(pixel);
        let certain = candidates.iter().filter(|candidate| candidate.certain);
        let hides_beyond = certain.map(|candidate| candidate.z_shifted).fold(f64::INFINITY, f64::min);
        let Some(picked) = picked else {
            assert!(hides_beyond.is_infinite(), "{}, {pixel:?}: nothing, not {hides_beyond}", hard.name);
            continue;
        };
        let limit = hides_beyond + 1e-5 * hides_beyond.abs();
        let possible = candidates.iter().filter(|it| it.z_shifted <= limit && is_of(it, &picked));
        let off = possible.map(|it| error_of(&picked, it, hard)).fold(f64::INFINITY, f64::min);
        assert!(off <= 1e-5, "{}, {pixel:?}: {off:e}; {picked:?} of {candidates:?}", hard.name);
        (worst, seen) = (worst.max(off), seen + 1);
    }
    (worst, seen)
}

fn is_of(candidate: &Candidate, picked: &Picked) -> bool {
    match picked.part {
        PickedPart::Splat(number) => candidate.splat == Some([picked.object, number.unwrap() as usize]),
        PickedPart::Triangle(number) => candidate.splat.is_none() && number.is_some(),
        PickedPart::Node => false,
    }
}

/// How far the place is from where the ray of its pixel has the candidate's depth, over the distance from the eye.
fn error_of(picked: &Picked, candidate: &Candidate, hard: &Hard) -> f64 {
    let camera = &hard.camera;
    let view = camera.view_from_world();
    let at = view.point(picked.position);
    // On the way to it, the place in view space has the ray's direction; only its depth is to be compared.
    let along = if camera.is_orthographic() { DVec3::Z } else { at / at.z };
    let distance = picked.distance.max(candidate.z.abs());
    ((picked.depth - candidate.z) * along.length()).abs().max((at.z - picked.depth).abs()) / distance
}

#[test]
fn places_are_those_of_the_oracle_on_every_hard_scene() {
    let mut headless = shared();
    let mut seen_in_all = 0;
    for hard in scenes::all() {
        let (off, seen) = worst(&mut headless, &hard);
        println!("{}: {seen} places, off by {off:.1e} of the distance", hard.name);
        assert!(seen > 0, "{}", hard.name);
        seen_in_all += seen;
    }
    assert!(seen_in_all > 400, "{seen_in_all}");
}

#[test]
fn so_they_are_of_transparent_things_and_polygons() {
    let mut headless = shared();
    let epsilon = |hard: &Hard| with(hard, |settings| settings.epsilon = Epsilon::Length(0.02));
    let all =
        [transparent::hybrid(Transition::Color), transparent::spheres(), epsilon(&transparent::spheres())];
    for hard in all {
        let (off, seen) = worst(&mut headless, &hard);
        println!("{}: {seen} places, off by {off:.1e} of the distance", hard.name);
        assert!(seen > 20, "{}: {seen}", hard.name);
    }
}

#[test]
fn so_they_are_by_every_rasterizer_and_filter_and_in_parts_of_pictures() {
    let mut headless = shared();
    let sphere = scenes::sphere_of_disks();
    for (name, rasterizer) in Rasterizer::METHODS {
        for filter in [Filter::Adjust, Filter::None, Filter::Max, Filter::Ewa, Filter::AdjustPaper] {
            for edges in [Edges::Coverage, Edges::Hard] {
                let settings = Settings { rasterizer: *rasterizer, filter, edges, ..sphere.settings.clone() };
                if settings.validate().is_ok() {
                    let (off, seen) = worst(&mut headless, &Hard { settings, ..sphere.clone() });
                    assert!(seen > 20, "{name}, {filter:?}: {seen}, {off}");
                }
            }
        }
    }
    let near = Camera { orthographic_height: Some(1.2), ..sphere.camera };
    let parallel = Hard { camera: near, ..sphere.clone() };
    assert!(worst(&mut headless, &parallel).1 > 40);
    let crop = surfel::scene::Crop { corner_px: [70, 60], size_px: [40, 50] };
    let view = crop.view(sphere.settings.size_px, &sphere.camera).unwrap();
    let settings = Settings { size_px: view.drawn_px, ..sphere.settings.clone() };
    assert!(worst(&mut headless, &Hard { camera: view.camera, settings, ..sphere.clone() }).1 > 40);
    let packed = Storage { order: Order::Input, format: SplatFormat::Packed };
    let mut hard = sphere.clone();
    hard.scene.storage = packed;
    let scene = Scene { numbered: true, ..hard.scene.clone() };
    let prepared = headless.prepare(&scene, &|_, _| {}).unwrap();
    let [width, height] = hard.settings.size_px;
    let middle = [width / 2, height / 2];
    let packed = headless.pick(&prepared, &hard.camera, &hard.settings, middle).unwrap().unwrap();
    assert!(packed.position.length() > 0.9 && packed.normal.dot(packed.position.normalize()) > 0.99);
}

#[test]
fn what_planes_cut_off_is_not_picked() {
    let mut headless = shared();
    let all = [scenes::sphere_of_disks(), transparent::hybrid(Transition::Color), transparent::spheres()];
    for hard in all {
        let cut = with(&hard, |settings| settings.clip_planes = ClipPlanes([[0.3, 1.0, 0.2, -0.1]].into()));
        let (off, seen) = worst(&mut headless, &cut);
        println!("{}: {seen} places, off by {off:.1e} of the distance", hard.name);
        assert!(seen > 10, "{}: {seen}", hard.name);
    }
}

/// UTM metres: f32 places a coordinate to half a metre.
#[test]
fn large_coordinates_lose_nothing() {
    let mut headless = shared();
    let far = DVec3::new(500_000.0, 4_600_000.0, 300.0);
    let mut hard = scenes::sphere_of_disks();
    hard.scene.objects[0].splats.positions.iter_mut().for_each(|position| *position += far);
    (hard.camera.eye, hard.camera.target) = (hard.camera.eye + far, hard.camera.target + far);
    let (off, seen) = worst(&mut headless, &hard);
    println!("{seen} places, off by {off:.1e} of the distance");
    assert!(seen > 20);
}

#[test]
fn levels_of_detail_are_picked_as_they_are_drawn() {
    let mut headless = shared();
    let object: Object = builtin::relief(20_000);
    let scene = Scene { objects: vec![object], levels: true, numbered: true, ..Scene::default() };
    let settings = Settings { lod: Lod::Px(4.0), size_px: [200, 200], ..Settings::default() };
    let camera = Camera::fit(&scene.ball().unwrap(), settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
    let hard = Hard { name: "levels", scene: scene.clone(), camera, settings };
    for rasterizer in [Rasterizer::Compute, Rasterizer::Perspective, Rasterizer::Quad] {
        for lod in [8.0, 0.5] {
            let hard =
                with(&hard, |settings| (settings.rasterizer, settings.lod) = (rasterizer, Lod::Px(lod)));
            let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
            let frame = render_as(&mut headless, &hard, ALL);
            let (mut nodes, mut leaves) = (0, 0);
            for [x, y] in grid(&hard) {
                let picked = headless.pick(&prepared, &camera, &hard.settings, [x, y]).unwrap();
                let depth = f64::from(frame.depth[(y * 200 + x) as usize]);
                let Some(picked) = picked else { continue };
                // The nearest of what is blended there, no farther off than the surface is thick.
                assert!(
                    (picked.depth - depth).abs() < 0.1,
                    "{rasterizer:?}, {x},{y}: {} {depth}",
                    picked.depth
                );
                match picked.part {
                    PickedPart::Node => nodes += 1,
                    PickedPart::Splat(number) => {
                        let center = scene.objects[0].splats.positions[number.unwrap() as usize];
                        assert!(center.distance(picked.position) < 0.1, "{number:?}: {center}");
                        leaves += 1;
                    }
                    PickedPart::Triangle(_) => panic!("no polygon is there"),
                }
            }
            let coarse = lod > 1.0 && rasterizer != Rasterizer::Quad;
            assert!(
                if coarse { nodes > 20 } else { leaves > 20 && nodes == 0 },
                "{rasterizer:?}, {lod}: {nodes}, {leaves}"
            );
        }
    }
}

#[test]
fn normals_are_of_the_world_toward_the_eye_and_pixels_are_of_the_picture() {
    let mut headless = shared();
    let sphere = scenes::sphere_of_disks();
    let prepared = headless.prepare(&sphere.scene, &|_, _| {}).unwrap();
    let mut seen = 0;
    for pixel in grid(&sphere) {
        let Some(picked) = headless.pick(&prepared, &sphere.camera, &sphere.settings, pixel).unwrap() else {
            continue;
        };
        assert_eq!((picked.object, picked.part), (0, PickedPart::Splat(None)), "numbers were not asked for");
        let outward = picked.position.normalize();
        assert!(
            picked.normal.dot(outward) > 0.95 && picked.normal.dot(sphere.camera.eye - picked.position) > 0.0
        );
        assert!((picked.distance - picked.position.distance(sphere.camera.eye)).abs() < 1e-12);
        seen += 1;
    }
    assert!(seen > 20);
    let nothing = headless.prepare(&Scene::default(), &|_, _| {}).unwrap();
    assert_eq!(headless.pick(&nothing, &sphere.camera, &sphere.settings, [0, 0]).unwrap(), None);
    let [width, height] = sphere.settings.size_px;
    let error = headless.pick(&prepared, &sphere.camera, &sphere.settings, [width, 0]).unwrap_err();
    assert_eq!(error.to_string(), format!("--pick: {width},0: expected a pixel of {width}x{height}"));
}
