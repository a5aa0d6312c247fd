//! What reports say of figures.

use surfel::report::{
    FrameSample, TimedFrames,
    bench::{HalfAndHalf, Measurement, Primitives, TransitionReport},
};

fn timed(rounds_ms: [f64; 6]) -> TimedFrames {
    let frame =
        |ms: f64| FrameSample { passes_ms: vec![Some(ms)], frame_ms: Some(ms), wall_ms: ms, record_ms: 0.1 };
    TimedFrames {
        passes: vec!["accumulate".to_owned()],
        rounds: rounds_ms.map(|ms| vec![frame(ms)]).into(),
        counts: vec![None],
        transient_bytes: 0,
    }
}

#[test]
fn what_is_uncertain_is_not_called_equal() {
    for (ratios, expected) in [
        ([0.98, 0.99, 1.0, 1.0, 1.01, 1.02], "yes"),
        ([0.5, 0.9, 1.0, 1.0, 1.1, 1.5], "uncertain"),
        ([1.01, 1.02, 1.02, 1.02, 1.02, 1.5], "no"),
    ] {
        let of = |name: &str, rounds_ms, transition| {
            let drawn = Primitives { splats: 1, triangles: 1, transition };
            (name.to_owned(), HalfAndHalf { drawn }, timed(rounds_ms))
        };
        let contestants = vec![of("none", [1.0; 6], false), of("color", ratios, true)];
        let report = TransitionReport {
            model: "ball".to_owned(),
            contestants: Measurement::all(contestants, None),
            floor: timed([1.0; 6]).times(),
        };
        assert!(report.grid().rows[1].iter().any(|cell| cell == expected), "{:?}", report.grid().rows);
    }
}
