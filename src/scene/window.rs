//! Which part of a picture is drawn: an off-center camera.

use crate::error::{Error, Result};

/// Where the drawn image lies in a picture. The default: it is the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Window {
    /// Width and height of the whole picture in pixels, which has the camera's field of view and its target in its middle;
    /// `None`: as many as the drawn image has.
    pub whole_px: Option<[u32; 2]>,
    /// The drawn image's top left corner, in pixels to the right and down from the whole picture's. Need not be whole: a part of a
    /// pixel moves the places where pixels are sampled. Multiples of 1/256 lose nothing in f32 in any picture.
    pub corner_px: [f64; 2],
}

/// The largest side of a whole picture, in pixels.
pub const LARGEST_WHOLE_PX: u32 = 65_536;

impl Window {
    /// The same, with pixels sampled so far to the right and down of their centers.
    #[must_use]
    pub fn shifted(self, offset_px: [f64; 2]) -> Self {
        let corner_px = [0, 1].map(|i| self.corner_px[i] + offset_px[i]);
        Self { corner_px, ..self }
    }

    /// Refuses a window without a picture.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`] for a whole picture with a side outside 1–65536 pixels, a corner farther than that.
    pub fn validate(&self) -> Result<()> {
        let whole_px = self.whole_px.unwrap_or([1; 2]);
        if !whole_px.iter().all(|side| (1..=LARGEST_WHOLE_PX).contains(side)) {
            let [width, height] = whole_px;
            let problem = format!("{width}x{height}: expected sides from 1 to {LARGEST_WHOLE_PX} pixels");
            return Err(Error::option("--size", problem));
        }
        if !self.corner_px.iter().all(|at| at.abs() <= LARGEST_WHOLE_PX.into()) {
            let [x, y] = self.corner_px;
            let [x, y] = [x, y].map(|at| if at.abs() < 1e9 { format!("{at}") } else { format!("{at:e}") });
            let problem = format!("{x},{y}: expected a corner at most {LARGEST_WHOLE_PX} pixels off");
            return Err(Error::option("--crop", problem));
        }
        Ok(())
    }
}
