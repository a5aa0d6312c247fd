//! What is wrong with JSON, in few words however long the file's own are.

use std::fmt::{self, Write as _};

/// Bytes of the beginning of a text that are kept, and of its end.
const MOST_BYTES: usize = 150;

/// What the crate says, without the middle of what it quotes: a text of the file may be as long as the file, and each copy of it costs as much again.
pub(super) fn problem(error: &serde_json::Error) -> String {
    let mut ends = Ends::default();
    // Strings can be written to.
    let _ = write!(ends, "{error}");
    let all =
        if ends.left_out { format!("{}… {}", ends.first, ends.last) } else { ends.first + &ends.last };
    all.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The first and the last bytes of what is written.
#[derive(Default)]
struct Ends {
    first: String,
    last: String,
    left_out: bool,
}

impl fmt::Write for Ends {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let room = (MOST_BYTES - self.first.len()).min(text.len());
        let end = (0..=room).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0);
        // Once something is behind the beginning, nothing more belongs to it.
        let (first, rest) = text.split_at(if self.last.is_empty() { end } else { 0 });
        self.first.push_str(first);
        let kept = from_last(rest);
        self.last.push_str(kept);
        let end_of_all = from_last(&self.last).to_owned();
        self.left_out |= kept.len() < rest.len() || end_of_all.len() < self.last.len();
        self.last = end_of_all;
        Ok(())
    }
}

fn from_last(text: &str) -> &str {
    let most = text.len().saturating_sub(MOST_BYTES);
    let start = (most..=text.len()).find(|at| text.is_char_boundary(*at)).unwrap_or(text.len());
    &text[start..]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_texts_of_files_are_quoted_by_their_ends() {
        let of = |length: usize| {
            let json = format!("\n\"{}z\"", "é".repeat(length));
            problem(&serde_json::from_str::<u32>(&json).unwrap_err())
        };
        let end = "z\", expected u32 at line 2 column";
        assert_eq!(of(2), format!("invalid type: string \"éé{end} 7"));
        let long = of(1_000_000);
        assert!(
            long.starts_with("invalid type: string \"éé") && long.ends_with(&format!("é{end} 2000003")),
            "{long}"
        );
        assert!(long.contains("é… é") && long.len() <= 2 * MOST_BYTES + 4, "{long}");
        // Nothing is lost, or said twice, of any length between.
        for length in 0..200 {
            let said = of(length);
            assert_eq!(said.matches('é').count() == length, !said.contains('…'), "{said}");
        }
    }
}
