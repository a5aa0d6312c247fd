//! Command lines that give by themselves what the page shows: what is gathered is what they ask for.

use std::{
    ffi::{OsStr, OsString},
    fmt,
    path::{Path, PathBuf},
};

use clap::{Args, Command};
use surfel::{Error, Result};

/// The words after the program's name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CommandLine(Vec<OsString>);

impl CommandLine {
    /// A line of these words.
    pub fn new(words: impl IntoIterator<Item = impl Into<OsString>>) -> Self {
        Self(words.into_iter().map(Into::into).collect())
    }

    /// With another word.
    pub fn word(mut self, word: impl Into<OsString>) -> Self {
        self.0.push(word.into());
        self
    }

    /// With an option and its value, in one word where the value could be taken for an option.
    pub fn option(self, name: &str, value: impl AsRef<OsStr>) -> Self {
        let value = value.as_ref();
        match value.to_string_lossy().starts_with('-') {
            true => {
                let mut word = OsString::from(format!("{name}="));
                word.push(value);
                self.word(word)
            }
            false => self.word(name).word(value),
        }
    }

    /// With an option that has a value.
    pub fn given(self, name: &str, value: Option<impl AsRef<OsStr>>) -> Self {
        match value {
            Some(value) => self.option(name, value),
            None => self,
        }
    }

    /// With an input file, if there is one.
    pub fn input(self, path: Option<&Path>) -> Self {
        let Some(path) = path else { return self };
        // What starts with a dash would be an option.
        let dashed = path.to_string_lossy().starts_with('-');
        self.word(if dashed { Path::new(".").join(path) } else { PathBuf::from(path) })
    }

    /// The arguments that it gives to its subcommand, which is `A`'s.
    ///
    /// # Errors
    /// Words that the subcommand does not take.
    pub fn arguments<A: Args>(&self) -> Result<A> {
        // The subcommand stands where the program's name would.
        let matches = A::augment_args(Command::new("surfel")).try_get_matches_from(&self.0);
        let parsed = matches.and_then(|matches| A::from_arg_matches(&matches));
        parsed.map_err(|error| Error::option("report", error.to_string()))
    }
}

/// As it is typed into a shell.
impl fmt::Display for CommandLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("surfel")?;
        for word in &self.0 {
            let word = word.to_string_lossy();
            let plain = |c: char| c.is_ascii_alphanumeric() || "-_./,:=+@%".contains(c);
            match !word.is_empty() && word.chars().all(plain) {
                true => write!(f, " {word}")?,
                false => write!(f, " '{}'", word.replace('\'', "'\\''"))?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::CompareArguments;

    #[test]
    fn words_are_quoted_where_a_shell_would_split_them() {
        let line =
            CommandLine::new(["render"]).input(Some(Path::new("my scan's.ply"))).option("--size", "9x9");
        assert_eq!(line.to_string(), "surfel render 'my scan'\\''s.ply' --size 9x9");
    }

    #[test]
    fn values_and_files_that_start_with_a_dash_are_no_options() {
        let line = CommandLine::new(["compare"]).input(Some(Path::new("-a.ply"))).option("--device", "-b");
        assert_eq!(line.to_string(), "surfel compare ./-a.ply --device=-b");
        let compare: CompareArguments = line.arguments().unwrap();
        assert_eq!(compare.input.inputs, [Path::new("./-a.ply")]);
        assert_eq!(compare.device.asked.as_deref(), Some("-b"));
        assert!(CommandLine::new(["compare", "--sise"]).arguments::<CompareArguments>().is_err());
    }
}
