//! Both sides of a ridge in one pixel, where clip curves leave a part of each: each side is shaded by itself, and has its part of the pixel.

use glam::DVec3;

use super::drawn_clip::Kept;
use super::fragment::Fragment;
use super::shade::Shader;
use super::splat::DrawnSplat;
use super::surface::Sums;

/// From this part of a pixel on, what curves leave of a splat is on the near side of the ridge, on which all that they do not cut is.
const HALF: f64 = 0.5;

/// Planes that cut all that is seen have nothing on their other side.
fn is_beyond(kept: Kept) -> bool {
    !kept.by_plane && kept.part < HALF
}

/// So near to that it may be taken for the other side.
const UNCERTAIN: f64 = 5e-4;

/// Whether a splat that curves cut may be taken for the other side of a ridge.
pub(super) fn is_undecided(kept: Kept) -> bool {
    !kept.by_plane && (kept.part - HALF).abs() < UNCERTAIN
}

/// The sums of one surface, of what has at least half of the pixel and of what has less.
#[derive(Clone, Copy, Default)]
pub(super) struct CreasedSums {
    here: Side,
    beyond: Side,
}

#[derive(Clone, Copy, Default)]
struct Side {
    sums: Sums,
    most_kept: f64,
}

impl CreasedSums {
    /// `kept`: what curves and planes leave of it.
    pub fn add(&mut self, fragment: Fragment, kept: Option<Kept>, splat: &DrawnSplat) {
        let side = if kept.is_some_and(is_beyond) { &mut self.beyond } else { &mut self.here };
        side.sums.add(fragment, splat);
        side.most_kept = side.most_kept.max(kept.map_or(1.0, |kept| kept.part));
    }

    pub fn weight(&self) -> f64 {
        self.here.sums.weight + self.beyond.sums.weight
    }

    /// Linear and shaded; `None` where nothing was added.
    pub fn color(&self, shader: &Shader, ray: DVec3) -> Option<DVec3> {
        let sides = [self.here, self.beyond];
        let of_pixel: f64 = sides.iter().map(|side| side.most_kept).sum();
        let shares = sides.iter().filter_map(|side| {
            let surface = side.sums.surface(shader, ray)?;
            Some(side.most_kept / of_pixel * surface.color)
        });
        shares.reduce(|a, b| a + b)
    }
}
