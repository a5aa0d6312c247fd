//! Splats as a binary PLY file (little endian), as `load` reads it.
//!
//! Disks are `x y z nx ny nz radius`, ellipses `x y z su_x su_y su_z sv_x sv_y sv_z`; `red green blue` where the colors
//! are not those of a surface without any, and `alpha` where one is not 1. The line `comment surfel closed` keeps what no
//! property tells: that the splats sample a closed surface, so that those which face away need not be drawn; `comment surfel up 0 0 1` which
//! direction is up, where that is known.
//!
//! **What is lost.** Normals, radii and tangent vectors: nothing. Positions: nothing as `double`; they are `float` only
//! where that moves no splat by more than [`MOST_SHIFT`] of its radius. Colors: nothing that came from a file; the file
//! has the narrowest type that gives back the same 32-bit floats, and where none does, `float` (sRGB, within a few
//! units of the last place). Clip curves: nothing; they are `clip_a1 clip_a3 clip_u clip_v clip_w` where a splat has one, the same with
//! `clip2_` where one has two, and `clip_mode` where both of two must remove.

mod clips;
mod colors;

use std::{
    io::{self, Write},
    path::Path,
};

use glam::{DVec3, Vec3};

use super::whole;
use crate::{
    error::Result,
    progress::Progress,
    scene::{Shapes, Splats},
};
use clips::ClipColumns;
use colors::ColorColumns;

/// The largest part of its radius by which rounding a position to `float` may move a splat: its rim stays where it is to
/// a thousandth of its own size. A model of a few units around the origin needs no `double` below some million splats.
const MOST_SHIFT: f64 = 1.0 / 1024.0;

/// How many splats are written between two progress messages.
const PROGRESS_SPLATS: usize = 1 << 16;

/// The form of a file that was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WrittenSplats {
    /// Bytes of the whole file.
    pub bytes: u64,
    /// Positions are `double`.
    pub double_positions: bool,
}

/// Writes splats; those with a [`crate::scene::Defect`] too. `closed` as [`crate::scene::Object::closed`], `up` as
/// [`crate::load::Loaded::up`].
///
/// # Errors
/// [`crate::ErrorKind::File`] if the file can't be written; nothing is left behind then.
pub fn splats(
    path: &Path,
    splats: &Splats,
    closed: bool,
    up: Option<DVec3>,
    progress: &dyn Progress,
) -> Result<WrittenSplats> {
    let double_positions = (0..splats.len()).any(|i| single_loses(splats, i));
    let colors = ColorColumns::of(splats);
    let clips = ClipColumns::of(&splats.clips);
    let header = header(splats, (closed, up), double_positions, &colors, &clips);
    let mut row = Vec::new();
    let mut bytes = header.len() as u64;
    whole::write(path, |file| {
        file.write_all(header.as_bytes())?;
        for i in 0..splats.len() {
            row.clear();
            push_row(&mut row, splats, i, double_positions, &colors)?;
            clips.push(&mut row, splats.clips.get(i));
            file.write_all(&row)?;
            bytes += row.len() as u64;
            if i % PROGRESS_SPLATS == 0 {
                progress.step("write the splats", i as u64, splats.len() as u64);
            }
        }
        Ok(())
    })?;
    progress.step("write the splats", splats.len() as u64, splats.len() as u64);
    Ok(WrittenSplats { bytes, double_positions })
}

/// Whether the position of splat `i` needs `double`. Beyond the range of `float` the shift is infinite; of what is not
/// finite it is NaN, and `float` keeps that.
fn single_loses(splats: &Splats, i: usize) -> bool {
    let position = splats.positions[i];
    let shift = position.distance(position.as_vec3().as_dvec3());
    shift > MOST_SHIFT * splats.major_radius(i) || (shift > 0.0 && splats.defect(i).is_some())
}

fn header(
    splats: &Splats,
    (closed, up): (bool, Option<DVec3>),
    double_positions: bool,
    colors: &ColorColumns,
    clips: &ClipColumns,
) -> String {
    let mut text =
        "ply\nformat binary_little_endian 1.0\ncomment splats: disks with radius, or tangent vectors\n"
            .to_owned();
    if closed {
        text += "comment surfel closed\n";
    }
    if let Some(up) = up {
        text += &format!("comment surfel up {} {} {}\n", up.x, up.y, up.z);
    }
    text += &format!("element vertex {}\n", splats.len());
    let mut properties = |kind: &str, names: &[&str]| {
        for name in names {
            text += &format!("property {kind} {name}\n");
        }
    };
    properties(if double_positions { "double" } else { "float" }, &["x", "y", "z"]);
    match splats.shapes {
        Shapes::Disks { .. } => properties("float", &["nx", "ny", "nz", "radius"]),
        Shapes::Ellipses { .. } => {
            properties("float", &["su_x", "su_y", "su_z", "sv_x", "sv_y", "sv_z"]);
        }
    }
    if let Some(number) = colors.rgb {
        properties(number.name(), &["red", "green", "blue"]);
    }
    if let Some(number) = colors.alpha {
        properties(number.name(), &["alpha"]);
    }
    clips.properties().for_each(|[kind, name]| properties(kind, &[name]));
    text + "end_header\n"
}

fn push_row(
    row: &mut Vec<u8>,
    splats: &Splats,
    i: usize,
    double_positions: bool,
    colors: &ColorColumns,
) -> io::Result<()> {
    let position: DVec3 = splats.positions[i];
    match double_positions {
        true => position.to_array().iter().try_for_each(|x| row.write_all(&x.to_le_bytes()))?,
        false => push(row, position.as_vec3())?,
    }
    match &splats.shapes {
        Shapes::Disks { normals, radii } => {
            push(row, normals[i])?;
            row.write_all(&radii[i].to_le_bytes())?;
        }
        Shapes::Ellipses { s, t } => {
            push(row, s[i])?;
            push(row, t[i])?;
        }
    }
    colors.push(row, splats.color(i))
}

fn push(row: &mut Vec<u8>, vector: Vec3) -> io::Result<()> {
    vector.to_array().iter().try_for_each(|x| row.write_all(&x.to_le_bytes()))
}
