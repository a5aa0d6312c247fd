//! The camera of a scene file: the keys of a camera file, each of which may be left out.

use glam::DVec3;

use super::document::Table;
use crate::{error::Result, scene::CameraParts};

pub(super) const KEYS: &[&str] = &["eye", "target", "up", "fov_deg", "near"];

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
    Ok(CameraParts { eye, target, up, from: None, fov_y_rad: fov_deg.map(f64::to_radians), near })
}
