//! What is dropped goes by the values of an engine's own timeline, whatever their steps.

use glam::DVec3;
use surfel::scene::Scene;

use super::{Beside, REVERSED};
use crate::common::scenes;

#[test]
fn what_is_dropped_goes_when_the_hosts_timeline_has_the_value_of_its_submission() {
    let beside = Beside::new(REVERSED);
    let [first, second] = [(); 2].map(|()| {
        beside.upload(&Scene { objects: vec![scenes::sphere(500, DVec3::ZERO)], ..Scene::default() })
    });
    let device = &beside.device;
    // What they were copied from goes first.
    // SAFETY: all that was submitted has finished; nothing is submitted here at all.
    unsafe { device.epoch_done(device.end_epoch()) };
    let used = || device.memory_in_use().0;
    let both = used();
    let one = both - first.bytes();

    device.end_epoch_at(70).unwrap();
    drop(first);
    // SAFETY: as above, here and below.
    unsafe {
        // The engine's own submissions go on; the epoch in which it was dropped has not ended.
        device.timeline_at(90);
        assert_eq!(used(), both);
        device.end_epoch_at(100).unwrap();
        device.timeline_at(99);
        assert_eq!(used(), both, "99 is before the submission that may use it");
        device.timeline_at(100);
        assert_eq!(used(), one);
        // By less than the value before no epoch ends, and by none of them.
        let refused = device.end_epoch_at(100).unwrap_err().to_string();
        assert_eq!(refused, "epoch: 100: expected more than 100, the value of the one before");
        drop(second);
        device.end_epoch_at(101).unwrap();
        device.end_epoch_at(5000).unwrap();
        device.timeline_at(4000);
        assert_eq!(used(), one - (both - one), "done up to 101");
        device.timeline_at(u64::MAX);
    }
    beside.end();
}
