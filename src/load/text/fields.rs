//! A line taken apart, and the numbers in it.

use super::thousands;
use crate::load::number;

/// What stands between the numbers of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Between {
    /// Any number of blanks and tabs.
    Blanks,
    Comma,
    Semicolon,
}

/// How the numbers of a file are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Writing {
    pub between: Between,
    /// 1,5 is one and a half.
    pub decimal_comma: bool,
}

impl Writing {
    /// Told by one row.
    pub fn of(row: &[u8]) -> Self {
        let has = |byte: u8| row.contains(&byte);
        let is_marked = |word: &[u8]| thousands::read(unquoted(word)).is_some_and(|(_, mark)| mark == b",");
        let semicolon = Self { between: Between::Semicolon, decimal_comma: has(b',') };
        if has(b';') {
            let decimal_comma = has(b',') && !semicolon.fields(row).any(is_marked);
            return Self { decimal_comma, ..semicolon };
        }
        // Of a table whose words are in quotation marks: a comma within is none between, and no mark of thousands where other than three digits follow.
        let quoted = Self { between: Between::Comma, decimal_comma: true };
        let is_decimal = |word: &[u8]| {
            let within = word.strip_prefix(b"\"").and_then(|word| word.split(|b| *b == b',').nth(1));
            let digits = within.and_then(|digits| digits.strip_suffix(b"\""));
            digits.is_some_and(|digits| digits.len() != 3 && !digits.contains(&b'.'))
        };
        if has(b'"') && quoted.fields(row).any(is_decimal) {
            return quoted;
        }
        let blanks = Self { between: Between::Blanks, decimal_comma: has(b',') };
        // Commas that stand within three or more words stand for points; in `1, 2, 3` they end words.
        let mut words = 0;
        let all_decimal = blanks.fields(row).all(|word| {
            let is_number = number(word, true).is_some() && !word.ends_with(b",");
            words += usize::from(is_number);
            is_number || !word.contains(&b',')
        });
        let with_marks = Self { decimal_comma: false, ..blanks };
        let are_numbers = || with_marks.fields(row).all(|word| with_marks.number(word).is_some());
        if with_marks.fields(row).any(is_marked) && with_marks.fields(row).nth(2).is_some() && are_numbers() {
            return with_marks;
        }
        match has(b',') && !(all_decimal && words >= 3) {
            true => Self { between: Between::Comma, decimal_comma: false },
            false => blanks,
        }
    }

    /// The words of a line, without blanks around them. One empty word at the end, behind a last comma, is none.
    pub fn fields<'a>(self, line: &'a [u8]) -> Fields<'a> {
        Fields { rest: Some(line), between: self.between }
    }

    /// Whether the last word of a line is empty, which [`Writing::fields`] does not count.
    pub fn ends_empty(self, line: &[u8]) -> bool {
        match self.between {
            Between::Blanks => false,
            Between::Comma => line.ends_with(b","),
            Between::Semicolon => line.ends_with(b";"),
        }
    }

    /// The number that a word is.
    pub fn number(self, word: &[u8]) -> Option<f64> {
        number(word, self.decimal_comma)
    }
}

/// The words of a line.
pub(super) struct Fields<'a> {
    rest: Option<&'a [u8]>,
    between: Between,
}

impl<'a> Iterator for Fields<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest?.trim_ascii_start();
        if rest.is_empty() {
            self.rest = None;
            return None;
        }
        let ends = |byte: &u8| match self.between {
            Between::Blanks => byte.is_ascii_whitespace(),
            Between::Comma => *byte == b',',
            Between::Semicolon => *byte == b';',
        };
        // What is in quotation marks is one word, but for theirs.
        let quoted = match (self.between, rest.first()) {
            (Between::Comma, Some(b'"')) => {
                rest.iter().skip(1).position(|b| *b == b'"').map_or(0, |end| end + 1)
            }
            _ => 0,
        };
        match rest.iter().skip(quoted).position(ends).map(|end| quoted + end) {
            Some(end) => {
                let (word, behind) = rest.split_at(end);
                self.rest = behind.get(1..);
                Some(word.trim_ascii_end())
            }
            None => {
                self.rest = None;
                Some(rest.trim_ascii_end())
            }
        }
    }
}

