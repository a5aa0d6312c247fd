//! Polygons near the eye, splats far from it (Guennebaud, Barthe, Paulin 2006, section 5.2): a mesh by distance, beside all of it as polygons, and as splats in
//! levels of detail.

use serde::Serialize;

use super::{LevelError, Measurement, gate::GateFigure};
use crate::report::{
    Grid,
    cells::{interval, median, number},
};

/// `bench hybrid`.
#[derive(Clone, Debug, Serialize)]
pub struct HybridReport {
    /// The model.
    pub model: String,
    /// Its triangles.
    pub triangles: u64,
    /// The splats that take their place.
    pub splats: u64,
    /// Each distance or zoom, from afar to near.
    pub views: Vec<HybridView>,
}

/// How a view is drawn.
#[derive(Clone, Debug, Serialize)]
pub struct HybridView {
    /// How large the model is, over a view that it fills.
    pub zoom: f64,
    /// Polygons, the hybrid and splats, timed in turn.
    pub ways: Vec<Measurement<HybridWay>>,
}

/// What a way to draw leaves.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct HybridWay {
    /// Splats that are set up: those that may be seen.
    pub splats: u64,
    /// Against polygons of many samples a pixel.
    pub error: LevelError,
}

impl HybridReport {
    /// The figures by which it is judged: what is counted.
    pub fn gate(&self) -> Vec<GateFigure> {
        let of = |(view, own): (&HybridView, &Measurement<HybridWay>)| {
            let name = format!("hybrid, zoom {}, {}, splats", view.zoom, own.name);
            GateFigure::count(name, super::gate::GateKind::Work, Some(own.subject.splats))
        };
        self.rows().filter_map(of).collect()
    }

    fn rows(&self) -> impl Iterator<Item = (&HybridView, &Measurement<HybridWay>)> {
        self.views.iter().flat_map(|view| view.ways.iter().map(move |own| (view, own)))
    }

    /// The table.
    pub fn grid(&self) -> Grid {
        let rows: Vec<_> = self.rows().collect();
        let title = format!(
            "polygons near, splats far: {}, {} triangles, {} splats",
            self.model, self.triangles, self.splats
        );
        Grid::of(title, &rows)
            .column("zoom", |(view, _)| view.zoom)
            .column("drawn as", |(_, own)| own.name.clone())
            .column("splats", |(_, own)| own.subject.splats)
            .column("frame ms", |(_, own)| median(own.frames.frame_ms, 2))
            .column("95% of the median", |(_, own)| interval(own.frames.frame_ms, 2))
            .column("x polygons", |(_, own)| median(own.beside_first, 3))
            .column("RMS", |(_, own)| number(Some(own.subject.error.rms), 2))
            .column("FLIP", |(_, own)| number(Some(own.subject.error.flip), 2))
            .column("silhouette px", |(_, own)| own.subject.error.silhouette_px)
            .note(
                "zoom: from afar below 1, of a narrower view above; splats: those that may be seen; x polygons: of each round; RMS, FLIP: against polygons of 64 samples a pixel over \
                 white, means over covered pixels, in 255ths; silhouette: covered by half in one only",
            )
            .grid()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::timed::tests::timed;

    #[test]
    fn each_view_is_set_beside_its_own_polygons() {
        let way = |name: &str, splats, ms| {
            let way = HybridWay { splats, error: LevelError::default() };
            (name.to_owned(), way, timed(&["polygons"], &[ms], &[], 1000))
        };
        let view = |zoom, ms| HybridView {
            zoom,
            ways: Measurement::all(vec![way("polygons", 0, 4.0), way("hybrid", 7, ms)], None),
        };
        let report = HybridReport {
            model: "ball".to_owned(),
            triangles: 20,
            splats: 9,
            views: vec![view(0.5, 1.0), view(1.0, 8.0)],
        };
        let grid = report.grid();
        let column = |i: usize| grid.rows.iter().map(|row| row[i].as_str()).collect::<Vec<_>>();
        assert_eq!(column(0), ["0.5", "0.5", "1", "1"]);
        assert_eq!(column(5), ["1.000", "0.250", "1.000", "2.000"]);
        assert_eq!(report.gate().len(), 4);
    }
}
