//! What a scene file says of the picture.

use super::{
    description::PictureDescription,
    document::{Table, Value},
};
use crate::{
    error::Result,
    scene::{Epsilon, OptionValue, Shading},
};

/// Reads the keys of the file itself.
pub(super) fn read(root: &Table<'_>) -> Result<PictureDescription> {
    Ok(PictureDescription {
        epsilon: root.get("epsilon").map(|value| epsilon(&value)).transpose()?,
        background: root.get("background").map(|value| background(&value)).transpose()?,
        shading: root.get("shading").map(|value| value.one_of(Shading::NAMES)).transpose()?,
    })
}

/// A number is a length.
pub(super) fn epsilon(value: &Value<'_>) -> Result<Epsilon> {
    let what = "\"auto\", multiples of a splat's radius, such as \"1r\", or a length, at least 0";
    match value.text(what) {
        Ok(word) => {
            // A length is a number, not a text.
            let parsed = Epsilon::parse(word).ok().filter(|epsilon| !matches!(epsilon, Epsilon::Length(_)));
            parsed.filter(|epsilon| epsilon.check().is_ok()).ok_or_else(|| value.expected(what))
        }
        Err(_) => value.number(what, |length| length >= 0.0).map(Epsilon::Length),
    }
}

/// An sRGB color, as on the command line.
fn background(value: &Value<'_>) -> Result<Option<[f32; 3]>> {
    let what = "red, green and blue from 0 to 1, or \"none\"";
    match value.text(what) {
        Ok("none") => Ok(None),
        Ok(_) => Err(value.expected(what)),
        Err(_) => {
            let color = value.numbers(what, |component| (0.0..=1.0).contains(&component))?;
            Ok(Some(color.map(|component: f64| component as f32)))
        }
    }
}
