//! What can go wrong, who is at fault, and the exit code that says so.

mod one_line;

use std::{
    fmt::{self, Write as _},
    io,
    path::PathBuf,
};

use one_line::OneLine;
pub use one_line::one_line;

/// A `Result` whose error is [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// Everything that surfel refuses or fails to do; one pointer wide. [`Error::kind`] tells what happened.
#[derive(Debug)]
pub struct Error(Box<ErrorKind>);

/// What happened. Each variant names the thing at fault and prints as one line ([`one_line`]).
#[derive(Debug)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The content of a file is not what its format demands.
    Input {
        /// The file at fault.
        path: PathBuf,
        /// Where in the file: an element, a line or a byte, in words; empty where the whole file is meant.
        place: String,
        /// What was found and what was expected.
        problem: String,
    },
    /// An option, or a value given through the library's interface, is out of its range.
    Option {
        /// The option's name as the user knows it, such as `--size`.
        option: String,
        /// What was given and what was expected.
        problem: String,
    },
    /// A file can't be read or written.
    File {
        /// The file at fault.
        path: PathBuf,
        /// What was tried: `read`, `write`, `rename`.
        action: &'static str,
        /// What the operating system said.
        source: io::Error,
    },
    /// No Vulkan device can do the work.
    NoDevice {
        /// Why, in a sentence; and for each device that was looked at, its name and the reason of its refusal.
        reasons: Vec<String>,
    },
    /// No window can be opened.
    NoWindow {
        /// Why, and what can be done about it.
        reason: String,
    },
    /// A Vulkan call failed.
    Vulkan {
        /// The call, such as `vkCreateBuffer`.
        call: &'static str,
        /// The object's debug name; empty where there is none yet.
        object: String,
        /// What the driver answered.
        result: ash::vk::Result,
    },
    /// Device memory can't be had.
    Memory {
        /// The object's debug name.
        object: String,
        /// Bytes asked for.
        bytes: u64,
        /// What the allocator said.
        reason: String,
    },
    /// A pipeline is not there yet, and was not to be made.
    NotReady {
        /// Its shaders.
        pipeline: String,
    },
    /// A render graph that can't be run: a mistake in the code that declared it.
    Graph {
        /// The pass that declares the illegal access; empty where the graph as a whole is meant.
        pass: String,
        /// The resource at fault; empty where none is.
        resource: String,
        /// Why it is illegal.
        reason: String,
    },
    /// The validation layer spoke.
    Validation {
        /// How many messages outside the allow-list.
        count: usize,
        /// The first of them.
        first: String,
    },
    /// Figures became worse than they were.
    Regression {
        /// How many.
        count: usize,
        /// The first of them.
        first: String,
    },
    /// Figures can't be trusted, and that was refused.
    Doubtful {
        /// How many reasons there are.
        count: usize,
        /// The first of them.
        first: String,
    },
    /// Cases of the self-test failed, or pass that are listed as failures.
    Selftest {
        /// How many cases there were.
        cases: usize,
        /// How many failed.
        failed: usize,
        /// How many passed against the list.
        fixed: usize,
        /// The first of both.
        first: String,
    },
}

impl Error {
    /// What happened.
    pub fn kind(&self) -> &ErrorKind {
        &self.0
    }

    /// The program's exit code: 1 the input or an option is at fault, 2 the device is, 3 validation messages or a failed
    /// check.
    pub fn exit_code(&self) -> u8 {
        match *self.0 {
            ErrorKind::Input { .. } | ErrorKind::Option { .. } | ErrorKind::File { .. } => 1,
            ErrorKind::NoDevice { .. }
            | ErrorKind::NoWindow { .. }
            | ErrorKind::Vulkan { .. }
            | ErrorKind::Memory { .. }
            | ErrorKind::NotReady { .. }
            | ErrorKind::Graph { .. }
            | ErrorKind::Doubtful { .. } => 2,
            ErrorKind::Validation { .. } | ErrorKind::Regression { .. } | ErrorKind::Selftest { .. } => 3,
        }
    }

    /// A file whose content is at fault. `place` is an element, a line or a byte in words; it may be empty.
    pub fn input(path: impl Into<PathBuf>, place: impl Into<String>, problem: impl Into<String>) -> Self {
        ErrorKind::Input { path: path.into(), place: place.into(), problem: problem.into() }.into()
    }

    /// An option out of its range.
    pub fn option(option: impl Into<String>, problem: impl Into<String>) -> Self {
        ErrorKind::Option { option: option.into(), problem: problem.into() }.into()
    }

    /// A file that can't be read or written.
    pub fn file(path: impl Into<PathBuf>, action: &'static str, source: io::Error) -> Self {
        ErrorKind::File { path: path.into(), action, source }.into()
    }

