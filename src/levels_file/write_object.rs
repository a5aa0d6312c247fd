//! An object that is in memory, as a file.

use std::{io, path::Path};

use glam::DVec3;

use super::{
    header::Header,
    page::Form,
    part::{write_part, write_top},
    write::Writer,
};
use crate::{
    error::{Error, Result},
    geometry::{Overlaps, hierarchy::Hierarchy},
    progress::Progress,
    save,
    scene::{Bounds, Colors, Object, Opacity},
};

/// The form of a file that was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// What it holds.
    pub header: Header,
    /// The parts of which its hierarchy was made; 1 where it was made in one go.
    pub parts: usize,
}

/// What is known of an object beside its splats.
#[derive(Clone, Copy, Debug)]
pub struct Facts {
    /// As [`crate::scene::Object::closed`].
    pub closed: bool,
    /// The direction that is up, where something tells it: unit.
    pub up: Option<DVec3>,
}

/// Writes an object without defects with its levels of detail. The same object gives the same bytes.
///
/// # Errors
/// [`crate::ErrorKind::File`] if the file can't be written; nothing is left behind then. [`crate::ErrorKind::Input`] for an object of which
/// nothing is seen; as [`Hierarchy::build`].
pub fn write_object(
    path: &Path,
    object: &Object,
    up: Option<DVec3>,
    progress: &dyn Progress,
) -> Result<Written> {
    let splats = &object.splats;
    let bounds = splats.bounds().ok_or_else(|| Error::input("splats", "", "none that can be drawn"))?;
    if splats.colors.opacity() == Opacity::Invisible {
        return Err(Error::input("splats", "", "all of them are invisible"));
    }
    let hierarchy = Hierarchy::build(splats, progress)?;
    let color = match splats.colors {
        Colors::Uniform(color) => Some(color),
        Colors::Each(_) => None,
    };
    let transparent = splats.colors.opacity() == Opacity::Transparent;
    let ellipses = matches!(splats.shapes, crate::scene::Shapes::Ellipses { .. });
    let form = Form { ellipses, color, alpha: transparent, origin: hierarchy.origin };
    let reach = |i: usize| splats.positions[i].distance(bounds.center()) + splats.major_radius(i);
    let facts = Facts { closed: object.closed, up };
    let overlaps = Overlaps::of(splats);
    let header = Header {
        radius: (0..splats.len()).map(reach).fold(0.0, f64::max),
        root_radius: hierarchy.bounds.first().map_or(0.0, |root| root.error.radius.into()),
        overlap: overlaps.mean,
        ..header(&form, &facts, &bounds)
    };
    let header = save::create(path, |file| {
        let written = || -> io::Result<Header> {
            let mut writer = Writer::new(file, form)?;
            let root = write_part(
                &mut writer,
                (splats, splats.len() as u64),
                &hierarchy,
                (&overlaps, overlaps.mean),
            )?;
            write_top(&mut writer, &[], &[(root, None)], color)?;
            writer.finish(header)
        };
        written().map_err(|e| Error::file(path, "write", e))
    })?;
    Ok(Written { header, parts: 1 })
}

/// A header of which the counts and lengths are still missing.
pub(super) fn header(form: &Form, facts: &Facts, bounds: &Bounds) -> Header {
    Header {
        splats: 0,
        nodes: 0,
        pages: 0,
        closed: facts.closed,
        ellipses: form.ellipses,
        transparent: form.alpha,
        color: form.color,
        origin: form.origin,
        bounds: [bounds.min, bounds.max],
        radius: 0.0,
        root_radius: 0.0,
        overlap: 1.0,
        up: facts.up,
        table_at: 0,
        table_crc: 0,
    }
}
