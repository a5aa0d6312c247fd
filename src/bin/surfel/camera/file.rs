//! Camera files, in JSON.

use std::path::Path;

use serde::Deserialize;
use surfel::{Error, ErrorKind, Result, scene::Camera, small_file::read_small_file};

/// More than any camera file holds: what is larger is something else.
const MAX_FILE_BYTES: u64 = 1 << 16;

/// A camera file. Angles in degrees, points in world space.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraFile {
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    /// Or `orthographic`.
    fov_deg: Option<f64>,
    /// The picture's height.
    orthographic: Option<f64>,
    near: Option<f64>,
}

/// Reads a camera.
///
/// # Errors
/// A file that can't be read or is no camera, with its line.
pub fn read(path: &Path) -> Result<Camera> {
    let text = read_small_file(path, MAX_FILE_BYTES, "a camera file (see surfel render --help)")?;
    let file: CameraFile = serde_json::from_slice(&text).map_err(|e| {
        let (line, column) = (e.line(), e.column());
        let problem = e.to_string();
        let problem = problem.strip_suffix(&format!(" at line {line} column {column}")).unwrap_or(&problem);
        Error::input(path, format!("line {line}, column {column}"), problem)
    })?;
    let projection = |problem: &str| Error::input(path, "", problem);
    let fov_deg = match (file.fov_deg, file.orthographic) {
        (Some(_), Some(_)) => {
            return Err(projection("both fov_deg and orthographic; expected one of them"));
        }
        (None, None) => return Err(projection("neither fov_deg nor orthographic; expected one of them")),
        (fov_deg, _) => fov_deg,
    };
    let camera = Camera {
        eye: file.eye.into(),
        target: file.target.into(),
        up: file.up.into(),
        fov_y_rad: fov_deg.map_or(Camera::DEFAULT_FOV_Y_RAD, f64::to_radians),
        orthographic_height: file.orthographic,
        near: file.near,
        ..Camera::default()
    };
    camera.validate().map_err(|error| match error.kind() {
        ErrorKind::Option { option, problem } => {
            let key = match option.as_str() {
                "--fov" => "fov_deg",
                "--orthographic" => "orthographic",
                _ => "",
            };
            Error::input(path, key, problem.as_str())
        }
        _ => error,
    })?;
    Ok(camera)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use glam::DVec3;

    use super::*;

    fn parsed(text: &str) -> std::result::Result<Camera, String> {
        let folder = temp_dir::TempDir::new().unwrap();
        let path = folder.path().join("cam.json");
        fs::write(&path, text).unwrap();
        read(&path).map_err(|e| {
            assert_eq!(e.exit_code(), 1);
            e.to_string().replace(&path.display().to_string(), "cam.json")
        })
    }

    #[test]
    fn a_camera_file_is_read_with_and_without_near_of_either_projection() {
        let text = r#"{"eye":[1,2,3], "target":[0,0,0], "up":[0,1,0], "fov_deg":90"#;
        let camera = parsed(&format!("{text}}}")).unwrap();
        assert_eq!((camera.eye, camera.near), (DVec3::new(1.0, 2.0, 3.0), None));
        assert!((camera.fov_y_rad - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
        assert_eq!(parsed(&format!("{text}, \"near\":0.5}}")).unwrap().near, Some(0.5));
        let parallel = parsed(&format!("{text}}}").replace("fov_deg\":90", "orthographic\":2.5")).unwrap();
        assert_eq!((parallel.orthographic_height, parallel.near()), (Some(2.5), 0.0));
    }

    #[test]
    fn faults_are_named_with_their_place() {
        let near = |near: &str| {
            format!(r#"{{"eye":[1,2,3], "target":[0,0,0], "up":[0,1,0], "fov_deg":45, "near":{near}}}"#)
        };
        let cases = [
            (
                "{\n\"eye\": [1,2],\n}",
                "cam.json: line 2, column 12: invalid length 2, expected an array of length 3",
            ),
            ("{\n\"eyes\": 1}", "cam.json: line 2, column 6: unknown field `eyes`, expected one of"),
            ("{}", "cam.json: line 1, column 2: missing field `eye`"),
            ("", "cam.json: line 1, column 0: EOF while parsing a value"),
            (&near("0"), "cam.json: near must be above zero"),
            (
                &near("1").replace("fov_deg\":45", "orthographic\":-1"),
                "cam.json: orthographic: -1: expected a height above 0",
            ),
            (
                &near("1").replace("fov_deg\":45", "fov_deg\":45, \"orthographic\":1"),
                "cam.json: both fov_deg and orthographic; expected one of them",
            ),
            (&near("1").replace("\"fov_deg\":45,", ""), "cam.json: neither fov_deg nor orthographic"),
            (&near("1e400"), "cam.json: line 1, column 74: number out of range"),
            (
                &near("1").replace("45", "180"),
                "cam.json: fov_deg: 180: expected degrees above 1e-10 and below 180",
            ),
            (&near("1").replace("1,2,3", "0,0,0"), "cam.json: eye and target must be two different points"),
            (&" ".repeat(100_000), "cam.json: 100000 bytes; expected a camera file"),
        ];
        for (text, expected) in cases {
            let error = parsed(text).unwrap_err();
            assert!(error.starts_with(expected), "{error}");
        }
    }
}
