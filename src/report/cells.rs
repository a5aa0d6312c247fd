//! The cells of tables: figures as text.

use super::Spread;

/// The cell of a figure that does not exist.
pub const NONE: &str = "-";

/// A figure as it is, or [`NONE`].
pub fn figure(figure: Option<impl ToString>) -> String {
    figure.map_or_else(|| NONE.to_owned(), |figure| figure.to_string())
}

/// A number with so many decimals, or [`NONE`].
pub fn number(number: Option<f64>, decimals: usize) -> String {
    figure(number.map(|number| format!("{number:.decimals$}")))
}

/// A number of any magnitude, or [`NONE`].
pub fn scientific(number: Option<f64>) -> String {
    figure(number.map(|number| if number == 0.0 { "0".to_owned() } else { format!("{number:.2e}") }))
}

/// The middle of several measurements.
pub fn median(spread: Option<Spread>, decimals: usize) -> String {
    number(spread.map(|spread| spread.median), decimals)
}

/// The interval that holds the true median.
pub fn interval(spread: Option<Spread>, decimals: usize) -> String {
    let interval = spread.and_then(|spread| spread.interval);
    figure(interval.map(|[low, high]| format!("{low:.decimals$} to {high:.decimals$}")))
}

/// A figure of others beside ours, in brackets; empty where they have none.
pub fn bracketed(figure: Option<f64>, decimals: usize) -> String {
    figure.map_or_else(String::new, |figure| format!("({figure:.decimals$})"))
}

/// Bytes in millions.
pub fn megabytes(bytes: u64) -> String {
    format!("{:.1}", 1e-6 * bytes as f64)
}
