//! Checkerboards in perspective: the built-in board of points one unit apart, seen from above it.

use glam::DVec3;
use surfel::{
    Result,
    load::builtin::{CHECKERBOARD_FIELD, CHECKERBOARD_RADIUS, checkerboard},
    scene::{Accumulate, Camera, Epsilon, Filter, Scene, Settings, Shading},
};

use super::{easel::Easel, sheet::Panel};

/// A board and from where it is seen; lengths in units of the spacing between points.
pub struct Board {
    /// Points along a side.
    pub side: usize,
    /// The eye; the board is in the plane z = 0 around the origin.
    pub eye: DVec3,
    /// To the right of the direction +y.
    pub turn_deg: f64,
    /// Downward from the horizon.
    pub pitch_deg: f64,
    /// The vertical field of view.
    pub fov_y_deg: f64,
}

/// A way to draw it, with what is said about it.
pub struct Way {
    /// The panel's name.
    pub name: &'static str,
    /// What else is to be said.
    pub caption: String,
    /// All but the size.
    pub settings: Settings,
}

impl Board {
    /// Draws the board in each way, each pixel enlarged that many times.
    ///
    /// # Errors
    /// As the easel's.
    pub fn panels(&self, easel: &mut Easel<'_>, enlarge: u32, ways: &[Way]) -> Result<Vec<Panel>> {
        let scene = easel.prepare(&Scene { objects: vec![checkerboard(self.side)], ..Scene::default() })?;
        let size_px = easel.size_px.map(|side| (side / enlarge).max(1));
        ways.iter()
            .map(|Way { name, caption, settings }| {
                let settings = Settings { size_px, ..settings.clone() };
                let picture = easel.picture(&scene, &self.camera(), &settings)?.enlarged(enlarge);
                Ok(Panel { name: (*name).to_owned(), caption: caption.clone(), picture })
            })
            .collect()
    }

    fn camera(&self) -> Camera {
        let (sin_turn, cos_turn) = self.turn_deg.to_radians().sin_cos();
        let (sin_pitch, cos_pitch) = self.pitch_deg.to_radians().sin_cos();
        let forward = DVec3::new(sin_turn * cos_pitch, cos_turn * cos_pitch, -sin_pitch);
        let fov_y_rad = self.fov_y_deg.to_radians();
        Camera { eye: self.eye, target: self.eye + forward, up: DVec3::Z, fov_y_rad, near: None }
    }

    /// What the board is, for a note.
    pub fn text(&self) -> String {
        format!(
            "Board: {side}x{side} points, fields of {CHECKERBOARD_FIELD}x{CHECKERBOARD_FIELD} points, disks of radius \
             {CHECKERBOARD_RADIUS} in units of the spacing; {}° vertical field of view.",
            self.fov_y_deg,
            side = self.side,
        )
    }
}

/// The board's own colors, sums in 32 bits, a filter, a background that no field has.
///
/// ε is larger than the board. With a multiple of the radius, a pixel toward the horizon would take the nearest of the
/// many points that it sees, and whatever the filter, the board would alias: filters are compared, not visibility.
pub fn unlit(filter: Filter) -> Settings {
    Settings {
        filter,
        shading: Shading::Albedo,
        accumulate: Accumulate::F32,
        epsilon: Epsilon::Length(1e4),
        background: Some([0.62, 0.80, 1.0]),
        ..Settings::default()
    }
}

/// What all of [`unlit`] have in common, for a note.
pub const UNLIT_TEXT: &str = "Epsilon is larger than the board, so that all points in a pixel are blended, none hidden; the \
    background is blue.";
