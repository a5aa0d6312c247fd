//! E57 files: scans, each with its pose, joined in the file's common coordinates. The crate `e57` reads them.

mod check;
#[cfg(test)]
mod tests;

use std::io::Cursor;

use e57::{CartesianCoordinate, E57Reader, PointCloud, RecordName, Transform};
use glam::DVec3;

use super::{Input, Loaded, Model, shade};
use crate::{
    error::Result,
    notes::Deed,
    scene::{Colors, Points, UNKNOWN_SRGB, Viewpoint},
};

/// How many points are read between two steps of progress.
const STEP_POINTS: u64 = 1 << 18;

/// What was read so far.
#[derive(Default)]
struct Scans {
    positions: Vec<DVec3>,
    /// sRGB, 0–1.
    colors: Vec<[f32; 3]>,
    has_colors: bool,
    invalid: u64,
}

pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    check::header(input)?;
    let fault = |e: e57::Error| input.fault("", one_line(&e));
    let mut reader = E57Reader::new(Cursor::new(input.bytes)).map_err(fault)?;
    let clouds = reader.pointclouds();
    if clouds.is_empty() {
        return Err(input.fault("", "no scan; expected at least one"));
    }
    check::sizes(input, &clouds)?;
    let mut scans = Scans::default();
    let mut ignored = Vec::new();
    let mut viewpoints = Vec::new();
    for (i, cloud) in clouds.iter().enumerate() {
        let fault = |e: e57::Error| input.fault(format!("scan {i}"), one_line(&e));
        let reader = reader.pointcloud_simple(cloud).map_err(fault)?;
        for (k, point) in (0_u64..).zip(reader) {
            scans.add(&point.map_err(fault)?);
            if k % STEP_POINTS == 0 {
                let before = input.bytes.len() / clouds.len() * i;
                let share =
                    (input.bytes.len() / clouds.len()) as f64 * (k as f64 / cloud.records.max(1) as f64);
                input.step(before + share as usize);
            }
        }
        viewpoints.push(Viewpoint { end: scans.positions.len(), place: viewpoint(cloud) });
        ignored.extend(unread(cloud).filter(|name| !ignored.contains(name)).collect::<Vec<_>>());
    }
    input.step(input.bytes.len());
    // Where no scan has been moved, all of them may have been put in one place before. One that is still as it was scanned has not.
    let is_alone = clouds.len() == 1 && clouds[0].transform.is_some() && is_as_scanned(&clouds[0]);
    if !(is_alone || clouds.iter().any(|cloud| cloud.transform.as_ref().is_some_and(moves)))
        || !viewpoints.iter().all(|v| v.place.is_finite())
    {
        viewpoints.clear();
    }
    let format = match clouds.len() {
        1 => "E57, 1 scan".to_owned(),
        scans => format!("E57, {scans} scans"),
    };
    let mut loaded = Loaded::new(Model::Points(scans.points(viewpoints)), format);
    loaded.up = Some(DVec3::Z);
    loaded.metres_per_unit = Some(1.0);
    loaded.note(Deed::Dropped, scans.invalid, "points that are marked as invalid");
    let names = ignored.join(", ");
    loaded.note(Deed::Ignored, ignored.len() as u64, format!("fields that have no meaning here ({names})"));
    Ok(loaded)
}

impl Scans {
    fn add(&mut self, point: &e57::Point) {
        let CartesianCoordinate::Valid { x, y, z } = point.cartesian else {
            self.invalid += 1;
            return;
        };
        self.positions.push(DVec3::new(x, y, z));
        // Intensities are here, too, where a point has no color.
        self.has_colors |= point.color.is_some();
        let color = point.color.as_ref().map(|color| [color.red, color.green, color.blue]);
        self.colors.push(color.unwrap_or([UNKNOWN_SRGB; 3]));
    }

    /// What was read, which is taken out.
    fn points(&mut self, viewpoints: Vec<Viewpoint>) -> Points {
        let srgb = std::mem::take(&mut self.colors);
        let colors = match self.has_colors {
            true => Colors::Each(shade::from_srgb(&srgb, 1.0).0),
            false => Colors::unknown(),
        };
        let positions = std::mem::take(&mut self.positions);
        Points { positions, normals: None, radii: None, radii_in_doubt: false, colors, viewpoints }
    }
}

/// Where the scanner stood: the origin of the scan's own coordinates. Of scans that others were put beside, it is the file's.
fn viewpoint(cloud: &PointCloud) -> DVec3 {
    cloud.transform.as_ref().map_or(DVec3::ZERO, |pose| {
        let place = &pose.translation;
        DVec3::new(place.x, place.y, place.z)
    })
}

fn moves(pose: &Transform) -> bool {
    let (place, turn) = (&pose.translation, &pose.rotation);
    [place.x, place.y, place.z, turn.x, turn.y, turn.z].iter().any(|value| *value != 0.0)
}

/// Whether points are told by angles, or by rows and columns, as a scanner sees them. Writers of other clouds leave a pose that moves
/// nothing, too.
fn is_as_scanned(cloud: &PointCloud) -> bool {
    let of_scanner = [RecordName::SphericalRange, RecordName::RowIndex, RecordName::ColumnIndex];
    cloud.prototype.iter().any(|record| of_scanner.contains(&record.name))
}

/// Fields of extensions, which may be normals or names of objects.
fn unread(cloud: &PointCloud) -> impl Iterator<Item = String> {
    cloud.prototype.iter().filter_map(|record| match &record.name {
        RecordName::Unknown { namespace, name } => {
            let name: String = format!("{namespace}:{name}").chars().take(40).collect();
            Some(name.escape_debug().to_string())
        }
        _ => None,
    })
}

/// What the crate says, with its cause, which it says itself of some.
fn one_line(error: &e57::Error) -> String {
    let mut said = error.to_string();
    if let Some(cause) = std::error::Error::source(error).map(ToString::to_string)
        && !said.ends_with(&cause)
    {
        said = format!("{said}: {cause}");
    }
    said.split_whitespace().collect::<Vec<_>>().join(" ")
}
