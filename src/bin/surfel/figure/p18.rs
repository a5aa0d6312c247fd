//! Pajarola et al. 2003, figure 18: a round kernel and a more localized one on a checkerboard.

use glam::DVec3;
use surfel::{
    Result,
    scene::{Filter, KernelEval, Rasterizer, Settings},
};

use super::{
    boards::{Board, UNLIT_TEXT, Way, unlit},
    easel::Easel,
    kernels::PsiE,
    sheet::Sheet,
};

/// Draws the figure.
///
/// # Errors
/// As the easel's.
pub fn draw(easel: &mut Easel<'_>) -> Result<Sheet> {
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
    Ok(Sheet {
        title: "Blending kernels on a checkerboard (Pajarola et al. 2003, figure 18)".to_owned(),
        headings: Vec::new(),
        columns: 2,
        panels: board.panels(easel, 1, &ways)?,
        notes: vec![
            board.text(),
            "As in the paper, a textured triangle for each splat and no screen-space filter. Unlike there, every point \
             is drawn: no level of detail (the paper's tau is 0.02% of the window)."
                .to_owned(),
            UNLIT_TEXT.to_owned(),
        ],
    })
}
