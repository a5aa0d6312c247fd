//! The options of the camera.

use std::path::PathBuf;

use clap::Args;
use surfel::scene::{OptionValue as _, PictureHeight, View};

use crate::{
    parse,
    settings::one_of,
    up::{self, Up},
};

/// All that says something of the camera but a file, which says it all.
pub const PARTS: [&str; 11] = [
    "eye",
    "view",
    "azimuth",
    "elevation",
    "target",
    "up",
    "fov",
    "orthographic",
    "ortho",
    "camera_zoom",
    "near",
];

/// The camera.
#[derive(Args)]
#[command(next_help_heading = "Camera")]
pub struct CameraArguments {
    /// Read the camera from this file
    #[arg(long, value_name = "FILE.json", conflicts_with_all = PARTS)]
    pub camera: Option<PathBuf>,

    /// The eye [default: on +z from the target, so far that the scene fits; on -y where z is up, and above it where a file or its shape
    /// says what is up and it is lower than wide; 30 degrees to the right of it and 20 above where the front of something closed is one flat side]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::triple, allow_hyphen_values = true, conflicts_with_all = ["view", "azimuth", "elevation"])]
    pub eye: Option<[f64; 3]>,

    /// The side that the eye is on, so far that all fits: the front is toward +z, where z is up toward -y; left and right are those of
    /// whoever stands there; iso is from the front, right and above
    #[arg(long, value_name = "SIDE", value_parser = one_of(View::NAMES), conflicts_with_all = ["azimuth", "elevation"])]
    pub view: Option<View>,

    /// The eye's turn about what is up, in degrees: 0 in front, 90 to the right, -90 to the left [default: 0]
    #[arg(long, value_name = "DEG", value_parser = parse::number("degrees", -360.0..=360.0), allow_hyphen_values = true)]
    pub azimuth: Option<f64>,

    /// The eye's height above the horizon in degrees, 90 above, -90 below [default: 0; where a
    /// file or its shape says what is up, up to 30 if the whole is lower than wide; 20 or 30 of
    /// what is flat or edge-on in front]
    #[arg(long, value_name = "DEG", value_parser = parse::number("degrees", -90.0..=90.0), allow_hyphen_values = true)]
    pub elevation: Option<f64>,

    /// The point in the middle of the picture, or the name of an object, which is shown whole unless an eye is given [default: the middle
    /// of the scene]
    #[arg(long, value_name = "X,Y,Z|NAME", value_parser = target, allow_hyphen_values = true)]
    pub target: Option<Target>,

    /// The direction that is up: x, y, z, -x, -y, -z, a direction such as 0,0.5,1, or auto: as the files or the scene file say; else z
    /// or y where the shape is plainly that of a map or a terrain, or stands on a floor; else y [default: auto]
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

    /// The same as --orthographic fit
    #[arg(long, conflicts_with_all = ["orthographic", "fov"])]
    pub ortho: bool,

    /// Show what is in the middle so many times as large, from the same eye [default: 1]
    #[arg(long, id = "camera_zoom", value_name = "TIMES", value_parser = parse::number("times", 1e-6..=1e6), allow_hyphen_values = true)]
    pub zoom: Option<f64>,

    /// The depth in front of which nothing is drawn, in the scene's unit [default: a millionth of the distance from eye to target; 0 of
    /// parallel rays]
    #[arg(long, value_name = "LENGTH", value_parser = depth, allow_hyphen_values = true)]
    pub near: Option<f64>,
}

impl CameraArguments {
    /// Whether an option says something of the camera.
    pub fn is_given(&self) -> bool {
        let Self { camera, eye, view, azimuth, elevation, target, up, fov, orthographic, ortho, zoom, near } =
            self;
        let has_place = eye.is_some() || view.is_some() || azimuth.is_some() || elevation.is_some();
        let looks = target.is_some() || up.is_some() || near.is_some();
        let projects = fov.is_some() || orthographic.is_some() || *ortho || zoom.is_some();
        camera.is_some() || has_place || looks || projects
    }
}

/// What is in the middle of the picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A point in world space.
    Point([f64; 3]),
    /// An object.
    Object(String),
}

/// `0.5,1,-2`, or a name.
fn target(word: &str) -> Result<Target, String> {
    let is_numbers = word.chars().all(|c| c.is_ascii_digit() || "+-.,eE \t".contains(c));
    match <[f64; 3]>::parse(word) {
        Ok(point) => Ok(Target::Point(point)),
        Err(problem) if is_numbers => Err(format!("{problem}, or the name of an object")),
        Err(_) => Ok(Target::Object(word.to_owned())),
    }
}

/// `45`, without a unit.
fn degrees(word: &str) -> Result<f64, String> {
    let degrees = word.parse().ok().filter(|degrees: &f64| *degrees > 1e-10 && *degrees < 180.0);
    degrees.ok_or_else(|| "expected degrees above 1e-10 and below 180, such as 45".to_owned())
}

/// `2.5`, in the scene's unit, or `fit`.
fn picture_height(word: &str) -> Result<PictureHeight, String> {
    if word == "fit" {
        return Ok(PictureHeight::Fit);
    }
    let height = word.parse().ok().filter(|height: &f64| *height > 0.0 && height.is_finite());
    let expected = || "expected a height above 0 in the scene's unit, such as 2.5, or fit".to_owned();
    height.map(PictureHeight::World).ok_or_else(expected)
}

/// `0.01`, in the scene's unit.
fn depth(word: &str) -> Result<f64, String> {
    let depth = word.parse().ok().filter(|depth: &f64| *depth >= 0.0 && depth.is_finite());
    depth.ok_or_else(|| "expected a depth in the scene's unit, such as 0.01".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_target_is_a_point_or_a_name() {
        assert_eq!(target("1,-2e3,.5"), Ok(Target::Point([1.0, -2000.0, 0.5])));
        assert_eq!(target("left ball"), Ok(Target::Object("left ball".to_owned())));
        assert_eq!(target("e.ply"), Ok(Target::Object("e.ply".to_owned())));
        for refused in ["", "1,2", "1,2,3,4", "-"] {
            assert!(target(refused).is_err(), "{refused}");
        }
    }
}
