//! Cameras that are off-center: parts of a picture, and pixels that are sampled beside their centers.

use crate::{
    common::{
        ALL, PICTURE, assert_same_bits, compare, moves_corners, oracle_of, render_as, scenes, shared, with,
    },
    samples::errors,
};
use surfel::{
    hard_scenes::{Hard, transparent},
    load::builtin,
    renderer::Frame,
    scene::{
        Accumulate, Camera, Crop, CropView, Cull, Filter, Object, Rasterizer, Scene, Settings, Shading,
        Transition,
    },
    selftest::tolerance,
};

/// A part of a picture, so far off that the axis is outside; and a whole one, off by parts of a pixel.
fn off_center(hard: &Hard) -> [Hard; 2] {
    let crop = Crop { corner_px: [149, 3], size_px: [101, 140] };
    let view = crop.view(hard.settings.size_px, &hard.camera).unwrap();
    let settings = Settings { size_px: view.drawn_px, ..hard.settings.clone() };
    let part = Hard { camera: view.camera, settings, ..hard.clone() };
    let shifted = Hard { camera: hard.camera.sample([-0.3125, 0.414_062_5]), ..hard.clone() };
    [part, shifted]
}

/// The default one, where the rasterizer has it.
fn filter_of(rasterizer: Rasterizer) -> Filter {
    let settings = Settings { rasterizer, ..Settings::default() };
    if settings.validate().is_ok() { Filter::Adjust } else { Filter::None }
}

#[test]
fn every_rasterizer_agrees_with_the_oracle_off_the_center() {
    let mut headless = shared();
    let opaque = scenes::sphere_of_disks().name;
    let all = [scenes::sphere_of_disks(), transparent::hybrid(Transition::Color), transparent::spheres()];
    for (hard, (name, rasterizer)) in
        all.iter().flat_map(|hard| Rasterizer::METHODS.iter().map(move |method| (hard, method)))
    {
        let filter = filter_of(*rasterizer);
        let hard = with(hard, |settings| (settings.rasterizer, settings.filter) = (*rasterizer, filter));
        for hard in off_center(&hard) {
            let (frame, oracle) = (render_as(&mut headless, &hard, ALL), oracle_of(&hard));
            // Of layers and polygons only the color.
            let [mean, beyond] = errors(&frame.linear, oracle.pixels.iter().map(|pixel| pixel.color));
            println!("{}, {name}: mean {mean:.1e}, {:.2}% of pixels beyond 1/255", hard.name, 100.0 * beyond);
            assert!(mean < 1e-4 && beyond < 5e-3, "{}, {name}: {mean:e}, {beyond}", hard.name);
            if hard.name == opaque
                && !(*rasterizer == Rasterizer::Triangle && moves_corners(headless.device()))
            {
                let errors = compare::compare(&frame, &oracle);
                println!("{}", errors.row(&format!("{}, {name}", hard.name)));
                let beyond = errors.beyond(&tolerance::of(&hard));
                assert!(beyond.is_empty(), "{}, {name}: {beyond:#?}", hard.name);
            }
        }
    }
}

fn crops() -> [Crop; 4] {
    [([0, 0], [64, 64]), ([101, 53], [97, 120]), ([299, 199], [1, 1]), ([150, 40], [150, 160])]
        .map(|(corner_px, size_px)| Crop { corner_px, size_px })
}

fn cut(mut frame: Frame, view: &CropView) -> Frame {
    frame.size_px = view.size_px();
    frame.linear = view.cut(&frame.linear);
    (frame.weight, frame.depth) = (view.cut(&frame.weight), view.cut(&frame.depth));
    (frame.albedo, frame.normal) = (view.cut(&frame.albedo), view.cut(&frame.normal));
    frame
}

/// The built-in model so near that the view cuts it.
fn near_model() -> Hard {
    let object: Object = builtin::relief(20_000);
    let scene = Scene { objects: vec![object], ..Scene::default() };
    let size_px = [300, 200];
    let camera = Camera::fit(&scene.ball().unwrap(), size_px, Camera::DEFAULT_FOV_Y_RAD);
    let camera = Camera { eye: camera.target + 0.8 * (camera.eye - camera.target), ..camera };
    Hard { name: "near model", scene, camera, settings: Settings { size_px, ..Settings::default() } }
}

