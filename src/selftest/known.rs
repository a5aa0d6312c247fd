//! Known results of drivers: cases that fail, that sometimes fail, and that must not be run.
//!
//! A list is a text, one entry a line:
//!
//! ```text
//! # Comments and empty lines mean nothing.
//! driver llvmpipe Mesa 22.3.*
//! fail  methods.triangle.none.edge-on-disks  # vertices are snapped to 1/256 px
//! flake repeat.quad.*                        # blends out of order now and then
//! skip  sums-16                              # crashes in the shader compiler
//! ```
//!
//! `driver` lines say which drivers it is about, by their name and version as `surfel info` prints them, without regard to
//! case; without any it is about all. Every entry is a [`Pattern`] of names and a reason. Where several entries match a
//! case, the last one counts.

use std::path::Path;

use super::pattern::{Pattern, is_like};
use crate::error::{Error, Result};

/// The lists that come with the program, each with its name.
pub const BUILT_IN: &[(&str, &str)] = &[
    ("lavapipe.txt", include_str!("known_lists/lavapipe.txt")),
    ("nvidia.txt", include_str!("known_lists/nvidia.txt")),
    ("swiftshader.txt", include_str!("known_lists/swiftshader.txt")),
];

/// The result that is expected of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expectation {
    /// It fails. Should it pass, the list is out of date.
    Fail,
    /// It may fail.
    Flake,
    /// It must not be run.
    Skip,
}

/// One line of a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The expected result.
    pub expectation: Expectation,
    /// The cases.
    pub pattern: Pattern,
    /// Why.
    pub reason: String,
    /// The list's name.
    pub list: String,
    /// The line, from 1.
    pub line: usize,
}

/// A list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KnownList {
    /// Its name: a file's.
    pub name: String,
    /// In lower case; empty for all drivers.
    drivers: Vec<String>,
    /// In their order.
    pub entries: Vec<Entry>,
}

impl KnownList {
    /// Reads a list.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Input`] with the name and the line of what is no entry.
    pub fn parse(name: &str, text: &str) -> Result<Self> {
        let mut list = Self { name: name.to_owned(), drivers: Vec::new(), entries: Vec::new() };
        for (i, row) in text.lines().enumerate() {
            list.read(i + 1, row).map_err(|problem| at_line(name, i + 1, problem))?;
        }
        Ok(list)
    }

    fn read(&mut self, line: usize, row: &str) -> std::result::Result<(), String> {
        let (entry, reason) = match row.split_once('#') {
            Some((entry, reason)) => (entry.trim(), reason.trim()),
            None => (row.trim(), ""),
        };
        if entry.is_empty() {
            return Ok(());
        }
        let (word, rest) = entry.split_once(char::is_whitespace).unwrap_or((entry, ""));
        let rest = rest.trim();
        let expectation = match word {
            "driver" if rest.is_empty() => return Err("driver: expected its name and version".to_owned()),
            "driver" => {
                self.drivers.push(rest.to_lowercase());
                return Ok(());
            }
            "fail" => Expectation::Fail,
            "flake" => Expectation::Flake,
            "skip" => Expectation::Skip,
            other => return Err(format!("'{other}': expected driver, fail, flake or skip")),
        };
        let pattern = Pattern::new(rest)?;
        if reason.is_empty() {
            return Err(format!("{pattern}: expected a reason, after #"));
        }
        self.entries.push(Entry {
            expectation,
            pattern,
            reason: reason.to_owned(),
            list: self.name.clone(),
            line,
        });
        Ok(())
    }

    /// Whether it is about the driver that calls itself so.
    pub fn is_about(&self, driver: &str) -> bool {
        let driver = driver.to_lowercase();
        self.drivers.is_empty() || self.drivers.iter().any(|pattern| is_like(&driver, pattern))
    }
}

/// All that is known of one driver.
#[derive(Clone, Debug, Default)]
pub struct Known {
    lists: Vec<KnownList>,
}

