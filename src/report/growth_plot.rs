//! Milliseconds over splats and over pixels as a plot.

use plotters::{coord::Shift, prelude::*};

use super::{
    GrowthPoint, GrowthReport,
    plot::{LEGEND_WIDTH_PX, LogAxis, SIZE_PX, Sign, color, failed, legend, log_chart, logarithmic},
};
use crate::error::Result;

/// Milliseconds a frame of every rasterizer, over splats above and over pixels below, as SVG; all axes are logarithmic. The
/// bars are the intervals of the medians, where there are any.
///
/// # Errors
/// None that an input could lead to.
pub fn growth_plot(report: &GrowthReport, device: &str) -> Result<String> {
    let mut svg = String::new();
    draw(report, device, SVGBackend::with_string(&mut svg, SIZE_PX)).map_err(failed)?;
    Ok(svg)
}

fn draw<B: DrawingBackend>(
    report: &GrowthReport,
    device: &str,
    backend: B,
) -> std::result::Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    let root = backend.into_drawing_area();
    root.fill(&WHITE)?;
    let (left, right) = root.split_horizontally(SIZE_PX.0 - LEGEND_WIDTH_PX);
    let (above, below) = left.split_vertically(SIZE_PX.1 / 2);
    let at = |point: &GrowthPoint| format!("{}x{} pixels", point.size_px[0], point.size_px[1]);
    let fixed = report.over_splats.first().map(at).unwrap_or_default();
    let over_splats = (report.over_splats.as_slice(), format!("{device}: {fixed}"));
    curves(&above, over_splats, "splats", |point| point.splats)?;
    let fixed = report.over_pixels.first().map(|point| format!("{} splats", point.splats));
    let over_pixels = (report.over_pixels.as_slice(), fixed.unwrap_or_default());
    curves(&below, over_pixels, "pixels", GrowthPoint::pixels)?;
    let names = report.points().next().into_iter().flat_map(|point| &point.methods);
    let lines = names.enumerate().map(|(i, method)| (Sign::Line(color(i), 2), method.name.clone()));
    legend(&right, lines)?;
    root.present()
}

/// One chart: a line for each rasterizer.
fn curves<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    (points, caption): (&[GrowthPoint], String),
    name: &str,
    grows: fn(&GrowthPoint) -> u64,
) -> std::result::Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    let methods = points.iter().map(|point| point.methods.len()).max().unwrap_or(0);
    let spread = |point: &GrowthPoint, i: usize| {
        let ms = point.methods.get(i)?.frames.frame_ms.filter(|ms| ms.min > 0.0)?;
        Some((grows(point) as f64, ms))
    };
    let all = || (0..methods).flat_map(|i| points.iter().filter_map(move |point| spread(point, i)));
    let ends = all().flat_map(|(_, ms)| ms.interval.unwrap_or([ms.median; 2]));
    let mut chart = log_chart(
        area,
        &caption,
        LogAxis { name, range: logarithmic(points.iter().map(|point| grows(point) as f64)) },
        LogAxis { name: "milliseconds a frame", range: logarithmic(ends) },
    )?;
    for i in 0..methods {
        let line: Vec<_> = points.iter().filter_map(|point| spread(point, i)).collect();
        let medians = line.iter().map(|(x, ms)| (*x, ms.median));
        chart.draw_series(LineSeries::new(medians.clone(), color(i).stroke_width(2)))?;
        chart.draw_series(medians.map(|place| Circle::new(place, 3, color(i).filled())))?;
        let bars = line.iter().filter_map(|(x, ms)| ms.interval.map(|[low, high]| [(*x, low), (*x, high)]));
        chart.draw_series(bars.map(|bar| PathElement::new(bar, color(i).stroke_width(1))))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{super::growth::tests::report, *};

    #[test]
    fn the_plot_has_a_line_for_each_rasterizer_in_both_charts() {
        let svg = growth_plot(&report(), "a device").unwrap();
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
    fn nothing_measured_is_an_empty_plot() {
        let empty = GrowthReport { over_splats: Vec::new(), over_pixels: Vec::new(), left_out: Vec::new() };
        assert!(growth_plot(&empty, "").unwrap().starts_with("<svg"));
    }
}
