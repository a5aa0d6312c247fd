//! Formats of text whose lines are elements: lines with their place, and the numbers in them.

use std::str::FromStr;

use super::{Input, sniff::without_mark};
use crate::error::{Error, Result};

/// The lines of a file that have something in them, without comments and blanks around them.
pub(super) struct Lines<'a> {
    input: &'a Input<'a>,
    line_end: u8,
    /// Where comments start in a line.
    comment: Option<u8>,
    at: usize,
}

/// A line.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    /// The byte at which it starts.
    pub at: usize,
    pub text: &'a [u8],
}

/// How many bytes are read between two steps of progress.
const STEP_BYTES: usize = 1 << 22;

impl<'a> Lines<'a> {
    /// The lines of a file; what follows `comment` in a line is none of it.
    pub fn new(input: &'a Input<'a>, comment: Option<u8>) -> Self {
        let line_end = if input.bytes.contains(&b'\n') { b'\n' } else { b'\r' };
        Self { input, line_end, comment, at: input.bytes.len() - without_mark(input.bytes).len() }
    }

    /// The first byte that is not read yet.
    pub fn at(&self) -> usize {
        self.at
    }

    /// How many bytes are not read yet.
    pub fn left(&self) -> usize {
        self.input.bytes.len().saturating_sub(self.at)
    }

    /// Goes on at a byte that starts a line.
    pub fn skip_to(&mut self, at: usize) {
        self.at = at;
    }

    /// The next line with something in it.
    pub fn next(&mut self) -> Result<Option<Line<'a>>> {
        while let Some(rest) = self.input.bytes.get(self.at..).filter(|rest| !rest.is_empty()) {
            let at = self.at;
            let most = self.input.options.limits.line_bytes;
            // No more of a line is looked at.
            let window = rest.get(..=most).unwrap_or(rest);
            let whole = window.split(|b| *b == self.line_end).next().unwrap_or_default();
            self.at += whole.len() + 1;
            if at / STEP_BYTES != self.at / STEP_BYTES {
                self.input.step(self.at.min(self.input.bytes.len()));
            }
            if whole.len() > most {
                return Err(self.input.fault(self.input.line(at), format!("longer than {most} bytes")));
            }
            let text = match self.comment {
                Some(comment) => whole.split(|b| *b == comment).next().unwrap_or_default(),
                None => whole,
            };
            let text = text.trim_ascii();
            if !text.is_empty() {
                return Ok(Some(Line { at, text }));
            }
        }
        Ok(None)
    }

    /// The next line, which must be there for `what`.
    pub fn expect(&mut self, what: &str) -> Result<Line<'a>> {
        let end = self.input.bytes.len();
        self.next()?
            .ok_or_else(|| self.input.fault(self.input.line(end), format!("the file ends; expected {what}")))
    }

    /// An error in a line.
    pub fn fault(&self, line: Line<'_>, problem: impl Into<String>) -> Error {
        self.input.fault(self.input.line(line.at), problem)
    }

    /// The next of the words of a line as a number.
    pub fn number<T: FromStr>(
        &self,
        line: Line<'_>,
        words: &mut impl Iterator<Item = &'a [u8]>,
        what: &str,
    ) -> Result<T> {
        let Some(word) = words.next() else {
            return Err(self.fault(line, format!("the line ends; expected {what}")));
        };
        let number = str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        number.ok_or_else(|| self.fault(line, format!("'{}'; expected {what}", shown(word))))
    }
}

impl<'a> Line<'a> {
    /// What stands between blanks.
    pub fn words(&self) -> impl Iterator<Item = &'a [u8]> + use<'a> {
        self.text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
    }
}

/// A word for a message: short and printable.
pub(super) fn shown(word: &[u8]) -> String {
    String::from_utf8_lossy(word.get(..40).unwrap_or(word)).escape_debug().to_string()
}
