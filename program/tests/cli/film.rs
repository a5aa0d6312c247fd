//! Films: pictures along a path, which are those of single renders, and a job that goes on where it stopped.

use std::{fs, process::Stdio, thread, time::Duration};

use super::program::{Folder, command, done, surfel, surfel_with};

const SMALL: [&str; 4] = ["--size", "40x30", "--shading", "normals"];

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write(
        "disks.ply",
        super::splats(
            "0 0 0 0 0 1 1 200 10 10\n0.5 0 0.7 1 0 0 0.5 10 200 10\n0 0.5 -0.5 0 1 0 0.5 9 9 99\n",
        ),
    );
    folder.write(
        "path.json",
        r#"{"version":1, "cameras":[
        {"time":1, "eye":[0,0,5], "target":[0,0,0], "up":[0,1,0], "fov_deg":33.3},
        {"time":2.5, "eye":[4,1,2], "target":[0.2,0,0], "up":[0,1,0.1], "fov_deg":20},
        {"time":3, "eye":[4,2,-2], "target":[0,0.1,0], "up":[0,1,0], "fov_deg":45}]}"#,
    );
    folder
}

fn bytes(folder: &Folder, name: &str) -> Vec<u8> {
    fs::read(folder.path(name)).unwrap()
}

/// Every picture has the bytes of a single render with its camera.
#[test]
fn pictures_are_those_of_single_renders() {
    let folder = folder();
    let films: [&[&str]; 2] = [
        &["--path", "path.json", "--frames", "7"],
        &["--turntable", "2", "--fps", "2.5", "--up", "z", "--elevation", "20", "--crop", "8,8,20,16"],
    ];
    for (film, count) in films.into_iter().zip([7, 5]) {
        let run = done(
            &folder,
            &[&["render", "disks.ply", "--print-camera", "-o", "a%02d.png"], film, &SMALL[..]].concat(),
        );
        let lines: Vec<&str> = run.stdout.lines().collect();
        assert_eq!(lines.len(), count);
        let crop: &[&str] = if film.contains(&"--crop") { &["--crop", "8,8,20,16"] } else { &[] };
        for (number, line) in lines.iter().enumerate() {
            let camera: Vec<&str> = line.split_whitespace().collect();
            done(
                &folder,
                &[&["render", "disks.ply", "-o", "one.png"], &camera[..], &SMALL[..], crop].concat(),
            );
            assert!(
                bytes(&folder, "one.png") == bytes(&folder, &format!("a{number:02}.png")),
                "{film:?}, {line}"
            );
        }
        let [first, last] = [0, count - 1].map(|i| bytes(&folder, &format!("a{i:02}.png")));
        assert!(first != last, "{film:?}");
        assert!(
            run.stderr.contains(&format!("a%02d.png: {count} pictures, {count} drawn, 0 there before")),
            "{}",
            run.stderr
        );
        assert!(run.stderr.contains("as a film: ffmpeg -y"), "{}", run.stderr);
    }
    // From the first place of the path to the last.
    let run = done(
        &folder,
        &[&["render", "disks.ply", "--print-camera", "--path", "path.json", "--frames", "2"], &SMALL[..]]
            .concat(),
    );
    let lines: Vec<&str> = run.stdout.lines().collect();
    assert_eq!(lines[0], "--eye 0,0,5 --target 0,0,0 --up 0,1,0 --fov 33.3");
    assert_eq!(lines[1], "--eye 4,2,-2 --target 0,0.1,0 --up 0,1,0 --fov 45");
}

const JOB: [&str; 8] = ["render", "disks.ply", "--turntable", "1", "--frames", "9", "-o", "b%d.png"];

#[test]
fn what_is_whole_and_of_the_same_job_is_kept() {
    let folder = folder();
    let run = |more: &[&str]| done(&folder, &[&JOB[..], &SMALL[..], more].concat()).stderr;
    assert!(run(&[]).contains("9 pictures, 9 drawn"));
    let before: Vec<Vec<u8>> = (0..9).map(|i| bytes(&folder, &format!("b{i}.png"))).collect();
    assert!(run(&[]).contains("9 pictures, 0 drawn, 9 there before"));
    fs::remove_file(folder.path("b3.png")).unwrap();
    fs::write(folder.path("b4.png"), &before[4][..50]).unwrap();
    fs::write(folder.path("b5.png"), &before[6]).unwrap();
    assert!(run(&[]).contains("9 pictures, 3 drawn, 6 there before"));
    assert!((0..9).all(|i| bytes(&folder, &format!("b{i}.png")) == before[i]));
    // Another job.
    assert!(run(&["--background", "0,0,0"]).contains("9 drawn"));
    assert!(run(&["--up", "z"]).contains("9 drawn"));
    let changed = String::from_utf8(bytes(&folder, "disks.ply")).unwrap().replace("200 10 10", "200 10 11");
    fs::write(folder.path("disks.ply"), changed).unwrap();
    assert!(run(&["--up", "z"]).contains("9 drawn"));
}

#[test]
fn an_interrupted_job_goes_on_to_the_same_files() {
    let folder = folder();
    let job = |count: &'static str| {
        [&["render", "--turntable", "3", "--frames", count, "-o"], &["c%03d.png", "--size", "64x64"][..]]
            .concat()
    };
    let mut child = command(&folder, &job("60")).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let is_there = || folder.path("c004.png").exists();
    for _ in 0..1200 {
        if is_there() || child.try_wait().unwrap().is_some() {
            break;
        }
        thread::sleep(Duration::from_millis(50));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let there = folder.names().iter().filter(|name| name.ends_with(".png")).count();
    assert!(is_there() && there < 60, "{there}");
    let said = done(&folder, &job("60")).stderr;
    assert!(!said.contains(" 60 drawn") && said.contains("60 pictures, "), "{said}");
    let other = Folder::new();
    done(&other, &job("60"));
    for i in 0..60 {
        let name = format!("c{i:03}.png");
        assert!(bytes(&folder, &name) == bytes(&other, &name), "{name}");
    }
}

