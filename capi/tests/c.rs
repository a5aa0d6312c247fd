//! Programs in C, compiled by the system's compiler, run under validation.

mod through_rust;

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

use temp_dir::TempDir;

/// Where a pixel of the example is of a board, and the color of that.
const BOARD: [f32; 3] = [0.9, 0.4, 0.05];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Where cargo has built the two libraries.
fn libraries() -> PathBuf {
    env::current_exe().unwrap().parent().unwrap().to_owned()
}

/// Runs a command, which must succeed and say nothing.
fn run(command: &mut Command) {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let said = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success() && said.iter().all(String::is_empty), "{command:?}: {}", said.concat());
}

/// The system's compiler, for C11 without a warning.
fn cc(out: &Path) -> Command {
    let mut cc = Command::new(env::var_os("CC").unwrap_or_else(|| "cc".into()));
    cc.args(["-std=c11", "-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-o"]).arg(out);
    cc.arg(format!("-I{}", root().join("examples/embed_c").display()));
    cc
}

/// Where the header is, for a compiler.
fn header() -> String {
    format!("-I{}", root().join("capi/include").display())
}

fn engine() -> PathBuf {
    root().join("examples/embed_c/engine.c")
}

/// The picture of a PFM file, the top row first.
fn picture(file: &Path) -> Vec<[f32; 3]> {
    let bytes = fs::read(file).unwrap();
    let head = b"PF\n640 480\n-1.0\n";
    assert!(bytes.starts_with(head));
    let floats = bytes[head.len()..].as_chunks().0.iter().map(|bytes| f32::from_le_bytes(*bytes));
    let floats: Vec<f32> = floats.collect();
    let rows: Vec<_> = floats.as_chunks().0.chunks(640).rev().collect();
    rows.concat()
}

/// What the compiler needs for the libraries that `capi/install` has put below a folder.
fn flags(prefix: &Path) -> Vec<String> {
    let mut install = Command::new(root().join("capi/install"));
    run(install.arg(prefix).arg(libraries()).env_remove("DESTDIR"));
    let mut pkg_config = Command::new("pkg-config");
    pkg_config.args(["--cflags", "--libs", "surfel"]).env("PKG_CONFIG_PATH", prefix.join("lib/pkgconfig"));
    let output = pkg_config.output().expect("third_party/with-deps installs pkg-config");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().split_whitespace().map(str::to_owned).collect()
}

#[test]
fn a_host_in_c_draws_what_a_host_in_rust_does() {
    let folder = TempDir::new().unwrap();
    let (program, shared) = (folder.child("embed_c"), folder.child("libengine.so"));
    let mut cc_program = cc(&program);
    cc_program.arg(root().join("examples/embed_c/main.c")).arg(engine());
    let prefix = folder.child("prefix");
    run(cc_program.args(flags(&prefix)).args(["-lvulkan", "-lm"]));
    let file = folder.child("out.pfm");
    run(Command::new(&program).arg(&file).env("LD_LIBRARY_PATH", prefix.join("lib")));
    let by_c = picture(&file);

    run(cc(&shared).args(["-shared", "-fPIC"]).arg(engine()).args(["-lvulkan", "-lm"]));
    let by_rust = through_rust::picture(&shared);
    let count = |what: fn(&[f32; 3]) -> bool| by_c.iter().filter(|pixel| what(pixel)).count();
    let (board, gray) = (count(|pixel| *pixel == BOARD), count(|pixel| *pixel == [0.2; 3]));
    println!("{board} pixels of the board, {gray} of nothing");
    assert!(board > 10_000 && gray > 50_000 && by_c.len() - board - gray > 40_000);
    assert!(by_c == by_rust, "the same bytes");
}

