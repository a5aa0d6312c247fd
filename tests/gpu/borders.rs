//! Splats at borders reach further than their rims, as far as a filtered border goes on: GPU against the oracle, and both against what there is.

use glam::DVec3;
use surfel::{
    hard_scenes::{Hard, sphere},
    scene::{ClipBox, Edges, Kernel, Settings, TileInvocations},
    selftest::{light::compare_light, tolerance::LIGHT},
};

use crate::{
    common::{
        PICTURE, builder, oracle_of, passes, render_as, shared,
        sheets::{covering, sheet},
        with,
    },
    edges::against_the_truth,
};

/// Two sheets, one before a part of the other, of splats of this size.
fn two_sheets(along: i32, radius: f64, ellipses: bool) -> Hard {
    let behind = DVec3::new(0.3, 0.2, -0.8);
    covering(vec![sheet(along, radius, DVec3::ZERO, ellipses), sheet(along, radius, behind, ellipses)])
}

#[test]
fn sheets_agree_with_the_oracle_by_size_kernel_camera_and_tile() {
    let changes: [fn(&mut Settings); 5] = [
        |_| (),
        |settings| settings.kernel = Kernel::PsiE { a: 6.0, b: 1.5, n: 3.0 },
        |settings| settings.tile_invocations = TileInvocations::Pixel,
        |settings| settings.tile_invocations = TileInvocations::ShortColumn,
        |settings| settings.clip_box = ClipBox(Some([[-0.45, -0.9, -1.0], [0.9, 0.35, 0.9]])),
    ];
    let mut cases: Vec<Hard> = changes.map(|change| with(&two_sheets(12, 0.1, false), change)).into();
    // Down to where none reaches, and up to what a few cover.
    cases
        .extend([(100, 0.012), (40, 0.03), (5, 0.3)].map(|(along, radius)| two_sheets(along, radius, false)));
    cases.push(two_sheets(12, 0.1, true));
    let mut parallel = two_sheets(12, 0.1, false);
    parallel.camera.orthographic_height = Some(2.0);
    let mut near = two_sheets(12, 0.1, false);
    near.camera.eye = DVec3::new(0.6, 0.0, 0.5);
    cases.extend([parallel, near]);
    let mut headless = shared();
    for (number, hard) in cases.iter().enumerate() {
        let errors = compare_light(&render_as(&mut headless, hard, PICTURE), &oracle_of(hard));
        println!("{number}: {}", errors.row(hard.name));
        assert!(errors.worst <= LIGHT && errors.not_finite == 0, "{number}: {errors:?}");
        assert!(errors.seen >= 1_000 && errors.compared >= 30_000, "{number}: {errors:?}");
    }
}

/// Where widened splats end at h²/2l beyond their rims, this is a half.
#[test]
fn outlines_of_sheets_have_a_quarter_of_the_error_of_hard_ones() {
    let mut headless = shared();
    for (along, radius, ellipses) in [(40, 0.03, false), (12, 0.1, false), (12, 0.1, true)] {
        let hard = covering(vec![sheet(along, radius, DVec3::ZERO, ellipses)]);
        let [part, crisp] = [Edges::Coverage, Edges::Hard]
            .map(|edges| against_the_truth(&mut headless, &with(&hard, |settings| settings.edges = edges)));
        println!("{along} along a side, {ellipses}: {part:.4?}, hard {crisp:.4?}");
        assert!(4.0 * part[0] < crisp[0], "{part:?} {crisp:?}");
    }
}

/// Half a million splats in one pixel make the tile one that is walked over in parts, beside a sheet that it shows as without them.
#[test]
fn in_overflow_tiles_they_cover_what_they_do_in_others() {
    let mut headless = shared();
    // A pixel of 16 is so wide there; the sheet and the ball lie in the first tile.
    let pixel = 2.0 * 900.0 * 22.5_f64.to_radians().tan() / 16.0;
    let at = |x: f64, y: f64| pixel * DVec3::new(x - 8.0, 8.0 - y, 0.0);
    let [without, beside] = [0, 560_000].map(|count| {
        let mut objects = vec![sheet(4, 1.2 * pixel, at(2.6, 3.4), false)];
        if count > 0 {
            objects.push(sphere(count, at(7.5, 7.5)));
        }
        let mut hard = covering(objects);
        hard.camera = builder::camera([0.0, 0.0, 900.0], [0.0; 3]);
        hard.settings.size_px = [16; 2];
        render_as(&mut headless, &hard, PICTURE)
    });
    let overflows = |frame| passes(frame).iter().any(|pass| pass.contains("overflow"));
    assert!(overflows(&beside) && !overflows(&without), "{:?} {:?}", passes(&beside), passes(&without));
    let mut in_part = 0;
    for (i, (a, b)) in without.linear.iter().zip(&beside.linear).enumerate() {
        if i % 16 < 6 && i / 16 < 7 {
            in_part += usize::from(a[3] > 0.02 && a[3] < 0.98);
            assert!((a[3] - b[3]).abs() < 1e-4, "{i}: {a:?} {b:?}");
        }
    }
    assert!(in_part >= 8, "{in_part}");
}
