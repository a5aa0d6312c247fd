//! Files that are no models, or broken ones: each ends with exit code 1 and one line that names what was found, in
//! seconds and without more memory than the file explains.

use std::{
    io::Write as _,
    process::Stdio,
    time::{Duration, Instant},
};

use super::program::{Folder, Run, command, run};

/// Beside 16 times the file, the program may take this much.
const KIB: u64 = 64 << 10;

/// Runs `info` on the file, and tells the most memory that it took, in KiB: what its allocator counted, or what the system saw that it
/// held, whichever is more.
///
/// The allocator knows what was asked for and never touched, the system what other libraries took. The system keeps the peak, not just the
/// present value, so that what is missed is at most what was taken within the last moment.
fn watched(folder: &Folder, name: &str) -> (Run, u64) {
    let counted = folder.path("peak");
    let mut program = command(folder, &["info", name]);
    program.env("SURFEL_PEAK_FILE", &counted).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = program.spawn().unwrap();
    let (status, start) = (format!("/proc/{}/status", child.id()), Instant::now());
    let mut peak = 0;
    while child.try_wait().unwrap().is_none() {
        let told = std::fs::read_to_string(&status).unwrap_or_default();
        let held = told.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB"));
        peak = held.map_or(peak, |held| held.trim().parse().unwrap());
        if start.elapsed() > Duration::from_secs(10) {
            child.kill().unwrap();
            panic!("{name} takes more than 10 s");
        }
        std::thread::sleep(Duration::from_micros(200));
    }
    let counted: u64 = std::fs::read_to_string(counted).unwrap().parse().unwrap();
    assert!(counted > 0);
    (run(child.wait_with_output().unwrap()), peak.max(counted / 1024))
}

#[track_caller]
fn refused(name: &str, bytes: &[u8], words: &str) {
    let folder = Folder::new();
    folder.write(name, bytes);
    is_refused(&folder, name, bytes.len() as u64, words);
}

#[track_caller]
fn is_refused(folder: &Folder, name: &str, bytes: u64, words: &str) {
    let (run, peak) = watched(folder, name);
    let line = run.stderr.strip_suffix('\n').unwrap_or_default();
    assert!(
        !line.contains('\n') && line.starts_with(&format!("surfel: {name}: ")),
        "not one line:\n{}",
        run.stderr
    );
    assert!(line.contains(words), "'{words}' is not in: {line}");
    assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{line}");
    let most = KIB + 16 * bytes / 1024;
    assert!(peak <= most, "{name} of {bytes} bytes takes {peak} KiB; expected at most {most}");
}

#[test]
fn what_is_no_model() {
    refused("a.ply", b"", "the file is empty; expected a PLY, OBJ, STL");
    refused("a.stl", b"", "the file is empty");
    refused("a.obj", b"<!DOCTYPE html>\n<html><body>404</body></html>\n", "this is an HTML page");
    refused(
        "a.las",
        b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n",
        "git-lfs pointer",
    );
    refused("a.ply", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "this is a PNG picture");
    refused("a.e57", b"PK\x03\x04\x14\0\0\0\x08\0", "this is a zip archive");
    refused("notes.md", b"# Notes\n\nNothing to see here, and no numbers.\n", "text of an unknown format");
    refused("a.xyz", &[0; 1000], "named .xyz, but its content is binary of another format");
    refused("a.obj", b"v 0 0 0\nv 1 0 \0\0\nv 0 1 0\n", "named .obj, but its content is binary");
    let folder = Folder::new();
    std::fs::create_dir(folder.path("folder.ply")).unwrap();
    is_refused(&folder, "folder.ply", 0, "a folder; expected a PLY");
}

#[test]
fn files_that_end_too_soon() {
    let points = super::formats::points_far_away();
    for (name, words) in [
        ("binary.ply", "expected"),
        ("a.pts", "expected"),
        ("a.pcd", "expected"),
        ("a.las", "expected"),
        ("a.laz", ""),
        ("a.e57", ""),
    ] {
        let bytes = &points.iter().find(|(other, _)| *other == name).unwrap().1;
        refused(name, &bytes[..bytes.len() / 2], words);
    }
    let mesh = super::formats::meshes_far_away();
    for (name, words) in [("mesh.ply", "expected"), ("mesh.off", "expected"), ("mesh.glb", "")] {
        let bytes = &mesh.iter().find(|(other, _)| *other == name).unwrap().1;
        refused(name, &bytes[..bytes.len() / 2], words);
    }
}