#[test]
fn wrong_use_has_codes_and_any_order_of_ends_is_sound() {
    let folder = TempDir::new().unwrap();
    let (program, splats, garbage) =
        (folder.child("refusals"), folder.child("four.ply"), folder.child("garbage.ply"));
    let properties =
        ["x", "y", "z", "nx", "ny", "nz", "radius"].map(|name| format!("property float {name}\n"));
    let head = format!("ply\nformat ascii 1.0\nelement vertex 4\n{}end_header\n", properties.concat());
    fs::write(&splats, head + &"0 0 0 0 0 1 0.5\n".repeat(4)).unwrap();
    fs::write(&garbage, "ply\nformat ascii 1.0\nelement vertex many\n").unwrap();
    // Against the static library, of which the linker takes what is needed.
    let mut cc = cc(&program);
    let sources = [
        "refusals.c",
        "frames.c",
        "objects.c",
        "rooms.c",
        "levels.c",
        "shapes.c",
        "hybrid.c",
        "defects.c",
        "lights.c",
        "names.c",
        "steady.c",
        "memory.c",
    ]
    .map(|name| root().join("capi/tests/c_programs").join(name));
    cc.arg(header()).args(sources).arg(engine());
    cc.arg(libraries().join("libsurfel_c.a"));
    // For steady.c, which counts.
    cc.args(
        ["malloc", "calloc", "realloc", "posix_memalign"].map(|function| format!("-Wl,--wrap={function}")),
    );
    run(cc.args(["-lvulkan", "-lpthread", "-ldl", "-lm", "-lgcc_s"]));
    run(Command::new(&program).args([&splats, &garbage]));
}

/// A picture of our own device is that of the same device in Rust, to the byte.
#[test]
fn a_program_without_a_device_reads_makes_saves_and_draws() {
    let folder = TempDir::new().unwrap();
    let (program, below) = (folder.child("alone"), folder.child("below"));
    let [ply, png, exr, raw] = ["cube.ply", "a.png", "a.exr", "a.raw"].map(|name| folder.child(name));
    fs::create_dir(&below).unwrap();
    let [scene_file, fitted] = ["scene.toml", "fitted.toml"].map(|name| below.join(name));
    fs::write(&scene_file, "shading = \"lambert\"\n[camera]\neye = [0, 0, 9]\nfov_deg = 60\n[[object]]\nfile = \"../cube.ply\"\n").unwrap();
    fs::write(&fitted, "[camera]\ntarget = \"box\"\n[[object]]\nfile = \"../cube.ply\"\nname = \"box\"\n")
        .unwrap();
    let mut cc = cc(&program);
    let sources =
        ["alone.c", "models.c", "scene_files.c"].map(|name| root().join("capi/tests/c_programs").join(name));
    cc.arg(header()).args(sources).arg(libraries().join("libsurfel_c.a"));
    run(cc.args(["-lpthread", "-ldl", "-lm", "-lgcc_s"]));
    run(Command::new(&program).args([&ply, &scene_file, &fitted, &png, &exr, &raw]));
    let by_rust = through_rust::headless::picture();
    assert!(fs::read(&raw).unwrap() == by_rust.as_flattened(), "the same bytes");
    assert!(fs::read(&png).unwrap() == surfel::save::png_bytes([96; 2], 4, by_rust.as_flattened()).unwrap());
    assert!(fs::metadata(&exr).unwrap().len() > 1000);
}

/// Its structs have no padding, which later versions could not tell from members; and C++ takes it, too.
#[test]
fn the_header_stands_alone() {
    let folder = TempDir::new().unwrap();
    let [c, cpp] = ["header.c", "header.cpp"].map(|name| folder.child(name));
    let text = "#include <surfel.h>\nint main(void) { return surfel_version() != SURFEL_VERSION; }\n";
    for file in [&c, &cpp] {
        fs::write(file, text).unwrap();
    }
    run(cc(&folder.child("header.o")).args(["-Wpadded", "-c"]).arg(header()).arg(&c));
    let mut compiler = Command::new(env::var_os("CXX").unwrap_or_else(|| "c++".into()));
    compiler.args(["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only"]);
    run(compiler.arg(header()).arg(&cpp));
}
