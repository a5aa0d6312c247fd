//! Camera files, in JSON.

use std::path::Path;

use serde::{Deserialize, de::DeserializeOwned};
use serde_json::error::Category;
use surfel::{Error, ErrorKind, Result, scene::Camera, small_file::read_small_file};

/// More than any camera file holds: what is larger is something else.
const MAX_FILE_BYTES: u64 = 1 << 16;

/// A camera file. Angles in degrees, points in world space.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraFile {
    pub eye: [f64; 3],
    pub target: [f64; 3],
    pub up: [f64; 3],
    /// Or `orthographic`.
    pub fov_deg: Option<f64>,
    /// The picture's height.
    pub orthographic: Option<f64>,
    pub near: Option<f64>,
}

/// What is expected of a file.
const KIND: &str = "a camera file (see surfel render --help)";

/// Reads a camera.
///
/// # Errors
/// A file that can't be read or is no camera, with its line.
pub fn read(path: &Path) -> Result<Camera> {
    let text = read_small_file(path, MAX_FILE_BYTES, KIND)?;
    let file: CameraFile = parse(path, &text, KIND)?;
    file.camera().map_err(|(key, problem)| Error::input(path, key, problem))
}

/// JSON of a known form: that of `kind`.
///
/// # Errors
/// What is not of that form, with its line.
pub fn parse<T: DeserializeOwned>(path: &Path, text: &[u8], kind: &str) -> Result<T> {
    serde_json::from_slice(text).map_err(|e| {
        let (line, column) = (e.line(), e.column());
        let problem = e.to_string();
        let problem = problem.strip_suffix(&format!(" at line {line} column {column}")).unwrap_or(&problem);
        let is_json = matches!(e.classify(), Category::Data);
        let problem = if is_json {
            problem.to_owned()
        } else {
            format!("{problem}, which is no JSON; expected {kind}")
        };
        Error::input(path, format!("line {line}, column {column}"), problem)
    })
}

impl CameraFile {
    /// The camera, or what is wrong with which key; without one, with all of it.
    pub fn camera(self) -> std::result::Result<Camera, (&'static str, String)> {
        let fov_deg = match (self.fov_deg, self.orthographic) {
            (Some(_), Some(_)) => {
                return Err(("", "both fov_deg and orthographic; expected one of them".to_owned()));
            }
            (None, None) => {
                return Err(("", "neither fov_deg nor orthographic; expected one of them".to_owned()));
            }
            (fov_deg, _) => fov_deg,
        };
        let camera = Camera {
            eye: self.eye.into(),
            target: self.target.into(),
            up: self.up.into(),
            fov_y_rad: fov_deg.map_or(Camera::DEFAULT_FOV_Y_RAD, f64::to_radians),
            orthographic_height: self.orthographic,
            near: self.near,
            ..Camera::default()
        };
        match camera.validate() {
            Ok(()) => Ok(camera),
            Err(error) => Err(match error.kind() {
                ErrorKind::Option { option, problem } => match option.as_str() {
                    "--fov" => ("fov_deg", problem.clone()),
                    "--orthographic" => ("orthographic", problem.clone()),
                    _ => ("", problem.clone()),
                },
                _ => ("", error.to_string()),
            }),
        }
    }
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
