//! `surfel figure`: small sizes; what the papers say of their figures is to be seen in ours.

mod panels;

use std::fs;

use panels::{Panel, panels, shown};

use super::{
    program::{Folder, done, surfel},
    splats,
};

#[test]
fn without_a_name_the_figures_are_listed() {
    let folder = Folder::new();
    let run = surfel(&folder, &["figure"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let names: Vec<_> = run.stdout.lines().filter_map(|line| line.split(' ').next()).collect();
    assert_eq!(
        names,
        [
            "g1", "g3", "g4", "g5", "g6", "slides", "p9", "p10", "p17", "p18", "p19", "p20", "i1", "i3",
            "i5", "i7", "i9", "i10", "i11", "samples"
        ]
    );
    assert!(folder.names().is_empty());
}

#[test]
fn g1_the_maximum_is_as_thin_as_no_filter_where_a_splat_is_minified_one_way() {
    let panels = panels("g1", [96, 96], &[]);
    assert_eq!(panels.len(), 15);
    // The weight of a panel; contours and pixel centers hide the same places in all of them.
    let ink = |i: usize| {
        let panel = &panels[i];
        let values = panel.values.iter().zip(&panel.colored).filter(|(_, colored)| !**colored);
        values.map(|(value, _)| 1.0 - value).sum::<f64>()
    };
    for row in 0..3 {
        let [ewa, none, adjust, paper, max] = [0, 1, 2, 3, 4].map(|column| ink(5 * row + column));
        println!(
            "row {row}: ewa {ewa:.0}, none {none:.0}, adjust {adjust:.0}, paper {paper:.0}, max {max:.0}"
        );
        assert!((adjust / ewa - 1.0).abs() < 0.1, "adjustment has nearly EWA's shape");
        match row {
            // All nearly the same.
            0 => assert!([none, paper, max].iter().all(|other| (other / ewa - 1.0).abs() < 0.1)),
            1 => assert!(none < 0.6 * ewa && (max / ewa - 1.0).abs() < 0.1),
            _ => assert!(none < 0.75 * ewa && max < 0.8 * ewa),
        }
    }
}

#[test]
fn g3_without_a_filter_the_far_board_aliases() {
    let [none, ewa, adjust, max] = <[Panel; 4]>::try_from(panels("g3", [320, 96], &[])).ok().unwrap();
    let [a, b, c, d] = [&none, &ewa, &adjust, &max].map(|panel| panel.energy(1));
    println!("energy of neighbors: none {a:.4}, ewa {b:.4}, adjust {c:.4}, max {d:.4}");
    // Without a filter fields finer than a pixel are black or white; filtered they are gray.
    assert!(a > 2.0 * b && a > 1.5 * c && a > d);
    assert!(d > b, "the maximum is the roughest filter");
    println!("from ewa: adjust {:.4}, max {:.4}", adjust.distance(&ewa), max.distance(&ewa));
    assert!(adjust.distance(&ewa) < max.distance(&ewa));
}

#[test]
fn g4_adjustment_is_nearer_to_ewa_than_the_maximum() {
    let [max, adjust, ewa] = <[Panel; 3]>::try_from(panels("g4", [180, 120], &[])).ok().unwrap();
    // Each pixel is a square of 3.
    let [a, b, c] = [&max, &adjust, &ewa].map(|panel| panel.energy(3));
    println!("energy of neighbors: max {a:.4}, adjust {b:.4}, ewa {c:.4}");
    println!("from ewa: max {:.4}, adjust {:.4}", max.distance(&ewa), adjust.distance(&ewa));
    assert!(a > 1.2 * b);
    assert!(adjust.distance(&ewa) < 0.5 * max.distance(&ewa));
}

#[test]
fn g5_the_seam_is_seen_unless_it_is_smoothed() {
    let [naive, smoothed, weights, plain] =
        <[Panel; 4]>::try_from(panels("g5", [240, 200], &[])).ok().unwrap();
    let [a, b, d] = [&naive, &smoothed, &plain].map(|panel| panel.steps(0.07));
    println!("steps: naive {a}, smoothed {b}, edges not sampled {d}");
    assert!(a > 5 * b.max(1) && d > b, "{a}, {b}, {d}");
    // The weights fall from 1 to 0 in a band along the seam.
    let [black, gray, white] = [0.0..0.001, 0.001..0.999, 0.999..1.1].map(|range| weights.count(range));
    println!("weights: {black} black, {gray} gray, {white} white");
    assert!(black > 10_000 && white > 10_000 && gray > 500 && gray < 5000);
}

#[test]
fn g5_shows_another_mesh() {
    let folder = Folder::new();
    folder.write("ridge.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 1\nf 1 2 3\nf 2 4 3\n");
    done(&folder, &["figure", "g5", "--size", "64x64", "--model", "ridge.obj"]);
    assert_eq!(folder.names(), ["g5.png", "ridge.obj"]);
}

#[test]
fn g6_six_layers_are_all_and_three_are_not() {
    let [six, dropped, blended, all] = <[Panel; 4]>::try_from(panels("g6", [240, 240], &[])).ok().unwrap();
    let [a, b, c] = [&six, &dropped, &blended].map(|panel| panel.distance(&all));
    let between = dropped.distance(&blended);
    println!("from all: six {a:.4}, dropped {b:.4}, blended {c:.4}; dropped from blended {between:.4}");
    assert!(a < 0.01 * b && b > 0.02 && c < 0.95 * b && between > 2e-3);
}

#[test]
fn slides_the_last_layer_has_what_is_behind() {
    let panels = panels("slides", [96, 96], &[]);
    assert_eq!(panels.len(), 6);
    let mut before = 1.0;
    for row in panels.chunks(3) {
        let [dropped, blended] = [&row[1], &row[2]].map(|panel| panel.distance(&row[0]));
        println!("from all: only the first {dropped:.4}, with the blended {blended:.4}");
        assert!(blended < 0.6 * dropped && blended < before);
        before = blended;
    }
    assert_eq!(panels[0].values, panels[3].values, "all layers, twice");
}

#[test]
fn p18_the_round_kernel_blurs_more_than_the_localized_one() {
    let [round, localized] = <[Panel; 2]>::try_from(panels("p18", [128, 96], &[])).ok().unwrap();
    let [a, b] = [&round, &localized].map(|panel| panel.count(0.1..0.9));
    println!("gray pixels: {a} and {b}");
    // Both have gray pixels where the board is far; 1.9 times as many were measured.
    assert!(2 * a > 3 * b && b > 0);
}

#[test]
fn p19_shows_the_built_in_model_or_another() {
    for more in [&[][..], &["--model", "model.ply"]] {
        let [narrow, plateau] = <[Panel; 2]>::try_from(panels("p19", [96, 96], more)).ok().unwrap();
        let distance = narrow.distance(&plateau);
        assert!(narrow.count(0.0..0.98) > 1000 && distance > 1e-3 && distance < 0.2, "{distance}");
    }
}

/// How much of a panel's surface differs from what is around it.
#[test]
fn p17_sums_are_uneven_and_their_quotient_is_not() {
    let [weights, sums, colors] = <[Panel; 3]>::try_from(panels("p17", [128, 128], &[])).ok().unwrap();
    let [a, b, c] = [&weights, &sums, &colors].map(|panel| panel.energy(2));
    println!("between neighbors: weights {a:.2e}, sums {b:.2e}, colors {c:.2e}");
    assert!(b > 1.2 * c && a > 1e-5, "{a} {b} {c}");
    panels("p17", [64, 64], &["--model", "model.ply"]);
}

#[test]
fn p20_levels_of_detail_look_alike() {
    let [all, papers, half] = <[Panel; 3]>::try_from(panels("p20", [128, 128], &[])).ok().unwrap();
    let [a, b] = [&papers, &half].map(|panel| panel.distance(&all));
    println!("from all: the paper's {a:.4}, half of them {b:.4}");
    assert!(a < 0.02 && b < 0.03 && a + b > 0.0, "{a} {b}");
}

#[test]
fn p9_and_p10_are_curves_with_the_papers_values() {
    let folder = Folder::new();
    // The third curve, σ = ½, at r = ½; the first, n = 2 and a = 8, at r = ¾, where q = ¼.
    let cases = [
        ("p9", "#009E73", 1.0 / 3.0, (-0.5_f64).exp(), ["σ = 0.2", "σ = 1"]),
        ("p10", "#0072B2", 0.5, (-8.0 / 3.0_f64).exp(), ["n = 2, a = 8", "n = 5, a = 4"]),
    ];
    for (name, color, r, weight, labels) in cases {
        done(&folder, &["figure", name, "-o", "a.svg", "--size", "900x600"]);
        let svg = fs::read_to_string(folder.path("a.svg")).unwrap();
        for label in labels {
            assert!(svg.contains(&format!("\n{label}\n")), "{label}");
        }
        let curve = svg
            .lines()
            .filter(|line| line.starts_with("<polyline") && line.contains(color))
            .max_by_key(|line| line.len())
            .unwrap();
        let points: Vec<[f64; 2]> = curve
            .split_once("points=\"")
            .and_then(|(_, rest)| rest.split_once('"'))
            .unwrap()
            .0
            .split_whitespace()
            .map(|point| {
                let (x, y) = point.split_once(',').unwrap();
                [x.parse().unwrap(), y.parse().unwrap()]
            })
            .collect();
        // From weight 1 at r = 0 to the rim.
        let (first, last) = (points[0], points[points.len() - 1]);
        let bottom = last[1];
        // The last of 251 points is half a step before the rim.
        let x = first[0] + r * (last[0] - first[0]) * 250.5 / 250.0;
        let at = points.iter().min_by(|a, b| (a[0] - x).abs().total_cmp(&(b[0] - x).abs())).unwrap();
        let drawn = (bottom - at[1]) / (bottom - first[1]);
        // σ = ½ ends at exp(−4.5) and not at 0. Places are whole pixels of some 440, and so is half a step along a
        // curve that falls by less than 1.3 pixels a pixel.
        let end = if name == "p9" { (-4.5_f64).exp() } else { 0.0 };
        let expected = (weight - end) / (1.0 - end);
        println!("{name}: {drawn:.4}, expected {expected:.4}");
        assert!((drawn - expected).abs() < 3.0 / 440.0, "{name}: {drawn} and {expected}");
    }
}

/// What sticks out of the mesh's outline, or is missing, of splats that nothing, lines and curves cut.
/// The nearer, the more a line is off the curve: the edge that is shown is bent.
#[test]
fn i1_shows_an_edge_that_lines_miss() {
    let panels = panels("i1", [120, 120], &[]);
    assert_eq!(panels.len(), 9);
    let differ = |row: usize| {
        let [lines, curves] = [1, 2].map(|column| &panels[3 * row + column].values);
        lines.iter().zip(curves).filter(|(a, b)| (*a - *b).abs() > 0.02).count()
    };
    let differ = [0, 1, 2].map(differ);
    println!("pixels between lines and curves: {differ:?} of {}", 120 * 120);
    assert!(differ[0] < differ[1] && differ[1] < differ[2] && differ[2] > 1000, "{differ:?}");
}

#[test]
fn i9_curves_leave_the_outline_of_the_mesh() {
    let panels = panels("i9", [160, 160], &[]);
    let off = |panel: &Panel| {
        let is_empty = |panel: &Panel, at: usize| panel.values[at] > 0.8;
        (0..panel.values.len()).filter(|at| is_empty(panel, *at) != is_empty(&panels[0], *at)).count()
    };
    let [uncut, lines, curves] = [1, 2, 3].map(|i| off(&panels[i]));
    println!("pixels off the outline: {uncut}, lines {lines}, curves {curves}");
    assert!(3 * curves < uncut && curves <= lines, "{uncut}, {lines}, {curves}");
}

#[test]
fn i3_i5_and_i7_single_splats_have_their_areas() {
    let by_weight = shown(&panels("i3", [120, 96], &[]));
    println!("by weight: {by_weight:.3?}");
    assert!(by_weight.len() == 6 && by_weight.windows(2).all(|pair| pair[1] < pair[0] - 0.01));
    // Both sides of a curve are a disk of radius 1 in 2.5 x 3.125, but for the dot that lies beside the second one.
    let sides: f64 = shown(&panels("i5", [120, 96], &[])).iter().sum();
    let disk = std::f64::consts::PI / (2.5 * 3.125);
    assert!((sides - disk).abs() < 0.02, "{sides} and {disk}");
    let around = shown(&panels("i7", [120, 96], &[]));
    let least = |row: &[f64]| row[2] < row[0] && row[2] < row[1];
    assert!(around.len() == 6 && around.chunks(3).all(least) && around[4] > around[3], "{around:?}");
}

#[test]
fn faults_are_one_line_and_leave_nothing() {
    let folder = Folder::new();
    folder.write("model.ply", splats("0 0 0 0 0 1 1 255 0 0\n"));
    let before = folder.names();
    let cases: [(&[&str], &str); 10] = [
        (
            &["g2"],
            "possible values: g1, g3, g4, g5, g6, slides, p9, p10, p17, p18, p19, p20, i1, i3, i5, i7, i9, i10, i11, samples",
        ),
        (&["--size", "64x64"], "required arguments"),
        (&["g3", "-o", "a.svg"], "--output: a.svg: expected a name in .png for g3"),
        (&["p9", "-o", "a.png"], "--output: a.png: expected a name in .svg for p9"),
        (&["g3", "--size", "31x64"], "--size: 31x64: expected 32 to 4096 pixels a side"),
        (&["g1", "--size", "64x32"], "--size: 64x32: expected a square"),
        (
            &["g3", "--model", "model.ply"],
            "--model: g3 has a scene of its own; expected g5, p17, p19, p20, i1, i9 or i10",
        ),
        (&["g5", "--model", "model.ply"], "model.ply: the file holds splats; expected a mesh"),
        (&["p19", "--model", "none.ply"], "none.ply: cannot read"),
        (&["g3", "-o", "no/such/a.png"], "no/such/a.png: cannot write"),
    ];
    for (words, expected) in cases {
        let run = surfel(&folder, &[&["figure"], words].concat());
        assert_eq!((run.code, run.stderr.lines().count(), run.stdout.as_str()), (1, 1, ""), "{}", run.stderr);
        assert!(run.stderr.contains(expected), "{words:?}: {}", run.stderr);
    }
    assert_eq!(folder.names(), before);
}
