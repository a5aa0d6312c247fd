use ash::vk;

use super::{rows::all_of, *};

fn limits() -> Limits {
    Limits { max_storage_buffer_range: 1 << 27, max_texels: 1 << 27, ..Limits::plain() }
}

fn plan(boxes: &[(u32, f64)], size_px: [u32; 2]) -> Option<TilePlan> {
    plan_of(boxes, size_px, Invocations::Columns)
}

fn plan_of(boxes: &[(u32, f64)], size_px: [u32; 2], invocations: Invocations) -> Option<TilePlan> {
    TilePlan::of_boxes(1, boxes.iter().copied(), all_of(size_px), &limits(), invocations)
}

const HEIGHTS: [Invocations; 2] = [Invocations::Columns, Invocations::ShortColumns];

#[test]
fn no_walk_exceeds_the_iterations_and_no_buffer_the_range() {
    for count in [1, 7, 1000, 154_000, 1_400_000, 5_000_000, 8_388_608] {
        for px in [3.0, 11.0, 40.0, 500.0, f64::INFINITY] {
            let sizes = [[1, 1], [1024, 1024], [4096, 4096], [8192, 8192]];
            let every = [Invocations::Columns, Invocations::ShortColumns, Invocations::Pixels];
            let of_all = sizes.map(|size_px| every.map(|of| (size_px, of)));
            let largest = ([16_384, 8192], Invocations::Columns);
            for (size_px, invocations) in of_all.into_iter().flatten().chain([largest]) {
                let plan = plan_of(&[(count, px)], size_px, invocations).unwrap();
                assert!(plan.round_length * plan.most_tiles <= MOST_ITERATIONS, "{plan:?}");
                assert!(plan.round_length > 0 && plan.most_tiles > 0, "{plan:?}");
                assert!(plan.segments * plan.segment_length >= plan.record_count, "{plan:?}");
                assert_eq!(plan.segment_length % SEGMENT_BLOCK, 0);
                assert!(plan.entry_room * 4 <= 1 << 27 && plan.entry_room >= u64::from(count), "{plan:?}");
                assert!(plan.count_bytes() <= 1 << 27, "{plan:?}");
                assert!(plan.walk_length / 8 * 2 < 65_535, "{plan:?}");
            }
        }
    }
}

#[test]
fn workgroups_walk_over_pieces_of_segments_as_far_as_memory_allows() {
    let pieces = |size_px, of| plan_of(&[(1000, 3.0)], size_px, of).unwrap().pieces;
    assert_eq!(pieces([1024, 1024], Invocations::Pixels), 4);
    assert_eq!(pieces([4096, 4096], Invocations::Pixels), 1);
    assert_eq!(pieces([1024, 1024], Invocations::Columns), 1);
    let whole = plan_of(&[(1000, 3.0)], [1024, 1024], Invocations::Pixels).unwrap();
    assert_eq!((whole.walks(), whole.count_bytes()), (4 * whole.segments, 4 * whole.bytes_of_counts(1)));
}

#[test]
fn both_lists_of_a_tile_are_counted_in_one_word_where_each_has_room_in_half_of_it() {
    let counts = |count, of, planes| {
        let plan = plan_of(&[(count, 3.0)], [1024, 1024], of).unwrap();
        let plan = plan.cut_by(false, planes, &limits()).unwrap();
        assert_eq!(plan.count_bytes(), u64::from(plan.count_bins() * plan.walks()) * 4);
        (plan.count_bins() - plan.chunk_count) / plan.tile_count
    };
    assert_eq!(counts(65_535, Invocations::Columns, true), 1);
    assert_eq!(counts(65_536, Invocations::Columns, true), 2);
    assert_eq!(counts(100, Invocations::Pixels, true), 2);
    assert_eq!(counts(100, Invocations::Columns, false), 1);
}

