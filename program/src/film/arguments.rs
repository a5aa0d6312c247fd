//! The options of films.

use std::path::PathBuf;

use clap::Args;

use crate::parse;

/// A film in place of a picture.
#[derive(Args)]
#[command(next_help_heading = "Film")]
pub struct FilmArguments {
    /// Draw a picture for each of --frames cameras along the path in this file, evenly spread from its begin to its end. The output is a name
    /// with the picture's number, such as out%04d.png, or .mp4, for which ffmpeg is run. Pictures that are there already, of the same job, are kept
    #[arg(long, value_name = "PATH.json", conflicts_with_all = ["turntable", "camera", "eye", "view", "azimuth", "elevation", "target", "up", "fov", "orthographic", "ortho", "camera_zoom", "near"])]
    pub path: Option<PathBuf>,

    /// The same, with the camera carried once around its target, about what is up, in that many seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse::number("seconds", 0.001..=86_400.0), allow_hyphen_values = true)]
    pub turntable: Option<f64>,

    /// Pictures a second of a film: how many there are where --frames does not say it, and what ffmpeg is told [default: 30; with --frames so many that the film takes the path's or the turn's time]
    #[arg(long, value_name = "N", value_parser = parse::number("pictures a second", 0.01..=1000.0), allow_hyphen_values = true)]
    pub fps: Option<f64>,
}

/// Pictures a second where nothing is said of it.
pub const FPS: f64 = 30.0;

impl FilmArguments {
    /// Whether a film is asked for.
    pub fn is_given(&self) -> bool {
        self.path.is_some() || self.turntable.is_some()
    }
}
