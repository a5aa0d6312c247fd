//! Cells of tables.

use surfel::report::{NONE, Spread};

/// A number of any magnitude.
pub fn scientific(value: Option<f64>) -> String {
    match value {
        None => NONE.to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(value) => format!("{value:.2e}"),
    }
}

/// Where the true median is with 95% confidence.
pub fn interval_cell(spread: Option<&Spread>) -> String {
    let interval = spread.and_then(|spread| spread.interval);
    interval.map_or_else(|| NONE.to_owned(), |[low, high]| format!("{low:.2} to {high:.2}"))
}