#[test]
fn counts_that_no_file_of_the_size_can_hold() {
    let ply = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n\
        property float y\nproperty float z\nend_header\n";
    refused("a.ply", ply.as_bytes(), "4000000000");
    refused("a.off", b"OFF\n353535235358 1 0\n0 0 0\n", "353535235358");
    let pcd = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 4000000000\nHEIGHT 1\nDATA binary\n";
    refused("a.pcd", pcd.as_bytes(), "4000000000");
    refused("a.pts", b"4000000000\n0 0 0\n1 0 0\n", "4000000000");
    let stl = [&[b' '; 80][..], &4_000_000_000_u32.to_le_bytes(), &[0; 100]].concat();
    refused("a.stl", &stl, "4000000000");
}

#[test]
fn a_small_file_that_expands_without_end() {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    // Ten thousand to one needs more than deflate's thousand to one has: compressed twice.
    (0..200).for_each(|_| encoder.write_all(&[b'0'; 1 << 20]).unwrap());
    let once = encoder.finish().unwrap();
    refused("a.xyz.gz", &once, "expands to more than");
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    encoder.write_all(&once).unwrap();
    let twice = encoder.finish().unwrap();
    assert!(twice.len() * 10_000 < 200 << 20, "{}", twice.len());
    refused("a.xyz.gz", &twice, "compressed twice, by gzip and gzip; expected once");
}

/// The smallest points, all at one place, in a file that becomes a thousandth.
#[test]
fn small_files_of_many_equal_points() {
    let count = 10_000_000;
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {count}\nproperty uchar x\nproperty uchar y\n\
        property uchar z\nend_header\n"
    );
    encoder.write_all(header.as_bytes()).unwrap();
    encoder.write_all(&vec![0; 3 * count]).unwrap();
    refused("a.ply.gz", &encoder.finish().unwrap(), "expands to more than");
}

#[test]
fn a_small_mesh_in_many_places() {
    let nodes = vec![r#"{"mesh":0}"#; 5000].join(",");
    let gltf = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{nodes}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3000,"type":"VEC3"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36000}}],
        "buffers":[{{"byteLength":36000,"uri":"data:;base64,{}"}}]}}"#,
        "A".repeat(48_000)
    );
    refused("a.gltf", gltf.as_bytes(), "15000000 vertices in all nodes together, about ");
}

#[test]
fn lines_without_end() {
    let ones = "1".repeat(200 << 20);
    let words = "line 2: a line of more than 1048576 bytes";
    refused("a.xyz", format!("0 0 0\n1 1 {ones}").as_bytes(), words);
    refused("a.xyz", format!("0 0 0\n1 1 1{}\n2 2 2\n", ones.replace('1', " ")).as_bytes(), words);
    refused("a.off", format!("OFF\n3 1 0\n{ones}\n").as_bytes(), "line 3: longer than 1048576 bytes");
}

#[test]
fn scene_files_of_many_values() {
    let values = |count: usize| format!("a = [{}0]\n", "0,".repeat(count));
    refused("a.toml", values(500_000).as_bytes(), "expected a scene file, at most 262144");
    refused("a.toml", values(131_000).as_bytes(), "line 1: unknown key 'a'");
}

#[test]
fn text_that_is_nested_without_end() {
    let (open, close) = ("[".repeat(100_000), "]".repeat(100_000));
    let gltf = format!(r#"{{"asset": {{"version": "2.0"}}, "extras": {open}{close}}}"#);
    refused("a.gltf", gltf.as_bytes(), "without triangles; expected some");
    let gltf = format!(r#"{{"asset": {{"version": "2.0"}}, "nodes": {open}{close}}}"#);
    refused("a.gltf", gltf.as_bytes(), "line 1");
    refused("a.toml", format!("a = {open}{close}\n").as_bytes(), "line 1");
    refused("b.toml", format!("{}\nb = 1\n", "a.".repeat(100_000) + "a = 1").as_bytes(), "");
    refused("a.gltf", open.as_bytes(), "text of an unknown format");
}

#[test]
fn words_where_numbers_are_expected() {
    refused("a.xyz", b"0 0 0\n1 0 0\n0 one 0\n", "line 3");
    refused("a.csv", b"x,y,z\n0,0,0\n1,0\n", "line 3");
    refused("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 x 0\nf 1 2 3\n", "line 3");
    refused("a.off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "7");
}

/// Nothing is made of them before they are left out.
#[test]
fn small_vertices_that_no_face_uses() {
    let count = 5_000_000;
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {count}\nproperty uchar x\nproperty uchar y\n\
        property uchar z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    );
    // A face of one vertex three times.
    let bytes = [header.as_bytes(), &vec![0; 3 * count], &[3], &[0; 12]].concat();
    refused("a.ply", &bytes, "no splat can be drawn");
}
