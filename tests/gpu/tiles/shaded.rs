//! Tiles that are shaded in the dispatch that sums them show the same picture as by their sums.

use super::{by_tiles, hard};
use crate::common::{ALL, PICTURE, passes, scenes, shared};
use glam::DVec3;
use surfel::{
    hard_scenes::{Hard, sphere, transparent},
    renderer::{Headless, Wanted},
    scene::{Accumulate, Cull, Light, LightKind, Rasterizer, Scene, Settings, Shading, Transition},
};

/// Whether tiles are shaded at once; then they are as they are by their sums.
pub fn is_shaded_as_by_sums(headless: &mut Headless, hard: &Hard) -> bool {
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let settings = Settings { rasterizer: Rasterizer::Compute, ..hard.settings.clone() };
    let mut draw = |wanted| headless.render(&prepared, &hard.camera, &settings, wanted).unwrap();
    let at_once = draw(PICTURE);
    if !passes(&at_once).contains(&"see, sum and shade tiles") {
        return false;
    }
    assert!(hard.scene.meshes.is_empty() || hard.settings.transition != Transition::Attributes);
    let by_sums = draw(ALL);
    assert!(!passes(&by_sums).contains(&"see, sum and shade tiles"));
    // Some ten operations, whose order each stage's compiler decides. By their sums, normals of polygons are normalized twice: of what
    // that rounds a highlight, the 32nd power of a cosine of twice the angle, makes 64 times as much, of which 0.2 is seen.
    let roundings = if hard.scene.meshes.is_empty() { 16.0 } else { 16.0 + 2.0 * 0.2 * 64.0 };
    for (pixel, (a, b)) in at_once.linear.iter().zip(&by_sums.linear).enumerate() {
        let far = a.iter().zip(b).any(|(a, b)| (a - b).abs() > roundings * f32::EPSILON * b.abs().max(1.0));
        assert!(!far, "{}, pixel {pixel}: {a:?}, by sums {b:?}", hard.name);
    }
    true
}

/// Opaque splats, alone or beside polygons, are shaded in the dispatch that sums them, unless someone else reads the sums, as what
/// exports the surface does: the same formulas of the same sums, in two stages of the device. Each shading, under the scene's own
/// lights and without.
#[test]
fn tiles_that_are_shaded_at_once_are_the_same_picture_as_by_their_sums() {
    let mut headless = shared();
    let directional = |direction, color| Light { kind: LightKind::Directional(direction), color };
    let lights = vec![
        directional(DVec3::new(-0.4, -1.0, -0.7), [0.9, 0.5, 0.2]),
        Light { kind: LightKind::Eye, color: [0.1, 0.3, 0.4] },
    ];
    let shadings = [Shading::Phong, Shading::Lambert, Shading::Normals, Shading::Albedo];
    let polygons = transparent::meshes_only().scene.meshes.swap_remove(0);
    let halves = [Transition::Color, Transition::Attributes, Transition::None, Transition::Paper]
        .map(transparent::hybrid);
    let (mut shaded, mut shaded_beside) = (0, 0);
    for (i, mut hard) in scenes::all().into_iter().chain(halves).enumerate() {
        hard.settings.size_px = [96, 64];
        hard.settings.shading = shadings[i % 4];
        hard.settings.accumulate = Accumulate::F32;
        hard.settings.cull = if i % 3 == 2 { Cull::Hidden } else { Cull::Auto };
        hard.settings.background = (i % 2 == 0).then_some([0.2, 0.4, 0.7]);
        let mut cut = hard.clone();
        cut.scene.meshes.push(polygons.clone());
        let lit = |hard: &Hard| {
            let scene = Scene { lights: lights.clone(), ..hard.scene.clone() };
            Hard { scene, ..hard.clone() }
        };
        for hard in [lit(&hard), lit(&cut), hard, cut] {
            let is_shaded = is_shaded_as_by_sums(&mut headless, &hard);
            shaded += usize::from(is_shaded);
            shaded_beside += usize::from(is_shaded && !hard.scene.meshes.is_empty());
        }
    }
    assert!(
        shaded >= 34 && shaded_beside >= 18,
        "{shaded} pictures, {shaded_beside} of them beside polygons"
    );
}

/// What tiles show is rounded to 16 bits where the target has fewer, and light ends with half floats: neither is seen there. A target
/// of 32 bits loses nothing.
#[test]
fn tiles_show_as_many_bits_as_the_target_has() {
    let mut headless = shared();
    let mut hard =
        hard(vec![sphere(4000, DVec3::ZERO)], scenes::builder::camera([0.0, 0.0, 3.2], [0.0; 3]), [97, 83]);
    let srgb = Wanted { linear: false, ..PICTURE };
    for intensity in [1.0, 1e6] {
        hard.scene.lights = vec![Light { kind: LightKind::Eye, color: [intensity, 0.5, 0.25] }];
        let [half, single] = [Accumulate::F16, Accumulate::F32].map(|accumulate| {
            hard.settings.accumulate = accumulate;
            [srgb, PICTURE].map(|wanted| {
                let frame = by_tiles(&mut headless, &hard, wanted);
                assert!(passes(&frame).contains(&"see, sum and shade tiles"));
                frame
            })
        });
        assert_eq!(half[1].linear, single[1].linear);
        let brightest = half[1].linear.iter().map(|color| color[0]).fold(0.0, f32::max);
        assert!(if intensity > 1.0 { brightest > 65_504.0 } else { brightest < 2.0 }, "{brightest}");
        // Half floats round by 2^-12 of a color: a 36th of an 8-bit step at most, at white, so that few turn over.
        let farthest = |(a, b): (&[u8; 4], &[u8; 4])| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max();
        let steps: Vec<_> = half[0].srgb.iter().zip(&single[0].srgb).filter_map(farthest).collect();
        assert!(steps.iter().all(|step| *step <= 1));
        assert!(steps.iter().filter(|step| **step > 0).count() * 10 < steps.len());
        assert!(half[0].srgb.iter().any(|color| color[0] > 200 && color[3] == 255));
    }
}
