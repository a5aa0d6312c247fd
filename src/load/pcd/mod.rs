//! PCD files, the Point Cloud Library's: text, binary, or binary compressed by LZF.

mod header;
#[cfg(test)]
mod tests;
mod values;

use glam::DVec3;

use super::{Input, Loaded, Model, shade};
use crate::{
    error::Result,
    notes::Deed,
    scene::{Colors, Points, Viewpoint},
};
use header::{Encoding, Field, Header, Kind};

/// The fields that are read, each under all of its names.
const NAMES: [&[&str]; 11] = [
    &["x"],
    &["y"],
    &["z"],
    &["normal_x", "nx"],
    &["normal_y", "ny"],
    &["normal_z", "nz"],
    &["rgb", "rgba"],
    &["r", "red"],
    &["g", "green"],
    &["b", "blue"],
    &["intensity", "i"],
];

/// Where in [`NAMES`] the color is whose channels share one number.
const PACKED: usize = 6;

pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    let header = header::read(input)?;
    let field =
        |names: &[&str]| header.fields.iter().find(|f| f.count > 0 && names.contains(&f.name.as_str()));
    let wanted = NAMES.map(field);
    let [x, y, z, nx, ny, nz, packed, r, g, b, intensity] = wanted;
    if [x, y, z].iter().any(Option::is_none) {
        return Err(input.fault("header", "not all of the fields x, y and z"));
    }
    if packed.is_some_and(|field| field.size != 4) {
        return Err(input.fault("header", "a field rgb that has not 4 bytes"));
    }
    input.options.limits.check_points(input, header.points as u64)?;
    let has_normals = [nx, ny, nz].iter().all(Option::is_some);
    let has_channels = packed.is_none() && [r, g, b].iter().all(Option::is_some);
    let has_colors = packed.is_some() || has_channels;
    let has_grays = !has_colors && intensity.is_some();
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    let (mut colors, mut grays) = (Vec::new(), Vec::new());
    values::each(input, &header, &wanted, PACKED, |batch| {
        for &[x, y, z, nx, ny, nz, packed, r, g, b, intensity] in batch {
            positions.push(DVec3::new(x, y, z));
            if has_normals {
                normals.push(DVec3::new(nx, ny, nz).as_vec3());
            }
            if has_channels {
                colors.push([r as f32, g as f32, b as f32]);
            } else if has_colors {
                // The fourth byte is alpha, where it is anything: writers leave it 0 in opaque clouds.
                let [b, g, r, _] = (packed as u32).to_le_bytes();
                colors.push([r, g, b].map(f32::from));
            }
            if has_grays {
                grays.push(intensity as f32);
            }
        }
    })?;
    input.step(input.bytes.len());
    let is_float = has_channels && r.is_some_and(|field| field.kind == Kind::Float);
    let unit = is_float && colors.iter().flatten().all(|value: &f32| *value <= 1.0);
    let (colors, outside) = match (has_colors, has_grays) {
        (true, _) => {
            let (colors, outside) = shade::from_srgb(&colors, if unit { 1.0 } else { 255.0 });
            (Colors::Each(colors), outside)
        }
        (false, true) => {
            let (grays, outside) = shade::gray(&grays);
            (Colors::Each(grays), outside)
        }
        (false, false) => (Colors::unknown(), 0),
    };
    let viewpoints = Viewpoint::of_all(positions.len(), header.viewpoint);
    let points = Points {
        positions,
        normals: has_normals.then_some(normals),
        radii: None,
        radii_in_doubt: false,
        colors,
        viewpoints,
    };
    let used = |field: &Field| wanted.iter().flatten().any(|used| used.index == field.index);
    let ignored: Vec<&str> = header
        .fields
        .iter()
        // An underscore names what only fills bytes.
        .filter(|field| !used(field) && field.name != "_" && field.name != "padding")
        .map(|field| field.name.as_str())
        .collect();
    let mut loaded = Loaded::new(Model::Points(points), words(&header, has_grays));
    loaded.note(Deed::Clamped, outside, "points with a color out of its range");
    let names = ignored.iter().take(8).copied().collect::<Vec<_>>().join(", ");
    loaded.note(Deed::Ignored, ignored.len() as u64, format!("fields ({names})"));
    Ok(loaded)
}

fn words(header: &Header, has_grays: bool) -> String {
    let encoding = match header.encoding {
        Encoding::Ascii => "ascii",
        Encoding::Binary => "binary",
        Encoding::Compressed => "binary, compressed",
    };
    format!("PCD, {encoding}{}", if has_grays { ", intensity as gray" } else { "" })
}
