//! Levels of detail from a file: the same picture as those that are made in memory.

use surfel::{
    levels_file::{LevelsFile, PageView, write_object},
    load::builtin,
    scene::{Camera, Epsilon, Lod, Object, Scene},
};

use crate::{
    common::{PICTURE, render_as, shared},
    levels::{ball, pixels_apart, rms},
};

/// The file of an object, opened; and its folder, which has to live as long.
fn file_of(object: &Object) -> (LevelsFile, temp_dir::TempDir) {
    let folder = temp_dir::TempDir::new().unwrap();
    let path = folder.path().join("a.surfel");
    write_object(&path, object, None, &()).unwrap();
    (LevelsFile::open(&path).unwrap(), folder)
}

/// Opaque and transparent, from afar and next to it, whole and in part: what is read for the view makes the picture that all of it makes.
#[test]
fn a_picture_from_a_file_is_that_of_the_hierarchy_in_memory() {
    let mut headless = shared();
    let mut opaque = builtin::relief(120_000);
    opaque.closed = false;
    let mut glass = builtin::relief(20_000);
    glass.splats.colors.tint(None, 0.6);
    for (object, glass) in [(opaque, false), (glass, true)] {
        let (mut file, _folder) = file_of(&object);
        let (mut pages, mut exact) = (Vec::new(), 0);
        for (distance, tau_px) in [(3.5, 0.0), (3.5, 1.0), (12.0, 1.0), (1.4, 2.0), (1.4, 0.0)] {
            let mut hard = ball(1, tau_px);
            hard.settings.lod = Lod::Px(tau_px);
            // Where it is found for each splat, it is from what is near it among those that were read.
            hard.settings.epsilon = Epsilon::Radii(1.0);
            hard.camera = Camera {
                eye: glam::DVec3::new(0.3, 0.2, distance),
                target: glam::DVec3::new(0.3, 0.2, 0.0),
                ..Camera::default()
            };
            hard.scene = Scene { objects: vec![object.clone()], levels: tau_px > 0.0, ..Scene::default() };
            let truth = render_as(&mut headless, &hard, PICTURE);
            let view = PageView::new(&hard.camera, hard.settings.size_px, tau_px);
            let chosen = file.load(Some(&view), u64::MAX, &()).unwrap();
            pages.push(chosen.pages);
            hard.scene = Scene { leveled: vec![chosen.object], ..Scene::default() };
            let found = render_as(&mut headless, &hard, PICTURE);
            let error = rms(&truth, &found);
            println!("glass {glass}, {distance}, {tau_px} px: {error} apart");
            // Sums of the same splats in another order, with the same weights: some roundings of 2⁻²⁴, which in single pixels turn what is
            // within ε.
            let apart = pixels_apart(&truth, &found);
            assert!(apart <= 4 && error < 1e-4, "{glass} {distance} {tau_px}: {apart} pixels, {error}");
            exact += usize::from(error < 2e-6);
            // Something is there.
            assert!(truth.linear.iter().filter(|pixel| pixel[3] > 0.5).count() > 500);
        }
        assert!(exact >= 3, "{exact} of 5 views are the same to the last bits");
        println!("pages {pages:?} of {}", file.pages().len());
        assert!(pages.iter().any(|read| *read < file.pages().len()), "{pages:?}");
    }
}
