//! Milliseconds a frame over numbers of splats, and over pixels, as plots; all axes are logarithmic.

use plotters::style::{BLACK, RGBColor};

use super::{ConversionReport, GrowthPoint, GrowthReport, ThroughputRow};
use crate::report::{
    Spread,
    plot::{Axis, Chart, Mark, Place, Plot, Sign, color},
};

/// Whether a place is on logarithmic axes.
fn is_placed((_, ms): &Place) -> bool {
    *ms > 0.0 && ms.is_finite()
}

/// A line of this name, color and width through those of its points that are on the axes.
fn line(
    plot: &mut Plot,
    name: String,
    (color, width): (RGBColor, u32),
    points: impl Iterator<Item = Place>,
) -> Mark {
    plot.legend.push((Sign::Line(color, width), name));
    Mark::Line { points: points.filter(is_placed).collect(), color, width, dot_px: 0 }
}

/// A bar beside a line.
fn bar(x: f64, ends: [f64; 2], color: RGBColor) -> Mark {
    Mark::Line { points: ends.map(|ms| (x, ms)).to_vec(), color, width: 1, dot_px: 0 }
}

/// A chart whose axes hold all lines and bars.
fn chart(caption: &str, [x, y]: [&str; 2], marks: Vec<Mark>) -> Chart {
    let places = || {
        marks.iter().flat_map(|mark| match mark {
            Mark::Line { points, .. } => points.as_slice(),
            _ => &[],
        })
    };
    let x = Axis::logarithmic(x, places().map(|(x, _)| *x));
    let y = Axis::logarithmic(y, places().map(|(_, ms)| *ms));
    Chart { caption: caption.to_owned(), x, y, marks }
}

/// Milliseconds a frame of every method, of the floor, and of the paper's. The bars are the smallest and the largest.
pub fn throughput_plot(rows: &[ThroughputRow], device: &str) -> Plot {
    let median = |row: &ThroughputRow, ms: Option<Spread>| Some((row.splats as f64, ms?.median));
    let mut plot = Plot::default();
    let mut marks = Vec::new();
    for (i, method) in rows.first().iter().flat_map(|row| row.methods.iter().enumerate()) {
        let own = |row: &ThroughputRow| median(row, row.methods.get(i)?.frames.frame_ms);
        marks.push(line(&mut plot, method.name.clone(), (color(i), 2), rows.iter().filter_map(own)));
        let paper =
            |row: &ThroughputRow| Some((row.splats as f64, 1e3 / row.methods.get(i)?.subject.paper?.fps));
        let paper: Vec<Place> = rows.iter().filter_map(paper).collect();
        if !paper.is_empty() {
            let name = format!("the paper's {}", method.name.split(',').next().unwrap_or_default());
            marks.push(line(&mut plot, name, (color(i), 1), paper.into_iter()));
        }
    }
    let floor = rows.iter().filter_map(|row| median(row, row.floor.frame_ms));
    marks.push(line(&mut plot, "floor".to_owned(), (BLACK, 2), floor));
    for row in rows {
        for (i, method) in row.methods.iter().enumerate() {
            let ms = method.frames.frame_ms.filter(|ms| ms.min > 0.0);
            marks.extend(ms.map(|ms| bar(row.splats as f64, [ms.min, ms.max], color(i))));
        }
    }
    let axes = ["splats", "milliseconds a frame (median; bars: smallest and largest)"];
    plot.charts.push(chart(device, axes, marks));
    plot
}

/// Milliseconds a frame of every rasterizer, over splats above and over pixels below. The bars are the intervals of the
/// medians, where there are any.
pub fn growth_plot(report: &GrowthReport, device: &str) -> Plot {
    let mut plot = Plot::default();
    let methods = report.points().next().into_iter().flat_map(|point| &point.methods);
    for (i, method) in methods.enumerate() {
        plot.legend.push((Sign::Line(color(i), 2), method.name.clone()));
    }
    let fixed = report.over_splats.first().map(|point| format!("{} pixels", point.size()));
    let caption = format!("{device}: {}", fixed.unwrap_or_default());
    plot.charts.push(growth_chart(&report.over_splats, &caption, "splats", |point| point.splats));
    let fixed = report.over_pixels.first().map(|point| format!("{} splats", point.splats));
    let caption = fixed.unwrap_or_default();
    plot.charts.push(growth_chart(&report.over_pixels, &caption, "pixels", GrowthPoint::pixels));
    plot
}

