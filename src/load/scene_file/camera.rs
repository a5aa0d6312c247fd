//! The camera of a scene file: the keys of a camera file and of the options, each of which may be left out.

use glam::DVec3;

use super::document::{Table, Value};
use crate::{
    error::Result,
    scene::{AXES, CameraParts, PictureHeight, View},
};

pub(super) const KEYS: &[&str] = &[
    "eye",
    "view",
    "azimuth_deg",
    "elevation_deg",
    "target",
    "up",
    "fov_deg",
    "orthographic",
    "zoom",
    "near",
];

/// The camera, and the name of the object that it looks at.
pub(super) fn read(table: &Table<'_>) -> Result<(CameraParts, Option<String>)> {
    let eye = table.get("eye").map(|value| point(&value, "three numbers")).transpose()?;
    let (target, object) = match table.get("target") {
        None => (None, None),
        Some(value) => match value.text("") {
            Ok(name) => (None, Some(name.to_owned())),
            Err(_) => (Some(point(&value, "three numbers, or the name of an object")?), None),
        },
    };
    if eye.is_some() && eye == target {
        return Err(table.fault("eye and target are the same; expected two different points"));
    }
    let number = |key: &'static str, what: &str, good: fn(f64) -> bool| {
        table.get(key).map(|value| value.number(what, good)).transpose()
    };
    let view = table.get("view").map(|value| value.one_of(View::NAMES)).transpose()?;
    let azimuth_deg = number("azimuth_deg", "degrees, -360 to 360", |deg| deg.abs() <= 360.0)?;
    let elevation_deg = number("elevation_deg", "degrees, -90 to 90", |deg| deg.abs() <= 90.0)?;
    let said = [
        ("eye", eye.is_some()),
        ("view", view.is_some()),
        ("azimuth_deg or elevation_deg", azimuth_deg.is_some() || elevation_deg.is_some()),
    ];
    let said: Vec<_> = said.into_iter().filter_map(|(key, is_said)| is_said.then_some(key)).collect();
    if let [first, second, ..] = said[..] {
        return Err(table.fault(&format!("both {first} and {second}; expected one of them")));
    }
    let angles = view.map(View::angles_rad);
    let fov_deg = number("fov_deg", "degrees above 1e-10 and below 180", |deg| deg > 1e-10 && deg < 180.0)?;
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
    let parts = CameraParts {
        eye,
        azimuth_rad: angles.map(|[azimuth, _]| azimuth).or(azimuth_deg.map(f64::to_radians)),
        elevation_rad: angles.map(|[_, elevation]| elevation).or(elevation_deg.map(f64::to_radians)),
        target,
        subject: None,
        up: table.get("up").map(|value| up(&value)).transpose()?.flatten(),
        orthographic,
        fov_y_rad: fov_deg.map(f64::to_radians),
        zoom: number("zoom", "a number, 1e-6 to 1e6", |zoom| (1e-6..=1e6).contains(&zoom))?,
        near: number("near", "a number above 0", |near| near > 0.0)?,
    };
    Ok((parts, object))
}

fn point(value: &Value<'_>, what: &str) -> Result<DVec3> {
    value.numbers(what, |_| true).map(DVec3::from_array)
}

/// A direction, by name or by numbers; none for `auto`.
fn up(value: &Value<'_>) -> Result<Option<DVec3>> {
    let what = "three numbers, \"auto\", \"x\", \"y\", \"z\", \"-x\", \"-y\" or \"-z\"";
    match value.text(what) {
        Ok("auto") => Ok(None),
        Ok(word) => {
            let named = AXES.iter().find(|(name, _)| *name == word.strip_prefix('+').unwrap_or(word));
            named.map(|(_, direction)| Some(*direction)).ok_or_else(|| value.expected(what))
        }
        Err(_) => point(value, what).map(Some),
    }
}
