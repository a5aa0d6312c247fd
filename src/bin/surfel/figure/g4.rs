//! Guennebaud et al. 2006, figure 4: where splats are magnified in one direction and minified in the other.

use glam::DVec3;
use surfel::{Result, scene::Filter};

use super::{
    boards::{Board, UNLIT_TEXT, Way, unlit},
    easel::Easel,
    sheet::Sheet,
};

/// So that single pixels are seen.
const ENLARGE: u32 = 3;

/// Draws the figure.
///
/// # Errors
/// As the easel's.
pub fn draw(easel: &mut Easel<'_>) -> Result<Sheet> {
    let board = Board {
        side: 600,
        eye: DVec3::new(0.3, -150.0, 5.0),
        turn_deg: 20.0,
        pitch_deg: 2.9,
        fov_y_deg: 3.0,
    };
    let way =
        |name, filter, caption: &str| Way { name, caption: caption.to_owned(), settings: unlit(filter) };
    let ways = [
        way("Maximum [Botsch et al. 2005]", Filter::Max, "steps and speckles along the edges"),
        way("Tangent adjustment, surfel's adjust", Filter::Adjust, "edges are smooth"),
        way("Full EWA, to judge both by", Filter::Ewa, "not in the paper's figure"),
    ];
    Ok(Sheet {
        title: "A close view of a checkerboard (Guennebaud et al. 2006, figure 4)".to_owned(),
        headings: Vec::new(),
        columns: 3,
        panels: board.panels(easel, ENLARGE, &ways)?,
        notes: vec![
            format!("{} Each pixel is {ENLARGE}x{ENLARGE} here.", board.text()),
            "Gaussian kernel, sigma 0.5 radii; low-pass radius sqrt 2 px.".to_owned(),
            UNLIT_TEXT.to_owned(),
        ],
    })
}