#[test]
fn splats_that_are_small_for_sure_leave_nothing_to_the_graphics_pipeline() {
    let small = plan(&[(154_000, 40.0)], [1024, 1024]).unwrap();
    assert!(!small.may_be_large && small.most_tiles == 36, "{small:?}");
    // 64 each are more than there is room for, but few have them.
    assert!(plan(&[(270_000, 57.0)], [1024, 1024]).unwrap().may_be_large);
    // A larger image has larger splats, and room for them.
    assert!(!plan(&[(300_000, 60.0)], [4096, 4096]).unwrap().may_be_large);
    assert!(plan(&[(300_000, 60.0)], [1024, 1024]).unwrap().may_be_large);
    let mixed = plan(&[(150_000, 20.0), (4000, 57.0)], [1024, 1024]).unwrap();
    assert!(!mixed.may_be_large && mixed.most_tiles == 64, "{mixed:?}");
    assert_eq!(mixed.entry_room, 150_000 * 16 + 4000 * 64);
    assert!(plan(&[(10, 3.0), (10, f64::INFINITY)], [1024, 1024]).unwrap().may_be_large);
    // Too many for lists of 9 tiles each.
    assert!(plan(&[(5_000_000, 12.0)], [1024, 1024]).unwrap().may_be_large);
}

#[test]
fn no_run_of_pixels_touches_more_tiles_than_its_box_says() {
    for pixels in 1..100_u32 {
        // A box of so many pixels: 1.5 of it are for rounding.
        let along =
            |side: u32| u64::from((0..side).map(|first| (first + pixels - 1) / side + 1).max().unwrap());
        for box_px in [f64::from(pixels) + 1.5, f64::from(pixels) + 2.4] {
            for (invocations, most) in HEIGHTS.into_iter().zip([along(8) * along(8), along(8) * along(4)]) {
                let in_image = |along| ImageTiles { along, invocations }.of(box_px);
                assert_eq!(in_image([1000; 2]), most, "{pixels} {box_px}");
                assert!(in_image([3, 1000]) <= most && in_image([3, 2]) <= 6, "{pixels} {box_px}");
            }
        }
    }
    let image = ImageTiles { along: [5, 7], invocations: Invocations::ShortColumns };
    assert_eq!(image.of(f64::INFINITY), 35);
}

#[test]
fn spans_have_bits_for_every_place_of_the_image_and_for_splats_as_large_as_that_leaves() {
    for (side_px, a_side) in
        [(2048, 192), (2049, 96), (4096, 96), (4097, 48), (8193, 24), (16_385, 12), (32_769, 6), (65_536, 6)]
    {
        let plan = |px| plan(&[(10, px)], [side_px, 100]).unwrap();
        let largest = f64::from(8 * a_side - 5);
        assert!(!plan(largest).may_be_large && plan(largest + 1.0).may_be_large, "{side_px}");
    }
    // Of tiles half as high, twice as many lie above each other.
    for (height_px, a_side) in [(1024, 192), (1025, 96), (2049, 48), (4097, 24), (16_385, 6), (32_768, 6)] {
        let plan = |px| plan_of(&[(10, px)], [100, height_px], Invocations::ShortColumns).unwrap();
        let largest = f64::from(4 * a_side - 1);
        assert!(!plan(largest).may_be_large && plan(largest + 1.0).may_be_large, "{height_px}");
    }
    // Of all of an image there are no more.
    for (size_px, invocations) in
        [([1536, 1536], Invocations::Columns), ([1536, 768], Invocations::ShortColumns)]
    {
        let plan = |px| plan_of(&[(10, px)], size_px, invocations).unwrap();
        assert!(!plan(1e9).may_be_large && plan(f64::INFINITY).may_be_large, "{size_px:?}");
    }
}

#[test]
fn what_has_no_room_has_no_plan() {
    assert_eq!(plan(&[], [64, 64]), None);
    assert_eq!(plan(&[(8_388_609, 3.0)], [64, 64]), None);
    assert_eq!(plan(&[(10, 3.0)], [65_536, 65_536]), None);
    // Counts of twice as many tiles.
    assert_eq!(plan_of(&[(10, 3.0)], [16_384, 8192], Invocations::ShortColumns), None);
    assert_eq!(
        TilePlan::of_boxes(
            8192,
            std::iter::once((8192, 3.0)),
            all_of([64, 64]),
            &limits(),
            Invocations::Columns
        ),
        None
    );
}

