//! The items of a list, read while they are asked for: no list takes memory of its own.

use super::{ascii, binary};
use crate::load::ply::schema::{Encoding, Scalar};

/// The items of one list. An item that is no number of its type is an error in words.
#[derive(Clone)]
pub(in crate::load::ply) enum Items<'a> {
    /// Words between blanks, and the property that they belong to.
    Words { words: std::str::SplitAsciiWhitespace<'a>, left: usize, name: &'a str, item: Scalar },
    /// As many bytes as the items have.
    Bytes { bytes: &'a [u8], item: Scalar, encoding: Encoding },
}

impl Items<'_> {
    /// How many are left.
    pub(in crate::load::ply) fn len(&self) -> usize {
        match self {
            Self::Words { left, .. } => *left,
            Self::Bytes { bytes, item, .. } => bytes.len() / item.bytes(),
        }
    }
}

impl Iterator for Items<'_> {
    type Item = Result<i64, String>;

    fn next(&mut self) -> Option<Self::Item> {
        match self {
            Self::Words { words, left, name, item } => {
                *left = left.checked_sub(1)?;
                // A list that is wanted has integers.
                Some(ascii::number(name, *item, words.next()).map(|value| value as i64))
            }
            Self::Bytes { bytes, item, encoding } => {
                let (first, rest) = bytes.split_at_checked(item.bytes())?;
                *bytes = rest;
                Some(Ok(binary::number(first, *item, *encoding) as i64))
            }
        }
    }
}
