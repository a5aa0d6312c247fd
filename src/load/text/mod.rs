//! Points as rows of numbers: XYZ, PTS, CSV and whatever else people call it, and [`ptx`]. [`layout`] says which columns are
//! what.

mod by_numbers;
mod columns;
mod fields;
mod header;
mod layout;
mod ptx;
mod rows;
#[cfg(test)]
mod tests;
mod thousands;

use glam::DVec3;

use super::{Input, Loaded, Model, geographic::Place, shade};
use crate::{
    error::Result,
    notes::Deed,
    scene::{Colors, Points},
};
use layout::{Fault, Layout};
use rows::{Below, Rows};

pub use columns::{Column, Columns};

pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    if input.options.columns.is_none() && ptx::is_ptx(input.bytes, input.options.limits.line_bytes) {
        return ptx::parse(input);
    }
    let fault = |(at, problem): Fault| input.fault(input.line(at), problem);
    let layout = layout::layout(input).map_err(fault)?;
    let rows =
        rows::read(input.bytes, &layout, &input.options.limits, |done| input.step(done)).map_err(fault)?;
    Ok(loaded(rows, &layout))
}

fn loaded(rows: Rows, layout: &Layout) -> Loaded {
    let longer = rows.longer;
    let has_shades = !rows.colors.is_empty() || !rows.intensities.is_empty();
    let (colors, what, outside) = match (rows.colors.is_empty(), rows.intensities.is_empty()) {
        (false, _) => {
            let largest = rows.colors.iter().flatten().fold(0.0, |a: f32, b| a.max(*b));
            let (scale, what) = match largest {
                // A little above is rounding.
                ..=1.001 => (1.0, ", colors 0–1"),
                ..=255.0 => (255.0, ", colors 0–255"),
                ..=4095.0 => (4095.0, ", colors 0–4095"),
                _ => (65535.0, ", colors 0–65535"),
            };
            let (colors, outside) = shade::from_srgb(&rows.colors, scale);
            (Colors::Each(colors), what, outside)
        }
        (true, false) => {
            let (grays, outside) = shade::gray(&rows.intensities);
            (Colors::Each(grays), ", intensity as gray", outside)
        }
        (true, true) => (Colors::unknown(), "", 0),
    };
    let count = rows.positions.len() as u64;
    let mut points = Points {
        positions: rows.positions,
        normals: (!rows.normals.is_empty()).then_some(rows.normals),
        radii: (!rows.radii.is_empty()).then_some(rows.radii),
        radii_in_doubt: false,
        colors,
        viewpoints: Vec::new(),
    };
    let format = format!("rows of {}{what}", layout.columns);
    let place = layout.geographic.then(|| Place::of(&points)).flatten();
    if let Some(place) = &place {
        place.flatten(&mut points);
    }
    let mut loaded = Loaded::new(Model::Points(points), format);
    loaded.metres_per_unit = layout.metres_per_unit;
    // A number of rows above them, and more than places in them: scanners' PTS, which has z up.
    loaded.up = (layout.counted && has_shades).then_some(DVec3::Z);
    if let Some(place) = place {
        place.tell(&mut loaded, count);
    }
    loaded.note(Deed::Clamped, outside, "points with a color out of its range");
    loaded.note(Deed::Ignored, longer, "rows with more numbers than columns, whose rest is");
    loaded.note(Deed::Ignored, layout.titles, "lines of words above the rows");
    if let Some(Below { words, .. }) = rows.below.first() {
        loaded.note(
            Deed::Ignored,
            rows.below.len() as u64,
            format!("lines of words ('{words}') below the rows"),
        );
    }
    let ignored = &layout.ignored;
    if !ignored.is_empty() {
        let names: Vec<&str> = ignored.iter().take(8).map(String::as_str).collect();
        let more = if ignored.len() > names.len() { ", …" } else { "" };
        loaded.note(Deed::Ignored, ignored.len() as u64, format!("columns ({}{more})", names.join(", ")));
    }
    loaded
}
