//! The command line as a whole: parsed, or refused in one line.

use std::{io, path::Path, process::ExitCode};

use clap::{CommandFactory as _, Parser as _, error::ErrorKind};

use surfel::Error;

use crate::{arguments::Arguments, console};

/// Parses the program's arguments. What is asked for but is no work (`--help`, `--version`) is done here.
///
/// # Errors
/// The exit code: 0 after help or version, 1 after a message about arguments that make no sense.
pub fn parse() -> Result<Arguments, ExitCode> {
    Arguments::try_parse().map_err(|error| match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            // In color where the output is a terminal. A reader that has left is no failure; a full disk is.
            match error.print() {
                Err(e) if e.kind() != io::ErrorKind::BrokenPipe => {
                    console::fail(&Error::file("standard output", "write", e).to_string());
                    ExitCode::FAILURE
                }
                _ => ExitCode::SUCCESS,
            }
        }
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            let _ = error.print();
            ExitCode::FAILURE
        }
        _ => {
            let asked = std::env::args().nth(1).unwrap_or_default();
            // The file's name in the place of a subcommand: what most people try first.
            match error.kind() == ErrorKind::InvalidSubcommand && Path::new(&asked).exists() {
                true => console::fail(&format!(
                    "{asked}: expected a subcommand before it, such as: surfel render {asked}"
                )),
                false => console::fail(&one_line(&error.to_string(), &manual(&asked))),
            }
            ExitCode::FAILURE
        }
    })
}

/// The command that prints help for a command line that starts with this word.
fn manual(first: &str) -> String {
    match Arguments::command().find_subcommand(first) {
        Some(command) => format!("surfel {} --help", command.get_name()),
        None => "surfel --help".to_owned(),
    }
}

/// The parser's message without its paragraphs: what is wrong, its tips, and where the manual is.
fn one_line(message: &str, manual: &str) -> String {
    let body = message.split("\nUsage:").next().unwrap_or(message);
    let body = body.split("\nFor more information").next().unwrap_or(body);
    let mut paragraphs = body.split("\n\n").map(|part| part.split_whitespace().collect::<Vec<_>>().join(" "));
    let problem = paragraphs.next().unwrap_or_default();
    let tips: Vec<String> = paragraphs
        .filter(|part| !part.is_empty())
        .map(|part| part.trim_start_matches("tip: ").to_owned())
        .chain([format!("see {manual}")])
        .collect();
    format!("{} ({})", problem.trim_start_matches("error: "), tips.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(arguments: &[&str]) -> String {
        let words = ["surfel"].iter().chain(arguments);
        let error = Arguments::try_parse_from(words).err().unwrap();
        one_line(&error.to_string(), &manual(arguments[0]))
    }

    #[test]
    fn the_declared_arguments_are_consistent() {
        Arguments::command().debug_assert();
        // Which asserts nothing where assertions are left out, as in `--release`.
        for command in Arguments::command().get_subcommands() {
            let mut seen = std::collections::HashSet::new();
            for option in command.get_arguments() {
                let names = [
                    Some(option.get_id().as_str()),
                    option.get_long().filter(|long| option.get_id() != *long),
                ];
                for name in names.into_iter().flatten() {
                    assert!(seen.insert(name.to_owned()), "surfel {}: {name} twice", command.get_name());
                }
            }
        }
    }

    #[test]
    fn a_refusal_is_one_line_with_the_tip_and_the_manual() {
        assert_eq!(
            refusal(&["render", "--sise", "1x1"]),
            "unexpected argument '--sise' found (a similar argument exists: '--size'; see surfel render --help)"
        );
        assert_eq!(
            refusal(&["render", "--size", "12"]),
            "invalid value '12' for '--size <WxH>': expected width x height in pixels, such as 1024x768 (see \
             surfel render --help)"
        );
        let several = refusal(&["render", "--filter", "blur"]);
        assert!(
            several.contains("[possible values: adjust, none, adjust-paper, max, ewa]")
                && !several.contains('\n'),
            "{several}"
        );
        assert!(refusal(&["paint"]).ends_with("(see surfel --help)"));
        let both = refusal(&["reference", "--camera", "a.json", "--fov", "3"]);
        assert!(
            both.contains("cannot be used with") && both.ends_with("see surfel reference --help)"),
            "{both}"
        );
    }
}
