//! The lines of an OBJ or MTL file: joined where one ends with `\`, and of a length within the limits.

use std::borrow::Cow;

use crate::{
    error::{Error, Result},
    load::Input,
};

/// How many lines are read between two progress messages.
const PROGRESS_LINES: u64 = 1 << 16;

/// A statement: a keyword and what follows it, without comments.
pub(super) struct Line<'a> {
    text: Cow<'a, [u8]>,
    /// Where the keyword ends.
    end: usize,
}

impl Line<'_> {
    pub(super) fn keyword(&self) -> &[u8] {
        self.text.get(..self.end).unwrap_or_default()
    }

    /// What follows the keyword.
    ///
    /// # Errors
    /// In words, if it is not UTF-8.
    pub(super) fn rest(&self) -> Result<&str, String> {
        let rest = self.text.get(self.end..).unwrap_or_default();
        str::from_utf8(rest).map(str::trim).map_err(|_| "not text; expected UTF-8".to_owned())
    }
}

/// The lines of a file, one after the other.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    input: &'a Input<'a>,
    rest: &'a [u8],
    /// The number of the last physical line, from 1.
    line: u64,
    /// That of the first one of the last statement.
    first: u64,
}

impl<'a> Lines<'a> {
    pub(super) fn new(input: &'a Input<'a>) -> Self {
        Self { input, rest: input.bytes, line: 0, first: 0 }
    }

    /// The next line that says something; `None` at the end.
    pub(super) fn next(&mut self) -> Result<Option<Line<'a>>> {
        while !self.rest.is_empty() {
            self.first = self.line + 1;
            let text = self.joined()?;
            let comment = text.iter().position(|&b| b == b'#').unwrap_or(text.len());
            let text = match text {
                Cow::Borrowed(text) => Cow::Borrowed(text.get(..comment).unwrap_or(text).trim_ascii()),
                Cow::Owned(text) => Cow::Owned(text.get(..comment).unwrap_or(&text).trim_ascii().to_vec()),
            };
            let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
            if end > 0 {
                return Ok(Some(Line { text, end }));
            }
        }
        Ok(None)
    }

    /// A line and those that continue it.
    fn joined(&mut self) -> Result<Cow<'a, [u8]>> {
        let first = self.physical(0)?;
        if !first.trim_ascii_end().ends_with(b"\\") {
            return Ok(Cow::Borrowed(first));
        }
        let mut text = first.to_vec();
        while let Some(head) = text.trim_ascii_end().strip_suffix(b"\\") {
            text.truncate(head.len());
            text.push(b' ');
            let more = self.physical(text.len())?;
            text.extend_from_slice(more);
            if self.rest.is_empty() {
                break;
            }
        }
        Ok(Cow::Owned(text))
    }

    /// The next line of the file, that continues one of `before` bytes.
    fn physical(&mut self, before: usize) -> Result<&'a [u8]> {
        let most = self.input.options.limits.line_bytes;
        let room = most.saturating_sub(before);
        let window = self.rest.get(..=room).unwrap_or(self.rest);
        let end = window.iter().position(|&b| b == b'\n').unwrap_or(window.len());
        self.line += 1;
        if end > room {
            return Err(self.fault(format!("longer than {most} bytes; expected at most that many")));
        }
        let (line, after) = self.rest.split_at_checked(end).unwrap_or((self.rest, &[]));
        self.rest = after.get(1..).unwrap_or_default();
        if self.line.is_multiple_of(PROGRESS_LINES) {
            self.input.step(self.input.bytes.len() - self.rest.len());
        }
        Ok(line)
    }

    /// The line in which the last statement begins.
    pub(super) fn first(&self) -> u64 {
        self.first
    }

    /// An error of the last statement.
    pub(super) fn fault(&self, problem: String) -> Error {
        self.fault_at(self.first, problem)
    }

    /// An error of a statement that begins in a line.
    pub(super) fn fault_at(&self, line: u64, problem: String) -> Error {
        self.input.fault(format!("line {line}"), problem)
    }
}

/// A word for a message: short and printable.
pub(super) fn shown(word: &str) -> String {
    word.chars().take(40).collect::<String>().escape_debug().to_string()
}
