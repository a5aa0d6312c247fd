//! Pictures of several samples a pixel: as the oracle draws them, and nearer to the ground truth the more there are.

use crate::common::{PICTURE, oracle_of, render_as, scenes, shared, with};
use surfel::{
    hard_scenes::{Hard, transparent},
    load::builtin,
    reference,
    renderer::Headless,
    scene::{Camera, Edges, Filter, Samples, Scene, Settings, Transition},
};

/// Mean and share of pixels off by more than 1/255, of color times alpha, and alpha.
pub fn errors(colors: &[[f32; 4]], exact: impl Iterator<Item = [f64; 4]>) -> [f64; 2] {
    let light = |[red, green, blue, alpha]: [f64; 4]| [alpha * red, alpha * green, alpha * blue, alpha];
    let of = |(color, exact): (&[f32; 4], [f64; 4])| {
        let (color, exact) = (light(color.map(f64::from)), light(exact));
        (0..4).map(|i| (color[i] - exact[i]).abs()).fold(0.0, f64::max)
    };
    let all: Vec<f64> = colors.iter().zip(exact).map(of).collect();
    let count = all.len() as f64;
    [all.iter().sum::<f64>() / count, all.iter().filter(|e| **e > 1.0 / 255.0).count() as f64 / count]
}

#[test]
fn the_mean_of_samples_is_the_oracles() {
    let mut headless = shared();
    let all = [
        scenes::sphere_of_disks(),
        transparent::spheres(),
        transparent::hybrid(Transition::Color),
        transparent::transparent_hybrid(Transition::Color),
    ];
    for hard in all {
        for background in [None, Some([1.0, 0.5, 0.25])] {
            let hard = with(&hard, |settings| {
                (settings.samples, settings.background, settings.size_px) =
                    (Samples(5), background, [128, 96]);
            });
            let frame = render_as(&mut headless, &hard, PICTURE);
            let oracle = oracle_of(&hard);
            let [mean, beyond] = errors(&frame.linear, oracle.pixels.iter().map(|pixel| pixel.color));
            println!("{}: mean {mean:.1e}, {:.2}% of pixels beyond 1/255", hard.name, 100.0 * beyond);
            assert!(mean < 1e-4 && beyond < 5e-3, "{}: {mean:e}, {beyond}", hard.name);
            let part = frame.linear.iter().filter(|color| color[3] > 0.0 && color[3] < 1.0).count();
            assert_eq!(
                background.is_none(),
                part > 0,
                "alpha between 0 and 1 where a silhouette is, of no background"
            );
            if background.is_some() {
                assert!(frame.linear.iter().all(|color| color[3] == 1.0), "{}: opaque to the bit", hard.name);
            }
        }
    }
}

fn model() -> Hard {
    let scene = Scene { objects: vec![builtin::relief(20_000)], ..Scene::default() };
    let size_px = [64, 64];
    let camera = Camera::fit(&scene.ball().unwrap(), size_px, Camera::DEFAULT_FOV_Y_RAD);
    Hard {
        name: "model",
        scene,
        camera,
        settings: Settings { size_px, edges: Edges::Hard, background: None, ..Settings::default() },
    }
}

/// Root mean square over all pixels, silhouettes too, of color times alpha.
#[test]
fn more_samples_are_nearer_to_the_ground_truth() {
    let mut headless = shared();
    for filter in [Filter::Adjust, Filter::None] {
        let hard = with(&model(), |settings| settings.filter = filter);
        let truth =
            reference::ground_truth(&hard.scene, &hard.camera, &hard.settings, 16, &|_, _| {}).unwrap();
        let rms = [1, 4, 16, 64, 256].map(|samples| {
            let hard = with(&hard, |settings| settings.samples = Samples(samples));
            let frame = render_as(&mut headless, &hard, PICTURE);
            let square = |(color, exact): (&[f32; 4], [f64; 3])| {
                (0..3).map(|i| (f64::from(color[i] * color[3]) - exact[i]).powi(2)).sum::<f64>() / 3.0
            };
            let exact = truth.pixels.iter().map(|pixel| pixel.color.map(|color| pixel.coverage * color));
            let sum: f64 = frame.linear.iter().zip(exact).map(square).sum();
            (sum / frame.linear.len() as f64).sqrt()
        });
        println!("{filter:?}: RMS {rms:.5?} at 1, 4, 16, 64, 256 samples");
        assert!(rms.windows(2).all(|pair| pair[1] < pair[0]), "{filter:?}: {rms:?}");
        assert!(rms[2] < 0.3 * rms[0] && rms[4] < 0.1 * rms[0], "{filter:?}: {rms:?}");
        if filter == Filter::Adjust {
            let of = |headless: &mut Headless, samples| {
                let covering = |settings: &mut Settings| {
                    (settings.samples, settings.edges) = (Samples(samples), Edges::Coverage);
                };
                let frame = render_as(headless, &with(&hard, covering), PICTURE);
                let exact = truth.pixels.iter().map(|pixel| pixel.color.map(|color| pixel.coverage * color));
                let square = |(color, exact): (&[f32; 4], [f64; 3])| {
                    (0..3).map(|i| (f64::from(color[i] * color[3]) - exact[i]).powi(2)).sum::<f64>() / 3.0
                };
                let sum: f64 = frame.linear.iter().zip(exact).map(square).sum();
                (sum / frame.linear.len() as f64).sqrt()
            };
            let covering = [1, 16, 256].map(|samples| of(&mut headless, samples));
            println!("edges covered in part: RMS {covering:.5?} at 1, 16, 256 samples");
            assert!(covering[0] < 0.5 * rms[0] && covering[2] < covering[1], "{covering:?}");
            assert!(covering[1] < covering[0] && covering[2] < 0.2 * rms[0], "{covering:?}");
        }
    }
}
