//! Gates of `surfel bench`: a run judged by an earlier one, and figures that are too uncertain.

use serde_json::Value;

use super::{TABLE1, bench};
use crate::program::Folder;

#[test]
fn a_gate_passes_what_is_the_same_and_stops_what_became_worse() {
    let folder = Folder::new();
    // On a busy machine intervals are wide; times are not what is tested here.
    let wide = ["--tolerance", "400", "--max-spread", "1000"];
    assert_eq!(bench(&folder, &[&TABLE1[..], &["--json", "before.json"]].concat()).code, 0);
    let same = bench(&folder, &[&TABLE1[..], &["--baseline", "before.json"], &wide].concat());
    assert_eq!(same.code, 0, "{} {}", same.stdout, same.stderr);
    assert!(same.stdout.contains("against the baseline: 0 worse"), "{}", same.stdout);

    // As if fragments had been fewer, a pass faster, and one more been measured.
    let mut before = folder.json("before.json");
    let figures = before["gate"]["figures"].as_array_mut().unwrap();
    let of = |figures: &mut Vec<Value>, end: &str| {
        figures.iter().position(|figure| figure["name"].as_str().unwrap().ends_with(end)).unwrap()
    };
    let fragments = of(figures, "1000 splats, raycast, adjust, accumulate, fragments");
    figures[fragments]["value"] = (figures[fragments]["value"].as_f64().unwrap() * 0.99).into();
    let time = of(figures, "1000 splats, perspective, adjust, visibility, x floor");
    figures[time]["interval"] = [0.001, 0.002].to_vec().into();
    figures.push(serde_json::json!({"name": "x", "kind": "work", "value": 1.0, "interval": null}));
    folder.write("better.json", before.to_string());
    let worse = bench(&folder, &[&TABLE1[..], &["--baseline", "better.json"], &wide].concat());
    assert_eq!(worse.code, 3, "{} {}", worse.stdout, worse.stderr);
    assert!(worse.stdout.contains("2 worse") && worse.stdout.contains("gone: x"), "{}", worse.stdout);
    assert!(worse.stderr.contains("3 figure(s) became worse"), "{}", worse.stderr);
}

#[test]
fn a_baseline_of_something_else_is_refused_before_the_long_work() {
    let folder = Folder::new();
    let gate = |figures: &str| {
        format!(
            r#"{{"gate": {{"subject": {{"table": "floor"}}, "circumstances": {{}}, "figures": [{figures}]}}}}"#
        )
    };
    folder.write("floor.json", gate(r#"{"name": "x", "kind": "work", "value": 1.0, "interval": null}"#));
    folder.write("empty.json", gate(""));
    folder.write("broken.json", "{\n\"gate\": 7}");
    for (file, expected) in [
        ("floor.json", "the baseline is of something else"),
        ("broken.json", "broken.json: line 2: "),
        ("empty.json", "has no figures to judge by"),
        ("missing.json", "cannot read"),
    ] {
        let refused = bench(&folder, &[&TABLE1[..], &["--baseline", file]].concat());
        assert_eq!((refused.code, refused.stderr.lines().count()), (1, 1), "{}", refused.stderr);
        assert!(refused.stderr.contains(expected) && refused.stdout.is_empty(), "{}", refused.stderr);
    }
}

#[test]
fn transitions_stand_beside_none_and_a_gate_judges_them() {
    let folder = Folder::new();
    let transition = ["transition", "--splats", "500", "--frames", "12"];
    let run = bench(&folder, &[&transition[..], &["--json", "t.json", "--csv", "tables"]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let report = folder.json("t.json");
    let contestants = report["transition"]["contestants"].as_array().unwrap();
    let names: Vec<_> = contestants.iter().map(|own| own["name"].clone()).collect();
    assert_eq!(names, ["none", "color", "attributes", "paper", "all splats", "all polygons"]);
    let drawn = |i: usize| ["splats", "triangles"].map(|key| contestants[i]["drawn"][key].as_u64().unwrap());
    assert_eq!((drawn(4), drawn(5)), ([500, 0], [0, 20_480]));
    // Of splats half, and more and smaller ones beside the edge; of triangles half, and those below the small ones.
    assert!((0..4).all(|i| (150..1500).contains(&drawn(i)[0]) && (10_000..20_480).contains(&drawn(i)[1])));
    assert_eq!(folder.names_in("tables"), ["transition.csv"]);
    let wide = ["--baseline", "t.json", "--tolerance", "400", "--max-spread", "1000"];
    let same = bench(&folder, &[&transition[..], &wide].concat());
    assert_eq!(same.code, 0, "{} {}", same.stdout, same.stderr);
    assert!(same.stdout.contains("against the baseline: 0 worse"), "{}", same.stdout);
    let few = bench(&folder, &["transition", "--splats", "500", "--frames", "6", "--baseline", "t.json"]);
    assert!(few.code == 1 && few.stderr.contains("a gate takes 12 at least"), "{}", few.stderr);

    folder.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let refused = bench(&folder, &["transition", "--model", "one.obj"]);
    assert_eq!((refused.code, refused.stderr.lines().count()), (1, 1), "{}", refused.stderr);
    assert!(refused.stderr.contains("one.obj: has no two halves"), "{}", refused.stderr);
}

#[test]
fn doubtful_figures_are_refused_where_that_is_asked_for() {
    let folder = Folder::new();
    let words = ["floor", "--frames", "3"];
    let refused = bench(&folder, &[&words[..], &["--strict"]].concat());
    assert_eq!(refused.code, 2, "{}", refused.stderr);
    assert!(refused.stderr.contains("can't be trusted, the first: "), "{}", refused.stderr);
    // The table is there all the same.
    assert!(refused.stdout.contains("accumulate"), "{}", refused.stdout);
}
