//! Patterns of names, as options and known lists have them.

use std::fmt;

/// A case's name, the beginning of one up to a dot, or either with `*` for any part: `methods.triangle` and
/// `*.edge-on-disks` are patterns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern(String);

impl Pattern {
    /// The pattern of a text.
    ///
    /// # Errors
    /// Why it can't match any name, in words.
    pub fn new(text: &str) -> Result<Self, String> {
        let odd = |c: &char| !(c.is_ascii_lowercase() || c.is_ascii_digit() || "-.*".contains(*c));
        match text.chars().find(odd) {
            _ if text.is_empty() => Err("expected a case's name or a pattern of names".to_owned()),
            Some(odd) => Err(format!("{text}: '{odd}' is in no case's name")),
            None => Ok(Self(text.to_owned())),
        }
    }

    /// Whether it matches the name of a case, or that of a group the case is in.
    pub fn matches(&self, case: &str) -> bool {
        let ends = case.match_indices('.').map(|(end, _)| end).chain([case.len()]);
        ends.into_iter().any(|end| is_like(&case[..end], &self.0))
    }
}

impl fmt::Display for Pattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Whether all of `text` is like `pattern`, in which `*` stands for any part.
pub(super) fn is_like(text: &str, pattern: &str) -> bool {
    let Some((start, rest)) = pattern.split_once('*') else { return text == pattern };
    let Some(mut left) = text.strip_prefix(start) else { return false };
    // The earliest place of each part leaves the most for those after it; the last must reach the end.
    let (middle, end) = rest.rsplit_once('*').unwrap_or(("", rest));
    for part in middle.split('*') {
        let Some(found) = left.find(part) else { return false };
        left = &left[found + part.len()..];
    }
    left.ends_with(end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_stand_for_any_part() {
        for (text, pattern) in [
            ("abc", "abc"),
            ("abc", "*"),
            ("abc", "a*c"),
            ("abc", "*b*"),
            ("abcbc", "a*bc"),
            ("aXbYa", "a*b*a"),
            ("", "*"),
        ] {
            assert!(is_like(text, pattern), "{text} {pattern}");
        }
        for (text, pattern) in [("abc", "ab"), ("abc", "b*"), ("a", "a*a"), ("abab", "a*b*c"), ("abc", "")] {
            assert!(!is_like(text, pattern), "{text} {pattern}");
        }
    }

    #[test]
    fn a_pattern_matches_a_case_or_its_groups() {
        let case = "methods.triangle.none.edge-on-disks";
        for pattern in ["methods", "methods.triangle", case, "*.edge-on-disks", "methods.*.none", "*"] {
            assert!(Pattern::new(pattern).unwrap().matches(case), "{pattern}");
        }
        for pattern in ["method", "methods.tri", "triangle", "methods.", "edge-on-disks", "methods.quad.*"] {
            assert!(!Pattern::new(pattern).unwrap().matches(case), "{pattern}");
        }
        for text in ["", "a b", "methods.Triangle", "methods/triangle", "a#"] {
            assert!(Pattern::new(text).is_err(), "{text}");
        }
    }
}
