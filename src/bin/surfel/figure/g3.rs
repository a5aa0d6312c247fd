//! Guennebaud et al. 2006, figure 3: four filters on a checkerboard to the horizon.

use glam::DVec3;
use surfel::{Result, scene::Filter};

use super::{
    boards::{Board, UNLIT_TEXT, Way, unlit},
    easel::Easel,
    sheet::Sheet,
};

/// Draws the figure.
///
/// # Errors
/// As the easel's.
pub fn draw(easel: &mut Easel<'_>) -> Result<Sheet> {
    // From above the near edge: disks are some pixels large there and far below a pixel at the horizon.
    let board = Board {
        side: 600,
        eye: DVec3::new(0.3, -330.0, 30.0),
        turn_deg: 8.0,
        pitch_deg: 11.0,
        fov_y_deg: 24.0,
    };
    let way =
        |name, filter, caption: &str| Way { name, caption: caption.to_owned(), settings: unlit(filter) };
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
    let notes = vec![
        board.text(),
        "Gaussian kernel, sigma 0.5 radii; low-pass radius sqrt 2 px.".to_owned(),
        UNLIT_TEXT.to_owned(),
    ];
    Ok(Sheet {
        title: "Filters on a checkerboard in perspective (Guennebaud et al. 2006, figure 3)".to_owned(),
        headings: Vec::new(),
        columns: 1,
        panels: board.panels(easel, 1, &ways)?,
        notes,
    })
}
