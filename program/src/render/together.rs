//! Which options of `surfel render` mean something together.

use surfel::{Error, Result};

use super::RenderArguments;
use crate::film;

impl RenderArguments {
    /// The names of all that the user gave of how things are drawn.
    pub fn said(&self) -> Vec<&'static str> {
        let memory = self.hierarchies.budget_memory.map(|_| "budget-memory");
        let explain = self.explain.then_some("explain");
        self.picture.said().chain(self.storage.said()).chain(memory).chain(explain).collect()
    }

    /// Whether a picture is written: beside what is seen in pixels where it is asked for.
    pub fn is_written(&self) -> bool {
        let is_named = self.picture.output.is_some() || self.picture.dump.is_some();
        self.pick.pixels.is_empty() || is_named
    }

    /// Whether a picture is drawn, be it only to be timed.
    pub fn is_drawn(&self) -> bool {
        self.is_written() || self.frames.is_some() || self.timings.is_some()
    }
}

/// Refuses what is of one picture.
///
/// # Errors
/// In the name of the option.
pub fn refuse_beside_a_film(arguments: &RenderArguments) -> Result<()> {
    let given = [
        ("--timings", arguments.timings.is_some()),
        ("--explain", arguments.explain),
        ("--pick", !arguments.pick.pixels.is_empty()),
        ("--dump", arguments.picture.dump.is_some()),
    ];
    if let Some((option, _)) = given.iter().find(|(_, is_given)| *is_given) {
        return Err(Error::option(*option, "is of one picture; expected no --path or --turntable"));
    }
    // Of .png the command that makes a film of them is told.
    let ending = arguments.picture.output.as_deref().and_then(|output| output.extension());
    let is_film = !ending.is_some_and(|ending| ending.eq_ignore_ascii_case("exr"));
    if arguments.film.fps.is_some() && arguments.frames.is_some() && !is_film {
        let problem =
            "has no meaning for .exr, of which --frames says how many there are; expected one of the two";
        return Err(Error::option("--fps", problem));
    }
    Ok(())
}

/// Refuses what is of films, where there is none.
///
/// # Errors
/// In the name of the option.
pub fn refuse_what_is_of_films(arguments: &RenderArguments) -> Result<()> {
    if arguments.film.fps.is_some() {
        return Err(Error::option("--fps", "has no meaning for a picture; expected --path or --turntable"));
    }
    if let Some(output) = arguments.picture.output.as_deref().filter(|name| film::is_name_of_film(name)) {
        let problem =
            format!("{}: is a film's, or its pictures'; expected --path or --turntable", output.display());
        return Err(Error::option("--output", problem));
    }
    Ok(())
}
