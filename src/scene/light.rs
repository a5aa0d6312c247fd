//! The lights of a scene.

use glam::DVec3;

use crate::{
    error::{Error, Result},
    math::srgb::linear_from_srgb,
};

/// The most lights of a scene: the device is told of them in a small buffer that each frame fills.
pub const MOST_LIGHTS: usize = 16;

/// The brightest that a channel of a light may be: all of them together stay within f32.
const BRIGHTEST: f32 = 1e30;

/// A light. There is no attenuation and no shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Its place.
    pub kind: LightKind,
    /// Linear red, green and blue, each from 0 to 1e30; 1 is white at full strength.
    pub color: [f32; 3],
}

/// The place of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// At the eye, wherever that is.
    Eye,
    /// Infinitely far; it shines in this direction of world space, of any length above 0.
    Directional(DVec3),
}

impl Light {
    /// White, at the eye: what a scene without lights has.
    pub const DEFAULT: Self = Self { kind: LightKind::Eye, color: [1.0; 3] };

    /// A light of words with commas between, as a command line has it: `eye`, or `direction=x,y,z`, with `color=r,g,b` (sRGB, 0–1) and
    /// `intensity=i` where they are not 1; the keys are those of scene files.
    ///
    /// # Errors
    /// A sentence that says what was given and what was expected.
    pub fn parse(words: &str) -> std::result::Result<Self, String> {
        let (mut kind, mut direction, mut color, mut intensity) = (None, None, [1.0; 3], 1.0);
        let mut words = words.split(',').map(str::trim).peekable();
        while let Some(word) = words.next() {
            let (key, first) = word.split_once('=').unwrap_or(("kind", word));
            let mut value = vec![first];
            while let Some(next) = words.next_if(|next| next.parse::<f64>().is_ok()) {
                value.push(next);
            }
            match key {
                "kind" if value == ["eye"] => kind = Some(LightKind::Eye),
                "kind" if value == ["directional"] => {}
                "direction" => direction = Some(DVec3::from(numbers(&value, key)?)),
                "color" => color = srgb(numbers(&value, key)?)?,
                "intensity" => [intensity] = numbers(&value, key)?,
                _ => {
                    let expected = "expected eye or direction=x,y,z, and color=r,g,b and intensity=i";
                    return Err(format!("'{word}': {expected}, with commas between"));
                }
            }
        }
        let kind = match (kind, direction) {
            (None, Some(direction)) => LightKind::Directional(direction),
            (Some(kind), None) => kind,
            (Some(_), Some(_)) => {
                return Err("a light at the eye has no direction; expected one of both".to_owned());
            }
            (None, None) => {
                return Err("expected eye, or direction=x,y,z in which the light travels".to_owned());
            }
        };
        let light = Self { kind, color: color.map(|component| (intensity * f64::from(component)) as f32) };
        light.validate().map(|()| light).map_err(|error| error.to_string())
    }

    /// Refuses a light without a direction, or of a color that is no light.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::Option`].
    pub fn validate(&self) -> Result<()> {
        if !self.color.iter().all(|c| (0.0..=BRIGHTEST).contains(c)) {
            let [red, green, blue] = self.color;
            let problem = format!("color {red},{green},{blue}: expected numbers from 0 to {BRIGHTEST:e}");
            return Err(Error::option("light", problem));
        }
        match self.kind {
            LightKind::Directional(direction) if direction.try_normalize().is_none() => {
                let problem = format!("direction {direction}: expected a finite vector of a length above 0");
                Err(Error::option("light", problem))
            }
            _ => Ok(()),
        }
    }
}

/// As many numbers as there are to be.
fn numbers<const N: usize>(words: &[&str], key: &str) -> std::result::Result<[f64; N], String> {
    let numbers: Option<Vec<f64>> = words.iter().map(|word| word.parse().ok()).collect();
    let expected = if N == 1 { "one number" } else { "three numbers with commas between" };
    numbers
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| format!("{key}={}: expected {expected}", words.join(",")))
}

/// Linear light of sRGB values.
fn srgb(color: [f64; 3]) -> std::result::Result<[f32; 3], String> {
    match color.iter().all(|component| (0.0..=1.0).contains(component)) {
        true => Ok(color.map(|component| linear_from_srgb(component as f32))),
        false => {
            let [red, green, blue] = color;
            Err(format!("color={red},{green},{blue}: expected three numbers from 0 to 1 (sRGB)"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_of_words_is_that_of_a_scene_file() {
        let of = |words: &str| Light::parse(words).unwrap_or_else(|problem| panic!("{words}: {problem}"));
        assert_eq!(of("eye"), Light::DEFAULT);
        assert_eq!(of("kind=eye,intensity=2"), Light { color: [2.0; 3], ..Light::DEFAULT });
        let down = LightKind::Directional(DVec3::new(0.0, -1.0, -2.5));
        assert_eq!(of("direction=0,-1,-2.5"), Light { kind: down, color: [1.0; 3] });
        let half = linear_from_srgb(0.5);
        for words in [
            "direction=0,-1,-2.5,color=1,0.5,0,intensity=3",
            "intensity=3, color=1, 0.5, 0, direction=0, -1, -2.5",
        ] {
            assert_eq!(of(words), Light { kind: down, color: [3.0, 3.0 * half, 0.0] }, "{words}");
        }
        assert_eq!(of("directional,direction=0,-1,-2.5").kind, down);
    }

    #[test]
    fn words_that_are_no_light_are_refused_in_a_line() {
        for (words, expected) in [
            ("", "'': expected eye or direction=x,y,z"),
            ("sun", "'sun': expected eye or direction=x,y,z"),
            ("0,-1,-1", "'0': expected eye"),
            ("color=1,1,1", "expected eye, or direction=x,y,z in which the light travels"),
            ("eye,direction=0,0,1", "a light at the eye has no direction"),
            ("direction=0,1", "direction=0,1: expected three numbers"),
            ("direction=0,0,0", "expected a finite vector of a length above 0"),
            ("eye,color=2,0,0", "color=2,0,0: expected three numbers from 0 to 1"),
            ("eye,intensity=-1", "expected numbers from 0 to 1e30"),
            ("eye,intensity=bright", "intensity=bright: expected one number"),
        ] {
            let problem = Light::parse(words).unwrap_err();
            assert!(problem.contains(expected) && !problem.contains('\n'), "{words}: {problem}");
        }
    }

    #[test]
    fn lights_that_f32_could_not_sum_are_refused() {
        let of = |red: f32| Light { color: [red, 0.0, 1.0], ..Light::DEFAULT }.validate();
        assert!(of(0.0).is_ok() && of(1e30).is_ok());
        for red in [-1.0, 3e38, f32::INFINITY, f32::NAN] {
            assert!(of(red).unwrap_err().to_string().contains("expected numbers from 0 to 1e30"), "{red}");
        }
    }
}