/// The whole picture cut to each crop, and that part drawn by itself.
fn wholes_and_parts(hard: &Hard) -> [(Crop, Frame, Frame); 4] {
    let mut headless = shared();
    let wanted = if hard.scene.meshes.is_empty() { ALL } else { PICTURE };
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let mut draw =
        |camera: &Camera, settings: &Settings| headless.render(&prepared, camera, settings, wanted).unwrap();
    let all = draw(&hard.camera, &hard.settings);
    crops().map(|crop| {
        let view = crop.view_shaded(hard.settings.size_px, &hard.camera, hard.settings.shading).unwrap();
        let settings = Settings { size_px: view.drawn_px, ..hard.settings.clone() };
        (crop, within(&all, crop), cut(draw(&view.camera, &settings), &view))
    })
}

/// A crop of the whole, by itself: no code of the program.
fn within(whole: &Frame, crop: Crop) -> Frame {
    let [width, _] = whole.size_px;
    let inside = |i: usize| {
        let (x, y) = (i as u32 % width, i as u32 / width);
        let within = |at: u32, axis: usize| {
            (crop.corner_px[axis]..crop.corner_px[axis] + crop.size_px[axis]).contains(&at)
        };
        within(x, 0) && within(y, 1)
    };
    fn kept<T: Copy>(all: &[T], inside: impl Fn(usize) -> bool) -> Vec<T> {
        (0..all.len()).filter(|i| inside(*i)).map(|i| all[i]).collect()
    }
    Frame {
        size_px: crop.size_px,
        linear: kept(&whole.linear, inside),
        weight: kept(&whole.weight, inside),
        depth: kept(&whole.depth, inside),
        albedo: kept(&whole.albedo, inside),
        normal: kept(&whole.normal, inside),
        ..whole.clone()
    }
}

/// By points, quads and rays in any case; by tiles where records have the same numbers in both, and so sums the same order.
#[test]
fn a_part_of_a_picture_has_the_bits_of_the_whole() {
    for rasterizer in [
        Rasterizer::Perspective,
        Rasterizer::PerspectivePaper,
        Rasterizer::Raycast,
        Rasterizer::Quad,
        Rasterizer::AffineCenter,
        Rasterizer::Compute,
    ] {
        let filter = filter_of(rasterizer);
        for hard in [near_model(), transparent::spheres()] {
            let hard = with(&hard, |settings| {
                (settings.rasterizer, settings.filter, settings.cull) = (rasterizer, filter, Cull::Setup);
                settings.size_px = [300, 200];
            });
            for (crop, whole, part) in wholes_and_parts(&hard) {
                assert_same_bits(&whole, &part, &format!("{}, {rasterizer:?}, {crop:?}", hard.name));
            }
        }
    }
}

/// Of eye-dome lighting pixels depend on others beside them, which are beyond the part.
#[test]
fn a_part_that_is_shaded_by_depth_has_the_bits_of_the_whole() {
    let hard = with(&near_model(), |settings| {
        (settings.rasterizer, settings.shading) = (Rasterizer::Perspective, Shading::EyeDome);
    });
    for (crop, whole, part) in wholes_and_parts(&hard) {
        assert_same_bits(&whole, &part, &format!("{crop:?}"));
    }
}

/// Where only listed splats are projected, a part of the picture has other lists, and sums another order: of n terms each sum is off by
/// n 2⁻²⁴ at most. Polygons and triangles are the device's rasterizer's: corners are snapped to a 256th of a pixel, counted from the image's
/// corner in f32, so that one may fall to the next.
#[test]
fn elsewhere_a_part_differs_by_rounding() {
    let tiles = with(&near_model(), |settings| {
        (settings.rasterizer, settings.cull, settings.accumulate) =
            (Rasterizer::Compute, Cull::List, Accumulate::F32);
    });
    let hybrid = with(&transparent::hybrid(Transition::Color), |settings| settings.size_px = [300, 200]);
    for (hard, most) in [(tiles, 0), (hybrid, 2)] {
        for (crop, whole, part) in wholes_and_parts(&hard) {
            let far =
                |(a, b): (&[f32; 4], &[f32; 4])| (0..4).any(|i| (a[i] - b[i]).abs() > 64.0 * f32::EPSILON);
            let different = whole.linear.iter().zip(&part.linear).filter(|pair| far(*pair)).count();
            println!("{}, {crop:?}: {different} pixels differ by more than rounding", hard.name);
            assert!(1000 * different <= most * whole.linear.len(), "{}, {crop:?}: {different}", hard.name);
        }
    }
}