    /// A Vulkan call on a named object that failed.
    pub fn vulkan(call: &'static str, object: impl Into<String>, result: ash::vk::Result) -> Self {
        ErrorKind::Vulkan { call, object: object.into(), result }.into()
    }
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Self(Box::new(kind))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut f = OneLine::new(f);
        match &*self.0 {
            ErrorKind::Input { path, place, problem } if place.is_empty() => {
                write!(f, "{}: {problem}", path.display())
            }
            ErrorKind::Input { path, place, problem } => {
                write!(f, "{}: {place}: {problem}", path.display())
            }
            ErrorKind::Option { option, problem } => write!(f, "{option}: {problem}"),
            ErrorKind::File { path, action, source } => {
                write!(f, "{}: cannot {action}: {source}", path.display())
            }
            ErrorKind::NoDevice { reasons } => {
                write!(f, "no Vulkan device can be used: {}", reasons.join("; "))
            }
            ErrorKind::NoWindow { reason } => write!(f, "no window can be opened: {reason}"),
            ErrorKind::Vulkan { call, object, result } if object.is_empty() => {
                write!(f, "{call} failed: {result:?}")
            }
            ErrorKind::Vulkan { call, object, result } => {
                write!(f, "{call} failed on '{object}': {result:?}")
            }
            ErrorKind::Memory { object, bytes, reason } => {
                write!(f, "no device memory for '{object}' ({bytes} bytes): {reason}")
            }
            ErrorKind::NotReady { pipeline } => write!(f, "compile_ahead has not made '{pipeline}'"),
            ErrorKind::Graph { pass, resource, reason } => {
                f.write_str("illegal render graph: ")?;
                match (pass.is_empty(), resource.is_empty()) {
                    (false, false) => write!(f, "pass '{pass}', resource '{resource}': {reason}"),
                    (false, true) => write!(f, "pass '{pass}': {reason}"),
                    (true, false) => write!(f, "resource '{resource}': {reason}"),
                    (true, true) => f.write_str(reason),
                }
            }
            ErrorKind::Validation { count, first } => {
                write!(f, "{count} validation message(s), the first: {first}")
            }
            ErrorKind::Regression { count, first } => {
                write!(f, "{count} figure(s) became worse, the first: {first}")
            }
            ErrorKind::Doubtful { count, first } => {
                write!(f, "{count} figure(s) can't be trusted, the first: {first}")
            }
            ErrorKind::Selftest { cases, failed, fixed: 0, first } => {
                write!(f, "{failed} of {cases} case(s) failed, the first: {first}")
            }
            ErrorKind::Selftest { cases, failed, fixed, first } => write!(
                f,
                "{failed} of {cases} case(s) failed and {fixed} passed against the list, the first: {first}"
            ),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &*self.0 {
            ErrorKind::File { source, .. } => Some(source),
            ErrorKind::Vulkan { result, .. } => Some(result),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_prints_one_line_and_has_the_exit_code_of_the_manual() {
        let cases: Vec<(Error, u8, &str)> = vec![
            (Error::input("a.ply", "vertex 3", "x is missing"), 1, "a.ply: vertex 3: x is missing"),
            (Error::input("a.ply", "", "empty file"), 1, "a.ply: empty file"),
            (Error::option("--size", "0x0: at least 1x1"), 1, "--size: 0x0: at least 1x1"),
            (
                ErrorKind::NoDevice { reasons: vec!["a".into(), "b".into()] }.into(),
                2,
                "no Vulkan device can be used: a; b",
            ),
            (
                ErrorKind::NoWindow { reason: "DISPLAY is not set".into() }.into(),
                2,
                "no window can be opened: DISPLAY is not set",
            ),
            (
                Error::vulkan("vkCreateBuffer", "splats 0", ash::vk::Result::ERROR_OUT_OF_DEVICE_MEMORY),
                2,
                "vkCreateBuffer failed on 'splats 0': ERROR_OUT_OF_DEVICE_MEMORY",
            ),
            (
                ErrorKind::Validation { count: 2, first: "VUID-x".into() }.into(),
                3,
                "2 validation message(s), the first: VUID-x",
            ),
            (
                ErrorKind::Regression { count: 1, first: "a".into() }.into(),
                3,
                "1 figure(s) became worse, the first: a",
            ),
            (
                ErrorKind::Doubtful { count: 1, first: "a".into() }.into(),
                2,
                "1 figure(s) can't be trusted, the first: a",
            ),
            (
                ErrorKind::Selftest { cases: 9, failed: 2, fixed: 0, first: "a.b".into() }.into(),
                3,
                "2 of 9 case(s) failed, the first: a.b",
            ),
            (
                ErrorKind::Selftest { cases: 9, failed: 0, fixed: 1, first: "a.b".into() }.into(),
                3,
                "0 of 9 case(s) failed and 1 passed against the list, the first: a.b",
            ),
        ];
        for (error, code, text) in cases {
            assert_eq!(error.exit_code(), code);
            assert_eq!(error.to_string(), text);
        }
        assert_eq!(size_of::<Error>(), size_of::<usize>());
    }
}
