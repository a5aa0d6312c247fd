//! `surfel bench`: tables, files, and the gate.

mod gates;

use std::fs;

use serde_json::Value;

use super::program::{Folder, Run, counts_all_fragments, done, surfel};

/// A run that is small: figures don't matter here.
fn bench(folder: &Folder, words: &[&str]) -> Run {
    surfel(folder, &[&["bench"], words, &["--size", "96x96"]].concat())
}

/// Frames come in pairs, and an interval takes 6 of them.
const TABLE1: [&str; 5] = ["table1", "--splats", "500,1k", "--frames", "12"];

/// The fewer are drawn the larger they may be, beside the paper's table; what is counted is judged.
#[test]
fn levels_of_detail_are_measured_over_tolerances() {
    let folder = Folder::new();
    let run =
        bench(&folder, &["p2", "--splats", "20k", "--frames", "6", "--json", "p2.json", "--csv", "tables"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let json = folder.json("p2.json");
    let rows = json["p2"]["rows"].as_array().unwrap();
    let names: Vec<_> = rows.iter().map(|row| row["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["0", "1px", "2px", "0.001%", "0.01%", "0.12%"]);
    let drawn: Vec<_> = rows.iter().map(|row| row["drawn"].as_u64().unwrap()).collect();
    assert!(drawn[0] > drawn[1] && drawn[1] > drawn[2] && drawn[2] > 10, "{drawn:?}");
    assert!(json["gate"].to_string().contains("p2, 2px, splats"), "{}", json["gate"]);
    let table = |name: &str| fs::read_to_string(folder.path(name)).unwrap();
    assert!(table("tables/p2.csv").starts_with("tolerance,px,splats,LOD ms,splatting ms"));
    let error = |row: usize| rows[row]["error"]["rms"].as_f64().unwrap();
    assert!(error(0) == 0.0 && error(1) > 0.0 && error(2) > error(1), "{rows:?}");
    assert!(table("tables/p2-paper.csv").contains("David"));
}

#[test]
fn the_floor_is_measured_in_turn_with_the_passes() {
    let folder = Folder::new();
    let run =
        bench(&folder, &["floor", "--frames", "3", "--json", "floor.json", "--csv", "tables", "--validate"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("x floor") && run.stdout.ends_with('\n'), "{}", run.stdout);
    // Of 3 frames no median is certain.
    assert!(run.stdout.contains("note: floor, frame: too few frames"), "{}", run.stdout);
    let json = folder.json("floor.json");
    let report = &json["floor"];
    let rows = report["rows"].as_array().unwrap();
    let names: Vec<_> = rows.iter().map(|row| row["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["visibility", "accumulate", "finalize", "frame"]);
    for row in rows {
        assert!(row["ratio"]["median"].as_f64().unwrap() > 0.0, "{row}");
        if counts_all_fragments(&json) {
            assert_eq!(row["fragments"], row["floor_fragments"], "{row}");
        }
        assert!(row["fragments"].as_u64() > Some(0) && row["floor_fragments"] != 0, "{row}");
    }
    let is_unknown = rows[0]["floor_fragments"].is_null();
    assert_eq!(run.stdout.contains("counts no fragments of a shader that does nothing"), is_unknown);
    assert!(report["strict_points"].as_u64() < report["floor_points"].as_u64());

    // In the same rounds: the device's limits, and which of them binds each pass.
    let limits = report["limits"]["limits"].as_array().unwrap();
    assert_eq!((limits.len(), &report["limits"]["notes"]), (9, &Value::Array(Vec::new())));
    assert!(limits.iter().all(|limit| limit["units_per_sec"].as_f64() > Some(0.0)), "{limits:?}");
    let bounds = report["limits"]["bounds"].as_array().unwrap();
    for (bound, row) in bounds.iter().zip(rows) {
        assert_eq!((&bound["name"], &bound["ms"]), (&row["name"], &row["ms"]));
        assert!(bound["ratio"]["median"].as_f64() > Some(0.0), "{bound}");
        assert_eq!(bound["binds"].is_string(), bound["name"] != "frame", "{bound}");
    }
    assert_eq!(bounds[1]["work"]["blended_fragments"], rows[1]["fragments"]);
    assert_eq!(bounds[1]["work"]["drawn_points"], report["strict_points"]);
    // 96 x 96 pixels: two sums of 16 bytes and a depth; 150 000 splats of 32 bytes, without colors.
    assert_eq!(bounds[1]["work"]["bytes"], 96 * 96 * 36 + 32 * 150_000);
    for (name, lines) in [("floor.csv", 5), ("floor-limits.csv", 10), ("floor-bounds.csv", 5)] {
        let csv = fs::read_to_string(folder.path(&format!("tables/{name}"))).unwrap();
        assert_eq!(csv.lines().count(), lines, "{name}");
    }
    let refused = bench(&folder, &["floor", "--json", "no/such/folder/x.json"]);
    assert_eq!((refused.code, refused.stderr.lines().count()), (1, 1), "{}", refused.stderr);
}

#[test]
fn passes_by_tiles_are_set_beside_the_devices_limits_too() {
    let folder = Folder::new();
    let words = ["floor", "--rasterizer", "compute", "--frames", "3", "--json", "floor.json", "--validate"];
    let run = bench(&folder, &words);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let report = folder.json("floor.json");
    assert_eq!(report["settings"]["rasterizer"], "compute", "{}", report["settings"]);
    let rows = report["floor"]["rows"].as_array().unwrap();
    let bounds = report["floor"]["limits"]["bounds"].as_array().unwrap();
    let bound = |name: &str| bounds.iter().find(|bound| bound["name"] == name).expect(name);
    let strict = report["floor"]["strict_points"].as_u64().unwrap();
    for (bound, row) in bounds.iter().zip(rows) {
        assert_eq!((&bound["name"], &bound["ms"]), (&row["name"], &row["ms"]));
        assert!(bound["ratio"]["median"].as_f64() > Some(0.0), "{bound}");
        assert_eq!(bound["binds"].is_string(), bound["name"] != "frame", "{bound}");
    }
    // Only what fills the target has a floor, as points have it; and the frame as a whole.
    let floored = rows.iter().filter(|row| !row["floor_ms"].is_null());
    let floored: Vec<_> = floored.map(|row| row["name"].as_str().unwrap()).collect();
    assert_eq!(floored, ["finalize", "frame"]);
    // Every splat of a tile is looked for at each of its pixels. Of some 55 500 splats that may be seen, each has a rect of 4 bytes; those
    // that cover some pixel, a record of 64, made from 32, and an entry of 4 in each of two tiles or less. A tile of 32 pixels has 8
    // bytes of each, and 4 for its number and its start.
    let work = |pass: &str, what: &str| bound(pass)["work"][what].as_u64().unwrap();
    let kernels = work("see, sum and shade tiles", "kernels");
    let entries = kernels / 32;
    assert!((strict..=2 * strict).contains(&entries) && kernels % 32 == 0, "{kernels}");
    let close = |pass: &str, least: u64, most: u64| {
        let bytes = work(pass, "bytes");
        assert!((least..=most).contains(&bytes), "{pass}: {bytes}, expected {least} to {most}");
    };
    close("count tiles", 4 * strict, 4 * 60_000);
    close("fill tiles", 4 * (strict + entries), 4 * (60_000 + entries) + 4 * 300);
    close("project splats", 90 * strict, 110 * strict);
    close(
        "see, sum and shade tiles",
        60 * strict + 4 * entries,
        70 * strict + 4 * entries + 300 * (32 * 8 + 8),
    );
}

/// A mesh that is closed, and as wide as it is high.
const CUBE: &str = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// What tiles with more splats than a dispatch takes leave to others is not known, of neither.
#[test]
fn passes_that_do_an_unknown_part_of_lists_have_no_bound() {
    let folder = Folder::new();
    folder.write("cube.obj", CUBE);
    done(&folder, &["convert", "cube.obj", "cube.ply", "--resample", "1500000"]);
    let floor = ["bench", "floor", "--rasterizer", "compute", "--frames", "1", "--json", "floor.json"];
    // Two tiles, and two hundred.
    for (size, is_known) in [("8x8", false), ("80x80", true)] {
        done(&folder, &[&floor[..], &["--model", "cube.ply", "--size", size]].concat());
        let report = folder.json("floor.json");
        let bounds = report["floor"]["limits"]["bounds"].as_array().unwrap();
        let of = |what: &str| {
            let found = bounds.iter().find(|row| row["name"].as_str().unwrap().contains(what));
            found.unwrap_or_else(|| panic!("{size}: {what}")).clone()
        };
        let (all, overflow) = (of("see, sum and shade"), of("overflow"));
        assert_eq!(all["work"]["kernels"].is_u64(), is_known, "{all}");
        assert_eq!(all["binds"].is_string(), is_known, "{all}");
        assert_eq!(overflow["binds"], Value::Null, "{overflow}");
    }
}

#[test]
fn lists_are_refused_where_a_table_takes_one_or_none() {
    let folder = Folder::new();
    for (words, named) in [
        (["floor", "--rasterizer", "compute,perspective"], "--rasterizer"),
        (["table1", "--rasterizer", "compute"], "--rasterizer"),
        (["all", "--rasterizer", "compute"], "--rasterizer"),
        (["floor", "--sizes", "64,128"], "--sizes"),
        (["table1", "--sizes", "64"], "--sizes"),
    ] {
        let refused = bench(&folder, &words);
        assert_eq!((refused.code, refused.stderr.lines().count()), (1, 1), "{words:?}: {}", refused.stderr);
        assert!(refused.stderr.contains(named) && refused.stderr.contains(words[0]), "{}", refused.stderr);
    }
}

#[test]
fn throughput_is_told_in_every_form_of_every_pass() {
    let folder = Folder::new();
    let files = ["--json", "t.json", "--markdown", "t.md", "--csv", "tables", "--plot", "t.svg"];
    let run = bench(&folder, &[&TABLE1[..], &files].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let report = folder.json("t.json");
    let rows = report["table1"].as_array().unwrap();
    assert_eq!(rows.len(), 2);
    for row in rows {
        let methods = row["methods"].as_array().unwrap();
        assert_eq!(methods.len(), 2);
        for method in methods {
            let passes = method["frames"]["passes"].as_array().unwrap();
            // A ratio to the floor for each pass, and for the frame.
            assert_eq!(method["over_floor"].as_array().unwrap().len(), passes.len() + 1);
            assert!(method["over_floor"].as_array().unwrap().iter().all(Value::is_object), "{method}");
            assert!(method["fps"].as_f64() > Some(0.0) && passes.iter().all(|pass| pass["ms"].is_object()));
            assert_eq!(method["frames"]["frame_ms"]["interval"].as_array().unwrap().len(), 2);
            assert!(method["frames"]["record_ms"]["median"].as_f64() > Some(0.0));
        }
        // What the floor draws is what perspective splatting draws, which has no early depth test.
        let fragments = |frames: &Value| frames["passes"][1]["fragments"].as_u64();
        let (floor, own) = (fragments(&row["floor"]), fragments(&methods[0]["frames"]));
        assert!(floor == own || floor > Some(0) && floor < own && !counts_all_fragments(&report), "{row}");
        assert!(row["splat_bytes"].as_u64() > Some(0) && row["transient_bytes"].as_u64() > Some(0));
    }
    assert!(report["machine"]["threads"].as_u64() > Some(0));
    let markdown = fs::read_to_string(folder.path("t.md")).unwrap();
    assert!(markdown.contains("| 1000 | raycast, adjust |"), "{markdown}");
    assert_eq!(folder.names_in("tables"), ["table1-passes.csv", "table1.csv"]);
    let passes = fs::read_to_string(folder.path("tables").join("table1-passes.csv")).unwrap();
    // A head; two numbers of splats, three contestants, three passes.
    assert_eq!(passes.lines().count(), 1 + 2 * 3 * 3, "{passes}");
    assert!(fs::read_to_string(folder.path("t.svg")).unwrap().contains("floor"));
}

#[test]
fn layers_stand_beside_the_papers_and_cost_an_opaque_scene_nothing() {
    let folder = Folder::new();
    let layers = ["layers", "--splats", "100", "--frames", "12"];
    let files = ["--json", "l.json", "--markdown", "l.md", "--csv", "tables", "--validate"];
    let run = bench(&folder, &[&layers[..], &files].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let report = &folder.json("l.json")["layers"];
    let contestants = report["contestants"].as_array().unwrap();
    let all = |key: &str| contestants.iter().map(|own| own[key].clone()).collect::<Vec<_>>();
    assert_eq!(
        all("name"),
        ["6, drop", "3, drop", "3, blend", "auto:16, drop", "opaque, 1", "opaque, auto:64"]
    );
    assert_eq!(
        all("layers"),
        [6, 3, 3, 16].map(Value::from).into_iter().chain([(); 2].map(|()| Value::Null)).collect::<Vec<_>>()
    );
    assert_eq!(all("paper_fps")[..3], [21.0, 45.0, 49.0].map(Value::from));
    for own in contestants {
        assert!(own["fps"].as_f64() > Some(0.0) && own["over_floor"]["median"].as_f64() > Some(0.0), "{own}");
        assert_eq!(own["beside_first"]["interval"].as_array().map(Vec::len), Some(2));
        assert!(own["frames"]["record_ms"]["median"].as_f64() > Some(0.0));
    }
    // Nothing grows with the number of layers, and an opaque scene has none.
    assert_eq!(all("transient_bytes")[0], all("transient_bytes")[1]);
    assert!(all("transient_bytes")[4].as_u64() < all("transient_bytes")[1].as_u64());
    assert_eq!(report["opaque"]["same_passes"], true);
    let passes = |i: usize| contestants[i]["frames"]["passes"].as_array().map(Vec::len);
    assert_eq!((passes(4), passes(5)), (Some(3), Some(3)));
    let empty = &report["empty"];
    let [recorded, drawn] = ["recorded", "drawn"].map(|key| empty[key].as_u64().unwrap());
    assert!(recorded == 16 && (3..16).contains(&drawn), "{empty}");
    let kinds: Vec<_> = empty["passes"].as_array().unwrap().iter().map(|pass| pass["name"].clone()).collect();
    assert_eq!(kinds, ["visibility", "accumulate", "compose", "count", "layer"]);
    assert!(empty["passes"][4]["share"]["median"].as_f64() < Some(0.5), "{empty}");

    assert_eq!(folder.names_in("tables"), ["layers-empty.csv", "layers.csv"]);
    let table = fs::read_to_string(folder.path("tables").join("layers.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 6, "{table}");
    let markdown = fs::read_to_string(folder.path("l.md")).unwrap();
    for text in ["| 3, blend | 3 |", "memory does not grow with their number", "the same passes as with one"]
    {
        assert!(markdown.contains(text), "{text}: {markdown}");
    }
    let refused = bench(&folder, &["layers", "--model", "x.ply"]);
    assert_eq!((refused.code, refused.stderr.lines().count()), (1, 1), "{}", refused.stderr);
}

#[test]
fn a_file_of_splats_has_no_area_to_resample() {
    let folder = Folder::new();
    let header = "ply\nformat ascii 1.0\nelement vertex 1\n";
    let floats = ["x", "y", "z", "nx", "ny", "nz", "radius"].map(|name| format!("property float {name}\n"));
    folder.write("one.ply", format!("{header}{}end_header\n0 0 0 0 0 1 1\n", floats.concat()));
    for table in ["table1", "transition"] {
        let refused = bench(&folder, &[table, "--model", "one.ply"]);
        assert_eq!(refused.code, 1, "{}", refused.stderr);
        let expected = "one.ply: the file holds splats; expected a mesh";
        assert!(refused.stderr.contains(expected), "{}", refused.stderr);
    }
}

#[test]
fn more_splats_than_there_is_memory_for_are_refused() {
    let folder = Folder::new();
    folder.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let program = env!("CARGO_BIN_EXE_surfel");
    for model in ["", "--model one.obj"] {
        // Systems that promise more memory than they have are kept from it.
        let command = format!(
            "ulimit -v 8000000; exec '{program}' bench table1 --size 96x96 --splats 4294967295 {model}"
        );
        let mut shell = std::process::Command::new("sh");
        let output = shell.args(["-c", &command]).current_dir(folder.path(".")).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.contains("no memory for 4294967295 samples"), "{said}");
    }
}