/// The longest number with a decimal comma: a shortest f64 has at most 24 characters.
const MOST_DECIMAL_BYTES: usize = 64;

fn number(word: &[u8], decimal_comma: bool) -> Option<f64> {
    let word = unquoted(word);
    plain_number(word, decimal_comma).or_else(|| thousands::read(word).map(|(value, _)| value))
}

fn unquoted(word: &[u8]) -> &[u8] {
    word.strip_prefix(b"\"").and_then(|word| word.strip_suffix(b"\"")).unwrap_or(word)
}

fn plain_number(word: &[u8], decimal_comma: bool) -> Option<f64> {
    if decimal_comma && word.contains(&b',') {
        let mut copy = [0; MOST_DECIMAL_BYTES];
        let copy = copy.get_mut(..word.len())?;
        copy.copy_from_slice(word);
        copy.iter_mut().filter(|b| **b == b',').for_each(|b| *b = b'.');
        return number::read(str::from_utf8(copy).ok()?);
    }
    number::read(str::from_utf8(word).ok()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_to_write_a_row_is_told() {
        let cases: [(&str, Between, bool, &[f64]); 17] = [
            ("1 2\t 3", Between::Blanks, false, &[1.0, 2.0, 3.0]),
            ("1,2,3", Between::Comma, false, &[1.0, 2.0, 3.0]),
            ("1, 2, 3,", Between::Comma, false, &[1.0, 2.0, 3.0]),
            ("1.5;2;3;", Between::Semicolon, false, &[1.5, 2.0, 3.0]),
            ("1,5;2,25;-3", Between::Semicolon, true, &[1.5, 2.25, -3.0]),
            ("1,5 2,5\t3,5", Between::Blanks, true, &[1.5, 2.5, 3.5]),
            ("\"1.5\",\"2\",\"3\"", Between::Comma, false, &[1.5, 2.0, 3.0]),
            ("\"0,85\",\"2\",\"-3,125\"", Between::Comma, true, &[0.85, 2.0, -3.125]),
            ("\"1,234\",\"2\",\"3\"", Between::Comma, false, &[]),
            ("\"1,234.5\",\"12,345.25\",\"3\"", Between::Comma, false, &[1234.5, 12_345.25, 3.0]),
            ("1,234.5;2;3.25", Between::Semicolon, false, &[1234.5, 2.0, 3.25]),
            ("1.234,5;2;3,25", Between::Semicolon, true, &[1234.5, 2.0, 3.25]),
            ("1 234,5;2 000;3,25", Between::Semicolon, true, &[1234.5, 2000.0, 3.25]),
            ("1,234.5 2 3,000.25", Between::Blanks, false, &[1234.5, 2.0, 3000.25]),
            ("1 234.5,2 000,3", Between::Comma, false, &[1234.5, 2000.0, 3.0]),
            ("1e3 +2. .5", Between::Blanks, false, &[1000.0, 2.0, 0.5]),
            ("1,2,3 4,5,6", Between::Comma, false, &[1.0, 2.0]),
        ];
        for (row, between, decimal_comma, numbers) in cases {
            let writing = Writing::of(row.as_bytes());
            assert_eq!(writing, Writing { between, decimal_comma }, "{row}");
            let read: Vec<f64> =
                writing.fields(row.as_bytes()).map_while(|word| writing.number(word)).collect();
            assert_eq!(read, numbers, "{row}");
        }
    }

    #[test]
    fn an_empty_word_between_commas_is_one() {
        let writing = Writing::of(b"1,2,3");
        assert_eq!(writing.fields(b"1,,3,").collect::<Vec<_>>(), [&b"1"[..], b"", b"3"]);
    }
}
