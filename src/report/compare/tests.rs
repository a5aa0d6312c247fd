//! Table, JSON and plot of a report that is made by hand.

use super::*;
use crate::{
    report::{
        FrameSample, PLOT_SIZE_PX,
        picture::{Figures, RegionError},
    },
    scene::{Accumulate, Camera, Filter, FilterWeight, KernelEval, Rasterizer, Settings},
};

fn method(rasterizer: Rasterizer, filter: Filter) -> Method {
    let (accumulate, kernel_eval) = (Accumulate::F32, KernelEval::Analytic);
    let filter = WeightedFilter { filter, ..WeightedFilter::default() };
    Method { rasterizer, filter, accumulate, kernel_eval }
}

fn figures(rms: f64) -> ErrorFigures {
    let deviation = Some(Deviation { max: 4.0 * rms, rms });
    ErrorFigures {
        compared_px: 1000,
        left_out_px: 10,
        left_out_share: 0.01,
        coverage_px: 3,
        color: deviation,
        image: deviation,
        left_out_color: None,
        psnr_db: (rms > 0.0).then(|| -20.0 * rms.log10()),
        ssim: Some(1.0 - rms),
        normal_deg: deviation,
        depth: deviation,
    }
}

fn picture(rms: f64) -> PictureError {
    let region = |px: u64, rms: f64| {
        let over = |rms: f64| Some(Figures { rms, flip: 2.0 * rms });
        RegionError { px, over_white: over(rms), over_black: over(0.5 * rms) }
    };
    PictureError {
        whole: region(1000, rms),
        inside: region(800, 0.5 * rms * rms / 0.01),
        silhouette: region(150, 2.0 * rms),
        dark_fringe: 1000.0 * rms,
        bright_fringe: 0.0,
        wider_px: Some(10.0 * rms),
        partial_px: if rms > 0.015 { 1 } else { 100 },
    }
}

fn times(ms: f64) -> FrameTimes {
    let sample = |ms: f64| FrameSample {
        passes_ms: vec![Some(ms), Some(2.0 * ms), Some(0.5), Some(0.25)],
        frame_ms: Some(3.0 * ms + 0.75),
        wall_ms: 4.0 * ms,
        record_ms: 0.1,
    };
    let names = ["visibility", "accumulate", "finalize", "list"].map(str::to_owned);
    let counts = [Some([100, 2000]), Some([100, 3000]), Some([3, 4096]), None];
    FrameTimes::of(&names, 2, &[sample(ms), sample(2.0 * ms)], &counts)
}

fn report() -> CompareReport {
    let row = |rasterizer, filter, ms, rms| {
        let row = method(rasterizer, filter);
        MethodRow::new(row, times(ms), figures(1e-5), figures(rms), picture(rms))
    };
    let skip = |rasterizer, reason: &str| Skipped {
        method: method(rasterizer, Filter::Ewa),
        reason: reason.to_owned(),
    };
    let mut report = CompareReport {
        surfel: "0.0.0".to_owned(),
        device: DeviceReport {
            name: "a device".to_owned(),
            driver: "its driver".to_owned(),
            api_version: "1.3.0".to_owned(),
            timestamp_period_ns: 1.0,
            timestamp_valid_bits: 64,
        },
        settings: Settings::default().as_options(),
        camera: (&Camera::fit(&crate::scene::Ball { center: glam::DVec3::ZERO, radius: 1.0 }, [64; 2], 0.75))
            .into(),
        inputs: Vec::new(),
        splats: 100,
        error_size_px: [256, 256],
        time_size_px: [1024, 1024],
        samples_per_side: 16,
        timed_frames: 2,
        methods: vec![
            row(Rasterizer::Perspective, Filter::Adjust, 10.0, 0.01),
            row(Rasterizer::Perspective, Filter::None, 9.0, 0.02),
            row(Rasterizer::Quad, Filter::Adjust, 20.0, 0.01),
        ],
        skipped: vec![
            skip(Rasterizer::Raycast, "no map"),
            skip(Rasterizer::Triangle, "no map"),
            skip(Rasterizer::Quad, "lost"),
        ],
        why: Vec::new(),
        notes: vec!["a note".to_owned()],
    };
    for (pass, [vertex, fragment]) in report.methods[0].passes.iter_mut().zip([[433, 9], [431, 14]]) {
        (pass.vertex_instructions, pass.fragment_instructions) = (Some(vertex), Some(fragment));
    }
    report.judge();
    report
}

