//! How a frame's time and memory grow with the number of splats, and with the number of pixels.

use serde::Serialize;

use super::{
    FrameTimes, Measured, Spread,
    gate::{GateFigure, GateKind},
};

/// A frame over numbers of splats at one size, and over sizes at one number of splats.
#[derive(Clone, Debug, Serialize)]
pub struct GrowthReport {
    /// From few splats to many, each at the same size.
    pub over_splats: Vec<GrowthPoint>,
    /// From few pixels to many, each with the same splats.
    pub over_pixels: Vec<GrowthPoint>,
    /// What was left out and why, a sentence each.
    pub left_out: Vec<String>,
}

/// A number of splats at a size.
#[derive(Clone, Debug, Serialize)]
pub struct GrowthPoint {
    /// Splats drawn, or culled.
    pub splats: u64,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Each way to draw, in turn.
    pub methods: Vec<GrowthMethod>,
    /// Bytes of device memory in splats.
    pub splat_bytes: u64,
    /// The most bytes that this process had from its own allocator, beyond what it had before, from the making of the splats
    /// to their first frame. Drivers' own memory is not in it.
    pub host_peak_bytes: u64,
}

/// A way to draw.
#[derive(Clone, Debug, Serialize)]
pub struct GrowthMethod {
    /// The rasterizer.
    pub name: String,
    /// Its frames.
    pub frames: FrameTimes,
    /// Splats a second, drawn or culled, by the median of frames whose passes are not timed; `None` where not measured.
    pub splats_per_sec: Option<f64>,
    /// How many times the first one's frame its own takes, round by round.
    pub beside_first: Option<Spread>,
    /// Bytes of device memory that a frame's own images and buffers share.
    pub transient_bytes: u64,
}

impl GrowthPoint {
    /// Of ways measured in turn; each with the bytes of its frame's own images and buffers.
    pub fn of(
        (splats, size_px): (u64, [u32; 2]),
        measured: &[Measured<'_>],
        transient_bytes: &[u64],
        splat_bytes: u64,
        host_peak_bytes: u64,
    ) -> Self {
        let method = |(own, bytes): (&Measured<'_>, &u64)| {
            let frames = own.times();
            let secs = frames.frame_ms.map(|ms| 1e-3 * ms.median).filter(|secs| *secs > 0.0);
            GrowthMethod {
                name: own.name.to_owned(),
                splats_per_sec: secs.map(|secs| splats as f64 / secs),
                beside_first: measured.first().and_then(|first| own.frame_ratio(first)),
                transient_bytes: *bytes,
                frames,
            }
        };
        let methods = measured.iter().zip(transient_bytes).map(method).collect();
        Self { splats, size_px, methods, splat_bytes, host_peak_bytes }
    }

    /// Pixels of the picture.
    pub fn pixels(&self) -> u64 {
        self.size_px.map(u64::from).iter().product()
    }
}

impl GrowthMethod {
    /// The median of frames whose passes are not timed, in milliseconds.
    pub fn ms(&self) -> Option<f64> {
        self.frames.frame_ms.map(|ms| ms.median)
    }

    /// Fragments of all passes; `None` where none were counted.
    pub fn fragments(&self) -> Option<u64> {
        self.frames.passes.iter().filter_map(|pass| pass.fragments).reduce(|sum, count| sum + count)
    }

    fn vertices(&self) -> Option<u64> {
        self.frames.passes.iter().filter_map(|pass| pass.vertices).reduce(|sum, count| sum + count)
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
            let [width, height] = point.size_px;
            let place = format!("growth over {curve}, {} splats, {width}x{height}", point.splats);
            let work =
                |what: &str, count| GateFigure::count(format!("{place}, {what}"), GateKind::Work, count);
            let methods = point.methods.iter().flat_map(|method| {
                let name = |what: &str| format!("{}, {what}", method.name);
                [
                    work(&name("vertices"), method.vertices()),
                    work(&name("fragments"), method.fragments()),
                    work(&name("bytes"), Some(method.transient_bytes)),
                ]
            });
            methods.chain([work("splat bytes", Some(point.splat_bytes))]).flatten().collect::<Vec<_>>()
        };
        let splats = self.over_splats.iter().flat_map(|point| of("splats", point));
        splats.chain(self.over_pixels.iter().flat_map(|point| of("pixels", point))).collect()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::contest::tests::{measured, rounds};
    use super::*;

    /// Two rasterizers, the second half as fast again. Ten times the splats take twice as long, four times the pixels four
    /// times; six rounds, the last of which is six times slower than the first.
    pub(in crate::report) fn report() -> GrowthReport {
        let passes = ["visibility", "accumulate"].map(str::to_owned);
        let counts = [Some([10, 30]), Some([10, 40])];
        let point = |splats, side: u32, ms: f64, host| {
            let all = [rounds(&[ms, 3.0 * ms]), rounds(&[1.5 * ms, 4.5 * ms])];
            let of = |name, i: usize| measured(name, &passes, &all[i], &counts);
            let measured = [of("perspective", 0), of("raycast", 1)];
            GrowthPoint::of((splats, [side; 2]), &measured, &[2_000_000, 3_000_000], 32 * splats, host)
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
        assert_eq!(perspective.ms(), Some(28.0));
        assert_eq!(perspective.splats_per_sec, Some(10_000.0 / 28e-3));
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
}
