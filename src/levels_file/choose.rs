//! Which pages a view needs: those that are in it, and have something that is drawn.

use glam::DVec3;

use super::{
    ladder::Rung,
    table::{PageEntry, Reach},
};
use crate::{
    error::{Error, Result},
    scene::{Camera, ViewFromWorld},
};

/// What a device finds of a size in f32, and f64 here, may differ by so much of it.
const RESERVE: f64 = 1e-5;

/// So far outside of the picture, in pixels, a splat may have its center and all of its disk and still be seen: by what the filter adds.
const MARGIN_PX: f64 = 16.0;

/// By so much τ grows from one try to the next, where memory does not suffice: an eighth of an octave.
const TRIES_AN_OCTAVE: f64 = 8.0;

/// The first size that is tried in the place of 0, in pixels.
const LEAST_PX: f64 = 1.0 / 16.0;

/// The last size that is tried: the whole object is one splat then.
const LARGEST_PX: f64 = 1e6;

/// A view of a file.
#[derive(Clone, Copy, Debug)]
pub struct PageView {
    view: ViewFromWorld,
    focal_px: f64,
    /// Where the axis meets the picture.
    middle_px: [f64; 2],
    size_px: [f64; 2],
    /// No size is larger than at this distance.
    near: f64,
    is_orthographic: bool,
    tau_px: f64,
    /// Nodes are drawn up to so many times τ.
    blended_size: f64,
    /// What any larger τ needs is needed, too.
    coarser: bool,
    /// Which of several readers this is, and how many there are.
    reader: [u32; 2],
}

/// Pages, in the order in which they came, and for which τ.
pub(super) struct Choice {
    pub pages: Vec<usize>,
    pub tau_px: f64,
    /// The memory for the τ that was asked for.
    pub wanted_bytes: u64,
}

impl Choice {
    pub fn all(pages: &[&PageEntry]) -> Self {
        let wanted_bytes = pages.iter().map(|page| page.host_bytes()).sum();
        Self { pages: (0..pages.len()).collect(), tau_px: 0.0, wanted_bytes }
    }
}

impl PageView {
    /// That of a camera, for a picture of this size and a largest size of `tau_px` on the screen.
    pub fn new(camera: &Camera, size_px: [u32; 2], tau_px: f64) -> Self {
        Self {
            view: camera.view_from_world(),
            focal_px: camera.focal_px(size_px[1]),
            middle_px: camera.middle_px(size_px),
            size_px: size_px.map(f64::from),
            near: camera.near().max(f64::MIN_POSITIVE),
            is_orthographic: camera.is_orthographic(),
            tau_px,
            blended_size: 1.0,
            coarser: false,
            reader: [0, 1],
        }
    }

    /// With nodes up to so many times τ, beside those below them ([`crate::scene::Settings::blended_size`]).
    pub fn with_blended(self, blended_size: f64) -> Self {
        Self { blended_size, ..self }
    }

    /// With what any larger size needs, too, of which a frame is to choose one.
    pub fn with_coarser(self) -> Self {
        Self { coarser: true, ..self }
    }

    /// Shared by `readers`, of which this is number `reader`, from 0 on: each reads other pages, for one τ, and all together read those that the view
    /// needs. Memory is what each of them has.
    pub fn with_readers(self, reader: u32, readers: u32) -> Self {
        Self { reader: [reader, readers.max(1)], ..self }
    }

    /// The pages for the smallest τ, the one that was asked for or more, for which memory suffices.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Option`] where it suffices for none.
    pub(super) fn choose(&self, pages: &[&PageEntry], most_bytes: u64) -> Result<Choice> {
        let seen: Vec<usize> = (0..pages.len()).filter(|i| self.sees(pages[*i])).collect();
        let (mut tau_px, mut wanted_bytes) = (self.tau_px, None);
        loop {
            let is_needed = |page: &PageEntry| self.draws_of(page, tau_px);
            let needed: Vec<usize> = seen.iter().copied().filter(|i| is_needed(pages[*i])).collect();
            let (own, bytes) = self.shared(pages, needed);
            let wanted_bytes = *wanted_bytes.get_or_insert(bytes);
            if bytes <= most_bytes {
                return Ok(Choice { pages: own, tau_px, wanted_bytes });
            }
            if tau_px > LARGEST_PX {
                let problem =
                    format!("{most_bytes} bytes; expected {bytes} at least, for the coarsest nodes");
                return Err(Error::option("--budget-memory", problem));
            }
            tau_px = tau_px.max(LEAST_PX) * TRIES_AN_OCTAVE.recip().exp2();
        }
    }

