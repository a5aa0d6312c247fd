//! Planes that cut a scene: what lies on their one side is seen, the rest is not there.

use std::sync::Arc;

use glam::{DVec3, DVec4};

use super::OptionValue;

/// The most planes of a frame, those of a box counted.
pub const MOST_PLANES: usize = 6;

/// A box with sides along the axes, in world space, outside of which nothing is seen: its smallest and its largest coordinates. Without, all is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ClipBox(pub Option<[[f64; 3]; 2]>);

/// Planes `a x + b y + c z = d` in world space; what has `a x + b y + c z ≥ d` for all of them is seen. Shared by all settings that are copies of each other, so that a frame
/// takes nothing from the heap for its own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClipPlanes(pub Arc<[[f64; 4]]>);

impl ClipBox {
    /// Its planes: unit normals toward its inside, and by how much the origin is inside.
    pub(super) fn planes(&self) -> impl Iterator<Item = DVec4> {
        self.0.into_iter().flat_map(|[min, max]| {
            [0, 1, 2].into_iter().flat_map(move |i| {
                let axis = DVec3::AXES[i];
                [axis.extend(-min[i]), (-axis).extend(max[i])]
            })
        })
    }
}

impl ClipPlanes {
    /// The same of planes.
    pub(super) fn planes(&self) -> impl Iterator<Item = DVec4> + '_ {
        self.0.iter().filter_map(|[a, b, c, d]| {
            let normal = DVec3::new(*a, *b, *c);
            // The largest component becomes 1 first: a square of it would leave the range of f64.
            let largest = normal.abs().max_element();
            let length = largest * (normal / largest).length();
            (length > 0.0).then(|| (normal / length).extend(-d / length))
        })
    }
}

const NONE: &str = "none";

impl OptionValue for ClipBox {
    fn word(&self) -> String {
        match self.0 {
            None => NONE.to_owned(),
            Some(corners) => corners.as_flattened().iter().map(f64::to_string).collect::<Vec<_>>().join(","),
        }
    }

    fn parse(word: &str) -> Result<Self, String> {
        if word == NONE {
            return Ok(Self(None));
        }
        let expected =
            || "expected the smallest x, y, z, then the largest, such as -1,-1,0,1,1,2, or none".to_owned();
        let [a, b, c, d, e, f] = numbers(word).ok_or_else(expected)?;
        Ok(Self(Some([[a, b, c], [d, e, f]])))
    }

    fn check(&self) -> Result<(), String> {
        let Some([min, max]) = self.0 else { return Ok(()) };
        let good = (0..3).all(|i| min[i] < max[i] && min[i].is_finite() && max[i].is_finite());
        good.then_some(())
            .ok_or_else(|| format!("{}: expected smallest coordinates below the largest", self.word()))
    }
}

impl OptionValue for ClipPlanes {
    fn word(&self) -> String {
        if self.0.is_empty() {
            return NONE.to_owned();
        }
        let plane = |plane: &[f64; 4]| plane.map(|part| part.to_string()).join(",");
        self.0.iter().map(plane).collect::<Vec<_>>().join(";")
    }

    fn parse(word: &str) -> Result<Self, String> {
        if word == NONE {
            return Ok(Self::default());
        }
        let planes: Option<Vec<[f64; 4]>> = word.split(';').map(numbers).collect();
        planes.map(|planes: Vec<_>| Self(planes.into())).ok_or_else(|| {
            "expected a,b,c,d, of which a x + b y + c z >= d is seen, such as 0,0,1,0.5, or none alone"
                .to_owned()
        })
    }

    fn check(&self) -> Result<(), String> {
        let is_plane = |plane: &&[f64; 4]| plane[..3].iter().any(|part| *part != 0.0);
        let finite = self.0.iter().flatten().all(|part| part.is_finite());
        match finite && self.0.iter().filter(is_plane).count() == self.0.len() {
            true => Ok(()),
            false => Err(format!("{}: expected finite numbers, and a, b, c that are not all 0", self.word())),
        }
    }
}

fn numbers<const N: usize>(word: &str) -> Option<[f64; N]> {
    let numbers: Option<Vec<f64>> = word.split(',').map(|part| part.trim().parse().ok()).collect();
    numbers?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Settings;

    #[test]
    fn boxes_and_planes_are_words() {
        let whole = ClipBox::parse("-1,-2,0,1,2.5,3").unwrap();
        assert_eq!(whole, ClipBox(Some([[-1.0, -2.0, 0.0], [1.0, 2.5, 3.0]])));
        assert_eq!((ClipBox::parse(&whole.word()), ClipBox::parse("none")), (Ok(whole), Ok(ClipBox(None))));
        let planes = ClipPlanes::parse("0,0,2,1;1,0,0,-3").unwrap();
        assert_eq!(*planes.0, [[0.0, 0.0, 2.0, 1.0], [1.0, 0.0, 0.0, -3.0]]);
        assert_eq!(
            (ClipPlanes::parse(&planes.word()), ClipPlanes::parse("none").unwrap().0.len()),
            (Ok(planes.clone()), 0)
        );
        assert_eq!(
            planes.planes().collect::<Vec<_>>(),
            [DVec4::new(0.0, 0.0, 1.0, -0.5), DVec4::new(1.0, 0.0, 0.0, 3.0)]
        );
        for word in ["", "1,2,3,4,5", "1,2,3,4,5,6,7", "a,b,c,d,e,f"] {
            assert!(ClipBox::parse(word).is_err(), "{word}");
        }
        for word in ["", "1,2,3", "1,2,3,4;", "1,2,3,4;5"] {
            assert!(ClipPlanes::parse(word).is_err(), "{word}");
        }
    }

    #[test]
    fn what_cuts_nothing_or_all_or_too_often_is_refused() {
        let of = |clip_box: &str, planes: &str| {
            let (clip_box, clip_planes) =
                (ClipBox::parse(clip_box).unwrap(), ClipPlanes::parse(planes).unwrap());
            Settings { clip_box, clip_planes, ..Settings::default() }
        };
        let refused = |settings: Settings| settings.validate().unwrap_err().to_string();
        assert!(refused(of("0,0,0,1,0,1", "none")).starts_with("--clip-box: 0,0,0,1,0,1: expected smallest"));
        assert!(refused(of("none", "0,0,0,1")).starts_with("--clip-plane: 0,0,0,1: expected finite"));
        assert!(refused(of("none", "NaN,0,0,1")).starts_with("--clip-plane: NaN"));
        assert!(
            refused(of("0,0,0,1,1,1", "1,0,0,0"))
                .starts_with("--clip-plane: 7 planes with those of --clip-box")
        );
        of("0,0,0,1,1,1", "none").validate().unwrap();
        let six = of("none", "1,0,0,0;1,0,0,0;1,0,0,0;1,0,0,0;1,0,0,0;1e300,1e300,0,0");
        six.validate().unwrap();
        assert!(six.clip().iter().all(|plane| (plane.truncate().length() - 1.0).abs() < 1e-15));
    }
}
