//! The element `camera`, in which the Point Cloud Library writes where a scan was taken from.

use glam::DVec3;

use super::{body::Body, schema::Element};
use crate::error::Result;

/// The properties that tell the place of the scanner; its axes and its lens, which the element has, too, are not kept.
pub(super) fn place(def: &Element) -> Option<[usize; 3]> {
    if def.name != "camera" {
        return None;
    }
    Some([def.scalar("view_px")?, def.scalar("view_py")?, def.scalar("view_pz")?])
}

/// The first place that the elements tell, if they tell one: 0 0 0 is what the library writes where it knows none.
pub(super) fn read(body: &mut Body<'_>, def: &Element, place: [usize; 3]) -> Result<Option<DVec3>> {
    let mut found = None;
    body.tables(def, &place, &mut |table| {
        let told = table.vectors([0, 1, 2]).find(|place| place.is_finite() && *place != DVec3::ZERO);
        found = found.or(told);
    })?;
    Ok(found)
}
