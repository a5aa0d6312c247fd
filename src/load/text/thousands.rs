//! Numbers with marks of thousands, as tables for readers have them: 1,234.5 and 1.234,5 and 1 234,5 and 1'234.5.

/// What may stand between the thousands of a number: commas and points, blanks that are kept together, by UTF-8 and by Latin-1, and
/// apostrophes.
const MARKS: [&[u8]; 8] =
    [b",", b".", b" ", b"'", "\u{a0}".as_bytes(), "\u{202f}".as_bytes(), "’".as_bytes(), b"\xa0"];

/// The longest number: a shortest f64 has at most 24 characters.
const MOST_BYTES: usize = 64;

/// The number, and its mark; `None` of what has no marks, and of what may as well be a fraction, as 1,234.
pub(super) fn read(word: &[u8]) -> Option<(f64, &'static [u8])> {
    let unsigned = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word);
    let first = unsigned.iter().take_while(|byte| byte.is_ascii_digit()).count();
    if !(1..=3).contains(&first) || word.len() > MOST_BYTES {
        return None;
    }
    let (digits, mut rest) = unsigned.split_at(first);
    let mark = MARKS.into_iter().find(|mark| rest.starts_with(mark))?;
    let mut whole = digits.to_vec();
    let mut groups = 0;
    while let Some(group) = rest.strip_prefix(mark).and_then(|behind| behind.get(..3)) {
        if !group.iter().all(u8::is_ascii_digit) {
            return None;
        }
        whole.extend(group);
        rest = rest.get(mark.len() + 3..).unwrap_or_default();
        groups += 1;
    }
    let fraction = match rest {
        [] => rest,
        [b'.' | b',', fraction @ ..] if !rest.starts_with(mark) => fraction,
        _ => return None,
    };
    let is_fraction_itself = groups == 1 && rest.is_empty() && matches!(mark, b"," | b".");
    if groups == 0 || is_fraction_itself || !fraction.iter().all(u8::is_ascii_digit) {
        return None;
    }
    whole.push(b'.');
    whole.extend(fraction);
    let value: f64 = str::from_utf8(&whole).ok()?.parse().ok()?;
    Some((if word.starts_with(b"-") { -value } else { value }, mark))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_told_from_fractions() {
        for (word, value) in [
            ("1,234.5", 1234.5),
            ("-1.234,25", -1234.25),
            ("+12 345", 12_345.0),
            ("1 234,5", 1234.5),
            ("1\u{a0}234.5", 1234.5),
            ("1\u{202f}234\u{202f}567", 1_234_567.0),
            ("4'600'000.125", 4_600_000.125),
            ("1’234", 1234.0),
            ("1,234,567", 1_234_567.0),
            ("1.234.567", 1_234_567.0),
            ("1,234.", 1234.0),
        ] {
            assert_eq!(read(word.as_bytes()).map(|(value, _)| value), Some(value), "{word}");
        }
        assert_eq!(read(b"1\xa0234"), Some((1234.0, &b"\xa0"[..])));
        for word in [
            "1,234",
            "1.234",
            "1234",
            "1234,567.5",
            "1,23.5",
            "1,2345",
            "1,234 567",
            "1,234,5",
            "1 2345",
            ",234",
            "1,234.5.6",
            "1,234.x",
            "",
            "-",
            "1,",
            "1 ",
            "12:30:15",
            "1,234.5e3",
        ] {
            assert_eq!(read(word.as_bytes()), None, "{word}");
        }
    }
}
