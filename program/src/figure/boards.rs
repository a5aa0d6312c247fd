//! Figures of checkerboards in perspective: the built-in board of points one unit apart, seen from above it.

use glam::DVec3;
use surfel::{
    Result,
    load::builtin::{CHECKERBOARD_FIELD, CHECKERBOARD_RADIUS, checkerboard},
    scene::{Accumulate, Camera, Epsilon, Filter, KernelEval, Rasterizer, Scene, Settings, Shading},
};

use super::{
    context::FigureContext,
    kernels::PsiE,
    sheet::{Panel, Sheet},
};

/// A board and from where it is seen; lengths in units of the spacing between points.
struct Board {
    /// Points along a side.
    side: usize,
    /// The eye; the board is in the plane z = 0 around the origin.
    eye: DVec3,
    /// To the right of the direction +y.
    turn_deg: f64,
    /// Downward from the horizon.
    pitch_deg: f64,
    /// The vertical field of view.
    fov_y_deg: f64,
}

/// A way to draw it, with what is said about it.
struct Way {
    /// The panel's name.
    name: &'static str,
    /// A remark.
    caption: String,
    /// All but the size.
    settings: Settings,
}

impl Board {
    /// Draws the board in each way, each pixel enlarged that many times.
    fn panels(&self, context: &mut FigureContext<'_>, enlarge: u32, ways: &[Way]) -> Result<Vec<Panel>> {
        let scene = context.prepare(&Scene::from(checkerboard(self.side)))?;
        let size_px = context.size_px.map(|side| (side / enlarge).max(1));
        ways.iter()
            .map(|Way { name, caption, settings }| {
                let settings = Settings { size_px, ..settings.clone() };
                let picture = context.picture(&scene, &self.camera(), &settings)?.enlarged(enlarge);
                Ok(Panel::new(*name, caption.clone(), picture))
            })
            .collect()
    }

    fn camera(&self) -> Camera {
        let (sin_turn, cos_turn) = self.turn_deg.to_radians().sin_cos();
        let (sin_pitch, cos_pitch) = self.pitch_deg.to_radians().sin_cos();
        let forward = DVec3::new(sin_turn * cos_pitch, cos_turn * cos_pitch, -sin_pitch);
        let fov_y_rad = self.fov_y_deg.to_radians();
        Camera { eye: self.eye, target: self.eye + forward, up: DVec3::Z, fov_y_rad, ..Camera::default() }
    }

    /// A note on the board.
    fn text(&self) -> String {
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
fn unlit(filter: Filter) -> Settings {
    Settings {
        filter,
        shading: Shading::Albedo,
        accumulate: Accumulate::F32,
        epsilon: Epsilon::Length(1e4),
        background: Some([0.62, 0.80, 1.0]),
        ..Settings::default()
    }
}

/// A note on what all settings of [`unlit`] have in common.
const UNLIT_TEXT: &str = "Epsilon is larger than the board, so that all points in a pixel are blended, none hidden; \
    blue is where no splat is.";

/// The kernel and the low-pass filter of figures 3 and 4.
const GAUSSIAN_TEXT: &str = "Gaussian kernel, sigma 0.5 radii; low-pass radius sqrt 2 px.";

/// A way without a kernel of its own.
fn way(name: &'static str, filter: Filter, caption: &str) -> Way {
    Way { name, caption: caption.to_owned(), settings: unlit(filter) }
}

/// Guennebaud et al. 2006, figure 3: four filters on a checkerboard to the horizon.
pub fn g3(context: &mut FigureContext<'_>) -> Result<Sheet> {
    // From above the near edge: disks are some pixels large there and far below a pixel at the horizon.
    let board = Board {
        side: 600,
        eye: DVec3::new(0.3, -330.0, 30.0),
        turn_deg: 8.0,
        pitch_deg: 11.0,
        fov_y_deg: 24.0,
    };
    let ways = [
        way(
            "No filter",
            Filter::None,
            "patterns that are not on the board, where fields are finer than pixels",
        ),
        way("Full EWA [Zwicker et al. 2001]", Filter::Ewa, "gray, where fields are finer than pixels"),
        way(
            "Tangent adjustment, surfel's adjust",
            Filter::Adjust,
            "orthogonal axes, as long as EWA's but for 0.2%",
        ),
        way(
            "Maximum of kernel and low-pass filter [Botsch et al. 2005]",
            Filter::Max,
            "ragged, where splats are wider than pixels but not higher",
        ),
    ];
    let title = "Filters on a checkerboard in perspective (Guennebaud et al. 2006, figure 3)";
    let panels = board.panels(context, 1, &ways)?;
    Ok(Sheet::new(title, 1, panels, &[&board.text(), GAUSSIAN_TEXT, UNLIT_TEXT]))
}

/// So that single pixels are seen.
const ENLARGE: u32 = 3;

/// Guennebaud et al. 2006, figure 4: splats that are magnified in one direction and minified in the other.
pub fn g4(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let board = Board {
        side: 600,
        eye: DVec3::new(0.3, -150.0, 5.0),
        turn_deg: 20.0,
        pitch_deg: 2.9,
        fov_y_deg: 3.0,
    };
    let ways = [
        way("Maximum [Botsch et al. 2005]", Filter::Max, "steps and speckles along the edges"),
        way("Tangent adjustment, surfel's adjust", Filter::Adjust, "edges are smooth"),
        way("Full EWA, to judge both by", Filter::Ewa, "not in the paper's figure"),
    ];
    let title = "A close view of a checkerboard (Guennebaud et al. 2006, figure 4)";
    let text = format!("{} Each pixel is {ENLARGE}x{ENLARGE} here.", board.text());
    let panels = board.panels(context, ENLARGE, &ways)?;
    Ok(Sheet::new(title, 3, panels, &[&text, GAUSSIAN_TEXT, UNLIT_TEXT]))
}

/// Pajarola et al. 2003, figure 18: a round kernel and a more localized one on a checkerboard.
pub fn p18(context: &mut FigureContext<'_>) -> Result<Sheet> {
    let board = Board {
        side: 512,
        eye: DVec3::new(0.3, -250.0, 14.0),
        turn_deg: 25.0,
        pitch_deg: 32.0,
        fov_y_deg: 40.0,
    };
    let way = |name, kernel: PsiE| Way {
        name,
        caption: kernel.text(),
        settings: Settings {
            rasterizer: Rasterizer::Triangle,
            kernel: kernel.kernel(),
            kernel_eval: KernelEval::Texture,
            ..unlit(Filter::None)
        },
    };
    let ways = [
        way("a) a round kernel", PsiE { a: 1.0, b: 1.5, n: 2.0 }),
        way("b) a more localized kernel", PsiE { a: 6.0, b: 1.5, n: 3.0 }),
    ];
    let title = "Blending kernels on a checkerboard (Pajarola et al. 2003, figure 18)";
    let text = "As in the paper, a textured triangle for each splat and no screen-space filter. Unlike there, every point \
                is drawn: no level of detail (the paper's tau is 0.02% of the window).";
    let panels = board.panels(context, 1, &ways)?;
    Ok(Sheet::new(title, 2, panels, &[&board.text(), text, UNLIT_TEXT]))
}
