//! Eye-dome lighting: of the depths around, against the oracle, by points and by tiles.

use crate::common::{PICTURE, assert_agrees, oracle_of, passes, render, render_as, scenes, shared, with};
use surfel::{
    hard_scenes::Hard,
    scene::{Accumulate, Filter, Rasterizer, Settings, Shading},
    selftest::light::compare_light,
};

fn by(hard: &Hard, rasterizer: Rasterizer, accumulate: Accumulate) -> Hard {
    with(hard, |settings: &mut Settings| {
        (settings.shading, settings.rasterizer) = (Shading::EyeDome, rasterizer);
        settings.accumulate = accumulate;
    })
}

/// A depth is a mean of splats within epsilon, whose weights are right to 1e-3, and of the last of 24 bits: some 1e-6 of itself. The
/// color's exponent is 0.7 · focal / √5 times twice that, 97 at this size: 2e-4 of it, a fifth of what is allowed.
#[test]
fn it_agrees_with_the_oracle_by_points_and_by_tiles_whatever_the_precision_of_other_sums() {
    let mut headless = shared();
    let scenes = [scenes::sphere_of_disks(), scenes::random_ellipses(Filter::Adjust), scenes::ground()];
    for hard in &scenes {
        let mut dark = Vec::new();
        for rasterizer in
            [Rasterizer::Perspective, Rasterizer::Quad, Rasterizer::Raycast, Rasterizer::Compute]
        {
            for accumulate in [Accumulate::F32, Accumulate::F16] {
                let hard = by(hard, rasterizer, accumulate);
                // A decision that rounding can turn is one of all pixels that look at it.
                let (frame, oracle) = assert_agrees(&mut headless, &hard, 1000);
                let names = passes(&frame);
                assert!(names.contains(&"eye dome") && !names.contains(&"finalize"), "{names:?}");
                // The picture alone is the same.
                assert_eq!(render_as(&mut headless, &hard, PICTURE).linear, frame.linear, "{}", hard.name);
                let errors = compare_light(&frame, &oracle);
                assert!(errors.compared > 20_000 && errors.worst < 1.0 / 1024.0, "{}", errors.row(hard.name));
                let pixels = frame.linear.iter().zip(&oracle.pixels).filter(|(_, pixel)| pixel.is_covered());
                dark.push(
                    pixels.filter(|(color, pixel)| f64::from(color[0]) < 0.9 * pixel.albedo[0]).count(),
                );
            }
        }
        assert!(dark.iter().all(|dark| *dark > 500), "{dark:?}");
    }
}

#[test]
fn a_frame_of_another_shading_has_no_pass_of_it_and_one_without_splats_is_background() {
    let mut headless = shared();
    let sphere = scenes::sphere_of_disks();
    assert!(!passes(&render(&mut headless, &sphere)).contains(&"eye dome"));
    let mut nothing = by(&sphere, Rasterizer::Perspective, Accumulate::F32);
    nothing.scene.objects.clear();
    let frame = render_as(&mut headless, &nothing, PICTURE);
    assert!(frame.linear.iter().all(|color| *color == [1.0; 4]) && !passes(&frame).contains(&"eye dome"));
    // Behind the camera there is something, and in the picture there is nothing.
    let mut behind = by(&sphere, Rasterizer::Compute, Accumulate::F32);
    behind.camera.target = behind.camera.eye + (behind.camera.eye - behind.camera.target);
    let frame = render_as(&mut headless, &behind, PICTURE);
    assert_eq!(frame.linear.len(), oracle_of(&behind).pixels.len());
    assert!(frame.linear.iter().all(|color| *color == [1.0; 4]));
}
