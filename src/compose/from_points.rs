//! Points become splats.

use super::{
    parts::{Parts, StepTimer},
    words::finish,
};
use crate::{
    error::{Error, Result},
    geometry::{check_memory_for, splats_from_points},
    load::ObjectDescription,
    scene::{Object, Points},
};

/// The bytes of a point at the height of the work: neighbors (48) and spreads, normals and places (64), the tree (33), edges and
/// their costs (24 and 72), and the splat.
const BYTES_PER_POINT: usize = 300;

/// The splats of points that are given in their own coordinates. Errors know no file.
pub(super) fn parts(
    own: Points,
    name: String,
    object: &ObjectDescription,
    work: &mut StepTimer<'_>,
) -> Result<Parts> {
    check_memory_for(own.positions.len(), BYTES_PER_POINT)
        .map_err(|problem| Error::input("", "", problem))?;
    Ok(work.time(format!("normals and radii of {name}"), |progress| {
        let mut points = own.transformed(&object.world_from_object);
        points.colors.tint(object.color, object.alpha);
        let (splats, report) = splats_from_points(points, progress);
        let closed = report.around_scanner;
        let (object, mut told) = finish(Object { name, splats, closed }, report.to_string(), None);
        told.notes = [report.notes(), told.notes].concat();
        told.because = "points become disks that close their surface".to_owned();
        Parts::of_splats(object, told)
    }))
}

#[cfg(all(test, feature = "e57"))]
mod tests;
