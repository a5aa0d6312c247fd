//! Texts of files in messages: on one line, short, and without what a terminal would obey.

use std::fmt::{self, Write};

/// The most characters of a message.
const MOST: usize = 2000;

/// Writes text through, with characters that a terminal would obey as their escapes, and ends after [`MOST`] characters.
pub(super) struct OneLine<'a, W: Write> {
    out: &'a mut W,
    left: usize,
}

impl<'a, W: Write> OneLine<'a, W> {
    pub fn new(out: &'a mut W) -> Self {
        Self { out, left: MOST }
    }
}

impl<W: Write> Write for OneLine<'_, W> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for c in text.chars() {
            match self.left {
                0 => return Ok(()),
                1 => self.out.write_str(" ...")?,
                _ if matches!(c, '\n' | '\r' | '\t') => self.out.write_char(' ')?,
                _ if is_obeyed(c) => write!(self.out, "{}", c.escape_default())?,
                _ => self.out.write_char(c)?,
            }
            self.left -= 1;
        }
        Ok(())
    }
}

/// A text as it can be shown beside others: on one line of at most 2000 characters, with breaks as spaces, and control characters and
/// those that turn the direction of writing as their escapes.
pub fn one_line(text: &str) -> String {
    let mut shown = String::new();
    // Writing to a string can't fail.
    let _ = OneLine::new(&mut shown).write_str(text);
    shown
}

/// Control characters, line and paragraph separators, and marks of direction (Unicode 15, "Bidi_Control").
fn is_obeyed(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;

    #[test]
    fn nothing_of_a_file_reaches_a_terminal_as_more_than_text() {
        let hostile = "a\u{1b}[2J\n\0\u{202e}b\u{7f}\u{9b}ü";
        assert_eq!(one_line(hostile), "a\\u{1b}[2J \\u{0}\\u{202e}b\\u{7f}\\u{9b}ü");
        let error = Error::input(hostile, hostile, hostile).to_string();
        assert!(error.chars().all(|c| !is_obeyed(c)) && error.contains('ü'), "{error}");
    }

    #[test]
    fn a_long_text_ends() {
        let long = "x".repeat(200_000);
        let error = Error::option("--known", long.as_str()).to_string();
        assert!(error.len() < MOST + 10 && error.starts_with("--known: xxx") && error.ends_with("x ..."));
        assert_eq!(one_line("short"), "short");
    }
}
