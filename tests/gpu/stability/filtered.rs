//! The same splats under the filters that widen them: the oracle decides, pixel by pixel, but where a rim passes through a
//! pixel's center within rounding.

use surfel::{
    renderer::Wanted,
    scene::{Accumulate, Filter, Settings},
};

use super::sweep;
use crate::common::{oracle_of, scenes::Hard, shared, with_points_up_to};

/// Wider pictures take the oracle minutes.
const WIDEST_PX: u32 = 1024;

#[test]
fn no_fragment_is_missed_or_surplus_under_a_filter() {
    let mut headless = shared();
    let mut inside = 0;
    for case in sweep::all(1) {
        // A center just at the near plane is filtered or not, by a bit.
        let undecided = (case.depth - 1.0).abs() < 1e-3;
        if undecided || case.hard.settings.size_px.iter().any(|side| *side > WIDEST_PX) {
            continue;
        }
        for filter in [Filter::Adjust, Filter::Ewa] {
            let settings = Settings { filter, accumulate: Accumulate::F32, ..case.hard.settings.clone() };
            let hard = Hard { settings, ..case.hard.clone() };
            let oracle = oracle_of(&hard);
            let scene = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
            for cap_px in [f32::INFINITY, 0.0] {
                let wanted = Wanted { surface: true, ..Wanted::default() };
                let frame = with_points_up_to(&mut headless, cap_px, |headless| {
                    headless.render(&scene, &hard.camera, &hard.settings, wanted).unwrap()
                });
                let decided = oracle.pixels.iter().zip(&frame.weight).filter(|(pixel, _)| !pixel.rim);
                let (mut missed, mut surplus) = (0, 0);
                for (pixel, weight) in decided {
                    inside += usize::from(pixel.is_covered());
                    missed += usize::from(pixel.is_covered() && *weight <= 0.0);
                    surplus += usize::from(!pixel.is_covered() && *weight > 0.0);
                }
                let what = format!(
                    "{filter:?}, tilt {}, offset {:e}, depth {:e}, {:?}, points up to {cap_px}",
                    case.tilt_deg, case.offset, case.depth, case.place
                );
                assert_eq!((missed, surplus), (0, 0), "{what}");
            }
        }
    }
    println!("{inside} pixels inside");
    assert!(inside > 1_000_000, "{inside}");
}
