//! Polygons that cover pixels in part where they end, beside splats that do: GPU against the oracle.

use crate::common::{
    PICTURE, builder, oracle_of, passes, render_as,
    scenes::{self, Hard, transparent},
    shared, with, with_limits,
};
use crate::edges::covering;
use glam::DVec3;
use surfel::{
    renderer::Headless,
    scene::{
        Camera, ClipPlanes, Crop, CropView, Edges, Samples, Scene, Settings, Shading, TileInvocations,
        Transition,
    },
    selftest::{light::compare_light, tolerance::LIGHT},
};

/// A ball of splats between a ball of polygons before it and a slanted wall of polygons behind it; `veiled`: and transparent balls, which these hide in part.
fn between(veiled: bool) -> Hard {
    let tinted_ball = |count, at: DVec3, color| transparent::tinted(scenes::sphere(count, at), color);
    let mut objects = vec![tinted_ball(6000, DVec3::ZERO, [0.8, 0.5, 0.2, 1.0])];
    if veiled {
        objects.push(tinted_ball(3000, DVec3::new(-0.6, 0.5, 0.9), [0.6, 0.2, 0.7, 0.4]));
        objects.push(tinted_ball(3000, DVec3::new(0.5, -0.6, -0.9), [0.2, 0.8, 0.7, 0.6]));
    }
    let before = builder::ball_of_polygons(DVec3::new(-0.4, -0.3, 1.2), 0.5, 20, [0.2, 0.7, 0.3, 1.0]);
    let corners = [[-1.3, -0.9, -1.5], [1.1, -1.2, -1.2], [1.4, 1.0, -1.4], [-1.1, 1.2, -1.8]];
    let wall = builder::rectangle(corners.map(DVec3::from), [0.2, 0.3, 0.9, 1.0]);
    let scene = Scene { objects, meshes: vec![before, wall], ..Scene::default() };
    covering(Hard::seen_from([0.4, 0.2, 4.5], "splats between polygons", scene))
}

fn agrees(headless: &mut Headless, hard: &Hard) {
    let frame = render_as(headless, hard, PICTURE);
    let errors = compare_light(&frame, &oracle_of(hard));
    println!("{}", errors.row(hard.name));
    assert!(errors.worst <= LIGHT && errors.not_finite == 0, "{}: {errors:?}", hard.name);
    assert!(errors.seen >= 1_000 && errors.compared >= 40_000, "{}: {errors:?}", hard.name);
}

/// Pixels whose opacity is a number of fourths, of which polygons alone have a part.
fn in_fourths(pixels: &[[f32; 4]]) -> usize {
    pixels.iter().filter(|[_, _, _, alpha]| [0.25, 0.5, 0.75].contains(alpha)).count()
}

#[test]
fn polygons_before_and_behind_splats_cover_pixels_in_part_as_the_oracles_do() {
    let mut headless = shared();
    let changes: [fn(&mut Settings); 6] = [
        |_| {},
        |settings| settings.shading = Shading::Albedo,
        |settings| settings.transition = Transition::None,
        |settings| settings.tile_invocations = TileInvocations::Pixel,
        |settings| settings.tile_invocations = TileInvocations::Column,
        |settings| settings.clip_planes = ClipPlanes([[1.0, 0.5, 0.3, 0.1]].into()),
    ];
    for change in changes {
        agrees(&mut headless, &with(&between(false), change));
    }
    agrees(&mut headless, &between(true));
    for hard in [between(false), covering(transparent::hybrid(Transition::Color))] {
        let camera = Camera { orthographic_height: Some(3.2), ..hard.camera };
        agrees(&mut headless, &Hard { camera, ..hard });
    }
    let frame = render_as(&mut headless, &between(false), PICTURE);
    assert!(passes(&frame).contains(&"resolve polygons"));
    assert!(in_fourths(&frame.linear) > 150, "{}", in_fourths(&frame.linear));
}

#[test]
fn a_part_of_a_picture_has_the_polygons_samples_of_the_whole() {
    let mut headless = shared();
    let hard = between(true);
    let crop = Crop { corner_px: [8, 128], size_px: [92, 94] };
    let CropView { camera, drawn_px, .. } = crop.view(hard.settings.size_px, &hard.camera).unwrap();
    let part = Hard { camera, ..with(&hard, |settings| settings.size_px = drawn_px) };
    let [whole, part] = [&hard, &part].map(|hard| render_as(&mut headless, hard, PICTURE).linear);
    let (width, [drawn_width, _]) = (hard.settings.size_px[0] as usize, drawn_px.map(|side| side as usize));
    assert!(in_fourths(&part) > 20, "{}", in_fourths(&part));
    // But for rounding, and for corners that fall to the next 256th of a pixel.
    let differs = |(i, pixel): &(usize, &[f32; 4])| {
        let of_whole = whole[(i / drawn_width + 128) * width + i % drawn_width + 8];
        (0..4).any(|c| (pixel[c] - of_whole[c]).abs() > 64.0 * f32::EPSILON)
    };
    let different = part.iter().enumerate().filter(differs).count();
    assert!(1000 * different <= 2 * part.len(), "{different} of {}", part.len());
}

/// Several samples of a picture are as many of its polygons. Where edges are hard, and where a device has no image for them, polygons have one.
#[test]
fn polygons_have_one_sample_where_pictures_have_more_and_where_edges_are_hard() {
    let mut headless = shared();
    let hard = between(false);
    let of_one = |headless: &mut Headless, hard: &Hard| {
        let frame = render_as(headless, hard, PICTURE);
        assert!(!passes(&frame).contains(&"resolve polygons"));
        frame.linear
    };
    of_one(&mut headless, &with(&hard, |settings| settings.samples = Samples(8)));
    let picture = of_one(&mut headless, &with(&hard, |settings| settings.edges = Edges::Hard));
    assert!(picture.iter().all(|pixel| pixel[3] == 0.0 || pixel[3] == 1.0));
    let alone =
        with_limits(&mut headless, |limits| limits.max_image_side = 300, |headless| of_one(headless, &hard));
    assert_eq!(in_fourths(&alone), 0);
    // Inside of what covers pixels wholly, both are the same.
    let sampled = render_as(&mut headless, &hard, PICTURE).linear;
    let apart = |(a, b): &(&[f32; 4], &[f32; 4])| (0..4).any(|i| (a[i] - b[i]).abs() > 0.02);
    let apart = alone.iter().zip(&sampled).filter(apart).count();
    assert!((300..3000).contains(&apart), "{apart}");
}
