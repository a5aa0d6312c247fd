//! What is seen of the layers of a pixel, one under the other.

use glam::{DVec2, DVec3};

use super::covering::part_behind;
use super::transition::Premultiplied;

/// The layers of a pixel, over whatever is behind them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stack {
    /// Linear, multiplied by alpha.
    pub color: DVec3,
    /// How much is seen through all of them: the product of `1 − α`.
    pub transmittance: f64,
    /// How many there are, drawn or not.
    pub layers: u32,
    /// The smallest margin of a decision which layer a fragment belongs to.
    pub margin: f64,
    ended: Ended,
}

/// What ended in a pixel, of several by how much each changes of its light: to begin with, nothing.
#[derive(Clone, Copy, Debug)]
struct Ended {
    /// How it falls toward where it ends.
    fall: DVec2,
    /// The part of the pixel that it covers.
    part: f64,
    /// Whether it faces away.
    faces_away: bool,
    /// How much is seen through all layers there, where [`Stack::transmittance`] is the mean of the pixel.
    transmittance: f64,
}

impl Stack {
    pub const EMPTY: Self = Self {
        color: DVec3::ZERO,
        transmittance: 1.0,
        layers: 0,
        margin: f64::INFINITY,
        ended: Ended { fall: DVec2::ZERO, part: 1.0, faces_away: false, transmittance: 1.0 },
    };

    /// A layer of this color and alpha that covers a part of the pixel. What ends where the other side of it has, as the far side of a ball does, lies behind that: the light of its
    /// part has come through all that is there, and beside it through what else the pixel has. Of the same side it may be what an ε has left.
    pub fn put_part_behind(&mut self, shown: Premultiplied, (part, fall, faces_away): (f64, DVec2, bool)) {
        let (ended, mean) = (self.ended, self.transmittance);
        let behind = if faces_away == ended.faces_away { 0.0 } else { part_behind(fall, ended.fall) };
        let within = part.min(ended.part) * ended.transmittance;
        let rest = 1.0 - ended.part;
        let beside = if rest > 0.0 { (mean - ended.part * ended.transmittance) / rest } else { 0.0 };
        let seen = within + (part - ended.part).max(0.0) * beside;
        let through = (1.0 - behind) * part * mean + behind * seen;
        self.color += through * shown.color;
        self.transmittance -= through * shown.alpha;
        // How much of the pixel's light changes from one side of an outline to the other, times how much of the pixel is on either.
        let old = ended.part * rest * (mean - ended.transmittance);
        let new = part * (1.0 - part) * shown.alpha * mean;
        let kept = if old + new > 0.0 { old / (old + new) } else { 0.0 };
        // What comes through the layer where it is, and through what had ended, of which the layer covers a part.
        let own = if part > 0.0 { (1.0 - shown.alpha) * through / part } else { mean };
        let of_ended = if ended.part > 0.0 { (part / ended.part).min(1.0) } else { 1.0 };
        let covered = (1.0 - behind) * part + behind * of_ended;
        let mix = |new: f64, old: f64| new + kept * (old - new);
        self.ended = Ended {
            fall: fall + kept * (ended.fall - fall),
            part: mix(part, ended.part),
            faces_away: if kept < 0.5 { faces_away } else { ended.faces_away },
            transmittance: mix(own, ended.transmittance * (1.0 - shown.alpha * covered)),
        };
        if faces_away != ended.faces_away && old.min(new) > 0.0 {
            self.margin = self.margin.min((kept - 0.5).abs());
        }
    }

    pub fn put_behind(&mut self, layer: Premultiplied) {
        self.color += self.transmittance * layer.color;
        self.transmittance *= 1.0 - layer.alpha;
    }

    /// Over a straight color with alpha, straight again; black where nothing is seen.
    pub fn over(&self, [red, green, blue, alpha]: [f64; 4]) -> [f64; 4] {
        let color = self.color + self.transmittance * alpha * DVec3::new(red, green, blue);
        let alpha = 1.0 - self.transmittance * (1.0 - alpha);
        if alpha > 0.0 { (color / alpha).extend(alpha).to_array() } else { [0.0; 4] }
    }
}