#[test]
fn lists_that_are_fetched_have_no_more_texels_than_the_device() {
    let limits = Limits { max_storage_buffer_range: 1 << 30, max_texels: 1 << 24, ..limits() };
    let plan = |(count, px), invocations| {
        TilePlan::of_boxes(1, std::iter::once((count, px)), all_of([4096, 4096]), &limits, invocations)
    };
    for boxes in [(10_000, 500.0), (1_000_000, 100.0), (4_000_000, 12.0), (1 << 24, 12.0)] {
        let fetched = plan(boxes, Invocations::Columns).unwrap();
        assert!(fetched.entry_room.max(fetched.record_room) <= 1 << 24, "{fetched:?}");
        // Words of a storage buffer are not.
        assert!(plan(boxes, Invocations::Pixels).unwrap().entry_room > 1 << 24, "{boxes:?}");
    }
    assert_eq!(plan(((1 << 24) + 1, 3.0), Invocations::Columns), None);
}

#[test]
fn rows_of_bands_are_one_row_of_tiles_or_two() {
    for (invocations, rows_of_tiles) in [(Invocations::Columns, 3), (Invocations::ShortColumns, 6)] {
        let whole = plan_of(&[(10, 3.0)], [100, 20], invocations).unwrap();
        assert_eq!((whole.rows.clone(), whole.tile_count), (0..3, 13 * rows_of_tiles));
        let band = whole.clone().within(1..3);
        assert_eq!(band.tile_count, 13 * rows_of_tiles / 3 * 2);
        assert_eq!(band.first_tile() + band.tile_count, whole.tile_count);
        let image = vk::Extent2D { width: 100, height: 20 };
        assert_eq!((band.area(image).offset.y, band.area(image).extent.height), (8, 12));
    }
}

#[test]
fn bands_agree_on_what_they_have_in_common() {
    let bands =
        [(9000, 3.0), (1_000_000, 3.0), (20_000, f64::INFINITY)].map(|of| plan(&[of], [1024, 1024]).unwrap());
    assert!(!bands[0].may_overflow() && bands[1].may_overflow() && bands[2].may_be_large);
    let among = bands.each_ref().map(|band| band.with_common_capacity(&bands));
    for (band, alone) in among.iter().zip(&bands) {
        assert!(band.may_overflow() && band.may_be_large, "{band:?}");
        assert_eq!([band.record_room, band.entry_room], [among[0].record_room, among[0].entry_room]);
        assert!(band.bytes() >= alone.bytes() && band.record_count == alone.record_count, "{band:?}");
    }
    // Splats that no box bounds beside many others, and beside few: what a few could have, all have no room for.
    for boxes in [
        [vec![(1000, f64::INFINITY), (399_000, 3.0)], vec![(1000, f64::INFINITY), (3000, 3.0)]],
        [vec![(100_000, 60.0)], vec![(100, 100.0)]],
        [vec![(150_000, 20.0)], vec![(4000, 57.0)]],
    ] {
        let bands = boxes.each_ref().map(|boxes| plan(boxes, [1024, 1024]).unwrap());
        for (of, boxes) in bands.each_ref().map(|band| band.with_common_capacity(&bands)).iter().zip(&boxes) {
            assert!(of.round_length * of.most_tiles <= MOST_ITERATIONS && of.round_length > 0, "{of:?}");
            assert!(of.segments * of.segment_length >= of.record_count, "{of:?}");
            let entries = |(count, px): &(u32, f64)| {
                u64::from(*count) * of.image_tiles().of(*px).min(of.most_tiles.into())
            };
            assert!(boxes.iter().map(entries).sum::<u64>() <= of.entry_room, "{of:?}");
            let fits = |px: f64| px.is_finite() && of.image_tiles().of(px) <= of.most_tiles.into();
            let all_fit = boxes.iter().all(|(_, px)| fits(*px));
            assert!(all_fit || of.may_be_large, "{of:?}");
        }
    }
}

/// Nodes of levels of detail, as long as a block's longest for all that is known.
#[test]
fn tiles_are_higher_where_lists_of_low_ones_have_no_room() {
    let of = |px| move |invocations| plan_of(&[(2_000_000, px)], [1024, 1024], invocations);
    let [short, high] = [Invocations::ShortColumns, Invocations::Columns];
    assert!(of(20.0)(short).unwrap().may_be_large && !of(20.0)(high).unwrap().may_be_large);
    let found = |px, may_be_high| TilePlan::with_room(of(px), short, may_be_high).unwrap();
    assert_eq!(found(20.0, true), of(20.0)(high).unwrap());
    // Named tiles stay; so do those that have room, and where no tiles have.
    assert_eq!(found(20.0, false), of(20.0)(short).unwrap());
    for px in [8.0, 60.0] {
        assert_eq!(found(px, true), of(px)(short).unwrap());
    }
}
