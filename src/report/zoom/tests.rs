//! Path, claims, table and plot of a report that is made by hand.

use super::*;
use crate::{
    report::{PLOT_SIZE_PX, compare::Deviation},
    scene::Filter,
};

const FILTERS: [Filter; 4] = [Filter::Adjust, Filter::AdjustPaper, Filter::Max, Filter::Ewa];

fn figures((rms, fragments): (f64, u64)) -> Option<ZoomFigures> {
    let color = Some(Deviation { max: rms, rms });
    let error = ErrorFigures {
        compared_px: 9,
        left_out_px: 0,
        left_out_share: 0.0,
        coverage_px: 1,
        color,
        image: color,
        left_out_color: None,
        psnr_db: None,
        ssim: None,
        normal_deg: None,
        depth: None,
    };
    Some(ZoomFigures { fragments: Some(fragments), error })
}

/// Of steps in pixels a splat, each with the figures of the four filters.
fn report(steps: &[(f64, [(f64, u64); 4])]) -> ZoomReport {
    let mut report = ZoomReport {
        surfel: "0.0.0".to_owned(),
        device: DeviceReport {
            name: "a device".to_owned(),
            driver: "its driver".to_owned(),
            api_version: "1.3.0".to_owned(),
            timestamp_period_ns: 1.0,
            timestamp_valid_bits: 64,
        },
        settings: BTreeMap::new(),
        size_px: [64, 64],
        samples_per_side: 16,
        board: Board { splats_per_side: 60, splats_per_field: 5, radius: 1.0, tilt_deg: DEFAULT_TILT_DEG },
        filters: FILTERS.map(|filter| WeightedFilter { filter, ..WeightedFilter::default() }).to_vec(),
        steps: steps
            .iter()
            .map(|(px, all)| ZoomStep {
                pixels_per_splat: *px,
                samples_per_side: 16,
                figures: all.map(figures).to_vec(),
            })
            .collect(),
        claims: Vec::new(),
    };
    report.claims = report.judge();
    report
}

#[test]
fn the_path_has_equal_ratios_and_both_ends() {
    let path = zoom_path(4);
    assert_eq!((path[0], path[3]), (0.05, 50.0));
    // A thousand in three steps.
    assert!(path.windows(2).all(|pair| (pair[1] / pair[0] - 10.0).abs() < 1e-9), "{path:?}");
    assert!(zoom_path(24).windows(2).all(|pair| pair[0] < pair[1]));
}

#[test]
fn samples_follow_the_splats_until_there_are_too_many() {
    // cos 75° is 0.2588: at 0.2 px neighbors are 0.0518 px apart, 1/19.3 px; two samples each.
    for (px, least, samples) in
        [(50.0, 16, 16), (0.2, 16, 39), (0.2, 48, 48), (0.05, 2, 155), (0.02, 16, 256)]
    {
        assert_eq!(samples_per_side(px, 75.0, least), samples, "{px} {least}");
    }
}

#[test]
fn mixed_is_where_the_filter_lies_between_the_two_axes() {
    let report = report(&[]);
    // cos 75° is 0.2588: the minor axis reaches √2 px at 5.46.
    for (px, mixed) in [(1.41, false), (1.42, true), (5.4, true), (5.5, false)] {
        let step = ZoomStep { pixels_per_splat: px, samples_per_side: 16, figures: Vec::new() };
        assert_eq!(step.is_mixed(&report.board), mixed, "{px}");
    }
}

#[test]
fn claims_are_judged_by_the_worst_step_and_only_where_they_are_made() {
    let good = [(1.0, 10), (1.0, 10), (2.0, 10), (1.0, 10)];
    let report = report(&[
        (0.1, [(1.0, 10), (1.0, 10), (0.5, 10), (0.95, 10)]),
        (2.0, good),
        (20.0, [(1.2, 11), (1.0, 10), (0.1, 10), (1.0, 10)]),
    ]);
    let claims = &report.claims;
    let judged: Vec<_> = claims.iter().map(|claim| (claim.holds(), claim.steps, claim.steps_above)).collect();
    assert_eq!(
        judged,
        [(Some(false), 3, 1), (Some(true), 1, 0), (Some(false), 3, 1), (Some(false), 3, 1)],
        "{claims:#?}"
    );
    assert_eq!((claims[0].worst_ratio, claims[0].worst_at_pixels_per_splat), (Some(1.2), Some(20.0)));
    // Worse than `max` outside of the band is no fault; within, it is twice as good.
    assert_eq!(claims[1].worst_ratio, Some(0.5));
    assert!(
        claims[3].to_string().contains("NO, not at 1 of 3 steps; worst ratio 1.100000 at 20.000"),
        "{}",
        claims[3]
    );
}

#[test]
fn what_has_no_figure_is_not_judged_and_what_is_no_number_fails() {
    let mut missing = report(&[(2.0, [(1.0, 1); 4])]);
    missing.steps[0].figures[1] = None;
    let claims = missing.judge();
    assert_eq!((claims[0].holds(), claims[0].worst_ratio), (None, None));
    assert!(claims[0].to_string().ends_with("no figures"));
    let wrong = report(&[(2.0, [(f64::NAN, 1), (1.0, 1), (1.0, 1), (1.0, 1)])]);
    assert_eq!(wrong.claims[0].holds(), Some(false));
    let perfect = report(&[(2.0, [(0.0, 0); 4])]);
    assert_eq!(perfect.claims[0].holds(), Some(true));
}

#[test]
fn table_and_plot_show_every_filter_and_step() {
    let mut report = report(&[(0.05, [(0.01, 5); 4]), (2.0, [(0.02, 6); 4])]);
    report.steps[1].figures[2] = None;
    let table = report.to_string();
    for text in [
        "adjust-paper",
        "\n0.050 ",
        "\n2.000~",
        "1.00e-2",
        "fragments",
        "adjust: no more fragments than ewa: yes",
    ] {
        assert!(table.contains(text), "'{text}' is not in\n{table}");
    }
    assert_eq!(
        table.lines().filter(|line| line.split_whitespace().nth(3) == Some("-")).count(),
        3,
        "{table}"
    );
    let svg = report.plot().svg(PLOT_SIZE_PX).unwrap();
    for text in ["adjust-paper", "ewa", "pixels a splat", "mixed: larger than"] {
        assert!(svg.contains(text), "{text}");
    }
}
