//! A table as plain text cells, and as what people and programs read: aligned text, Markdown, CSV.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A table.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Grid {
    /// Over the table: one line, or nothing.
    pub title: String,
    /// The columns' names.
    pub head: Vec<String>,
    /// The rows, as long as `head` each.
    pub rows: Vec<Vec<String>>,
    /// Under the table, a line each.
    pub notes: Vec<String>,
    /// How many columns, from the first on, name the row: they are aligned to the left, all others to the right.
    pub names: usize,
}

/// A table while its columns are listed; each is a heading and the cell that it has in a row.
pub struct Table<'a, R> {
    rows: &'a [R],
    grid: Grid,
}

impl Grid {
    /// A table with a row for each of these, without columns. Its first column names the row.
    pub fn of<R>(title: impl Into<String>, rows: &[R]) -> Table<'_, R> {
        let cells = vec![Vec::new(); rows.len()];
        Table { rows, grid: Self { title: title.into(), rows: cells, names: 1, ..Self::default() } }
    }

    /// As Markdown.
    pub fn markdown(&self) -> String {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let escaped =
            |cells: &[String]| cells.iter().map(|cell| cell.replace('|', "\\|")).collect::<Vec<_>>();
        let rule: Vec<String> =
            (0..self.head.len()).map(|i| if i < self.names { "---" } else { "---:" }.to_owned()).collect();
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

impl<R> Table<'_, R> {
    /// With another column.
    pub fn column<C: ToString>(mut self, head: impl Into<String>, cell: impl Fn(&R) -> C) -> Self {
        self.grid.head.push(head.into());
        for (row, cells) in self.rows.iter().zip(&mut self.grid.rows) {
            cells.push(cell(row).to_string());
        }
        self
    }

    /// So many columns name the row, in place of one.
    pub fn names(mut self, names: usize) -> Self {
        self.grid.names = names;
        self
    }

    /// With another line under it.
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.grid.notes.push(note.into());
        self
    }

    /// The table, with these further lines under it.
    pub fn with_notes(mut self, notes: impl IntoIterator<Item = String>) -> Grid {
        self.grid.notes.extend(notes);
        self.grid
    }

    /// The table.
    pub fn grid(self) -> Grid {
        self.grid
    }
}

impl fmt::Display for Grid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.title.is_empty() {
            writeln!(f, "{}", self.title)?;
        }
        let all = || [&self.head].into_iter().chain(&self.rows);
        let width = |i: usize| all().filter_map(|row| row.get(i)).map(|cell| cell.chars().count()).max();
        let widths: Vec<usize> = (0..self.head.len()).map(|i| width(i).unwrap_or(0)).collect();
        for row in all() {
            let mut line = String::new();
            for (i, (cell, width)) in row.iter().zip(&widths).enumerate() {
                let gap = if i == 0 { "" } else { "  " };
                line += &match i < self.names {
                    true => format!("{gap}{cell:width$}"),
                    false => format!("{gap}{cell:>width$}"),
                };
            }
            writeln!(f, "{}", line.trim_end())?;
        }
        self.notes.iter().try_for_each(|note| writeln!(f, "{note}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Grid {
        let rows = [("x, \"y\"", "1.2"), ("a|b", "-")];
        let table = Grid::of("a title", &rows).column("name", |row| row.0).column("ms", |row| row.1);
        table.note("a note").grid()
    }

    #[test]
    fn text_is_aligned() {
        assert_eq!(grid().to_string(), "a title\nname     ms\nx, \"y\"  1.2\na|b       -\na note\n");
        let untitled = Grid { title: String::new(), names: 2, notes: Vec::new(), ..grid() };
        assert_eq!(untitled.to_string(), "name    ms\nx, \"y\"  1.2\na|b     -\n");
    }

    #[test]
    fn markdown_and_csv_escape_what_separates() {
        let expected =
            "**a title**\n\n| name | ms |\n| --- | ---: |\n| x, \"y\" | 1.2 |\n| a\\|b | - |\n\na note\n";
        assert_eq!(grid().markdown(), expected);
        assert_eq!(grid().csv(), "name,ms\n\"x, \"\"y\"\"\",1.2\na|b,-\n");
    }
}
