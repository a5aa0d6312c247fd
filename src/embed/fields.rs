//! What is refused, by the names that a host knows: settings are options of a command line, and to a host fields.

use crate::{
    error::{Error, ErrorKind},
    scene::{OptionTable as _, Settings},
};

/// The same error, with the fields of [`Settings`] in place of options.
pub(super) fn as_fields(error: Error) -> Error {
    match error.kind() {
        ErrorKind::Option { option, problem } if option.contains("--") || problem.contains("--") => {
            Error::option(named(option), named(problem))
        }
        _ => error,
    }
}

fn named(words: &str) -> String {
    // What of a picture is seen follows from a host's camera.
    let beside = ("crop", "camera");
    let mut names: Vec<_> =
        Settings::OPTIONS.iter().map(|option| (option.name, option.field)).chain([beside]).collect();
    // One name may begin with another.
    names.sort_by_key(|(name, _)| std::cmp::Reverse(name.len()));
    let replace = |words: String, (name, field)| words.replace(&format!("--{name}"), field);
    names.into_iter().fold(words.to_owned(), replace)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_fields_and_all_else_stays() {
        let said = |option: &str, problem: &str| as_fields(Error::option(option, problem)).to_string();
        assert_eq!(said("--size", "0x0: expected more"), "size_px: 0x0: expected more");
        assert_eq!(
            said("--filter", "ewa with --kernel-eval and --kernel psi_e"),
            "filter: ewa with kernel_eval and kernel psi_e"
        );
        assert_eq!(
            said("--clip-plane", "7 with those of --clip-box"),
            "clip_planes: 7 with those of clip_box"
        );
        assert_eq!(said("--crop", "1,1: a corner"), "camera: 1,1: a corner");
        assert_eq!(said("camera", "is none"), "camera: is none");
        let other = Error::input("a--size.ply", "", "empty");
        assert_eq!(as_fields(other).to_string(), "a--size.ply: empty");
    }
}
