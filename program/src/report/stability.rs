//! The tables of numerical stability. A test measures and writes them (`tests/gpu/stability`); here they are shown.

use surfel::{Result, report::Grid, selftest::STABILITY_TABLES};

use super::{
    part::{Block, Part},
    session::Session,
};
use crate::json::to_value;

/// The tables, as the test has written them.
fn grids() -> Vec<Grid> {
    serde_json::from_str(STABILITY_TABLES).unwrap_or_default()
}

/// The columns in words.
const COLUMNS: [&str; 5] = [
    "A row is the worst of all splats with that value. `naive`: the textbook's formulas on the same numbers; `-`: they give no \
     number.",
    "`box too small`, `box too large`: how far a side of the bounding box is from the true one, in pixels. 1/256 pixel may be \
     missing, boxes are enlarged by that; too large costs time only.",
    "`(u, v)`: the error of the place within the splat, in radii. `of allowed`: as a part of what no missing fragment may exceed.",
    "`pixels`: those whose coverage is decided by that margin; of them `missed`, and `surplus` ones outside.",
    "Tilt, offset and near plane take turns with every radius; half of the splats are disks, half ellipses.",
];

/// Gathers the part.
pub fn gather(_: &mut Session<'_>) -> Result<Part> {
    let grids = grids();
    let text = "Single splats, set up in f32 on the device as the renderer sets them up, against f64. These tables are not of this \
         run: a test of the sources measured them on lavapipe (llvmpipe, Mesa 22.3.6), and holds every device that it runs on \
         to their bounds: `SURFEL_UPDATE_TABLES=1 cargo test --release --test gpu stability` writes them anew.";
    let (finding, csvs) = (finding(&grids), grids.iter().map(Grid::csv).collect::<Vec<_>>());
    let mut blocks = vec![Block::Text(text.to_owned()), Block::List(COLUMNS.map(str::to_owned).to_vec())];
    blocks.extend(grids.into_iter().map(|grid| Block::Table(grid, Vec::new())));
    Ok(Part { finding, blocks, data: to_value(&csvs)?, ..Part::default() })
}

/// Whether the device has missed any pixel.
fn finding(grids: &[Grid]) -> String {
    let sum = |grids: &[Grid], name: &str| -> u64 {
        let cells = grids.iter().flat_map(|grid| {
            let column = grid.head.iter().position(|head| head == name);
            grid.rows.iter().filter_map(move |row| row.get(column?)?.parse::<u64>().ok())
        });
        cells.sum()
    };
    format!(
        "Of {} decided pixels {} are missed and {} are surplus, at radii from a millionth of the distance to a hundred \
         times it; the textbook's formulas lose the splat.",
        // The same splats are in several tables.
        sum(&grids[..grids.len().min(1)], "pixels"),
        sum(grids, "missed"),
        sum(grids, "surplus")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_committed_tables_are_found_whole_with_the_device_that_is_named() {
        let grids = grids();
        assert_eq!(grids.len(), 5);
        for grid in &grids {
            assert_eq!(grid.head.len(), 12, "{}", grid.title);
            assert!(grid.rows.len() >= 4 && grid.rows.iter().all(|row| row.len() == 12), "{}", grid.title);
        }
        assert_eq!(grids[1].title, "By tilt, degrees");
        assert!(
            finding(&grids).contains(" decided pixels 0 are missed and 0 are surplus"),
            "{}",
            finding(&grids)
        );
        let page = include_str!("../../../tests/gpu/stability/README.md");
        assert!(page.contains("lavapipe's (llvmpipe, Mesa 22.3.6)"));
        assert!(grids.iter().all(|grid| page.contains(&grid.markdown())));
    }
}
