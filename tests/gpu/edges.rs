//! Surfaces that cover pixels in part where they end: GPU against the oracle's A-buffer, and both against what there is: the surface itself,
//! low-passed.

use crate::common::{
    PICTURE, builder, oracle_of, passes, render_as,
    scenes::{self, Hard, transparent},
    shared, with,
};
use glam::{DVec3, Vec3};
use surfel::{
    math::srgb::linear_from_srgb,
    reference::ground_truth,
    renderer::{Headless, Wanted},
    scene::{
        Camera, Colors, Edges, Epsilon, Filter, FilterWeight, Kernel, Mesh, MeshObject, Rasterizer, Samples,
        Settings, Shading, TileInvocations, Transition,
    },
    selftest::{light::compare_light, tolerance::LIGHT},
};

/// As data there is no background, and sums are exact.
pub(crate) fn covering(hard: Hard) -> Hard {
    with(&hard, |settings| {
        settings.edges = Edges::Coverage;
        settings.rasterizer = Rasterizer::Compute;
        settings.background = None;
    })
}

/// Two balls, one partly before the other, of splats around a pixel large.
fn balls(count: usize) -> Hard {
    let mut scene = builder::Builder::default().scene(true);
    scene.objects = vec![
        scenes::sphere(count, DVec3::ZERO),
        transparent::tinted(scenes::sphere(count, DVec3::new(0.9, 0.5, -1.5)), [0.9, 0.3, 0.1, 1.0]),
    ];
    covering(Hard::seen_from([0.0, 0.0, 5.0], "two balls", scene))
}

/// An open plate, seen slanted, of disks from far below a pixel to many pixels.
fn plate(radius: f64) -> Hard {
    let mut builder = builder::Builder::default();
    let steps = (1.0 / radius) as i32;
    for x in -steps..=steps {
        for y in -steps..=steps {
            let place = DVec3::new(f64::from(x), f64::from(y), 0.0) * radius;
            builder.disk(place, DVec3::Z, 1.5 * radius, [0.5, 0.6, 0.7, 1.0]);
        }
    }
    covering(Hard::seen_from([2.0, 1.0, 2.5], "plate", builder.scene(false)))
}

/// A plate whose sides are one and a half radii of their disks apart, of two colors, seen slanted. With `flipped` the normals look inward.
fn two_sides(flipped: bool) -> Hard {
    plate_of_two(0.03, flipped, [3.0, 1.5, 3.5])
}

/// The same of any thickness, seen from any place.
fn plate_of_two(half_thickness: f64, flipped: bool, eye: [f64; 3]) -> Hard {
    let mut builder = builder::Builder::default();
    for (x, y) in (-40..=40).flat_map(|x| (-40..=40).map(move |y| (x, y))) {
        for side in [1.0, -1.0] {
            let color = if side > 0.0 { [0.8, 0.2, 0.1, 1.0] } else { [0.1, 0.2, 0.8, 1.0] };
            let place = DVec3::new(0.025 * f64::from(x), 0.025 * f64::from(y), half_thickness * side);
            builder.disk(place, if flipped { -side } else { side } * DVec3::Z, 0.04, color);
        }
    }
    covering(Hard::seen_from(eye, "two sides", builder.scene(false)))
}

fn agrees(headless: &mut Headless, hard: &Hard, seen: usize) {
    let frame = render_as(headless, hard, PICTURE);
    let errors = compare_light(&frame, &oracle_of(hard));
    println!("{}", errors.row(hard.name));
    assert!(errors.worst <= LIGHT && errors.not_finite == 0, "{}: {errors:?}", hard.name);
    assert!(errors.seen >= seen && errors.compared >= 40_000, "{}: {errors:?}", hard.name);
}

/// Pixels that are neither empty nor covered.
fn partly_covered(pixels: &[[f32; 4]]) -> usize {
    pixels.iter().filter(|pixel| pixel[3] > 0.01 && pixel[3] < 0.97).count()
}

#[test]
fn opaque_surfaces_agree_with_the_oracle_by_every_filter_kernel_and_tile() {
    let mut headless = shared();
    for hard in [balls(1_000), balls(20_000), plate(0.2), plate(0.02)] {
        agrees(&mut headless, &hard, 1_000);
        let frame = render_as(&mut headless, &hard, PICTURE);
        assert!(partly_covered(&frame.linear) > 200, "{}", hard.name);
        assert!(!passes(&frame).contains(&"accumulate"));
    }
    let changes: [fn(&mut Settings); 6] = [
        |settings| settings.filter = Filter::Ewa,
        |settings| settings.filter = Filter::AdjustPaper,
        |settings| settings.filter_weight = FilterWeight::Unit,
        |settings| settings.kernel = Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 },
        |settings| settings.tile_invocations = TileInvocations::Pixel,
        |settings| settings.tile_invocations = TileInvocations::Column,
    ];
    for change in changes {
        agrees(&mut headless, &with(&balls(5_000), change), 1_000);
    }
}

