//! The direction that is up in the picture: asked for, or told by files.

use glam::DVec3;
use surfel::{
    Progress as _,
    geometry::FoundUp,
    scene::{AXES, Camera, OptionValue as _},
};

use crate::console::{self, Bars};

/// `--up`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Up {
    /// As files or shapes tell, else +y.
    Auto,
    /// This direction.
    Given([f64; 3]),
}

/// `auto`, `z`, `-x` or `0,0.5,1`.
pub fn parse(word: &str) -> Result<Up, String> {
    if word == "auto" {
        return Ok(Up::Auto);
    }
    let name = word.strip_prefix('+').unwrap_or(word);
    if let Some((_, direction)) = AXES.iter().find(|(own, _)| *own == name) {
        return Ok(Up::Given(direction.to_array()));
    }
    let expected = || "expected auto, x, y, z, -x, -y, -z, or a direction such as 0,0.5,1".to_owned();
    let direction = <[f64; 3]>::parse(word).map_err(|_| expected())?;
    match DVec3::from(direction).try_normalize() {
        Some(_) => Ok(Up::Given(direction)),
        None => Err(expected()),
    }
}

/// The direction in a word.
fn word(direction: DVec3) -> String {
    match AXES.iter().find(|(_, own)| direction.distance(*own) < 1e-9) {
        Some((name, _)) if name.starts_with('-') => (*name).to_owned(),
        Some((name, _)) => format!("+{name}"),
        None => {
            let [x, y, z] = direction.to_array().map(|part| (1e4 * part).round() / 1e4 + 0.0);
            format!("{x},{y},{z}")
        }
    }
}

/// What the first of the files says that say something; it is told where another says something else.
pub fn of(files: Vec<(DVec3, String)>, bars: &Bars) -> Option<FoundUp> {
    let (direction, name) = files.first()?;
    let name = if name == "-" { "standard input" } else { name };
    if let Some((other, of)) = files.iter().find(|(other, _)| other.distance(*direction) > 1e-3) {
        let [first, second] = [*direction, *other].map(word);
        bars.note(&format!("{of}: has {second} up, and {name} {first}, which is taken; --up says otherwise"));
    }
    let is_named =
        |ending: &&&str| name.to_ascii_lowercase().contains(&format!(".{}", ending.to_lowercase()));
    let because = match ["STL", "PTS"].iter().find(is_named) {
        Some(kind) => format!("{name} has it, as most {kind} files"),
        None => format!("{name} says so"),
    };
    Some(FoundUp { direction: *direction, because })
}

/// Whether a camera looks along a direction, and has another one up in the picture.
pub fn is_along(up: DVec3, camera: &Camera) -> bool {
    camera.up.angle_between(up) > 1.0
}

/// Tells that the picture has another direction up than was asked for.
pub fn tell_another(asked: DVec3, taken: DVec3) {
    let [asked, taken] = [asked, taken].map(word);
    console::say(&format!("the view is along {asked}; up in the picture is {taken}"));
}

/// Tells what was found, or that nothing was, of what may as well have z up.
pub fn tell(found: Option<&FoundUp>) {
    let Some(FoundUp { direction, because }) = found else {
        return console::say("up is +y, since nothing says otherwise; --up z if it lies on its back");
    };
    let other = if direction.distance(DVec3::Y) < 1e-9 { "z" } else { "y" };
    console::say(&format!("up is {}, because {because}; --up {other} if not", word(*direction)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_have_names() {
        assert_eq!(parse("auto"), Ok(Up::Auto));
        for (word, direction) in [("z", [0.0, 0.0, 1.0]), ("+z", [0.0, 0.0, 1.0]), ("-x", [-1.0, 0.0, 0.0])] {
            assert_eq!(parse(word), Ok(Up::Given(direction)));
        }
        assert_eq!(parse("0,-0.5,1"), Ok(Up::Given([0.0, -0.5, 1.0])));
        for refused in ["", "w", "+", "1,2", "0,0,0", "up", "--z", "NaN,0,0", "1e999,0,0"] {
            assert!(parse(refused).is_err(), "{refused}");
        }
        assert_eq!([DVec3::Z, DVec3::NEG_X, DVec3::ONE].map(word), ["+z", "-x", "1,1,1"]);
    }

    #[test]
    fn the_first_file_that_says_it_is_believed() {
        let files = [(DVec3::Z, "a.las".to_owned()), (DVec3::Y, "b.glb".to_owned())];
        let found = of(files.to_vec(), &Bars::new()).unwrap();
        assert_eq!((found.direction, found.because.as_str()), (DVec3::Z, "a.las says so"));
        assert_eq!(of(Vec::new(), &Bars::new()), None);
        let piped = of(vec![(DVec3::Z, "-".to_owned())], &Bars::new()).unwrap();
        assert_eq!(piped.because, "standard input says so");
    }
}
