//! The panels of a figure's sheet, and what is measured of them.

use crate::{
    files::{Png, png},
    program::{Folder, done},
    splats,
};

/// Around each panel.
const FRAME: [u8; 3] = [160; 3];

/// A panel's gray values, row by row.
pub struct Panel {
    width: usize,
    pub values: Vec<f64>,
    /// Whether the pixel has a color, as lines and dots over gray ones have.
    pub colored: Vec<bool>,
}

/// Draws a figure under validation and cuts its panels out, in reading order.
pub fn panels(name: &str, size: [u32; 2], more: &[&str]) -> Vec<Panel> {
    let folder = Folder::new();
    folder.write("model.ply", splats("0 0 0 0 0 1 1 255 0 0\n1 0.3 0.2 0 0 1 1 0 0 255\n"));
    let side = format!("{}x{}", size[0], size[1]);
    let run = done(&folder, &[&["figure", name, "--size", &side, "--validate"], more].concat());
    assert!(run.stderr.contains("validation: no message"), "{}", run.stderr);
    let mut names = [format!("{name}.png"), "model.ply".to_owned()];
    names.sort();
    assert_eq!(folder.names(), names);
    let sheet = png(&folder.path(&format!("{name}.png")));
    // Text is wrapped to the sheet's margins, where nothing else is black.
    assert!((0..sheet.size[1]).any(|row| (16..200).any(|column| sheet.at(column, row) == [0; 3])));
    let mut found = Vec::new();
    for row in 1..sheet.size[1] - size[1] {
        for column in 1..sheet.size[0] - size[0] {
            if framed(&sheet, [column, row], size) {
                found.push(cut(&sheet, [column, row], size));
            }
        }
    }
    found
}

/// Whether a panel's corner is here.
fn framed(sheet: &Png, [left, top]: [u32; 2], [width, height]: [u32; 2]) -> bool {
    let is_frame = |x, y| sheet.at(x, y) == FRAME;
    (left - 1..=left + width).all(|x| is_frame(x, top - 1) && is_frame(x, top + height))
        && (top..top + height).all(|y| is_frame(left - 1, y) && is_frame(left + width, y))
}

fn cut(sheet: &Png, [left, top]: [u32; 2], [width, height]: [u32; 2]) -> Panel {
    let gray = |[r, g, b]: [u8; 3]| (f64::from(r) + f64::from(g) + f64::from(b)) / 765.0;
    let places = (top..top + height).flat_map(|y| (left..left + width).map(move |x| [x, y]));
    let colors: Vec<[u8; 3]> = places.map(|[x, y]| sheet.at(x, y)).collect();
    let colored = colors.iter().map(|[r, g, b]| r != g || g != b).collect();
    Panel { width: width as usize, values: colors.into_iter().map(gray).collect(), colored }
}

impl Panel {
    /// The mean squared difference of pixels this far from each other, along rows and columns.
    pub fn energy(&self, step: usize) -> f64 {
        let (width, values) = (self.width, &self.values);
        let across =
            (0..values.len()).filter(|i| i % width + step < width).map(|i| values[i + step] - values[i]);
        let down = (0..values.len() - step * width).map(|i| values[i + step * width] - values[i]);
        across.chain(down).map(|difference| difference * difference).sum::<f64>() / (2 * values.len()) as f64
    }

    /// How many neighbors in a row differ by more.
    pub fn steps(&self, least: f64) -> usize {
        let rows = self.values.chunks(self.width);
        rows.flat_map(|row| row.windows(2)).filter(|pair| (pair[1] - pair[0]).abs() > least).count()
    }

    /// How many pixels are between these.
    pub fn count(&self, range: std::ops::Range<f64>) -> usize {
        self.values.iter().filter(|value| range.contains(value)).count()
    }

    /// The mean distance of two panels.
    pub fn distance(&self, other: &Self) -> f64 {
        let sum: f64 = self.values.iter().zip(&other.values).map(|(a, b)| (a - b).abs()).sum();
        sum / self.values.len() as f64
    }
}

/// The part of each panel that shows something.
pub fn shown(panels: &[Panel]) -> Vec<f64> {
    let part = |panel: &Panel| {
        panel.values.iter().filter(|value| **value < 0.9).count() as f64 / panel.values.len() as f64
    };
    panels.iter().map(part).collect()
}
