//! The examples, each run as its head says, under validation, about which none of them is silent: it ends with an error then.

use std::{path::PathBuf, process::Command};

use temp_dir::TempDir;

/// `cargo test` builds examples beside the tests; `cargo test --test cli` alone does not.
fn example(name: &str) -> PathBuf {
    let here = std::env::current_exe().unwrap();
    let file = here.parent().and_then(|deps| deps.parent()).unwrap().join("examples").join(name);
    assert!(file.exists(), "{} is not there: cargo build --release --examples", file.display());
    file
}

#[test]
fn every_example_leaves_its_pictures_and_the_layer_is_silent() {
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.child(name);
    let relief = surfel::load::builtin::relief(5000);
    surfel::save::splats(&at("relief.ply"), &relief.splats, relief.closed, None, &()).unwrap();
    let splats = "relief.ply".to_owned();
    let runs: [(&str, Vec<String>, Vec<&str>); 7] = [
        ("minimal", vec!["minimal.png".to_owned()], vec!["minimal.png"]),
        ("minimal", vec!["of_file.png".to_owned(), splats], vec!["of_file.png"]),
        ("turntable", vec!["2".to_owned(), "turn%04d.png".to_owned()], vec!["turn0000.png", "turn0001.png"]),
        ("embed", vec!["embed.png".to_owned()], vec!["embed.png"]),
        ("custom_pass", vec!["custom_pass.png".to_owned()], vec!["custom_pass.png"]),
        ("stereo", vec!["stereo.png".to_owned()], vec!["stereo.png"]),
        ("animated", vec!["2".to_owned(), "wave%04d.png".to_owned()], vec!["wave0000.png", "wave0001.png"]),
    ];
    let mut tried = 0;
    for (name, arguments, files) in runs {
        let run = Command::new(example(name)).args(arguments).current_dir(folder.path()).output().unwrap();
        let said = String::from_utf8_lossy(&run.stderr);
        assert!(run.status.success() && said.is_empty(), "{name}: {said}");
        let pictures: Vec<_> = files.iter().map(|file| image::open(at(file)).unwrap().into_rgb8()).collect();
        for picture in &pictures {
            let first = picture.get_pixel(0, 0);
            let other = picture.pixels().filter(|pixel| *pixel != first).count();
            assert!(other > picture.len() / 3 / 10, "{name}: {other} pixels of something");
        }
        if let [one, other] = pictures.as_slice() {
            assert_ne!(one, other, "{name}: what moves");
        }
        tried += 1;
    }
    assert_eq!(tried, 7);
}
