//! Opaque 8-bit pictures and text in them.

use std::convert::Infallible;

use embedded_graphics::{
    Drawable as _, Pixel,
    draw_target::DrawTarget,
    geometry::{OriginDimensions, Point, Size},
    mono_font::{MonoFont, MonoTextStyle, iso_8859_1},
    pixelcolor::{Rgb888, RgbColor as _},
    text::{Baseline, Text},
};
use surfel::{Error, Result};

/// Red, green, blue, sRGB; row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Width and height.
    pub size_px: [u32; 2],
    /// `width · height` colors.
    pub pixels: Vec<[u8; 3]>,
}

/// The look of text. The fonts hold the characters of ISO 8859-1; others show as question marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextStyle {
    /// A title.
    Title,
    /// A heading or a panel's name.
    Heading,
    /// Captions and notes.
    Plain,
}

impl TextStyle {
    fn font(self) -> &'static MonoFont<'static> {
        match self {
            Self::Title => &iso_8859_1::FONT_10X20,
            Self::Heading => &iso_8859_1::FONT_8X13_BOLD,
            Self::Plain => &iso_8859_1::FONT_8X13,
        }
    }

    /// The distance from a line to the next.
    pub fn line_px(self) -> u32 {
        self.font().character_size.height + 4
    }

    /// The text in lines that are no wider; at a character where a word is too long.
    pub fn wrapped(self, text: &str, width_px: u32) -> Vec<String> {
        let limit = (width_px / self.font().character_size.width).max(1) as usize;
        let mut lines = vec![String::new()];
        for word in text.split(' ') {
            let mut word: Vec<char> = word.chars().collect();
            loop {
                let line = lines.last_mut().map(|line| (line.chars().count(), line));
                let Some((used, line)) = line else { break };
                let gap = usize::from(used > 0);
                if used + gap + word.len() <= limit {
                    line.extend([' '].iter().take(gap));
                    line.extend(&word);
                    break;
                }
                if used == 0 {
                    line.extend(word.drain(..limit));
                }
                lines.push(String::new());
            }
        }
        lines
    }
}

impl Raster {
    /// A white one.
    pub fn white(size_px: [u32; 2]) -> Result<Self> {
        let count = usize::try_from(u64::from(size_px[0]) * u64::from(size_px[1])).unwrap_or(usize::MAX);
        let mut pixels = Vec::new();
        pixels.try_reserve_exact(count).map_err(|_| {
            Error::option("--size", format!("{}x{}: memory can't hold the picture", size_px[0], size_px[1]))
        })?;
        pixels.resize(count, [255; 3]);
        Ok(Self { size_px, pixels })
    }

    /// Copies a picture to here; what would lie outside is left out.
    pub fn paste(&mut self, picture: &Self, [left, top]: [u32; 2]) {
        for row in 0..picture.size_px[1].min(self.size_px[1].saturating_sub(top)) {
            let width = picture.size_px[0].min(self.size_px[0].saturating_sub(left)) as usize;
            let from = row as usize * picture.size_px[0] as usize;
            let to = (top + row) as usize * self.size_px[0] as usize + left as usize;
            self.pixels[to..to + width].copy_from_slice(&picture.pixels[from..from + width]);
        }
    }

    /// Draws a line of one pixel around these, which stay as they are.
    pub fn frame(&mut self, [left, top]: [u32; 2], [width, height]: [u32; 2], color: [u8; 3]) {
        let size = self.size_px;
        for y in top.saturating_sub(1)..(top + height + 1).min(size[1]) {
            for x in left.saturating_sub(1)..(left + width + 1).min(size[0]) {
                if !((left..left + width).contains(&x) && (top..top + height).contains(&y)) {
                    self.pixels[y as usize * size[0] as usize + x as usize] = color;
                }
            }
        }
    }

    /// Writes a line of black text, its top left corner here.
    pub fn text(&mut self, text: &str, [left, top]: [u32; 2], style: TextStyle) {
        let style = MonoTextStyle::new(style.font(), Rgb888::BLACK);
        let corner = Point::new(left.cast_signed(), top.cast_signed());
        let Ok(_) = Text::with_baseline(text, corner, style, Baseline::Top).draw(self);
    }

    /// Each pixel as a square of this many.
    pub fn enlarged(&self, times: u32) -> Self {
        let [width, height] = self.size_px;
        let pixel = |column: u32, row: u32| self.pixels[row as usize * width as usize + column as usize];
        let rows = (0..height * times).flat_map(|row| (0..width * times).map(move |column| [column, row]));
        let pixels = rows.map(|[column, row]| pixel(column / times, row / times)).collect();
        Self { size_px: [width * times, height * times], pixels }
    }
}

impl OriginDimensions for Raster {
    fn size(&self) -> Size {
        Size::new(self.size_px[0], self.size_px[1])
    }
}

impl DrawTarget for Raster {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(
        &mut self,
        pixels: I,
    ) -> std::result::Result<(), Infallible> {
        for Pixel(Point { x, y }, color) in pixels {
            let place = u32::try_from(x).ok().zip(u32::try_from(y).ok());
            if let Some((x, y)) = place.filter(|(x, y)| *x < self.size_px[0] && *y < self.size_px[1]) {
                let index = y as usize * self.size_px[0] as usize + x as usize;
                self.pixels[index] = [color.r(), color.g(), color.b()];
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_wrapped_at_spaces_and_long_words_anywhere() {
        let wrapped = |text: &str, characters: u32| TextStyle::Plain.wrapped(text, characters * 8);
        assert_eq!(wrapped("one two three", 7), ["one two", "three"]);
        assert_eq!(wrapped("abcdefgh ij", 3), ["abc", "def", "gh", "ij"]);
        assert_eq!(wrapped("", 5), [""]);
        assert_eq!(wrapped("ab", 0), ["a", "b"]);
    }

    #[test]
    fn text_and_pictures_beyond_the_border_are_cut_off() {
        let mut raster = Raster::white([20, 10]).unwrap();
        raster.text("MMMMMMM", [4, 2], TextStyle::Plain);
        let black = raster.pixels.iter().filter(|pixel| **pixel == [0; 3]).count();
        assert!(black > 10, "{black}");
        raster.paste(&Raster { size_px: [3, 2], pixels: vec![[9; 3]; 6] }, [18, 9]);
        assert_eq!(raster.pixels.iter().filter(|pixel| **pixel == [9; 3]).count(), 2);
        raster.paste(&Raster { size_px: [3, 2], pixels: vec![[7; 3]; 6] }, [30, 90]);
        assert!(!raster.pixels.contains(&[7; 3]));
    }

    #[test]
    fn an_enlarged_pixel_is_a_square() {
        let raster = Raster { size_px: [2, 1], pixels: vec![[1; 3], [2; 3]] };
        let expected = [[1; 3], [1; 3], [2; 3], [2; 3]].repeat(2);
        assert_eq!(raster.enlarged(2), Raster { size_px: [4, 2], pixels: expected });
    }
}
