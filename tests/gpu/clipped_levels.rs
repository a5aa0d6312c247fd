//! Levels of detail of splats with clip curves: leaves keep them, nodes cover what they leave.

use crate::{
    common::{PICTURE, passes, render_as, scenes::Hard, shared},
    levels::{ball, rms},
};
use glam::DVec3;
use surfel::{
    geometry::sharp::{SharpOptions, sharp_splats},
    hard_scenes::parts::bored_block,
    scene::{Camera, Clips, Lod, Object, Scene},
};

/// A part with sharp edges, from so far.
fn part(clipped: bool, tau_px: f64, distance: f64) -> Hard {
    let mesh = bored_block(192, 12);
    let (mut splats, report) =
        sharp_splats(&mesh, &SharpOptions { splats: Some(800), ..SharpOptions::default() }, &()).unwrap();
    if !clipped {
        splats.clips = Clips::default();
    }
    let mut hard = ball(1, tau_px);
    let object = Object { name: "part".to_owned(), splats, closed: report.closed };
    hard.scene = Scene { objects: vec![object], levels: tau_px > 0.0, ..Scene::default() };
    hard.settings.lod = Lod::Px(tau_px);
    hard.camera = Camera { eye: distance * DVec3::new(0.5, -0.6, 0.7).normalize(), ..hard.camera };
    hard
}

/// Near the eye all splats are drawn as they are; from afar nodes stand for them, and what is seen is nearer to the part than what nodes of whole splats show.
#[test]
fn leaves_keep_their_curves_and_nodes_cover_what_these_leave() {
    let mut headless = shared();
    let near = [0.0, 1e-3].map(|tau_px| render_as(&mut headless, &part(true, tau_px, 4.0), PICTURE));
    assert!(passes(&near[1]).iter().any(|pass| pass.starts_with("mark visible")), "{:?}", passes(&near[1]));
    assert!(rms(&near[0], &near[1]) < 2e-6, "{}", rms(&near[0], &near[1]));
    let mut errors = Vec::new();
    for (tau_px, distance) in [(1.0, 20.0), (2.0, 10.0), (4.0, 6.0)] {
        let whole = render_as(&mut headless, &part(true, 0.0, distance), PICTURE);
        let [clipped, unclipped] = [true, false]
            .map(|clipped| rms(&whole, &render_as(&mut headless, &part(clipped, tau_px, distance), PICTURE)));
        println!("{tau_px} px from {distance}: RMS {clipped}, of nodes of whole splats {unclipped}");
        errors.push([clipped, unclipped]);
    }
    assert!(errors.iter().all(|[clipped, unclipped]| clipped < unclipped), "{errors:?}");
    assert!(errors[0][0] < 2.0 / 255.0, "{errors:?}");
}
