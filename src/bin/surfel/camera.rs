//! The camera: from a file, from options, or fitted to the scene.

use std::path::{Path, PathBuf};

use clap::Args;
use glam::DVec3;
use serde::Deserialize;
use surfel::{
    Error, ErrorKind, Result,
    scene::{Camera, CameraParts, PictureHeight},
    small_file::read_small_file,
};

use crate::{
    parse,
    scene::Loaded,
    up::{self, Up},
};

/// The camera.
#[derive(Args)]
#[command(next_help_heading = "Camera")]
pub struct CameraArguments {
    /// Read the camera from this file
    #[arg(long, value_name = "FILE.json", conflicts_with_all = ["eye", "target", "up", "fov", "orthographic"])]
    pub camera: Option<PathBuf>,

    /// The eye [default: on +z from the target, so far that the scene fits; on -y where z is up, and above it where nobody
    /// said that z is]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::triple, allow_hyphen_values = true)]
    pub eye: Option<[f64; 3]>,

    /// The point in the middle of the picture [default: the middle of the scene]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::triple, allow_hyphen_values = true)]
    pub target: Option<[f64; 3]>,

    /// The direction that is up: x, y, z, -x, -y, -z, a direction such as 0,0.5,1, or auto: as the files or the scene file say; else z
    /// where the shape is plainly that of a map, a terrain or a building; else y [default: auto]
    #[arg(long, value_name = "UP", value_parser = up::parse, allow_hyphen_values = true)]
    pub up: Option<Up>,

    /// The vertical field of view in degrees [default: 45]
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_hyphen_values = true)]
    pub fov: Option<f64>,

    /// Parallel rays, as in a plan or an elevation, where lengths can be measured: the picture's height in the scene's unit, or fit for one
    /// that shows all of it. For all rasterizers and filters but perspective-paper, affine-center, affine-contour, raycast-approximate and
    /// adjust-paper, which only make something of a perspective
    #[arg(long, value_name = "HEIGHT|fit", value_parser = picture_height, allow_hyphen_values = true, conflicts_with = "fov")]
    pub orthographic: Option<PictureHeight>,
}

/// More than any camera file holds: what is larger is something else.
const MAX_FILE_BYTES: u64 = 1 << 16;

/// `45`, without a unit.
fn degrees(word: &str) -> std::result::Result<f64, String> {
    let degrees = word.parse().ok().filter(|degrees: &f64| *degrees > 1e-10 && *degrees < 180.0);
    degrees.ok_or_else(|| "expected degrees above 1e-10 and below 180, such as 45".to_owned())
}

/// `2.5`, in the scene's unit, or `fit`.
fn picture_height(word: &str) -> std::result::Result<PictureHeight, String> {
    if word == "fit" {
        return Ok(PictureHeight::Fit);
    }
    let height = word.parse().ok().filter(|height: &f64| *height > 0.0 && height.is_finite());
    let expected = || "expected a height above 0 in the scene's unit, such as 2.5, or fit".to_owned();
    height.map(PictureHeight::World).ok_or_else(expected)
}

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

/// The camera as the command line has it, before there is a scene.
pub enum CameraChoice {
    /// A whole camera, from a file.
    File(Camera),
    /// The parts that options give; the rest comes from the scene.
    Options(CameraParts),
}

impl CameraArguments {
    /// Whether an option says something of the camera.
    pub fn is_given(&self) -> bool {
        let Self { camera, eye, target, up, fov, orthographic } = self;
        let has_place = eye.is_some() || target.is_some() || up.is_some();
        camera.is_some() || has_place || fov.is_some() || orthographic.is_some()
    }
}

impl CameraChoice {
    /// No options.
    pub fn none() -> Self {
        Self::Options(CameraParts::default())
    }

