//! Files of camera paths, in JSON.

use std::path::Path;

use serde::{Deserialize, Serialize};
use surfel::{
    Error, ErrorKind, Result,
    scene::{Camera, CameraPath, Interpolation},
    small_file::read_small_file,
};

use super::file::CameraFile;

/// More than any path takes that somebody made: what is larger is something else.
const MAX_FILE_BYTES: u64 = 1 << 24;

/// What is expected of a file.
const KIND: &str = "a path of cameras (see surfel render --help)";

/// The only version.
const VERSION: u32 = 1;

/// A path file. Times in seconds; cameras are those of camera files.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct PathFile {
    version: u32,
    #[serde(default = "smooth")]
    interpolation: String,
    cameras: Vec<TimedCamera>,
}

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct TimedCamera {
    time: f64,
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    fov_deg: Option<f64>,
    orthographic: Option<f64>,
    near: Option<f64>,
}

fn smooth() -> String {
    Interpolation::Smooth.name().to_owned()
}

/// Reads a path.
///
/// # Errors
/// A file that can't be read or is no path, with its line or the number of its camera.
pub fn read(path: &Path) -> Result<CameraPath> {
    let text = read_small_file(path, MAX_FILE_BYTES, KIND)?;
    let file: PathFile = super::file::parse(path, &text, KIND)?;
    let fault = |place: &str, problem: String| Error::input(path, place, problem);
    if file.version != VERSION {
        return Err(fault("version", format!("{}: expected {VERSION}", file.version)));
    }
    let known = Interpolation::NAMES.iter().find(|(name, _)| *name == file.interpolation);
    let Some((_, interpolation)) = known else {
        let names = Interpolation::NAMES.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(" or ");
        return Err(fault("interpolation", format!("'{}': expected {names}", file.interpolation)));
    };
    let key = |(i, camera): (usize, TimedCamera)| {
        let TimedCamera { time, eye, target, up, fov_deg, orthographic, near } = camera;
        let camera = CameraFile { eye, target, up, fov_deg, orthographic, near }.camera();
        camera.map(|camera| (time, camera)).map_err(|(key, problem)| {
            let key = if key.is_empty() { String::new() } else { format!(": {key}") };
            fault(&format!("camera {}{key}", i + 1), problem)
        })
    };
    let keys = file.cameras.into_iter().enumerate().map(key).collect::<Result<Vec<_>>>()?;
    CameraPath::new(*interpolation, keys).map_err(|error| match error.kind() {
        ErrorKind::Option { option, problem } => fault(option, problem.clone()),
        _ => error,
    })
}

/// A path as a file, from which [`read`] makes it again.
///
/// # Errors
/// None that is known.
pub fn text(path: &CameraPath) -> Result<String> {
    let camera = |(time, camera): &(f64, Camera)| TimedCamera {
        time: *time,
        eye: camera.eye.into(),
        target: camera.target.into(),
        up: camera.usable_up().into(),
        fov_deg: (!camera.is_orthographic()).then(|| super::words::degrees(camera.fov_y_rad)),
        orthographic: camera.orthographic_height,
        near: camera.near,
    };
    crate::json::to_json(&PathFile {
        version: VERSION,
        interpolation: path.interpolation().name().to_owned(),
        cameras: path.keys().iter().map(camera).collect(),
    })
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn parsed(text: &str) -> std::result::Result<CameraPath, String> {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join("path.json");
        fs::write(&path, text).unwrap();
        read(&path).map_err(|e| e.to_string().replace(&path.display().to_string(), "path.json"))
    }

    const TWO: &str = r#"{"version": 1, "cameras": [
{"time": 0, "eye": [0,0,5], "target": [0,0,0], "up": [0,1,0], "fov_deg": 33.3, "near": 0.5},
{"time": 2, "eye": [5,0,0], "target": [0,0,0], "up": [0,1,0], "fov_deg": 45, "near": 0.25}]}"#;

    #[test]
    fn a_path_comes_back_as_it_was_written() {
        let path = parsed(TWO).unwrap();
        assert_eq!((path.interpolation(), path.times()), (Interpolation::Smooth, [0.0, 2.0]));
        assert_eq!(parsed(&text(&path).unwrap()).unwrap(), path);
        let linear = TWO.replace("1, \"c", "1, \"interpolation\": \"linear\", \"c");
        assert_eq!(parsed(&linear).unwrap().interpolation(), Interpolation::Linear);
        let parallel = TWO
            .replace("\"fov_deg\": 33.3", "\"orthographic\": 3")
            .replace("\"fov_deg\": 45", "\"orthographic\": 4");
        let path = parsed(&parallel).unwrap();
        assert_eq!(parsed(&text(&path).unwrap()).unwrap(), path);
    }

    #[test]
    fn faults_are_named_with_their_place() {
        for (from, to, expected) in [
            ("\"version\": 1", "\"version\": 2", "path.json: version: 2: expected 1"),
            ("\"version\": 1, ", "", "path.json: line 3, column"),
            (
                "1, \"c",
                "1, \"interpolation\": \"cubic\", \"c",
                "path.json: interpolation: 'cubic': expected smooth or linear",
            ),
            ("\"time\": 2", "\"time\": 0", "path.json: camera 2: time 0 after 0; expected a later one"),
            ("\"fov_deg\": 45", "\"fov_deg\": 180", "path.json: camera 2: fov_deg: 180: expected degrees"),
            ("\"fov_deg\": 45, ", "", "path.json: camera 2: neither fov_deg nor orthographic"),
            (", \"near\": 0.25", "", "path.json: camera 2: near is there"),
            ("[5,0,0]", "[0,0,0]", "path.json: camera 2: eye and target must be two different points"),
            ("\"time\": 2", "\"tyme\": 2", "path.json: line 3, column 7: unknown field `tyme`"),
        ] {
            let error = parsed(&TWO.replace(from, to)).unwrap_err();
            assert!(error.starts_with(expected), "{error}");
        }
        assert!(
            parsed(r#"{"version": 1, "cameras": []}"#)
                .unwrap_err()
                .ends_with("no camera; expected one at least")
        );
    }
}
