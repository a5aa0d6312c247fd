//! JSON texts.

use std::{io, path::Path};

use serde::Serialize;
use serde_json::Value;
use surfel::{Error, Result, save};

/// JSON, indented, with a line end. Numbers that are not finite become `null`.
///
/// # Errors
/// None for plain structures; a map whose keys are no texts.
pub fn to_json(value: &impl Serialize) -> Result<String> {
    let text = serde_json::to_string_pretty(value);
    text.map(|text| text + "\n").map_err(|e| Error::file("JSON", "write", io::Error::other(e)))
}

/// A part of a larger JSON.
pub fn to_value(value: &impl Serialize) -> Result<Value> {
    serde_json::to_value(value).map_err(|e| Error::file("JSON", "write", io::Error::other(e)))
}

/// Writes it into a file, where one is asked for.
pub fn write_json(path: Option<&Path>, value: &impl Serialize) -> Result<()> {
    path.map_or(Ok(()), |path| save::text(path, &to_json(value)?))
}
