//! The camera: from a file, from options, or fitted to the scene.

mod arguments;
mod file;
mod path_file;
mod words;

use std::f64::consts::FRAC_PI_6;

use glam::DVec3;
use surfel::{
    Error, ErrorKind, Result,
    geometry::{is_flat_in_front, share_facing},
    load::file_name,
    scene::{Ball, Camera, CameraParts, PictureHeight, View, toward_eye},
};

pub use arguments::{CameraArguments, PARTS, Target};
pub use path_file::{read as read_path, text as path_text};
pub use words::{degrees, words};

use crate::{
    console,
    scene::Loaded,
    up::{self, Up},
};

/// The camera as the command line has it, before there is a scene.
pub enum CameraChoice {
    /// A whole camera, from a file.
    File(Camera),
    /// The parts that options give; the rest comes from the scene.
    Options {
        /// The parts.
        parts: CameraParts,
        /// The name of the object that is looked at.
        object: Option<String>,
    },
}

impl CameraChoice {
    /// No options.
    pub fn none() -> Self {
        Self::Options { parts: CameraParts::default(), object: None }
    }

    /// Reads the camera file, if one is named.
    ///
    /// # Errors
    /// A file that can't be read or is no camera, with its line; an angle out of range.
    pub fn of(arguments: &CameraArguments) -> Result<Self> {
        if let Some(path) = &arguments.camera {
            return file::read(path).map(Self::File);
        }
        let (target, object) = match &arguments.target {
            Some(Target::Point(point)) => (Some(DVec3::from(*point)), None),
            Some(Target::Object(name)) => (None, Some(name.clone())),
            None => (None, None),
        };
        let angles_rad = arguments.view.map(View::angles_rad);
        let [azimuth_rad, elevation_rad] = [(0, arguments.azimuth), (1, arguments.elevation)]
            .map(|(i, deg)| angles_rad.map(|rad| rad[i]).or(deg.map(f64::to_radians)));
        let parts = CameraParts {
            eye: arguments.eye.map(DVec3::from),
            azimuth_rad,
            elevation_rad,
            target,
            subject: None,
            up: match arguments.up {
                Some(Up::Given(direction)) => Some(direction.into()),
                Some(Up::Auto) | None => None,
            },
            orthographic: arguments.orthographic.or(arguments.ortho.then_some(PictureHeight::Fit)),
            fov_y_rad: arguments.fov.map(f64::to_radians),
            zoom: arguments.zoom,
            near: arguments.near,
        };
        Ok(Self::Options { parts, object })
    }

    /// The camera for a scene. What the command line leaves out is as a scene file says, and what that leaves out too is
    /// chosen so that all is seen, see [`CameraParts`].
    ///
    /// # Errors
    /// A camera without a picture, such as an eye at the target; an object that is not there.
    pub fn camera(&self, loaded: &Loaded, size_px: [u32; 2]) -> Result<Camera> {
        let (parts, object) = match self {
            Self::File(camera) => return Ok(*camera),
            Self::Options { parts, object } => (*parts, object),
        };
        let subject = object.as_ref().map(|name| ball_named(name, loaded)).transpose()?;
        let options = CameraParts { subject, ..parts };
        let camera = match &loaded.camera {
            None => as_shaped(options, loaded).camera(&loaded.ball, size_px),
            Some((path, parts)) => {
                let camera = as_shaped(options.or(*parts), loaded).camera(&loaded.ball, size_px);
                camera.map_err(|error| match error.kind() {
                    ErrorKind::Option { problem, .. } => Error::input(path, "camera", problem),
                    _ => error,
                })
            }
        }?;
        if let Some(up) = parts.up.filter(|up| up::is_along(*up, &camera)) {
            up::tell_another(up, camera.up);
        }
        Ok(camera)
    }
}

