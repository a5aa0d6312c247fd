//! What is seen of the layers of a pixel, one under the other.

use glam::{DVec2, DVec3};

use super::covering::part_behind;
use super::transition::Premultiplied;

/// How far behind another layer one may begin that goes on with its surface, as a part of its own ε.
const SEAM: f64 = 0.2;

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
    last: Option<Surface>,
}

/// Where a layer lies, and what it covers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    /// The part of the pixel that it would cover by itself.
    pub part: f64,
    /// How that falls toward where it ends.
    pub fall: DVec2,
    pub faces_away: bool,
    /// Of the fragment that it begins with, the depth,
    pub z: f64,
    /// and by ε: there it ends.
    pub z_shifted: f64,
    /// Its surface has sharp edges, whose ε takes it piece by piece where it bends.
    pub is_sharp: bool,
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

/// That of the layer before.
#[derive(Clone, Copy, Debug)]
struct Surface {
    /// What all of its layers cover.
    part: f64,
    faces_away: bool,
    /// Where the last one ends.
    z_shifted: f64,
    /// Whether it is what ended.
    ended: bool,
}

impl Stack {
    pub const EMPTY: Self = Self {
        color: DVec3::ZERO,
        transmittance: 1.0,
        layers: 0,
        margin: f64::INFINITY,
        ended: Ended { fall: DVec2::ZERO, part: 1.0, faces_away: false, transmittance: 1.0 },
        last: None,
    };

    /// A layer of this color and alpha that covers a part of the pixel. What ends where the other side of it has, as the far side of a ball does, lies behind that: the light of its
    /// part has come through all that is there, and beside it through what else the pixel has. Of the same side it may be what an ε has left: then it lies beside what that has taken,
    /// and both cover the pixel once.
    pub fn put_part_behind(&mut self, shown: Premultiplied, layer: Extent) {
        let last = self.last.filter(|last| {
            last.faces_away == layer.faces_away && layer.is_sharp && self.goes_on(*last, layer)
        });
        let covered = last.map_or(0.0, |last| last.part);
        let part = layer.part.min(1.0 - covered);
        let ended = match last.is_some_and(|last| last.ended) {
            true => self.put_part_beside(shown, part, layer.fall),
            false => self.put_other_part(shown, part, layer),
        };
        let (faces_away, z_shifted) = (layer.faces_away, layer.z_shifted);
        self.last = Some(Surface { part: covered + part, faces_away, z_shifted, ended });
    }

    /// Whether it goes on with that surface: in inverse depth it begins within a part of its own ε behind the end of that.
    fn goes_on(&mut self, last: Surface, layer: Extent) -> bool {
        let [end, begin, own_end] = [last.z_shifted, layer.z, layer.z_shifted].map(f64::recip);
        let furthest = begin + SEAM * (begin - own_end);
        self.margin = self.margin.min((end / furthest - 1.0).abs());
        end <= furthest
    }

    /// A part of what ended, which it had not covered before.
    fn put_part_beside(&mut self, shown: Premultiplied, part: f64, fall: DVec2) -> bool {
        let ended = self.ended;
        let rest = 1.0 - ended.part;
        let beside =
            if rest > 0.0 { (self.transmittance - ended.part * ended.transmittance) / rest } else { 0.0 };
        self.color += part * beside * shown.color;
        self.transmittance -= part * beside * shown.alpha;
        let all = ended.part + part;
        let through = part * (1.0 - shown.alpha) * beside + ended.part * ended.transmittance;
        self.ended = Ended {
            fall: ended.fall + fall,
            part: all,
            transmittance: if all > 0.0 { through / all } else { ended.transmittance },
            ..ended
        };
        true
    }

    /// A part of another surface than what ended; whether that is what ended from now on.
    fn put_other_part(&mut self, shown: Premultiplied, part: f64, layer: Extent) -> bool {
        let Extent { fall, faces_away, .. } = layer;
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
        kept < 0.5
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
