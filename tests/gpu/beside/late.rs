//! Uploads of which the commands are submitted in a later epoch than they were recorded in.

use surfel::{embed::Placed, scene::Scene};

use super::{
    Beside, REVERSED,
    updates::{BEHIND, camera},
};
use crate::common::scenes;

fn ball() -> Scene {
    Scene { objects: vec![scenes::sphere(2000, glam::DVec3::ZERO)], ..Scene::default() }
}

/// Two epochs end, and are done, before the commands are submitted: what they copy from is there, and goes once they have run; or with the scene, where they never run.
#[test]
fn an_upload_is_submitted_in_whichever_epoch_and_what_it_copies_from_goes_when_it_has_run() {
    let mut beside = Beside::new(REVERSED);
    let picture = |beside: &mut Beside, scene: &surfel::embed::PreparedScene| {
        let settings = surfel::Settings { size_px: super::SIZE_PX, ..surfel::Settings::default() };
        beside.draw(&[Placed::at_home(scene)], &camera(), &settings, &BEHIND, false);
        beside.engine.pixels()
    };
    let upload_bytes = |beside: &Beside| beside.device.memory_by_use().upload;
    let scene = beside.upload(&ball());
    let expected = picture(&mut beside, &scene);
    drop(scene);
    // SAFETY: all that was submitted is done.
    let others_end = |beside: &Beside| unsafe { beside.device.epoch_done(beside.device.end_epoch()) };
    others_end(&beside);
    let without = upload_bytes(&beside);

    beside.engine.begin();
    // SAFETY: recording; submitted below.
    let late = unsafe { beside.renderer.upload(beside.engine.commands, &ball()) }.unwrap();
    let with = upload_bytes(&beside);
    assert!(with > without, "{with} bytes, {without} before");
    others_end(&beside);
    others_end(&beside);
    assert_eq!(upload_bytes(&beside), with, "what is copied from has gone");
    beside.engine.begin_rendering(true);
    beside.engine.end_rendering();
    beside.submit();
    // It has run; its epoch ends with the next submission.
    others_end(&beside);
    assert_eq!(upload_bytes(&beside), without);
    assert!(picture(&mut beside, &late) == expected);

    beside.engine.begin();
    // SAFETY: recording; the copies are never submitted.
    let never = unsafe { beside.renderer.upload(beside.engine.commands, &ball()) }.unwrap();
    others_end(&beside);
    assert_eq!(upload_bytes(&beside), with);
    drop((never, late));
    others_end(&beside);
    assert_eq!(upload_bytes(&beside), without);
    beside.end();
}