/// A ball around the objects of this name.
fn ball_named(name: &str, loaded: &Loaded) -> Result<Ball> {
    let octrees = || loaded.octrees.files.iter().map(|file| (file_name(file.path()), file.ball()));
    let files =
        || loaded.hierarchies.iter().map(|file| (file.name().to_owned(), file.ball())).chain(octrees());
    let of_files = files().filter(|(own, _)| own == name).map(|(_, ball)| ball);
    let found = of_files.chain(loaded.scene.ball_named(name)).reduce(Ball::union);
    found.ok_or_else(|| {
        let objects = loaded.scene.objects.iter().map(|object| object.name.clone());
        let meshes = loaded.scene.meshes.iter().map(|mesh| mesh.name.clone());
        let mut names: Vec<String> = objects.chain(meshes).chain(files().map(|(name, _)| name)).collect();
        names.sort();
        names.dedup();
        let others = names.len().saturating_sub(MOST_NAMES);
        names.truncate(MOST_NAMES);
        let more = if others > 0 { format!(" and {others} more") } else { String::new() };
        let names = names.join("', '");
        Error::option(
            "--target",
            format!("no object is called '{name}'; expected a point, or '{names}'{more}"),
        )
    })
}

/// Names in a message.
const MOST_NAMES: usize = 8;

/// With what is up, and from where it is seen, as the scene's shape has it where nothing is said.
fn as_shaped(parts: CameraParts, loaded: &Loaded) -> CameraParts {
    let up = found_up(parts, loaded);
    let parts = CameraParts { up: parts.up.or(up), ..parts };
    let raised = if up.is_some() { parts.from_above(loaded.extent()) } else { parts };
    let Some(front) = parts.front() else { return raised };
    if is_flat_in_front(&loaded.scene, front) {
        console::say("seen from a corner, because its front is one flat side; --view front if not");
        return parts.from_corner();
    }
    if raised != parts {
        return raised;
    }
    if let Some((words, seen)) = beside_its_edge(parts, front, loaded) {
        console::say(&format!(
            "seen from {words}, because from the front it is edge-on; --view front if not"
        ));
        return seen;
    }
    parts
}

/// From above, the right or the left, what is edge-on from the front.
fn beside_its_edge(parts: CameraParts, front: DVec3, loaded: &Loaded) -> Option<(&'static str, CameraParts)> {
    let scene = &loaded.scene;
    let edge_on = share_facing(scene, front);
    if edge_on > EDGE_ON {
        return None;
    }
    // As high as what is known to lie.
    let above_rad =
        parts.from_above(loaded.extent()).elevation_rad.map_or(FRAC_PI_6, |rad| rad.max(FRAC_PI_6));
    let [right_rad, left_rad] = [60.0, -60.0].map(|azimuth: f64| [azimuth, 20.0].map(f64::to_radians));
    let sides = [("above", [0.0, above_rad]), ("the right", right_rad), ("the left", left_rad)].map(
        |(words, angles_rad)| {
            let share = share_facing(scene, toward_eye(parts.up, angles_rad)[0]);
            (share, words, parts.from_angles(angles_rad))
        },
    );
    let best = sides.into_iter().reduce(|best, side| if side.0 > best.0 + 1e-6 { side } else { best });
    best.filter(|(share, ..)| *share > 2.0 * EDGE_ON).map(|(_, words, seen)| (words, seen))
}

/// The share of all area that is seen, up to which a scene is edge-on.
const EDGE_ON: f64 = 0.1;

/// The direction that files or shapes tell to be up, where none is given. An eye that is given and looks along it has no use for it.
fn found_up(parts: CameraParts, loaded: &Loaded) -> Option<DVec3> {
    if parts.up.is_some() {
        return None;
    }
    let Some(found) = loaded.up.as_ref() else {
        let is_of_a_file = loaded.inputs.iter().any(|input| input.model.is_some());
        if is_of_a_file && loaded.camera.is_none() {
            up::tell(None);
        }
        return None;
    };
    let with = CameraParts { up: Some(found.direction), ..parts };
    with.camera(&loaded.ball, [1, 1]).ok()?;
    up::tell(Some(found));
    Some(found.direction)
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use surfel::{
        load::PictureDescription,
        scene::{Ball, Scene},
    };

    use super::*;

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
            octrees: Default::default(),
        };
        let eye = |x: f64| Some(DVec3::new(x, 1.0, 1.0));
        let parts = CameraParts { eye: eye(7.0), fov_y_rad: Some(0.5), ..CameraParts::default() };
        let parts_given = CameraParts { eye: eye(9.0), near: Some(0.1), ..CameraParts::default() };
        let options = CameraChoice::Options { parts: parts_given, object: None };
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
