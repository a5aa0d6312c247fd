//! `--dump`: what a device draws beside the oracle's, value by value.

use std::fs;

use super::{
    files::{exr, png},
    program::{Folder, done},
};

#[test]
fn render_and_reference_agree() {
    let folder = Folder::new();
    let options = ["--size", "96x64", "--accumulate", "f32", "--eye", "0.5,1,2.5", "--fov", "40"];
    let run = |subcommand: &str, dump: &str| {
        let words = [&[subcommand, "-o", "a.png", "--dump", dump], &options[..]].concat();
        done(&folder, &words);
        png(&folder.path("a.png"))
    };
    let pictures = [run("render", "gpu"), run("reference", "new/cpu")];
    assert_eq!(folder.names_in("gpu"), folder.names_in("new/cpu"));
    assert_eq!(folder.names_in("gpu"), ["albedo.exr", "depth.exr", "final.exr", "normal.exr", "weight.exr"]);
    let both = |name: &str| {
        [exr(&folder.path(&format!("gpu/{name}"))), exr(&folder.path(&format!("new/cpu/{name}")))]
    };

    let [gpu, cpu] = both("weight.exr");
    assert_eq!(
        (gpu.size, gpu.channels.keys().map(String::as_str).collect::<String>()),
        ([96, 64], "Y".into())
    );
    let (covered, beyond) = compare(&gpu.channels["Y"], &cpu.channels["Y"], |g, c| (g - c).abs() <= 1e-3 * c);
    println!("weight: {covered} pixels covered, {beyond} beyond 1e-3");
    assert!(covered > 1000, "{covered}");
    // Rounding may turn a fragment at a rim or at the threshold of the surface; one pixel in five hundred may have one.
    assert!(beyond * 500 <= covered, "{beyond} of {covered}");

    let [gpu, cpu] = both("depth.exr");
    let empty = |values: &[f32]| values.iter().filter(|z| **z == f32::INFINITY).count();
    assert!(empty(&gpu.channels["Z"]) > 100 && empty(&gpu.channels["Z"]) == empty(&cpu.channels["Z"]));
    let (_, beyond) = compare(&gpu.channels["Z"], &cpu.channels["Z"], |g, c| (g - c).abs() <= 1e-3 * c);
    assert!(beyond * 500 <= covered, "{beyond} of {covered}");

    for (name, channels) in [("albedo.exr", "BGR"), ("normal.exr", "XYZ"), ("final.exr", "ABGR")] {
        let [gpu, cpu] = both(name);
        assert_eq!(gpu.channels.keys().map(String::as_str).collect::<String>(), channels);
        for (channel, values) in &gpu.channels {
            let (_, beyond) = compare(values, &cpu.channels[channel], |g, c| (g - c).abs() <= 0.01);
            assert!(beyond * 100 <= covered, "{name} {channel}: {beyond} of {covered}");
        }
    }
    let [gpu, cpu] = pictures;
    let differ = gpu.pixels.iter().zip(&cpu.pixels).filter(|(g, c)| g.abs_diff(**c) > 2).count();
    assert!(differ * 100 <= gpu.pixels.len(), "{differ} of {} bytes of the PNGs differ", gpu.pixels.len());
}

/// How many pixels the second has, and in how many the first is not close to it.
fn compare(gpu: &[f32], cpu: &[f32], close: fn(f32, f32) -> bool) -> (usize, usize) {
    assert_eq!(gpu.len(), cpu.len());
    let covered = cpu.iter().filter(|value| **value != 0.0 && value.is_finite()).count();
    let beyond = gpu.iter().zip(cpu).filter(|(g, c)| **g != **c && !close(**g, **c)).count();
    (covered, beyond)
}

#[test]
fn the_picture_is_the_same_with_and_without_a_dump_and_as_floats() {
    let folder = Folder::new();
    // A dump has the sums, of which those of 16 bits are rounded before they are shaded, not after.
    let f32 = ["--accumulate", "f32"];
    for words in [&["-o", "a.png"][..], &["-o", "b.png", "--dump", "d"], &["-o", "c.exr", "--frames", "1"]] {
        done(&folder, &[&["render", "--size", "64x64"], &f32[..], words].concat());
    }
    assert_eq!(fs::read(folder.path("a.png")).unwrap(), fs::read(folder.path("b.png")).unwrap());
    let (whole, dumped) = (exr(&folder.path("c.exr")), exr(&folder.path("d/final.exr")));
    // The dump sums the depth as well, which leaves the color as it is; and it shades in another stage: some ten operations, in
    // an order that each stage's compiler decides, of colors up to 1.2.
    for (name, values) in &whole.channels {
        let (_, differ) = compare(values, &dumped.channels[name], |a, b| (a - b).abs() < 20.0 * f32::EPSILON);
        assert_eq!(differ, 0, "{name}");
    }
}