    /// What is needed for τ and for each size that is twice the one before, up to the one at which all of it is one splat.
    pub(super) fn rungs(&self, pages: &[PageEntry], is_seen: impl Fn(usize) -> bool) -> Vec<Rung> {
        let seen: Vec<usize> = (0..pages.len()).filter(|i| is_seen(*i) && self.sees(&pages[*i])).collect();
        let sizes = std::iter::successors(Some(self.tau_px), |tau_px| {
            (*tau_px <= LARGEST_PX).then_some((2.0 * tau_px).max(LEAST_PX))
        });
        let rung = |tau_px| {
            let is_needed = |i: &usize| self.draws_of(&pages[*i], tau_px);
            Rung { tau_px, pages: seen.iter().copied().filter(is_needed).collect() }
        };
        sizes.map(rung).collect()
    }

    /// What this reader reads of some pages, and how much memory the one takes who takes most. One page after the other goes to who has least so
    /// far, so that all of them have as much, in every part of the view.
    fn shared(&self, pages: &[&PageEntry], needed: Vec<usize>) -> (Vec<usize>, u64) {
        let [reader, readers] = self.reader;
        let mut bytes = vec![0_u64; readers as usize];
        let mut own = Vec::new();
        for i in needed {
            let least = (0..bytes.len()).min_by_key(|of| bytes[*of]).unwrap_or(0);
            bytes[least] += pages[i].host_bytes();
            if least == reader as usize {
                own.push(i);
            }
        }
        (own, bytes.into_iter().max().unwrap_or(0))
    }

    /// The same view for another τ.
    #[must_use]
    pub fn with_tau(self, tau_px: f64) -> Self {
        Self { tau_px, ..self }
    }

    /// Whether something that is so long may be longer on the screen than τ, wherever it is in this ball.
    pub fn may_be_long(&self, length: f64, center: DVec3, radius: f64) -> bool {
        let distance = self.view.eye.distance(center) - radius;
        let distance = if self.is_orthographic { 1.0 } else { distance.max(self.near) };
        length * self.focal_px > self.tau_px * distance * (1.0 - RESERVE)
    }

    /// Whether something of a page may be in the picture.
    fn sees(&self, page: &PageEntry) -> bool {
        self.sees_all_of(page.center, |across, along| page.radius * across.hypot(along))
    }

    /// Whether something in a box may be in the picture, or within `reach` of the box.
    pub fn sees_box(&self, center: DVec3, half: DVec3, reach: f64) -> bool {
        let middle = self.view.point(center);
        let ends = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| self.view.point(center + half * axis) - middle);
        let of_axis = |axis: usize, across: f64, along: f64| {
            let of_ends = ends.map(|end| (across * end[axis] + along * end.z).abs());
            of_ends.iter().sum::<f64>() + reach * across.hypot(along)
        };
        [0, 1]
            .into_iter()
            .all(|axis| self.is_between(middle, axis, |across, along| of_axis(axis, across, along)))
            && middle.z >= -of_axis(0, 0.0, 1.0)
    }

    fn sees_all_of(&self, center: DVec3, reach: impl Fn(f64, f64) -> f64) -> bool {
        let middle = self.view.point(center);
        [0, 1].into_iter().all(|axis| self.is_between(middle, axis, &reach)) && middle.z >= -reach(0.0, 1.0)
    }

    /// Whether something is between the picture's two edges along an axis, 0 for x and 1 for y, or may be. `reach`: how far it reaches from its middle along a
    /// direction that is so long across the view's axis, and so long along it; times that length.
    fn is_between(&self, middle: DVec3, axis: usize, reach: impl Fn(f64, f64) -> f64) -> bool {
        // Distances of the picture's edges from its axis, on either side.
        let before_px = self.middle_px[axis] + MARGIN_PX;
        let behind_px = self.size_px[axis] - self.middle_px[axis] + MARGIN_PX;
        [(1.0, before_px), (-1.0, behind_px)].into_iter().all(|(side, edge_px)| {
            let (across, along) = match self.is_orthographic {
                true => (side * self.focal_px, 0.0),
                false => (side * self.focal_px, edge_px),
            };
            let behind_edge = if self.is_orthographic { edge_px } else { 0.0 };
            across * middle[axis] + along * middle.z + behind_edge >= -reach(across, along)
        })
    }

    /// Whether something of a page may be drawn for a τ: as the plan of a frame tells it of blocks.
    fn draws_of(&self, page: &PageEntry, tau_px: f64) -> bool {
        let distance = self.view.eye.distance(page.center);
        let share = tau_px / self.focal_px;
        let at = |distance: f64| share * if self.is_orthographic { 1.0 } else { distance.max(self.near) };
        let least = |balls: &Reach| at(distance - balls.reach) * (1.0 - RESERVE);
        let most = |balls: &Reach| at(distance + balls.far) * (1.0 + RESERVE);
        let some_parent_is_large = page.parent.spreads[1] > least(&page.parent);
        let some_own_is_small =
            !page.nodes || self.coarser || page.own.spreads[0] <= self.blended_size * most(&page.own);
        some_parent_is_large && some_own_is_small
    }
}
