//! Filters over distance for people: errors, holes, fragments, and what follows.

use std::fmt;

use super::{ZoomFigures, ZoomReport};
use crate::report::{
    Grid,
    cells::{figure, scientific},
};

impl ZoomReport {
    /// The board and the view, in words.
    pub fn setting(&self) -> String {
        let ([width, height], board) = (self.size_px, &self.board);
        let samples = |side: u32| u64::from(side).pow(2);
        let least = samples(self.samples_per_side);
        let most = self.steps.iter().map(|step| samples(step.samples_per_side)).max().unwrap_or(least);
        let far = match most > least {
            true => format!(", up to {most} where splats are far below one"),
            false => String::new(),
        };
        format!(
            "checkerboard of {0}x{0} splats, fields of {1}x{1}, radius {2} of the spacing, tilted by {3} degrees\n\
             {width}x{height} pixels, ground truth of {least} samples a pixel{far}",
            board.splats_per_side, board.splats_per_field, board.radius, board.tilt_deg
        )
    }

    /// Errors, holes and fragments of every filter at every distance.
    pub fn grids(&self) -> [Grid; 3] {
        [
            self.grid("RMS of linear color over pixels that both cover (~: mixed)", |own| {
                own.error.color.map(|color| scientific(Some(color.rms)))
            }),
            self.grid("pixels covered in one and empty in the other", |own| {
                Some(own.error.coverage_px.to_string())
            }),
            self.grid("fragments of the accumulation", |own| Some(own.fragments?.to_string())),
        ]
    }

    /// A table of one figure.
    fn grid(&self, title: &str, of: fn(&ZoomFigures) -> Option<String>) -> Grid {
        let table = Grid::of(title, &self.steps).column("px", |step| {
            let mixed = if step.is_mixed(&self.board) { "~" } else { "" };
            format!("{:.3}{mixed}", step.pixels_per_splat)
        });
        let filters = self.filters.iter().enumerate();
        filters
            .fold(table, |table, (i, filter)| {
                table.column(filter.to_string(), |step| {
                    figure(step.figures.get(i).and_then(|own| of(own.as_ref()?)))
                })
            })
            .grid()
    }

    /// The tables' marks in words.
    pub const NOTE: &str = "px: the spacing of the splats in the middle of the picture; mixed: there larger than the filter \
        (sqrt 2 px) along one axis and smaller along the other";
}

impl fmt::Display for ZoomReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}, {}\n{}", self.device.name, self.device.driver, self.setting())?;
        self.grids().iter().try_for_each(|grid| write!(f, "\n{grid}"))?;
        writeln!(f, "{}", Self::NOTE)?;
        self.claims.iter().try_for_each(|claim| writeln!(f, "{claim}"))
    }
}
