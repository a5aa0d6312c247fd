//! Milliseconds over numbers of splats as a plot.

use plotters::prelude::*;

use super::{
    ThroughputRow,
    plot::{LEGEND_WIDTH_PX, LogAxis, SIZE_PX, Sign, color, failed, legend, log_chart, logarithmic},
};
use crate::error::Result;

/// A line of the plot.
struct Curve {
    name: String,
    color: RGBColor,
    width: u32,
    points: Vec<(f64, f64)>,
}

/// Milliseconds a frame of every method, of the floor, and of the paper's, as SVG; both axes are logarithmic. The bars are
/// the smallest and the largest.
///
/// # Errors
/// None that an input could lead to.
pub fn throughput_plot(rows: &[ThroughputRow], device: &str) -> Result<String> {
    let mut svg = String::new();
    draw(rows, device, SVGBackend::with_string(&mut svg, SIZE_PX)).map_err(failed)?;
    Ok(svg)
}

fn draw<B: DrawingBackend>(
    rows: &[ThroughputRow],
    device: &str,
    backend: B,
) -> std::result::Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    let curves = curves(rows);
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let root = backend.into_drawing_area();
    root.fill(&WHITE)?;
    let (left, right) = root.split_horizontally(SIZE_PX.0 - LEGEND_WIDTH_PX);
    let splats = logarithmic(points().map(|(splats, _)| *splats));
    let ms = logarithmic(points().map(|(_, ms)| *ms).chain(ends(rows)));
    let mut chart = log_chart(
        &left,
        device,
        LogAxis { name: "splats", range: splats },
        LogAxis { name: "milliseconds a frame (median; bars: smallest and largest)", range: ms },
    )?;
    for curve in &curves {
        let style = curve.color.stroke_width(curve.width);
        chart.draw_series(LineSeries::new(curve.points.iter().copied(), style))?;
    }
    for row in rows {
        for (i, method) in row.methods.iter().enumerate() {
            if let Some(ms) = method.frames.frame_ms.filter(|ms| ms.min > 0.0) {
                let bar = [(row.splats as f64, ms.min), (row.splats as f64, ms.max)];
                chart.draw_series([PathElement::new(bar, color(i).stroke_width(1))])?;
            }
        }
    }
    let lines = curves.into_iter().map(|curve| (Sign::Line(curve.color, curve.width), curve.name));
    legend(&right, lines)?;
    root.present()
}

/// The methods in color, the floor in black, the paper's in the methods' colors, thin.
fn curves(rows: &[ThroughputRow]) -> Vec<Curve> {
    let on_axes = |(splats, ms): (u64, Option<f64>)| {
        ms.filter(|ms| *ms > 0.0 && ms.is_finite()).map(|ms| (splats as f64, ms))
    };
    let median = |frames: &super::FrameTimes| frames.frame_ms.map(|ms| ms.median);
    let methods = rows.first().map(|row| row.methods.as_slice()).unwrap_or_default();
    let mut curves = Vec::new();
    for (i, method) in methods.iter().enumerate() {
        let own = rows.iter().filter_map(|row| Some((row.splats, median(&row.methods.get(i)?.frames))));
        let points = own.filter_map(on_axes).collect();
        curves.push(Curve { name: method.name.clone(), color: color(i), width: 2, points });
        let paper = rows
            .iter()
            .filter_map(|row| Some((row.splats, row.methods.get(i)?.paper.map(|paper| 1e3 / paper.fps))));
        let points: Vec<_> = paper.filter_map(on_axes).collect();
        if !points.is_empty() {
            let name = format!("the paper's {}", method.name.split(',').next().unwrap_or_default());
            curves.push(Curve { name, color: color(i), width: 1, points });
        }
    }
    let floor = rows.iter().map(|row| (row.splats, median(&row.floor))).filter_map(on_axes).collect();
    curves.push(Curve { name: "floor".to_owned(), color: BLACK, width: 2, points: floor });
    curves
}

/// The ends of all bars.
fn ends(rows: &[ThroughputRow]) -> impl Iterator<Item = f64> {
    let methods = rows.iter().flat_map(|row| &row.methods);
    methods.filter_map(|method| method.frames.frame_ms).flat_map(|ms| [ms.min, ms.max])
}