    /// Reads the camera file, if one is named.
    ///
    /// # Errors
    /// A file that can't be read or is no camera, with its line; an angle out of range.
    pub fn of(arguments: &CameraArguments) -> Result<Self> {
        if let Some(path) = &arguments.camera {
            return read(path).map(Self::File);
        }
        let vector = |given: Option<[f64; 3]>| given.map(DVec3::from);
        Ok(Self::Options(CameraParts {
            eye: vector(arguments.eye),
            target: vector(arguments.target),
            from: None,
            up: match arguments.up {
                Some(Up::Given(direction)) => Some(direction.into()),
                Some(Up::Auto) | None => None,
            },
            orthographic: arguments.orthographic,
            fov_y_rad: arguments.fov.map(f64::to_radians),
            near: None,
        }))
    }

    /// The camera for a scene. What the command line leaves out is as a scene file says, and what that leaves out too is
    /// chosen so that all is seen, see [`CameraParts`].
    ///
    /// # Errors
    /// A camera without a picture, such as an eye at the target.
    pub fn camera(&self, loaded: &Loaded, size_px: [u32; 2]) -> Result<Camera> {
        match (self, &loaded.camera) {
            (Self::File(camera), _) => Ok(*camera),
            (Self::Options(options), None) => with_up(*options, loaded).camera(&loaded.ball, size_px),
            (Self::Options(options), Some((path, parts))) => with_up(options.or(*parts), loaded)
                .camera(&loaded.ball, size_px)
                .map_err(|error| match error.kind() {
                    ErrorKind::Option { problem, .. } => Error::input(path, "camera", problem),
                    _ => error,
                }),
        }
    }
}

/// With the direction that files or shapes tell, where none is given. An eye that is given and looks along it has no use for it.
fn with_up(parts: CameraParts, loaded: &Loaded) -> CameraParts {
    let Some(found) = loaded.up.as_ref().filter(|_| parts.up.is_none()) else { return parts };
    let with = parts.with_found_up(found.direction);
    match with.camera(&loaded.ball, [1, 1]) {
        Ok(_) => {
            up::tell(found);
            with
        }
        Err(_) => parts,
    }
}

fn read(path: &Path) -> Result<Camera> {
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
    use std::{fs, path::PathBuf};

    use surfel::{
        load::PictureDescription,
        scene::{Ball, Scene},
    };

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

    #[test]
    fn the_command_line_comes_before_the_scene_file_and_that_before_the_scene() {
        let ball = Ball { center: DVec3::new(5.0, 0.0, 0.0), radius: 1.0 };
        let of_file = |parts| Loaded {
            scene: Scene::default(),
            ball,
            camera: Some((PathBuf::from("a.toml"), parts)),
            up: None,
            picture: PictureDescription::default(),
            inputs: Vec::new(),
            steps: Vec::new(),
            hierarchies: Vec::new(),
        };
        let eye = |x: f64| Some(DVec3::new(x, 1.0, 1.0));
        let parts = CameraParts { eye: eye(7.0), fov_y_rad: Some(0.5), ..CameraParts::default() };
        let options =
            CameraChoice::Options(CameraParts { eye: eye(9.0), near: Some(0.1), ..CameraParts::default() });
        let camera = options.camera(&of_file(parts), [8, 8]).unwrap();
        assert_eq!((Some(camera.eye), camera.target), (eye(9.0), ball.center));
        assert_eq!((camera.fov_y_rad, camera.near), (0.5, Some(0.1)));
        assert_eq!(CameraChoice::none().camera(&of_file(parts), [8, 8]).unwrap().eye.x, 7.0);
        assert_eq!(CameraChoice::File(camera).camera(&of_file(parts), [8, 8]).unwrap(), camera);
        let inside = CameraParts { eye: Some(ball.center), ..CameraParts::default() };
        let refused = CameraChoice::none().camera(&of_file(inside), [8, 8]).unwrap_err();
        assert_eq!(refused.exit_code(), 1);
        assert_eq!(refused.to_string(), "a.toml: camera: eye and target must be two different points");
    }
}
