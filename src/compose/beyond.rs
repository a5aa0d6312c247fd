//! Places that are too far out for any picture: one number that is wrong in a file is no reason to draw nothing.

use glam::DVec3;

use crate::{
    load::Model,
    notes::{Deed, Note},
    scene::{Mesh, Points, Splats},
};

/// What is farther out is no place: beyond numbers of 32 bits, which a device has.
const FARTHEST: f64 = f32::MAX as f64;

/// Puts such places among those that are not finite, which are dropped and counted.
pub(super) fn lose(model: &mut Model) -> Option<Note> {
    let (Model::Splats { splats: Splats { positions, .. }, .. }
    | Model::Points(Points { positions, .. })
    | Model::Mesh(Mesh { positions, .. })) = model;
    let is_beyond = |place: &DVec3| place.is_finite() && place.abs().max_element() > FARTHEST;
    let mut count = 0;
    for place in positions.iter_mut().filter(|place| is_beyond(place)) {
        *place = DVec3::INFINITY;
        count += 1;
    }
    Note::of(Deed::Replaced, count, "places beyond numbers of 32 bits (3.4e38), by infinities,")
}
