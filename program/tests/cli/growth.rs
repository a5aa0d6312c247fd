//! `surfel bench growth`: both curves in every form, and what it refuses.

use std::fs;

use serde_json::Value;

use super::program::{Folder, Run, surfel};

/// Figures don't matter here.
fn growth(folder: &Folder, words: &[&str]) -> Run {
    let tiny = ["bench", "growth", "--splats", "2k,1k,1000", "--size", "96x96", "--frames", "3"];
    surfel(folder, &[&tiny[..], words].concat())
}

#[test]
fn growth_is_told_over_splats_and_over_pixels_in_every_form() {
    let folder = Folder::new();
    let what = ["--sizes", "64x64,128", "--rasterizer", "perspective,raycast,perspective", "--validate"];
    let files = ["--json", "g.json", "--markdown", "g.md", "--csv", "tables", "--plot", "g.svg"];
    let run = growth(&folder, &[&what[..], &files].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let report = folder.json("g.json");
    let growth = &report["growth"];
    let points = |curve: &str| growth[curve].as_array().unwrap().clone();
    let place = |point: &Value| {
        let size = [0, 1].map(|i| point["size_px"][i].as_u64().unwrap());
        (point["splats"].as_u64().unwrap(), size)
    };
    let (splats, pixels) = (points("over_splats"), points("over_pixels"));
    // Each once, from few to many; over sizes the middle number, of two the lesser.
    assert_eq!(splats.iter().map(place).collect::<Vec<_>>(), [(1000, [96, 96]), (2000, [96, 96])]);
    assert_eq!(pixels.iter().map(place).collect::<Vec<_>>(), [(1000, [64, 64]), (1000, [128, 128])]);
    for point in splats.iter().chain(&pixels) {
        let methods = point["methods"].as_array().unwrap();
        let names: Vec<&Value> = methods.iter().map(|method| &method["name"]).collect();
        assert_eq!(names, ["perspective", "raycast"]);
        for method in methods {
            assert!(method["splats_per_sec"].as_f64() > Some(0.0), "{method}");
            assert!(method["beside_first"]["median"].as_f64() > Some(0.0), "{method}");
            let passes = method["frames"]["passes"].as_array().unwrap();
            assert!(passes.len() == 3 && passes.iter().all(|pass| pass["ms"].is_object()), "{method}");
        }
        // A depth and two sums of 8 to 16 bytes a pixel; on a CPU images of sums have no side that is a power of two, and rows and columns by fours.
        let transient = methods[0]["transient_bytes"].as_u64().unwrap();
        let size = place(point).1;
        let pixels = |size: [u64; 2]| size[0] * size[1];
        let with_room = size.map(|side| if side.is_power_of_two() { side + 4 } else { side });
        let most = 32 * pixels(with_room) + 4 * pixels(size);
        assert!((20 * pixels(size)..=most).contains(&transient), "{transient}");
        // A position, a normal, a radius and a color; and of each block of 256 its bounds, for the ball is closed, where there are more than four.
        let count = place(point).0;
        let blocks = Some(count.div_ceil(256)).filter(|blocks| *blocks > 4);
        assert_eq!(point["splat_bytes"].as_u64(), Some(40 * count + 16 * blocks.unwrap_or(0)));
    }
    // The host holds them at least once, before they are on the device.
    let host = |point: &Value| point["host_peak_bytes"].as_u64();
    let held = |point: &Value| host(point) > Some(40 * place(point).0);
    assert!(splats.iter().chain(&pixels).all(held), "{splats:?} {pixels:?}");
    let fragments = |point: &Value| point["methods"][0]["frames"]["passes"][1]["fragments"].as_u64().unwrap();
    assert!(fragments(&pixels[1]) > fragments(&pixels[0]) && fragments(&splats[1]) > fragments(&splats[0]));
    let markdown = fs::read_to_string(folder.path("g.md")).unwrap();
    assert!(markdown.contains("| 1000 | 128x128 | raycast |"), "{markdown}");
    let tables = ["growth-passes.csv", "growth-pixels.csv", "growth-splats.csv"];
    assert_eq!(folder.names_in("tables"), tables);
    let passes = fs::read_to_string(folder.path("tables").join(tables[0])).unwrap();
    assert_eq!(passes.lines().count(), 1 + 4 * 2 * 3, "{passes}");
    let svg = fs::read_to_string(folder.path("g.svg")).unwrap();
    assert!(svg.contains("raycast") && svg.contains("1000 splats"), "{svg}");
    let few = surfel(&folder, &["bench", "growth", "--frames", "6", "--baseline", "g.json"]);
    assert!(few.code == 1 && few.stderr.contains("a gate takes 12 at least"), "{}", few.stderr);
}

#[test]
fn what_does_not_fit_is_left_out_and_told() {
    let folder = Folder::new();
    let run = growth(&folder, &["--sizes", "64,4000000000"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("note: growth: left out: 4000000000x4000000000 pixels"), "{}", run.stdout);
    assert!(run.stdout.contains("64x64"), "{}", run.stdout);
}

#[test]
fn growth_takes_closed_meshes_and_has_its_lists_alone() {
    let folder = Folder::new();
    folder.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let open = growth(&folder, &["--model", "one.obj"]);
    assert_eq!(open.code, 1, "{}", open.stderr);
    assert!(open.stderr.contains("not closed"), "{}", open.stderr);
    let refused = growth(&folder, &["--sizes", "64x"]);
    assert!(refused.code != 0 && refused.stderr.contains("the side of a square"), "{}", refused.stderr);
}

/// Without a device, whatever one can do.
#[test]
fn making_splats_of_a_mesh_is_told_and_plotted() {
    let folder = Folder::new();
    folder
        .write("tetrahedron.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    let files = ["--json", "i3.json", "--csv", "tables", "--plot", "i3.svg"];
    let run = surfel(&folder, &[&["bench", "i3", "--model", "tetrahedron.obj"], &files[..]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let rows = folder.json("i3.json")["i3"]["rows"].clone();
    // Each of its triangles has three ridges, of which a splat can be cut at two.
    assert_eq!((rows[0]["triangles"].as_u64(), rows[0]["splats"].as_u64()), (Some(4), Some(16)), "{rows}");
    assert!(rows[0]["secs"]["median"].as_f64() > Some(0.0), "{rows}");
    let text = |name: &str| fs::read_to_string(folder.path(name)).unwrap();
    assert!(text("tables/i3.csv").starts_with("triangles,splats,clipped,seconds"));
    assert!(text("i3.svg").contains("\nn log n\n"));
}