#[cfg(unix)]
#[test]
fn a_film_is_made_by_ffmpeg_or_its_command_is_told() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = folder();
    let job = [&["render", "disks.ply", "--turntable", "0.1", "-o", "my film.mp4"], &SMALL[..]].concat();
    let run = surfel_with(&folder, &job, &[("PATH", "")]);
    assert_eq!(run.code, 1);
    assert!(
        run.stderr.contains("there is no ffmpeg; the pictures are there, and this makes the film: ffmpeg -y -loglevel error -framerate 30 -i 'my film.frames/%05d.png'"),
        "{}",
        run.stderr
    );
    assert!(folder.path("my film.frames/00002.png").exists());
    // One that writes its arguments.
    folder.write("ffmpeg", "#!/bin/sh\nfor last; do :; done\necho \"$@\" > \"$last\"\n");
    fs::set_permissions(folder.path("ffmpeg"), fs::Permissions::from_mode(0o755)).unwrap();
    let place = folder.path(".").display().to_string();
    let run = surfel_with(&folder, &job, &[("PATH", &place)]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(
        run.stderr.contains("0 drawn, 3 there before")
            && run.stderr.contains("wrote my film.mp4, 3 pictures"),
        "{}",
        run.stderr
    );
    assert!(String::from_utf8(bytes(&folder, "my film.mp4")).unwrap().contains("libx264"));
    assert!(!folder.path("my film.frames").exists() && !folder.path("my film.unfinished.mp4").exists());
    // What somebody else has there stays, and so many pictures are shown, in the time that was said, as there are: others may be left of a job before.
    let longer =
        [&["render", "disks.ply", "--turntable", "0.5", "--frames", "4", "-o", "my film.mp4"], &SMALL[..]]
            .concat();
    fs::create_dir(folder.path("my film.frames")).unwrap();
    folder.write("my film.frames/00009.png", "of a job before");
    folder.write("my film.frames/notes.txt", "mine");
    assert_eq!(surfel_with(&folder, &longer, &[("PATH", &place)]).code, 0);
    let said = String::from_utf8(bytes(&folder, "my film.mp4")).unwrap();
    assert!(said.contains("-framerate 8 ") && said.contains("-frames:v 4 "), "{said}");
    assert_eq!(fs::read_dir(folder.path("my film.frames")).unwrap().count(), 1);
    fs::remove_dir_all(folder.path("my film.frames")).unwrap();
    // One that fails.
    folder.write("ffmpeg", "#!/bin/sh\necho no encoder >&2\nexit 1\n");
    let run = surfel_with(&folder, &job, &[("PATH", &place)]);
    assert!(run.code == 1 && run.stderr.contains("my film.mp4: ffmpeg failed: no encoder"), "{}", run.stderr);
    assert!(folder.path("my film.frames/00002.png").exists());
}

/// Of what a picture tells.
#[test]
fn what_has_no_digits_is_told_once() {
    let folder = folder();
    let words = ["render", "disks.ply", "--epsilon", "1e-9"];
    let one = done(&folder, &[&words[..], &["-o", "one.png"], &SMALL].concat()).stderr;
    let film = ["--turntable", "1", "--frames", "3", "-o", "a%02d.png"];
    let all = done(&folder, &[&words[..], &film, &SMALL].concat()).stderr;
    let told = "epsilon is less than a millionth of the depth";
    assert!(one.matches(told).count() == 1 && all.matches(told).count() == 1, "{one}{all}");
    assert!(all.contains(&format!("a00.png: {told}")), "{all}");
}

#[test]
fn what_makes_no_film_is_refused() {
    let folder = folder();
    folder.write("bad.json", r#"{"version":1, "cameras":[]}"#);
    for (words, expected) in [
        (
            &["--turntable", "1", "-o", "a.png"][..],
            "--output: a.png: expected a name with the picture's number, such as out%04d.png",
        ),
        (&["--turntable", "1", "--pick", "1,1"], "--pick: is of one picture"),
        (&["--turntable", "1", "--timings", "a.json"], "--timings: is of one picture"),
        (&["--turntable", "0"], "expected seconds, 0.001 to 86400"),
        (&["--turntable", "86400", "--fps", "1000"], "--fps: 1000: more than a million pictures"),
        (&["--fps", "9"], "--fps: has no meaning for a picture"),
        (
            &["-o", "a%02d.png"],
            "--output: a%02d.png: is a film's, or its pictures'; expected --path or --turntable",
        ),
        (&["-o", "a.mp4"], "--output: a.mp4: is a film's"),
        (&["--path", "path.json", "--turntable", "1"], "cannot be used with"),
        (&["--path", "path.json", "--eye", "1,1,1"], "cannot be used with"),
        (&["--path", "bad.json"], "bad.json: path: no camera; expected one at least"),
        (&["--path", "path.json", "-o", "no/a%d.png"], "no/a0.png"),
    ] {
        let run = surfel(&folder, &[&["render", "disks.ply"], words].concat());
        assert!(run.code == 1 && run.stderr.contains(expected), "{words:?}: {}", run.stderr);
    }
}
