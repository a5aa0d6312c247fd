//! A light of a scene file.

use glam::DVec3;

use super::document::{Table, Value};
use crate::{
    error::Result,
    math::srgb::linear_from_srgb,
    scene::{Light, LightKind},
};

pub(super) const KEYS: &[&str] = &["kind", "direction", "color", "intensity"];

pub(super) fn read(table: &Table<'_>) -> Result<Light> {
    let Some(kind) = table.get("kind") else {
        return Err(table.fault("no kind; expected 'eye' or 'directional'"));
    };
    let kind = match kind.one_of(&[("eye", false), ("directional", true)])? {
        true => LightKind::Directional(direction(table)?),
        false => {
            table.refuse("direction", "for a light at the eye; expected kind = \"directional\"")?;
            LightKind::Eye
        }
    };
    let color = table.get("color").map(|value| color(&value)).transpose()?.unwrap_or([1.0; 3]);
    let intensity = match table.get("intensity") {
        None => 1.0,
        Some(value) => {
            let in_range = |number: f64| (0.0..=f64::from(f32::MAX)).contains(&number);
            value.number("a number, at least 0", in_range)? as f32
        }
    };
    let light = Light { kind, color: color.map(|component| intensity * component) };
    light.validate().map_err(|error| table.fault(&error.to_string()))?;
    Ok(light)
}

fn direction(table: &Table<'_>) -> Result<DVec3> {
    let what = "in which direction the light travels, three numbers that are not all 0";
    let Some(value) = table.get("direction") else {
        return Err(table.fault(&format!("no direction; expected {what}")));
    };
    let direction = DVec3::from_array(value.numbers(what, |_| true)?);
    match direction.try_normalize() {
        Some(_) => Ok(direction),
        None => Err(value.expected(what)),
    }
}

/// Three sRGB values as linear light.
pub(super) fn color(value: &Value<'_>) -> Result<[f32; 3]> {
    let color = value.numbers("three numbers from 0 to 1 (sRGB)", |number| (0.0..=1.0).contains(&number))?;
    Ok(color.map(|component| linear_from_srgb(component as f32)))
}
