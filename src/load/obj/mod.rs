//! OBJ files: the mesh in them with the colors of its materials, or their vertices where no row is a face. Texture
//! coordinates are left out; points, lines, free forms and textures, too, with a note.
//!
//! The crate `tobj` reads rows of numbers, and materials. What it doesn't know is closed around it: continued lines and
//! limits (`lines`), colors of some vertices and those that no face uses (`rows`), faces before their vertices and normals
//! that are not there (`corners`).

mod corners;
mod faces;
mod lines;
mod materials;
mod rows;
#[cfg(test)]
mod tests;
mod vertices;

use std::mem;

use glam::Vec3;

use super::{Input, Loaded, Model};
use crate::{
    error::{Error, Result},
    notes::Deed,
    scene::{Colors, Mesh, Points},
};
use faces::Faces;
use vertices::Vertices;

pub(super) fn parse(input: &Input<'_>) -> Result<Loaded> {
    let mut file = Vertices::read(input)?;
    let mut loaded = if file.has_faces { mesh(input, &file)? } else { points(input, &mut file)? };
    input.step(input.bytes.len());
    loaded.note(Deed::Ignored, file.lines_and_points, "rows of lines and points");
    loaded.note(Deed::Ignored, file.free_forms, "free-form shapes (curve or surface)");
    let outside = "material files outside of the model's folder (--allow-outside reads them)";
    loaded.note(Deed::Ignored, file.materials.outside, outside);
    loaded.note(Deed::Ignored, file.materials.unreadable, "material files that can't be read");
    let strange = "colors of materials that are not red, green and blue";
    loaded.note(Deed::Ignored, file.materials.strange_colors, strange);
    Ok(loaded)
}

fn nothing(input: &Input<'_>) -> Error {
    input.fault("", "neither a face nor a point; expected a mesh or points")
}

fn mesh(input: &Input<'_>, file: &Vertices) -> Result<Loaded> {
    let Faces { triangles, fans, origins, paints, palette, normals, counts, .. } = Faces::read(input, file)?;
    if triangles.is_empty() {
        return Err(nothing(input));
    }
    let mut beyond = 0;
    let colors = if file.have_colors() {
        let linear = |&origin: &u32| {
            let (color, is_beyond) = file.color(origin as usize);
            beyond += u64::from(is_beyond);
            color
        };
        Colors::Each(origins.iter().map(linear).collect())
    } else {
        painted(&paints, palette)
    };
    let left_out = unused(&origins, file.positions.len());
    let normals: Vec<Vec3> = normals.iter().map(|sum| sum.normalize_or_zero().as_vec3()).collect();
    let mesh = Mesh {
        positions: origins
            .iter()
            .filter_map(|&origin| file.positions.get(origin as usize).copied())
            .collect(),
        // Where a vertex has none, its faces give it one.
        normals: normals.iter().any(|normal| *normal != Vec3::ZERO).then_some(normals),
        colors,
        triangles,
    };
    let mut loaded = Loaded::new(Model::Mesh(mesh), "OBJ");
    loaded.fans = fans;
    loaded.note(Deed::Dropped, left_out, "vertices without a face");
    loaded.note(Deed::Dropped, counts.small, "faces with fewer than 3 corners");
    loaded.note(Deed::Dropped, counts.not_finite, "faces with a coordinate that is not finite");
    loaded.note(
        Deed::Ignored,
        counts.unusable_normals,
        "faces' normals that are zero, not finite or not there",
    );
    loaded.note(Deed::Clamped, beyond, "colors beyond 0 to 1");
    loaded.note(Deed::Ignored, counts.unknown_materials, "uses of materials that no file describes");
    loaded.note(Deed::Ignored, counts.overruled, "faces' materials, whose vertices have colors,");
    loaded.note(Deed::Ignored, counts.textures, "textures of materials");
    loaded.note(Deed::Ignored, counts.transparent, "transparencies of materials");
    Ok(loaded)
}

/// The colors of materials; vertices of faces without one look like a surface without colors.
fn painted(paints: &[u32], mut palette: Vec<[f32; 4]>) -> Colors {
    if palette.len() < 2 {
        return Colors::unknown();
    }
    if let (Some(first), Some(gray)) = (palette.first_mut(), Colors::unknown().get(0)) {
        *first = gray;
    }
    Colors::Each(paints.iter().filter_map(|&paint| palette.get(paint as usize).copied()).collect())
}

/// How many of the file's vertices have no copy.
fn unused(origins: &[u32], count: usize) -> u64 {
    let mut is_used = vec![false; count];
    for &origin in origins {
        if let Some(is_used) = is_used.get_mut(origin as usize) {
            *is_used = true;
        }
    }
    is_used.into_iter().filter(|is_used| !is_used).count() as u64
}

/// The vertices of a file without faces. Normals are theirs where there are as many.
fn points(input: &Input<'_>, file: &mut Vertices) -> Result<Loaded> {
    let count = file.positions.len();
    if count == 0 {
        return Err(nothing(input));
    }
    let mut beyond = 0;
    let colors = if file.have_colors() {
        let linear = |vertex: usize| {
            let (color, is_beyond) = file.color(vertex);
            beyond += u64::from(is_beyond);
            color
        };
        Colors::Each((0..count).map(linear).collect())
    } else {
        Colors::unknown()
    };
    let other_normals = if file.normals.len() == count { 0 } else { file.normals.len() as u64 };
    let normals = (file.normals.len() == count).then(|| mem::take(&mut file.normals));
    let positions = mem::take(&mut file.positions);
    let points =
        Points { positions, normals, radii: None, radii_in_doubt: false, colors, viewpoints: Vec::new() };
    let mut loaded = Loaded::new(Model::Points(points), "OBJ");
    loaded.note(Deed::Ignored, other_normals, "normals, of which there is not one for each point,");
    loaded.note(Deed::Clamped, beyond, "colors beyond 0 to 1");
    Ok(loaded)
}
