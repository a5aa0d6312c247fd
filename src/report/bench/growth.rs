//! How a frame's time and memory grow with the number of splats, and with the number of pixels.

use serde::Serialize;

use super::{
    Measurement,
    gate::{GateFigure, GateKind},
};
use crate::report::{
    Grid, PassFigures,
    cells::{figure, interval, median, megabytes, number},
};

/// A frame over numbers of splats at one size, and over sizes at one number of splats.
#[derive(Clone, Debug, Default, Serialize)]
pub struct GrowthReport {
    /// From few splats to many, each at the same size.
    pub over_splats: Vec<GrowthPoint>,
    /// From few pixels to many, each with the same splats.
    pub over_pixels: Vec<GrowthPoint>,
    /// Points that were left out and why, a sentence each.
    pub left_out: Vec<String>,
}

/// A number of splats at a size.
#[derive(Clone, Debug, Serialize)]
pub struct GrowthPoint {
    /// Splats drawn, or culled.
    pub splats: u64,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Each rasterizer, in turn.
    pub methods: Vec<Measurement<GrowthRate>>,
    /// Bytes of device memory in splats.
    pub splat_bytes: u64,
    /// The most bytes that this process had from its own allocator, beyond what it had before, from the making of the splats
    /// to their first frame. Drivers' own memory is not in it.
    pub host_peak_bytes: u64,
}

/// The figures of a rasterizer beside its frames.
#[derive(Clone, Debug, Default, Serialize)]
pub struct GrowthRate {
    /// Splats a second, drawn or culled, by the median of frames whose passes are not timed; `None` where not measured.
    pub splats_per_sec: Option<f64>,
}

impl GrowthPoint {
    /// The point of rasterizers measured in turn.
    pub fn of(
        (splats, size_px): (u64, [u32; 2]),
        mut methods: Vec<Measurement<GrowthRate>>,
        splat_bytes: u64,
        host_peak_bytes: u64,
    ) -> Self {
        for method in &mut methods {
            method.subject.splats_per_sec = method.fps.map(|fps| splats as f64 * fps);
        }
        Self { splats, size_px, methods, splat_bytes, host_peak_bytes }
    }

    /// Pixels of the picture.
    pub fn pixels(&self) -> u64 {
        self.size_px.map(u64::from).iter().product()
    }

    /// Width and height, as `1024x768`.
    pub(super) fn size(&self) -> String {
        let [width, height] = self.size_px;
        format!("{width}x{height}")
    }

    /// The median of a method's frames, in milliseconds.
    fn ms(&self, method: usize) -> Option<f64> {
        Some(self.methods.get(method)?.frames.frame_ms?.median)
    }
}

/// The power of what grows that time grows with, between neighbors: 0 where it does not matter, 1 where twice as much takes
/// twice as long. Of the points of one curve as (what grows, milliseconds); the first has none.
pub fn growth_powers(points: &[(u64, Option<f64>)]) -> Vec<Option<f64>> {
    let power = |pair: &[(u64, Option<f64>)]| {
        let more = (pair[1].0 as f64 / pair[0].0 as f64).ln();
        let longer = (pair[1].1? / pair[0].1?).ln();
        Some(longer / more).filter(|power| power.is_finite())
    };
    let first = (!points.is_empty()).then_some(None);
    first.into_iter().chain(points.windows(2).map(power)).collect()
}

impl GrowthReport {
    /// All points, those over splats first.
    pub fn points(&self) -> impl Iterator<Item = &GrowthPoint> {
        self.over_splats.iter().chain(&self.over_pixels)
    }