impl Known {
    /// The lists that are about this driver, the later ones above the earlier.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Input`] for an entry, of whichever driver, that matches none of `cases`: a name that
    /// was mistyped or is no more.
    pub fn of_driver<'a>(
        lists: Vec<KnownList>,
        driver: &str,
        cases: impl Iterator<Item = &'a str> + Clone,
    ) -> Result<Self> {
        for entry in lists.iter().flat_map(|list| &list.entries) {
            if !cases.clone().any(|case| entry.pattern.matches(case)) {
                return Err(at_line(&entry.list, entry.line, format!("{}: matches no case", entry.pattern)));
            }
        }
        Ok(Self { lists: lists.into_iter().filter(|list| list.is_about(driver)).collect() })
    }

    /// The lists that come with the program.
    ///
    /// # Errors
    /// None: a test reads them all.
    pub fn built_in() -> Result<Vec<KnownList>> {
        BUILT_IN.iter().map(|(name, text)| KnownList::parse(name, text)).collect()
    }

    /// The entry of a case, if there is one.
    pub fn entry(&self, case: &str) -> Option<&Entry> {
        self.lists
            .iter()
            .rev()
            .flat_map(|list| list.entries.iter().rev())
            .find(|entry| entry.pattern.matches(case))
    }

    /// The names of the lists.
    pub fn lists(&self) -> impl Iterator<Item = &str> {
        self.lists.iter().map(|list| list.name.as_str())
    }
}

fn at_line(list: &str, line: usize, problem: String) -> Error {
    Error::input(Path::new(list), format!("line {line}"), problem)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::selftest::Suite;

    const CASES: [&str; 3] = ["a.b.c", "a.b.d", "e.f"];

    fn known(text: &str) -> Result<Known> {
        Known::of_driver(
            vec![KnownList::parse("k.txt", text)?],
            "llvmpipe Mesa 22.3.6 (LLVM 15)",
            CASES.into_iter(),
        )
    }

    #[test]
    fn entries_are_read_and_the_last_that_matches_counts() {
        let known = known("# all of a fails\n\n fail a.b # why not\nflake\ta.b.d#now and then\n").unwrap();
        let entry = known.entry("a.b.c").unwrap();
        assert_eq!((entry.expectation, entry.reason.as_str(), entry.line), (Expectation::Fail, "why not", 3));
        assert_eq!(known.entry("a.b.d").unwrap().expectation, Expectation::Flake);
        assert_eq!(known.entry("e.f"), None);
    }

    #[test]
    fn a_list_is_for_its_drivers() {
        for (text, expected) in [
            ("driver llvmpipe *\n", true),
            ("driver LLVMpipe Mesa 22.3.*\n", true),
            ("driver NVIDIA *\ndriver llvmpipe Mesa 22.*\n", true),
            ("driver llvmpipe Mesa 23.*\n", false),
            ("driver llvmpipe\n", false),
            ("", true),
        ] {
            let known = known(&format!("{text}fail e.f # why\n")).unwrap();
            assert_eq!(known.entry("e.f").is_some(), expected, "{text}");
            assert_eq!(known.lists().count(), usize::from(expected));
        }
    }

    #[test]
    fn what_is_no_entry_is_refused_with_its_line() {
        for (text, expected) in [
            ("\nfails a # why", "k.txt: line 2: 'fails': expected driver, fail, flake or skip"),
            ("fail a.b", "k.txt: line 1: a.b: expected a reason, after #"),
            ("skip # why", "k.txt: line 1: expected a case's name or a pattern of names"),
            ("skip a b # why", "k.txt: line 1: a b: ' ' is in no case's name"),
            ("driver", "k.txt: line 1: driver: expected its name and version"),
            ("fail e.f # why\n\nfail a.c # why", "k.txt: line 3: a.c: matches no case"),
            // Also of other drivers: a list is right or wrong wherever it is read.
            ("driver other\nskip a.c # why", "k.txt: line 2: a.c: matches no case"),
        ] {
            let error = known(text).unwrap_err();
            assert_eq!((error.to_string().as_str(), error.exit_code()), (expected, 1));
        }
    }

    #[test]
    fn the_lists_that_come_along_are_right_and_all_there() {
        let suite = Suite::new();
        let names = || suite.cases.iter().map(|case| case.name.as_str());
        for (driver, list) in [
            ("llvmpipe Mesa 22.3.6 (LLVM 15.0.6)", "lavapipe.txt"),
            ("NVIDIA 580.159.04", "nvidia.txt"),
            ("SwiftShader driver 5.0.0", "swiftshader.txt"),
        ] {
            let known = Known::of_driver(Known::built_in().unwrap(), driver, names()).unwrap();
            assert_eq!(known.lists().collect::<Vec<_>>(), [list]);
        }
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/selftest/known_lists");
        let mut files: Vec<_> = std::fs::read_dir(folder)
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        files.sort();
        assert_eq!(files, BUILT_IN.iter().map(|(name, _)| *name).collect::<Vec<_>>());
    }
}
