//! A table as plain text cells, and as what people and programs read: aligned text, Markdown, CSV.

use std::fmt;

/// A table.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Grid {
    /// Over the table; one line.
    pub title: String,
    /// The columns' names. The first column is aligned to the left, all others to the right.
    pub head: Vec<String>,
    /// The rows, as long as `head` each.
    pub rows: Vec<Vec<String>>,
    /// Under the table, a line each.
    pub notes: Vec<String>,
}

/// What stands for a figure that does not exist.
pub const NONE: &str = "-";

/// A figure with so many decimals, or [`NONE`].
pub fn cell(figure: Option<f64>, decimals: usize) -> String {
    figure.map_or_else(|| NONE.to_owned(), |figure| format!("{figure:.decimals$}"))
}

/// A figure of others beside ours, in brackets; empty where they have none.
pub(super) fn bracketed(figure: Option<f64>, decimals: usize) -> String {
    figure.map_or_else(String::new, |figure| format!("({figure:.decimals$})"))
}

/// A count, or [`NONE`].
pub fn count_cell(count: Option<u64>) -> String {
    count.map_or_else(|| NONE.to_owned(), |count| count.to_string())
}

impl Grid {
    /// A table without rows.
    pub fn new(title: impl Into<String>, head: &[&str]) -> Self {
        let head = head.iter().map(|name| (*name).to_owned()).collect();
        Self { title: title.into(), head, ..Self::default() }
    }

    /// Adds a row.
    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }

    /// As Markdown.
    pub fn markdown(&self) -> String {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let escaped =
            |cells: &[String]| cells.iter().map(|cell| cell.replace('|', "\\|")).collect::<Vec<_>>();
        let rule: Vec<String> =
            (0..self.head.len()).map(|i| if i == 0 { "---" } else { "---:" }.to_owned()).collect();
        let rows: String = self.rows.iter().map(|row| line(&escaped(row))).collect();
        let notes: String = self.notes.iter().map(|note| format!("\n{note}\n")).collect();
        format!("**{}**\n\n{}{}{rows}{notes}", self.title, line(&escaped(&self.head)), line(&rule))
    }

    /// As CSV (RFC 4180 with line feeds): the head, then the rows.
    pub fn csv(&self) -> String {
        let quoted = |cell: &String| match cell.contains([',', '"', '\n']) {
            true => format!("\"{}\"", cell.replace('"', "\"\"")),
            false => cell.clone(),
        };
        let line = |cells: &Vec<String>| cells.iter().map(quoted).collect::<Vec<_>>().join(",") + "\n";
        [&self.head].into_iter().chain(&self.rows).map(line).collect()
    }
}

impl fmt::Display for Grid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.title)?;
        let all = || [&self.head].into_iter().chain(&self.rows);
        let width = |i: usize| all().filter_map(|row| row.get(i)).map(|cell| cell.chars().count()).max();
        let widths: Vec<usize> = (0..self.head.len()).map(|i| width(i).unwrap_or(0)).collect();
        for row in all() {
            let mut line = String::new();
            for (i, (cell, width)) in row.iter().zip(&widths).enumerate() {
                line += &match i {
                    0 => format!("{cell:width$}"),
                    _ => format!("  {cell:>width$}"),
                };
            }
            writeln!(f, "{}", line.trim_end())?;
        }
        for note in &self.notes {
            writeln!(f, "{note}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Grid {
        let mut grid = Grid::new("a title", &["name", "ms"]);
        grid.row(["x, \"y\"".to_owned(), cell(Some(1.25), 1)]);
        grid.row(["a|b".to_owned(), count_cell(None)]);
        grid.notes.push("a note".to_owned());
        grid
    }

    #[test]
    fn text_is_aligned() {
        assert_eq!(grid().to_string(), "a title\nname     ms\nx, \"y\"  1.2\na|b       -\na note\n");
    }

    #[test]
    fn markdown_and_csv_escape_what_separates() {
        let expected =
            "**a title**\n\n| name | ms |\n| --- | ---: |\n| x, \"y\" | 1.2 |\n| a\\|b | - |\n\na note\n";
        assert_eq!(grid().markdown(), expected);
        assert_eq!(grid().csv(), "name,ms\n\"x, \"\"y\"\"\",1.2\na|b,-\n");
    }
}