#[test]
fn layers_over_what_is_opaque_agree_with_the_oracle() {
    let mut headless = shared();
    for hard in [
        transparent::spheres(),
        transparent::interpenetrating(),
        transparent::glass(),
        transparent::upon_the_opaque(),
    ] {
        agrees(&mut headless, &covering(hard), 1_000);
    }
}

#[test]
fn splats_cover_polygons_behind_them_in_part() {
    let mut headless = shared();
    for transition in [Transition::Color, Transition::None] {
        agrees(&mut headless, &covering(transparent::hybrid(transition)), 1_000);
    }
}

/// The long epsilon of slanted splats is of the surface that is seen: a floor seen all but from its edge, far behind a wall of polygons, is not.
#[test]
fn what_is_far_behind_polygons_is_not_seen_through_them() {
    let mut headless = shared();
    let wall = |with_floor: bool| {
        let mut builder = builder::Builder::default();
        for i in 0..(if with_floor { 4000 } else { 1 }) {
            // One lies beside the wall, so that there are splats in either.
            let at = match i {
                0 => DVec3::new(0.0, 0.9, 0.0),
                _ => DVec3::new(
                    -0.8 + 0.02 * f64::from(i % 80),
                    0.02 * f64::from(i % 7 - 3),
                    -0.4 - 0.01 * f64::from(i / 80),
                ),
            };
            let normal = if i == 0 { DVec3::Z } else { DVec3::new(0.0, 1.0, 0.01) };
            builder.disk(at, normal, 0.02, [0.9, 0.1, 0.1, 1.0]);
        }
        let corners = [[-1.0, -0.6], [1.0, -0.6], [1.0, 0.6], [-1.0, 0.6]];
        let mesh = Mesh {
            positions: corners.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec(),
            normals: Some(vec![Vec3::Z; 4]),
            colors: Colors::Uniform([0.1, 0.2, 0.8, 1.0]),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
        };
        let mut scene = builder.scene(false);
        scene.meshes.push(MeshObject { name: "wall".to_owned(), mesh, closed: false });
        covering(Hard::seen_from([0.0, 0.0, 3.0], "a floor behind a wall", scene))
    };
    let [without, with_floor] = [false, true].map(wall);
    let pictures = [&without, &with_floor].map(|hard| render_as(&mut headless, hard, PICTURE).linear);
    let red = pictures[1].iter().zip(&pictures[0]).filter(|(a, b)| (a[0] - b[0]).abs() > 1e-3).count();
    assert_eq!(red, 0, "pixels in which the floor is seen");
    agrees(&mut headless, &with_floor, 1000);
}

/// The long epsilon of slanted splats takes both sides of something thin for one surface, unless each is one by itself.
#[test]
fn both_sides_of_a_thin_plate_stay_apart() {
    let mut headless = shared();
    for size_px in [[64; 2], [200; 2]] {
        for flipped in [false, true] {
            let hard = with(&two_sides(flipped), |settings| {
                settings.size_px = size_px;
                settings.shading = Shading::Albedo;
            });
            let frame = render_as(&mut headless, &hard, PICTURE);
            let errors = compare_light(&frame, &oracle_of(&hard));
            println!("{}", errors.row(hard.name));
            assert!(errors.worst <= LIGHT && errors.not_finite == 0, "{errors:?}");
            // The far side is blue: none of it is seen but at the rim, where the near one covers in part.
            let near =
                frame.linear.iter().filter(|pixel| pixel[3] > 0.99 && (pixel[0] - 0.8).abs() < 0.01).count();
            let covered = frame.linear.iter().filter(|pixel| pixel[3] > 0.99).count();
            assert!(covered > 400 && 10 * near > 9 * covered, "{near} of {covered}");
        }
    }
}

/// What none of it asks for has the edges of the papers.
/// Where surfaces are of one side, how near the other side is makes no epsilon small: filtered splats of a slanted plate, whose depths vary by
/// more than the plate is thick, would cut holes into each other.
#[test]
fn a_plate_much_thinner_than_its_disks_is_whole_at_a_grazing_angle() {
    let hard = with(&plate_of_two(0.002, false, [4.0, 1.0, 1.2]), |settings| {
        settings.epsilon = Epsilon::Auto;
        settings.shading = Shading::Albedo;
    });
    let mut headless = shared();
    agrees(&mut headless, &hard, 500);
    let seen = render_as(&mut headless, &hard, PICTURE).linear;
    let whole: Vec<_> = seen.iter().filter(|pixel| pixel[3] > 0.99).collect();
    let mixed = whole.iter().filter(|[red, _, blue, _]| red.min(*blue) > 0.1 && *blue > 0.2).count();
    println!("{mixed} of {} pixels show the far side", whole.len());
    assert!(whole.len() > 300 && 10 * mixed < whole.len());
}