#[test]
fn the_table_is_the_same_to_the_letter() {
    let table = report().to_string();
    // Where a change is wanted, the new text is in the failure.
    assert_eq!(table, include_str!("tests/table.txt"), "\n{table}");
}

#[test]
fn the_table_of_all_methods_fits_a_terminal_of_120_columns() {
    let mut report = report();
    let longest = WeightedFilter { filter: Filter::AdjustPaper, filter_weight: FilterWeight::Unit };
    report.methods[0].method = Method {
        rasterizer: Rasterizer::RaycastApproximate,
        filter: longest,
        kernel_eval: KernelEval::Texture,
        ..report.methods[0].method
    };
    report.methods[0].frame_ms = times(12_345.0).frame_ms;
    report.judge();
    let widest = |lines: &str| lines.lines().map(|line| line.chars().count()).max();
    assert!(widest(&report.summary().to_string()) <= Some(120), "{}", report.summary());
    assert!(widest(&report.why.join("\n")) <= Some(160), "{:?}", report.why);
}

#[test]
fn the_nearest_filter_is_told_first_whatever_the_order_of_methods() {
    let mut report = report();
    let told = report.why.clone();
    assert_eq!(told.len(), 2);
    report.methods.reverse();
    report.judge();
    assert_eq!(report.why, told);
}

#[test]
fn what_was_not_measured_is_a_dash() {
    let mut report = report();
    report.methods.truncate(1);
    let row = &mut report.methods[0];
    row.frame_ms = None;
    row.passes.iter_mut().for_each(|pass| (pass.figures.ms, pass.figures.fragments) = (None, None));
    let nothing = RegionError::default();
    row.picture_error =
        PictureError { whole: nothing, inside: nothing, silhouette: nothing, ..row.picture_error };
    report.judge();
    assert!(!report.methods[0].pareto);
    let table = report.to_string();
    let dashes = |line: &str| line.split_whitespace().filter(|word| *word == "-").count();
    let rows: Vec<usize> =
        table.lines().filter(|line| line.starts_with("  perspective")).map(dashes).collect();
    assert_eq!(rows, [7], "{table}");
    assert!(report.why.is_empty());
    let pages = report.grids().map(|grid| grid.rows[0].iter().filter(|cell| *cell == "-").count());
    assert_eq!(pages, [9, 6, 0, 0]);
    assert!(report.plot().svg(PLOT_SIZE_PX).unwrap().contains("Pareto front"));
}

#[test]
fn json_has_names_units_and_null_for_what_is_not_counted() {
    let json = serde_json::to_value(report()).unwrap();
    let first = &json["methods"][0];
    assert_eq!(first["rasterizer"], "perspective");
    assert_eq!(first["frame_ms"]["min"], 30.75);
    assert!(first["passes"][2]["vertex_instructions"].is_null() && first["passes"][3]["fragments"].is_null());
    assert_eq!(first["passes"][1]["fragments"], 3000);
    assert_eq!(first["passes"][1]["fragment_instructions"], 14);
    assert_eq!((&first["pareto"], &json["methods"][2]["pareto"]), (&true.into(), &false.into()));
    assert_eq!(first["method_error"]["color"]["rms"], 0.01);
    assert_eq!(first["picture_error"]["silhouette"]["over_black"]["rms"], 0.01);
    assert!(json["why"][1].as_str().unwrap().starts_with("none: 0.0200"), "{}", json["why"]);
    assert_eq!(json["skipped"][2]["reason"], "lost");
}

#[test]
fn the_plot_names_the_front_its_axes_and_each_filter() {
    let svg = report().plot().svg(PLOT_SIZE_PX).unwrap();
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    for text in [
        "perspective, adjust, f32, analytic",
        "perspective, none, f32",
        "milliseconds",
        "RMS",
        "ewa",
        "raycast",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    // Not on the front, so without its name.
    assert!(!svg.contains("quad, adjust"));
    assert_eq!(svg, report().plot().svg(PLOT_SIZE_PX).unwrap());
}
