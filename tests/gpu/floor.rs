//! The floor is what it says: the same points, the same fragments, the same formats.

use crate::common::{scenes, shared, with_limits};
use surfel::{
    graph::execute::{FrameProfile, Profile},
    instruments::{Floor, LimitProbes},
    renderer::{Headless, Wanted},
    report::ThroughputProbe,
};

fn fragments(profile: &FrameProfile) -> Vec<Option<u64>> {
    profile.passes.iter().map(|pass| pass.counts.map(|counts| counts.fragments)).collect()
}

/// Whether the driver counts all that is drawn, as Mesa 22.3.6 (Debian 12) does. Others need not run a shader that does
/// nothing, nor one of a fragment that an early depth test hides.
fn counts_all(headless: &Headless) -> bool {
    headless.device().facts().driver.contains("Mesa 22.")
}

/// The floor draws the fragments of the passes. The passes themselves write depth, which allows no early test, until finalize.
fn assert_same(headless: &Headless, floor: &[Option<u64>], own: &[Option<u64>]) {
    if counts_all(headless) {
        assert!(own.len() == 3 && own.iter().all(Option::is_some), "{own:?}");
        assert_eq!(floor, own);
    } else {
        let ([depth, add, fill], [visibility, accumulate, finalize]) = (floor, own) else {
            panic!("{floor:?}, {own:?}");
        };
        let is_less = |less: &Option<u64>, more: &Option<u64>| *less > Some(0) && less <= more;
        assert!(depth.is_none() || depth == visibility, "{depth:?}, {visibility:?}");
        assert!(is_less(add, accumulate) && is_less(finalize, fill), "{floor:?}, {own:?}");
    }
}

#[test]
fn the_floor_draws_the_fragments_of_the_passes_and_the_strict_floor_fewer_points() {
    let mut headless = shared();
    let hard = scenes::sphere_of_disks();
    let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
    let wanted = Wanted { profile: Some(Profile::Counts), ..Wanted::default() };
    for size_px in [[256, 256], [300, 200]] {
        let settings = surfel::Settings { size_px, ..hard.settings.clone() };
        let frame = headless.render(&prepared, &hard.camera, &settings, wanted).unwrap();
        let own = fragments(&frame.profile.unwrap());
        for (survivors, is_fewer) in [(false, false), (true, true)] {
            let mut floor = Floor::new(&headless, &prepared, &hard.camera, &settings, survivors).unwrap();
            let counted = fragments(&floor.frame(&headless, Profile::Counts).unwrap());
            println!("{size_px:?}: {} points; fragments {own:?}, the floor's {counted:?}", floor.count());
            assert_same(&headless, &counted, &own);
            // A closed sphere: about half of its splats face away.
            assert_eq!(floor.count() < prepared.splat_count(), is_fewer);
            let times = floor.frame(&headless, Profile::Times).unwrap();
            assert!(times.passes.iter().all(|pass| pass.secs.is_some_and(|secs| secs > 0.0)));
        }
    }
}

#[test]
fn a_scene_of_several_chunks_has_a_floor_too() {
    let mut headless = shared();
    let hard = scenes::sphere_of_disks();
    // 32 bytes a disk: four chunks.
    with_limits(
        &mut headless,
        |limits| limits.max_storage_buffer_range = 32 * 1000,
        |headless| {
            let prepared = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
            let wanted = Wanted { profile: Some(Profile::Counts), ..Wanted::default() };
            let frame = headless.render(&prepared, &hard.camera, &hard.settings, wanted).unwrap();
            for survivors in [false, true] {
                let mut floor =
                    Floor::new(headless, &prepared, &hard.camera, &hard.settings, survivors).unwrap();
                let counted = fragments(&floor.frame(headless, Profile::Counts).unwrap());
                assert_same(headless, &counted, &fragments(frame.profile.as_ref().unwrap()));
                assert_eq!(floor.count() < prepared.splat_count(), survivors);
            }
        },
    );
}

#[test]
fn the_limits_shade_what_their_rates_count() {
    let headless = shared();
    for size_px in [[64, 96], [100, 52]] {
        let settings = surfel::Settings { size_px, ..surfel::Settings::default() };
        let mut limits = LimitProbes::new(&headless, &settings).unwrap();
        assert!(limits.notes.is_empty(), "{:?}", limits.notes);
        let secs = limits.measure(&headless).unwrap();
        let counted = limits.counted(&headless).unwrap();
        for ((probe, secs), fragments) in limits.probes.iter().zip(secs).zip(counted) {
            let limit = probe.limit();
            println!("{size_px:?}, {limit:?}: {} units, {secs:?} s, fragments {fragments:?}", probe.units());
            assert!(secs.is_some_and(|secs| secs > 0.0), "{limit:?}");
            match limit {
                // None is kept, and none counted where a driver tests the depth first.
                ThroughputProbe::Points => assert_eq!(fragments, Some(0)),
                ThroughputProbe::DrawnPoints => {}
                ThroughputProbe::DepthFragments if fragments == Some(0) && !counts_all(&headless) => {}
                // Points of 32 pixels: in 64x96 none overlaps another. Drivers may count by blocks of 4x4.
                ThroughputProbe::Fragments
                | ThroughputProbe::DepthFragments
                | ThroughputProbe::BlendedFragments => {
                    let fragments = fragments.expect("counted");
                    let most = if size_px == [64, 96] { probe.units() } else { probe.units() * 5 / 4 };
                    assert!((probe.units()..=most).contains(&fragments), "{limit:?}: {fragments}");
                }
                ThroughputProbe::Bytes => assert_eq!(fragments, None),
                ThroughputProbe::Invocations | ThroughputProbe::Atomics => {
                    assert_eq!(fragments, Some(probe.units()))
                }
                // 64 splats at each pixel of an invocation: a column of 8 on a CPU, one on others.
                ThroughputProbe::Kernels => {
                    let pixels = if headless.device().facts().limits.is_cpu { 8 } else { 1 };
                    assert_eq!(fragments.map(|counted| 64 * pixels * counted), Some(probe.units()));
                }
            }
        }
    }
}