/// Seconds over triangles; the bars are the smallest and the largest. Beside them what the first row's time would grow to by n log n.
pub fn conversion_plot(report: &ConversionReport) -> Plot {
    let mut plot = Plot::default();
    let rows = || report.rows.iter().filter_map(|row| Some((row.triangles as f64, row.secs?)));
    let name = format!("{}, {} threads", report.model, report.threads);
    let medians = rows().map(|(n, secs)| (n, secs.median));
    let mut marks = vec![line(&mut plot, name, (color(0), 2), medians)];
    marks.extend(rows().map(|(n, secs)| bar(n, [secs.min, secs.max], color(0))));
    if let Some((first, secs)) = rows().next() {
        let grown = move |n: f64| secs.median * (n * n.ln()) / (first * first.ln());
        marks.push(line(&mut plot, "n log n".to_owned(), (BLACK, 1), rows().map(|(n, _)| (n, grown(n)))));
    }
    let axes = ["triangles", "seconds (median; bars: smallest and largest)"];
    plot.charts.push(chart("clipped splats of a mesh", axes, marks));
    plot
}

/// A line for each rasterizer.
fn growth_chart(points: &[GrowthPoint], caption: &str, name: &str, grows: fn(&GrowthPoint) -> u64) -> Chart {
    let mut marks = Vec::new();
    for i in 0..points.iter().map(|point| point.methods.len()).max().unwrap_or(0) {
        let spread = |point: &GrowthPoint| {
            let ms = point.methods.get(i)?.frames.frame_ms.filter(|ms| ms.min > 0.0)?;
            Some((grows(point) as f64, ms))
        };
        let all: Vec<(f64, Spread)> = points.iter().filter_map(spread).collect();
        let medians = all.iter().map(|(x, ms)| (*x, ms.median)).collect();
        marks.push(Mark::Line { points: medians, color: color(i), width: 2, dot_px: 3 });
        marks.extend(all.iter().filter_map(|(x, ms)| Some(bar(*x, ms.interval?, color(i)))));
    }
    chart(caption, [name, "milliseconds a frame"], marks)
}

#[cfg(test)]
mod tests {
    use super::{
        super::{ConversionRow, growth::tests::report},
        *,
    };

    #[test]
    fn the_plot_has_a_line_for_each_rasterizer_in_both_charts() {
        let svg = growth_plot(&report(), "a device").svg([1280, 800]).unwrap();
        for text in ["a device: 64x64 pixels", "1000 splats", "splats", "pixels", "perspective", "raycast"] {
            assert!(svg.contains(&format!("\n{text}\n")), "'{text}' is not in {svg}");
        }
        for hex in ["#0072B2", "#D55E00"] {
            // Two curves and the legend's line; two bars in each chart.
            let lines = svg.lines().filter(|line| line.starts_with("<polyline") && line.contains(hex));
            assert_eq!(lines.count(), 3 + 4, "{hex}");
        }
    }

    #[test]
    fn seconds_over_triangles_have_a_line_and_bars_and_stand_beside_n_log_n() {
        let row = |triangles: u64, secs: f64| ConversionRow {
            triangles,
            splats: 2500,
            clipped: 70,
            secs: Spread::of([0.9 * secs, secs, secs, secs, secs, 1.1 * secs]),
        };
        let rows = vec![row(10_000, 0.02), row(100_000, 0.2), row(1_000_000, 2.0)];
        let report = ConversionReport { model: "a part".to_owned(), threads: 2, rows };
        let plot = conversion_plot(&report);
        let Mark::Line { points, .. } = &plot.charts[0].marks[4] else { panic!("a line") };
        assert!((points[2].1 - 0.02 * 100.0 * 6.0 / 4.0).abs() < 1e-9, "{points:?}");
        let svg = plot.svg([1280, 800]).unwrap();
        for text in ["a part, 2 threads", "n log n", "triangles"] {
            assert!(svg.contains(&format!("\n{text}\n")), "'{text}' is not in {svg}");
        }
    }

    #[test]
    fn nothing_measured_is_an_empty_plot() {
        let plots = [
            growth_plot(&GrowthReport::default(), ""),
            throughput_plot(&[], ""),
            conversion_plot(&ConversionReport::default()),
        ];
        for plot in plots {
            assert!(plot.svg([1280, 800]).unwrap().starts_with("<svg"));
        }
    }
}
