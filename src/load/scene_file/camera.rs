//! The camera of a scene file: the keys of a camera file, each of which may be left out.

use glam::DVec3;

use super::document::Table;
use crate::{
    error::Result,
    scene::{CameraParts, PictureHeight},
};

pub(super) const KEYS: &[&str] = &["eye", "target", "up", "fov_deg", "orthographic", "near"];

pub(super) fn read(table: &Table<'_>) -> Result<CameraParts> {
    let point = |key: &'static str| {
        let numbers = |value: super::document::Value<'_>| value.numbers("three numbers", |_| true);
        table.get(key).map(numbers).transpose().map(|numbers| numbers.map(DVec3::from_array))
    };
    let (eye, target, up) = (point("eye")?, point("target")?, point("up")?);
    if eye.is_some() && eye == target {
        return Err(table.fault("eye and target are the same; expected two different points"));
    }
    let number = |key: &'static str, what: &str, good: fn(f64) -> bool| {
        table.get(key).map(|value| value.number(what, good)).transpose()
    };
    let fov_deg = number("fov_deg", "degrees above 1e-10 and below 180", |deg| deg > 1e-10 && deg < 180.0)?;
    let near = number("near", "a number above 0", |near| near > 0.0)?;
    let height = "a height above 0, or \"fit\"";
    let orthographic = match table.get("orthographic") {
        Some(value) if value.text(height).is_ok_and(|word| word == "fit") => Some(PictureHeight::Fit),
        Some(value) => Some(PictureHeight::World(value.number(height, |height| height > 0.0)?)),
        None => None,
    };
    if fov_deg.is_some() && orthographic.is_some() {
        return Err(table.fault(
            "both fov_deg and orthographic; expected one of them: parallel rays have no field of view",
        ));
    }
    let fov_y_rad = fov_deg.map(f64::to_radians);
    Ok(CameraParts { eye, target, up, from: None, orthographic, fov_y_rad, near })
}