#[test]
fn edges_are_hard_where_they_are_asked_for_so_and_where_nothing_widens() {
    let mut headless = shared();
    let changes: [fn(&mut Settings); 4] = [
        |settings| settings.edges = Edges::Hard,
        |settings| settings.filter = Filter::None,
        |settings| settings.rasterizer = Rasterizer::Perspective,
        |settings| settings.transition = Transition::Attributes,
    ];
    for change in changes {
        let frame = render_as(&mut headless, &with(&balls(5_000), change), PICTURE);
        assert!(frame.linear.iter().all(|pixel| pixel[3] == 0.0 || pixel[3] == 1.0));
    }
    // The surface as data has no opacity, nor has the picture beside it.
    let surface = render_as(&mut headless, &balls(5_000), Wanted { surface: true, ..PICTURE });
    assert_eq!(partly_covered(&surface.linear), 0);
}

/// Both sides of a transparent ball lie within an epsilon at its rim. As one layer, whose normals face sideways, they made dark dots, and were one surface
/// where there are two.
#[test]
fn rims_of_transparent_balls_are_of_two_sides() {
    let mut headless = shared();
    let hard = scenes::transparent::spheres();
    let settings = Settings { size_px: [64; 2], background: None, ..Settings::default() };
    let truth = Settings { edges: Edges::Hard, samples: Samples(64), ..settings.clone() };
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let [seen, wanted] = [settings, truth].map(|settings| {
        let settings = Settings { rasterizer: Rasterizer::Compute, ..settings };
        headless.render(&prepared, &hard.camera, &settings, PICTURE).unwrap().linear
    });
    let over_white = |[red, _, _, alpha]: &[f32; 4]| f64::from(alpha * red + 1.0 - alpha);
    let squares = seen.iter().zip(&wanted).map(|(a, b)| (over_white(a) - over_white(b)).powi(2));
    let rms = (squares.sum::<f64>() / seen.len() as f64).sqrt();
    println!("{rms:.4}");
    assert!(rms < 0.04, "{rms}");
}

/// How far pictures over white are from the surface itself: RMS of the pixels where it ends, and of all.
pub(crate) fn against_the_truth(headless: &mut Headless, hard: &Hard) -> [f64; 2] {
    let truth = ground_truth(&hard.scene, &hard.camera, &hard.settings, 16, &|_, _| {}).unwrap();
    let frame = render_as(headless, hard, PICTURE);
    let white = f64::from(linear_from_srgb(1.0));
    let (mut sums, mut counts) = ([0.0; 2], [0.0; 2]);
    for (pixel, truth) in frame.linear.iter().zip(&truth.pixels) {
        let [red, _, _, alpha] = pixel.map(f64::from);
        let got = alpha * red + (1.0 - alpha) * white;
        let wanted = truth.coverage * truth.color[0] + (1.0 - truth.coverage) * white;
        let ends = truth.coverage < 254.0 / 255.0 && (truth.coverage > 1.0 / 255.0 || alpha > 0.0);
        for (of, counts_here) in [(0, ends), (1, true)] {
            if counts_here {
                sums[of] += (got - wanted).powi(2);
                counts[of] += 1.0;
            }
        }
    }
    [(sums[0] / counts[0]).sqrt(), (sums[1] / counts[1]).sqrt()]
}

/// Less than a seventh of the error at silhouettes, whatever the size of splats, and of all. With sums that are stretched everywhere it is a sixth.
#[test]
fn silhouettes_are_several_times_nearer_to_the_truth_than_hard_ones() {
    let mut headless = shared();
    for (count, side_px) in [(1_000, 64), (20_000, 64), (20_000, 128), (5_000, 256)] {
        let mut hard = balls(count);
        hard.scene.objects.truncate(1);
        let hard = with(&hard, |settings| settings.size_px = [side_px; 2]);
        let [covering, crisp] = [Edges::Coverage, Edges::Hard]
            .map(|edges| against_the_truth(&mut headless, &with(&hard, |settings| settings.edges = edges)));
        println!("{count} splats, {side_px} px: {covering:.4?}, hard {crisp:.4?}");
        assert!(7.0 * covering[0] < crisp[0] && 7.0 * covering[1] < crisp[1], "{covering:?} {crisp:?}");
    }
}

/// What the window says of them.
#[test]
fn a_method_tells_whether_its_edges_cover_in_part() {
    let headless = shared();
    let hard = balls(2000);
    let scene = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    for (rasterizer, edges, covers) in [
        (Rasterizer::Compute, Edges::Coverage, true),
        (Rasterizer::Compute, Edges::Hard, false),
        (Rasterizer::Perspective, Edges::Coverage, false),
    ] {
        let settings = Settings { rasterizer, edges, ..hard.settings.clone() };
        let told = headless.renderer.covers_in_part(&scene, &hard.camera, &settings).unwrap();
        assert_eq!(told, covers, "{rasterizer:?}, {edges:?}");
    }
    // Splats that are too large for tiles have hard edges.
    let near = Camera { eye: DVec3::new(0.0, 0.0, 1.0005), ..hard.camera };
    assert!(!headless.renderer.covers_in_part(&scene, &near, &hard.settings).unwrap());
}
