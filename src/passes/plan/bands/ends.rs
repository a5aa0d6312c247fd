//! Where bands are to end, known before their blocks are looked at closely: there it matters in which rows they are.

use std::ops::Range;

use super::MOST_BANDS;
use crate::{
    arena::Arena,
    passes::plan::{seen::PotentiallyVisibleBlocks, tiles::TilePlan},
};

/// How many bands of what `whole` would draw at once are likely to take no more than so many bytes each, a sixteenth of them for blocks that two of them have.
pub(crate) fn likely_bands(whole: &TilePlan, most_bytes: u64) -> u64 {
    (whole.bytes() * 17 / 16).div_ceil(most_bytes.max(1)).min(MOST_BANDS as u64)
}

/// The rows at which so many bands of what `whole` would draw at once are likely to end, if all take as much.
pub(crate) fn likely_ends<'m>(
    arena: &'m Arena,
    seen: &PotentiallyVisibleBlocks<'_>,
    whole: &TilePlan,
    bands: u64,
) -> &'m [u32] {
    let Some(rows) = seen.rows() else { return &[] };
    let bands = bands.min(MOST_BANDS as u64);
    let costs = seen.costs(arena, |box_px| whole.bytes_of_one(box_px));
    // Of blocks that have begun and not ended a half is before a row.
    let before = |row: u32| {
        let [begun, ended] = costs[row as usize];
        (begun + ended) / 2 + of_tiles(whole, rows.start..row)
    };
    let all = before(rows.end);
    let (mut ends, mut row) = (arena.growing(), rows.start);
    for band in 1..bands {
        while row < rows.end && before(row) * bands < all * band {
            row += 1;
        }
        if ends.last().map_or(rows.start, |end| *end) < row && row < rows.end {
            ends.push(row);
        }
    }
    ends.into_bump_slice()
}

/// About what the largest of the bands takes that end at these rows.
pub(crate) fn largest_of(
    arena: &Arena,
    seen: &PotentiallyVisibleBlocks<'_>,
    whole: &TilePlan,
    ends: &[u32],
) -> u64 {
    let Some(rows) = seen.rows() else { return 0 };
    let costs = seen.costs(arena, |box_px| whole.bytes_of_one(box_px));
    let mut begin = rows.start;
    let of_bands = ends.iter().chain([&rows.end]).map(|end| {
        let band = std::mem::replace(&mut begin, *end)..*end;
        cost_of_rows(whole, costs, band)
    });
    of_bands.max().unwrap_or(0)
}

/// The part that some rows have of what there is of each tile, whatever splats it has; segments of a band have one piece.
fn of_tiles(whole: &TilePlan, rows: Range<u32>) -> u64 {
    whole.bytes_of_bins(1) * rows.len() as u64 / whole.rows.len().max(1) as u64
}

/// About what these rows take: records, entries, and their share of the tiles.
pub(super) fn cost_of_rows(whole: &TilePlan, costs: &[[u64; 2]], rows: Range<u32>) -> u64 {
    let of_tiles = of_tiles(whole, rows.clone());
    let [end, start] = [rows.end, rows.start].map(|row| costs[row as usize]);
    end[0] - start[1] + of_tiles
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;
    use crate::{
        math::random::SplitMix,
        passes::plan::{FramePlan, bands::most_bytes, tiles::rows::Drawn},
        prepare::{Placed, prepare_without_device},
        scene::{Camera, Colors, Object, Rasterizer, Scene, Settings, Shapes, Splats, TileMemory},
        vk::Limits,
    };

    /// A ball all of which is drawn: no more bands than its lists need, or one more, of about the same size, and most blocks are not told apart for it.
    #[test]
    fn bands_are_few_and_alike_and_blocks_are_looked_at_where_they_end() {
        const COUNT: usize = 300_000;
        let mut random = SplitMix(5);
        let mut side = || 2.0 * random.unit() - 1.0;
        let mut normal = || loop {
            let v = DVec3::new(side(), side(), side());
            if (0.1..1.0).contains(&v.length()) {
                return v.normalize();
            }
        };
        let positions: Vec<_> = (0..COUNT).map(|_| normal()).collect();
        let normals: Vec<Vec3> = positions.iter().map(|at: &DVec3| at.as_vec3()).collect();
        let shapes = Shapes::Disks { normals, radii: vec![0.006; COUNT] };
        let splats = Splats::new(positions, shapes, Colors::Uniform([1.0; 4]));
        let objects = vec![Object { name: "ball".to_owned(), splats, closed: false }];
        let limits = Limits::plain();
        let ball = prepare_without_device(&limits, &Scene { objects, ..Scene::default() }).expect("a ball");
        let camera = Camera { eye: DVec3::new(0.3, 0.5, 4.0), ..Camera::default() };
        for megabytes in [12, 15, 20] {
            let settings = Settings {
                size_px: [1024; 2],
                rasterizer: Rasterizer::Compute,
                tile_memory: TileMemory::Most(megabytes * 1_000_000),
                ..Settings::default()
            };
            let arena = Arena::new();
            let plan = FramePlan::new(&arena, &[Placed::at_home(&ball)], &camera, &settings, &limits);
            let bands = plan.opaque.bands();
            let all = TilePlan::of(Drawn::new(&arena, plan.opaque.splats), false, &settings, &limits)
                .expect("room")
                .bytes();
            let most = most_bytes(plan.opaque.splats, settings.tile_memory);
            let of_bands: Vec<u64> = bands.iter().map(|band| band.plan.bytes()).collect();
            let records: Vec<u32> = bands.iter().map(|band| band.plan.record_count).collect();
            let sum: u32 = records.iter().sum();
            println!("{megabytes} of {all}: {of_bands:?}, {records:?}");
            assert!(of_bands.iter().all(|bytes| *bytes <= most), "{of_bands:?} of {most}");
            assert!(bands.len() as u64 <= all.div_ceil(most) + 1, "{of_bands:?} of {all}");
            assert!(sum as usize * 5 < COUNT * 8, "{records:?}");
        }
    }
}
