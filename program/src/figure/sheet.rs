//! Panels with their names on one sheet: a title, rows of panels, notes below.

use surfel::Result;

use super::raster::{Raster, TextStyle};

/// A picture with what it shows.
pub struct Panel {
    /// Which of the compared things it is.
    pub name: String,
    /// A remark, a line or more.
    pub caption: String,
    /// The picture; all panels of a sheet have the same size.
    pub picture: Raster,
}

/// A figure.
pub struct Sheet {
    /// Over all.
    pub title: String,
    /// Over each row of panels; none where there are fewer.
    pub headings: Vec<String>,
    /// Panels in a row.
    pub columns: usize,
    /// Row by row.
    pub panels: Vec<Panel>,
    /// Below, a paragraph each.
    pub notes: Vec<String>,
}

/// Around everything, and between panels.
const MARGIN_PX: u32 = 16;
/// Around each panel.
const FRAME: [u8; 3] = [160; 3];
/// Between a panel and its name.
const GAP_PX: u32 = 4;
/// Between a row of panels and the next.
const ROW_GAP_PX: u32 = 10;
/// Text needs some width, however small the panels are.
const NARROWEST_PX: u32 = 480;

impl Panel {
    /// A panel of this picture.
    pub fn new(name: impl Into<String>, caption: impl Into<String>, picture: Raster) -> Self {
        Self { name: name.into(), caption: caption.into(), picture }
    }
}

impl Sheet {
    /// A figure without headings.
    pub fn new(title: &str, columns: usize, panels: Vec<Panel>, notes: &[&str]) -> Self {
        let notes = notes.iter().map(|note| (*note).to_owned()).collect();
        Self { title: title.to_owned(), columns, panels, notes, headings: Vec::new() }
    }

    /// The sheet as one picture.
    pub fn draw(&self) -> Result<Raster> {
        // Once to find the height, once to draw.
        let inner_px = self.inner_width_px();
        let height = self.place(&mut Ink { raster: None }, inner_px);
        let mut ink = Ink { raster: Some(Raster::white([inner_px + 2 * MARGIN_PX, height])?) };
        self.place(&mut ink, inner_px);
        ink.raster.map_or_else(|| Raster::white([1, 1]), Ok)
    }

    fn panel_size_px(&self) -> [u32; 2] {
        self.panels.first().map_or([1; 2], |panel| panel.picture.size_px)
    }

    fn inner_width_px(&self) -> u32 {
        let columns = u32::try_from(self.columns).unwrap_or(1).max(1);
        (columns * (self.panel_size_px()[0] + MARGIN_PX) - MARGIN_PX).max(NARROWEST_PX)
    }

    /// Draws everything; the sheet's height.
    fn place(&self, ink: &mut Ink, inner_px: u32) -> u32 {
        let mut top = ink.paragraph(&self.title, [MARGIN_PX, MARGIN_PX], inner_px, TextStyle::Title) + GAP_PX;
        let [width, height] = self.panel_size_px();
        for (i, row) in self.panels.chunks(self.columns.max(1)).enumerate() {
            top += ROW_GAP_PX;
            if let Some(heading) = self.headings.get(i) {
                top = ink.paragraph(heading, [MARGIN_PX, top], inner_px, TextStyle::Heading) + GAP_PX;
            }
            let mut bottom = top;
            let mut left = MARGIN_PX;
            for panel in row {
                let mut below = ink.paragraph(&panel.name, [left, top], width, TextStyle::Heading);
                if !panel.caption.is_empty() {
                    below = ink.paragraph(&panel.caption, [left, below], width, TextStyle::Plain);
                }
                bottom = bottom.max(below);
                left += width + MARGIN_PX;
            }
            // Pictures of a row are level however long their names are.
            let mut left = MARGIN_PX;
            for panel in row {
                ink.picture(&panel.picture, [left, bottom + GAP_PX]);
                left += width + MARGIN_PX;
            }
            top = bottom + GAP_PX + height + GAP_PX;
        }
        top += GAP_PX;
        for note in &self.notes {
            top = ink.paragraph(note, [MARGIN_PX, top], inner_px, TextStyle::Plain);
        }
        top + MARGIN_PX
    }
}

/// The picture that is drawn on; without one only places are found.
struct Ink {
    raster: Option<Raster>,
}

impl Ink {
    /// Writes lines of text; where the next would begin.
    fn paragraph(&mut self, text: &str, [left, mut top]: [u32; 2], width_px: u32, style: TextStyle) -> u32 {
        for line in style.wrapped(text, width_px) {
            if let Some(raster) = &mut self.raster {
                raster.text(&line, [left, top], style);
            }
            top += style.line_px();
        }
        top
    }

    fn picture(&mut self, picture: &Raster, corner: [u32; 2]) {
        if let Some(raster) = &mut self.raster {
            raster.paste(picture, corner);
            raster.frame(corner, picture.size_px, FRAME);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_panel_is_on_the_sheet_once_and_whole_and_text_lies_around_them() {
        let panel = |shade: u8| Panel {
            name: format!("panel {shade}"),
            caption: "a caption that needs more than one line beside others".to_owned(),
            picture: Raster { size_px: [100, 50], pixels: vec![[shade, 1, 2]; 5000] },
        };
        let sheet = Sheet {
            title: "a title that is longer than the sheet is wide, so that it has to be wrapped to two lines"
                .to_owned(),
            headings: vec!["first row".to_owned()],
            columns: 2,
            panels: vec![panel(10), panel(20), panel(30)],
            notes: vec!["a note".to_owned()],
        };
        let raster = sheet.draw().unwrap();
        assert_eq!(raster.size_px[0], 480 + 32);
        for shade in [10, 20, 30] {
            assert_eq!(raster.pixels.iter().filter(|pixel| **pixel == [shade, 1, 2]).count(), 5000);
        }
        let width = raster.size_px[0] as usize;
        let last_text = raster.pixels.iter().rposition(|pixel| *pixel == [0; 3]).unwrap() / width;
        let last_panel = raster.pixels.iter().rposition(|pixel| *pixel == [30, 1, 2]).unwrap() / width;
        assert!(last_panel < last_text && last_text < raster.size_px[1] as usize - 10);
        assert!(raster.pixels[..width * 16].iter().all(|pixel| *pixel == [255; 3]), "the margin is empty");
    }
}
