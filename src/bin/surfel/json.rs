//! JSON texts.

use std::io;

use serde::Serialize;
use serde_json::Value;
use surfel::{Error, Result};

/// JSON, indented, with a line end. Numbers that are not finite become `null`.
///
/// # Errors
/// None for plain structures; a map whose keys are no texts.
pub fn to_json(value: &impl Serialize) -> Result<String> {
    let text = serde_json::to_string_pretty(value);
    text.map(|text| text + "\n").map_err(|e| Error::file("JSON", "write", io::Error::other(e)))
}

/// A part of a larger JSON.
///
/// # Errors
/// As [`to_json`].
pub fn to_value(value: &impl Serialize) -> Result<Value> {
    serde_json::to_value(value).map_err(|e| Error::file("JSON", "write", io::Error::other(e)))
}
