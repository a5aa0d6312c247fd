//! The same splats under the filters that widen them: the oracle decides, pixel by pixel, but where a rim passes through a
//! pixel's center within rounding.

use surfel::{
    reference,
    renderer::Wanted,
    scene::{Accumulate, Filter, Settings},
};

use super::sweep;
use crate::common::{scenes::Hard, shared, with_limits};

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
            let oracle = reference::render(&hard.scene, &hard.camera, &hard.settings, &|_, _| {}).unwrap();
            let scene = headless.prepare(&hard.scene, &|_, _| {}).unwrap();
            for as_quads in [false, true] {
                let wanted = Wanted { surface: true, ..Wanted::default() };
                let frame = with_limits(
                    &mut headless,
                    |limits| {
                        if as_quads {
                            limits.point_size_range[1] = 0.0;
                        }
                    },
                    |headless| headless.render(&scene, &hard.camera, &hard.settings, wanted).unwrap(),
                );
                let decided = oracle.pixels.iter().zip(&frame.weight).filter(|(pixel, _)| !pixel.rim);
                let (mut missed, mut surplus) = (0, 0);
                for (pixel, weight) in decided {
                    inside += usize::from(pixel.is_covered());
                    missed += usize::from(pixel.is_covered() && *weight <= 0.0);
                    surplus += usize::from(!pixel.is_covered() && *weight > 0.0);
                }
                let what = format!(
                    "{filter:?}, tilt {}, offset {:e}, depth {:e}, {:?}, quads {as_quads}",
                    case.tilt_deg, case.offset, case.depth, case.place
                );
                assert_eq!((missed, surplus), (0, 0), "{what}");
            }
        }
    }
    println!("{inside} pixels inside");
    assert!(inside > 1_000_000, "{inside}");
}
