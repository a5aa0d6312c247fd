//! What a scene file says of the picture.

use super::{
    description::PictureDescription,
    document::{Table, Value},
};
use crate::{
    error::Result,
    scene::{ClipBox, ClipPlanes, Epsilon, MOST_PLANES, OptionValue, Shading},
};

/// Reads the keys of the file itself.
pub(super) fn read(root: &Table<'_>) -> Result<PictureDescription> {
    Ok(PictureDescription {
        epsilon: root.get("epsilon").map(|value| epsilon(&value)).transpose()?,
        background: root.get("background").map(|value| background(&value)).transpose()?,
        clip_box: root.get("clip_box").map(|value| clip_box(&value)).transpose()?,
        clip_planes: root.get("clip_planes").map(|value| clip_planes(&value)).transpose()?,
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

/// Two corners.
fn clip_box(value: &Value<'_>) -> Result<ClipBox> {
    let what = "six numbers: the smallest x, y and z, then the largest";
    let [a, b, c, d, e, f] = value.numbers(what, |_| true)?;
    let clip_box = ClipBox(Some([[a, b, c], [d, e, f]]));
    clip_box.check().map(|()| clip_box).map_err(|_| value.expected("smallest coordinates below the largest"))
}

/// Four numbers each.
fn clip_planes(value: &Value<'_>) -> Result<ClipPlanes> {
    let what = "arrays of four numbers, [a, b, c, d], of which a x + b y + c z >= d is seen";
    let planes = value.elements().ok_or_else(|| value.expected(what))?;
    let planes = planes.iter().map(|plane| plane.numbers(what, |_| true)).collect::<Result<Vec<_>>>()?;
    let planes = ClipPlanes(planes.into());
    planes.check().map_err(|_| value.expected("a, b and c that are not all 0"))?;
    match planes.0.len() <= MOST_PLANES {
        true => Ok(planes),
        false => Err(value.expected(&format!("at most {MOST_PLANES} planes"))),
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
