//! The tables of how frames grow.

use super::{
    GrowthPoint, GrowthReport,
    contest::interval_cell,
    grid::{Grid, cell, count_cell},
    growth::growth_powers,
};

/// What is the same in both tables of frames.
const HEAD: [&str; 12] = [
    "splats",
    "size",
    "rasterizer",
    "ms",
    "95% of the median",
    "power",
    "x first",
    "M splats/s",
    "fragments",
    "splats MB",
    "frame MB",
    "host MB",
];

impl GrowthReport {
    /// Frames over splats, frames over pixels, and where their time goes.
    pub fn grids(&self) -> Vec<Grid> {
        let mut grids = vec![
            frames_grid("growth over splats", &self.over_splats, |point| point.splats),
            frames_grid("growth over pixels", &self.over_pixels, GrowthPoint::pixels),
            self.passes_grid(),
        ];
        // A curve may be left out; the flags say why.
        grids.retain(|grid| !grid.rows.is_empty());
        grids
    }

    fn passes_grid(&self) -> Grid {
        let head = ["splats", "size", "rasterizer", "pass", "ms", "min", "max", "vertices", "fragments"];
        let mut grid = Grid::new("growth: where the time goes", &head);
        for point in self.points() {
            for method in &point.methods {
                for pass in &method.frames.passes {
                    grid.row([
                        point.splats.to_string(),
                        size_cell(point),
                        method.name.clone(),
                        pass.name.clone(),
                        cell(pass.ms.map(|ms| ms.median), 3),
                        cell(pass.ms.map(|ms| ms.min), 3),
                        cell(pass.ms.map(|ms| ms.max), 3),
                        count_cell(pass.vertices),
                        count_cell(pass.fragments),
                    ]);
                }
            }
        }
        grid
    }
}

/// A row for each point and method.
fn frames_grid(title: &str, points: &[GrowthPoint], grows: fn(&GrowthPoint) -> u64) -> Grid {
    let mut grid = Grid::new(title, &HEAD);
    let methods = points.iter().map(|point| point.methods.len()).max().unwrap_or(0);
    let powers: Vec<Vec<Option<f64>>> = (0..methods)
        .map(|i| {
            let ms = |point: &GrowthPoint| point.methods.get(i).and_then(super::GrowthMethod::ms);
            growth_powers(&points.iter().map(|point| (grows(point), ms(point))).collect::<Vec<_>>())
        })
        .collect();
    let mega = |bytes: u64| format!("{:.1}", 1e-6 * bytes as f64);
    for (at, point) in points.iter().enumerate() {
        for (method, powers) in point.methods.iter().zip(&powers) {
            let ms = method.frames.frame_ms;
            grid.row([
                point.splats.to_string(),
                size_cell(point),
                method.name.clone(),
                cell(method.ms(), 3),
                interval_cell(ms.as_ref(), 3),
                cell(powers[at], 2),
                cell(method.beside_first.map(|ratio| ratio.median), 3),
                cell(method.splats_per_sec.map(|rate| 1e-6 * rate), 2),
                count_cell(method.fragments()),
                mega(point.splat_bytes),
                mega(method.transient_bytes),
                mega(point.host_peak_bytes),
            ]);
        }
    }
    grid.notes.push(
        "medians, of frames whose passes are not timed; power: of what grows, from the row before: 1 where twice as much takes twice as long; x first: the median \
         of the rounds' own ratios to the first rasterizer; MB: device memory of splats and of a frame, and the most of this \
         process's own from the making of the splats to their first frame"
            .to_owned(),
    );
    grid
}

fn size_cell(point: &GrowthPoint) -> String {
    let [width, height] = point.size_px;
    format!("{width}x{height}")
}

#[cfg(test)]
mod tests {
    use super::super::growth::tests::report;

    #[test]
    fn the_tables_have_a_row_for_each_point_and_method() {
        let grids = report().grids();
        let [splats, pixels, passes] = grids.as_slice() else { panic!("three tables") };
        // 8 ms in the first round, 48 in the last; the interval of 12 frames leaves two at each end out.
        let expected = [
            "10000",
            "64x64",
            "perspective",
            "28.000",
            "16.000 to 40.000",
            "0.30",
            "1.000",
            "0.36",
            "70",
            "0.3",
            "2.0",
            "5.0",
        ];
        assert_eq!(splats.rows[2], expected);
        assert_eq!((splats.rows[3][5].as_str(), splats.rows[3][6].as_str()), ("0.30", "1.500"));
        // Four times the pixels take four times as long.
        assert_eq!((pixels.rows[2][5].as_str(), pixels.rows[2][11].as_str()), ("1.00", "0.6"));
        assert_eq!(passes.rows.len(), 4 * 2 * 2);
    }
}
