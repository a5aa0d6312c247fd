//! Filters over distance for people: errors, holes, fragments, and what follows.

use std::fmt;

use super::{ZoomReport, ZoomStep};

/// The width of a filter's column.
const WIDTH: usize = 17;

impl fmt::Display for ZoomReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, height] = self.size_px;
        let samples = u64::from(self.samples_per_side).pow(2);
        let board = &self.board;
        writeln!(f, "{}, {}", self.device.name, self.device.driver)?;
        writeln!(
            f,
            "checkerboard of {0}x{0} splats, fields of {1}x{1}, radius {2} of the spacing, tilted by {3} degrees",
            board.splats_per_side, board.splats_per_field, board.radius, board.tilt_deg
        )?;
        let most =
            self.steps.iter().map(|step| u64::from(step.samples_per_side).pow(2)).max().unwrap_or(samples);
        write!(f, "{width}x{height} pixels, ground truth of {samples} samples a pixel")?;
        match most > samples {
            true => writeln!(f, ", up to {most} where splats are far below one")?,
            false => writeln!(f)?,
        }
        self.block(f, "RMS of linear color over pixels that both cover (~: mixed)", &|step, i| {
            step.rms(i).map(|rms| format!("{rms:.3e}"))
        })?;
        self.block(f, "pixels covered in one and empty in the other", &|step, i| {
            Some(step.figures.get(i)?.as_ref()?.error.coverage_px.to_string())
        })?;
        self.block(f, "fragments of the accumulation", &|step, i| {
            Some(step.figures.get(i)?.as_ref()?.fragments?.to_string())
        })?;
        writeln!(
            f,
            "px: the spacing of the splats in the middle of the picture; mixed: there larger than the filter (sqrt 2 \
             px) along one axis and smaller along the other"
        )?;
        for claim in &self.claims {
            writeln!(f, "{claim}")?;
        }
        Ok(())
    }
}

impl ZoomReport {
    /// A table of one figure.
    fn block(
        &self,
        f: &mut fmt::Formatter<'_>,
        title: &str,
        figure: &dyn Fn(&ZoomStep, usize) -> Option<String>,
    ) -> fmt::Result {
        writeln!(f, "\n{title}")?;
        write!(f, "{:>9} ", "px")?;
        for filter in &self.filters {
            write!(f, " {:>WIDTH$}", filter.line())?;
        }
        writeln!(f)?;
        for step in &self.steps {
            let mixed = if step.is_mixed(&self.board) { '~' } else { ' ' };
            write!(f, "{:9.3}{mixed}", step.pixels_per_splat)?;
            for i in 0..self.filters.len() {
                write!(f, " {:>WIDTH$}", figure(step, i).unwrap_or_else(|| "-".to_owned()))?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}