    /// The figures by which it is judged: what is counted. Times have no floor here to be judged by.
    pub fn gate(&self) -> Vec<GateFigure> {
        let of = |curve: &str, point: &GrowthPoint| {
            let place = format!("growth over {curve}, {} splats, {}", point.splats, point.size());
            let bytes = Some(point.splat_bytes);
            let bytes = GateFigure::count(format!("{place}, splat bytes"), GateKind::Work, bytes);
            let methods = point.methods.iter().flat_map(|method| method.gate(&place));
            methods.chain(bytes).collect::<Vec<_>>()
        };
        let splats = self.over_splats.iter().flat_map(|point| of("splats", point));
        splats.chain(self.over_pixels.iter().flat_map(|point| of("pixels", point))).collect()
    }

    /// Frames over splats, frames over pixels, and where their time goes.
    pub(super) fn grids(&self) -> [(&'static str, Grid); 3] {
        [
            ("growth-splats", frames_grid("growth over splats", &self.over_splats, |point| point.splats)),
            ("growth-pixels", frames_grid("growth over pixels", &self.over_pixels, GrowthPoint::pixels)),
            ("growth-passes", self.passes_grid()),
        ]
    }

    fn passes_grid(&self) -> Grid {
        let mut passes: Vec<(&GrowthPoint, &str, &PassFigures)> = Vec::new();
        for point in self.points() {
            for own in &point.methods {
                passes.extend(own.frames.passes.iter().map(|pass| (point, own.name.as_str(), pass)));
            }
        }
        Grid::of("growth: where the time goes", &passes)
            .column("splats", |(point, ..)| point.splats)
            .column("size", |(point, ..)| point.size())
            .column("rasterizer", |(_, name, _)| (*name).to_owned())
            .column("pass", |(.., pass)| pass.name.clone())
            .column("ms", |(.., pass)| median(pass.ms, 3))
            .column("min", |(.., pass)| number(pass.ms.map(|ms| ms.min), 3))
            .column("max", |(.., pass)| number(pass.ms.map(|ms| ms.max), 3))
            .column("vertices", |(.., pass)| figure(pass.vertices))
            .column("fragments", |(.., pass)| figure(pass.fragments))
            .grid()
    }
}

/// A row for each point and method.
fn frames_grid(title: &str, points: &[GrowthPoint], grows: fn(&GrowthPoint) -> u64) -> Grid {
    let methods = points.iter().map(|point| point.methods.len()).max().unwrap_or(0);
    let curve = |i: usize| points.iter().map(|point| (grows(point), point.ms(i))).collect::<Vec<_>>();
    let powers: Vec<Vec<Option<f64>>> = (0..methods).map(|i| growth_powers(&curve(i))).collect();
    let mut rows: Vec<(&GrowthPoint, &Measurement<GrowthRate>, Option<f64>)> = Vec::new();
    for (at, point) in points.iter().enumerate() {
        rows.extend(point.methods.iter().zip(&powers).map(|(own, powers)| (point, own, powers[at])));
    }
    Grid::of(title, &rows)
        .column("splats", |(point, ..)| point.splats)
        .column("size", |(point, ..)| point.size())
        .column("rasterizer", |(_, own, _)| own.name.clone())
        .column("ms", |(_, own, _)| median(own.frames.frame_ms, 3))
        .column("95% of the median", |(_, own, _)| interval(own.frames.frame_ms, 3))
        .column("power", |(.., power)| number(*power, 2))
        .column("x first", |(_, own, _)| median(own.beside_first, 3))
        .column("M splats/s", |(_, own, _)| number(own.subject.splats_per_sec.map(|rate| 1e-6 * rate), 2))
        .column("fragments", |(_, own, _)| figure(own.fragments()))
        .column("splats MB", |(point, ..)| megabytes(point.splat_bytes))
        .column("frame MB", |(_, own, _)| megabytes(own.transient_bytes))
        .column("host MB", |(point, ..)| megabytes(point.host_peak_bytes))
        .note(
            "medians, of frames whose passes are not timed; power: of what grows, from the row before: 1 where twice as much \
             takes twice as long; x first: the median of the rounds' own ratios to the first rasterizer; MB: device memory of \
             splats and of a frame, and the most of this process's own from the making of the splats to their first frame",
        )
        .grid()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::report::{Spread, timed::tests::timed};

    /// Two rasterizers, the second half as fast again. Ten times the splats take twice as long, four times the pixels four
    /// times; six rounds, the last of which is six times slower than the first.
    pub(crate) fn report() -> GrowthReport {
        let counts = [Some([10, 30]), Some([10, 40])];
        let point = |splats, side: u32, ms: f64, host| {
            let of = |name: &str, ms: f64, bytes| {
                let passes = ["visibility", "accumulate"];
                (name.to_owned(), GrowthRate::default(), timed(&passes, &[ms, 3.0 * ms], &counts, bytes))
            };
            let both = vec![of("perspective", ms, 2_000_000), of("raycast", 1.5 * ms, 3_000_000)];
            GrowthPoint::of((splats, [side; 2]), Measurement::all(both, None), 32 * splats, host)
        };
        GrowthReport {
            over_splats: vec![point(1000, 64, 1.0, 500_000), point(10_000, 64, 2.0, 5_000_000)],
            over_pixels: vec![point(1000, 64, 1.0, 500_000), point(1000, 128, 4.0, 600_000)],
            left_out: vec!["5000000 splats: no memory".to_owned()],
        }
    }

    #[test]
    fn a_point_has_rates_ratios_and_counts() {
        let report = report();
        let [perspective, raycast] = report.over_splats[1].methods.as_slice() else { panic!("two") };
        // 8 ms in the first round, 48 in the last.
        assert_eq!(report.over_splats[1].ms(0), Some(28.0));
        assert_eq!(perspective.subject.splats_per_sec, Some(10_000.0 * (1e3 / 28.0)));
        assert_eq!((perspective.fragments(), perspective.vertices()), (Some(70), Some(20)));
        assert_eq!(raycast.beside_first, Spread::of([1.5; 6]));
        assert_eq!(report.over_pixels[1].pixels(), 128 * 128);
        assert_eq!(report.points().count(), 4);
    }

    #[test]
    fn powers_tell_how_time_grows() {
        let powers = growth_powers(&[(10, Some(1.0)), (20, Some(2.0)), (40, Some(2.0)), (80, None)]);
        assert_eq!(powers, [None, Some(1.0), Some(0.0), None]);
        // Twice the same has no power.
        assert_eq!(growth_powers(&[(10, Some(1.0)), (10, Some(1.0))]), [None, None]);
        assert_eq!(growth_powers(&[]), Vec::<Option<f64>>::new());
    }

    #[test]
    fn the_gate_has_each_figure_once() {
        let gate = report().gate();
        let mut names: Vec<&str> = gate.iter().map(|figure| figure.name.as_str()).collect();
        // Four points, two methods of three figures, and the splats.
        assert_eq!(names.len(), 4 * 7);
        assert_eq!(names[1], "growth over splats, 1000 splats, 64x64, perspective, fragments");
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), 4 * 7);
    }

    #[test]
    fn the_tables_have_a_row_for_each_point_and_method() {
        let [(_, splats), (_, pixels), (_, passes)] = report().grids();
        // 8 ms in the first round, 48 in the last; the interval of 12 frames leaves two at each end out.
        let frames = ["10000", "64x64", "perspective", "28.000", "16.000 to 40.000", "0.30", "1.000"];
        assert_eq!(splats.rows[2][..7], frames);
        assert_eq!(splats.rows[2][7..], ["0.36", "70", "0.3", "2.0", "5.0"]);
        assert_eq!((splats.rows[3][5].as_str(), splats.rows[3][6].as_str()), ("0.30", "1.500"));
        // Four times the pixels take four times as long.
        assert_eq!((pixels.rows[2][5].as_str(), pixels.rows[2][11].as_str()), ("1.00", "0.6"));
        assert_eq!(passes.rows.len(), 4 * 2 * 2);
    }
}
