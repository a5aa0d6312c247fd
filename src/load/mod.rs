//! Models from files, and the one that needs none.
//!
//! The format is told by the content, not by the name alone. Files that another one names are opened in its folder or
//! below, and elsewhere only if the user allows it.

mod beside;
pub mod builtin;
#[cfg(feature = "e57")]
mod e57;
mod fans;
mod foreign;
mod geographic;
#[cfg(feature = "gltf")]
mod gltf;
#[cfg(test)]
mod hostile;
mod input;
#[cfg(any(feature = "gltf", feature = "octrees"))]
mod json;
#[cfg(feature = "las")]
mod las;
mod lines;
mod loaded;
#[cfg(test)]
mod mutate;
mod number;
mod obj;
#[cfg(feature = "octrees")]
mod octree;
mod off;
mod options;
mod packed;
mod pcd;
mod ply;
#[cfg(test)]
pub mod real;
mod scene_file;
mod shade;
mod sniff;
mod source;
mod stl;
#[cfg(test)]
mod tests;
mod text;
mod units;

use std::path::Path;

use crate::{
    error::{Error, Result},
    notes::Deed,
    progress::Progress,
    scene::{Colors, Mesh, Object, Points, Splats},
};
use input::Input;

pub use foreign::runs_foreign_decoder;
pub use loaded::{Loaded, Model};
#[cfg(feature = "octrees")]
pub use octree::{LevelOfOctree, NodeKey, OctreeNode, PointOctree, is_point_octree};
pub use options::{Limits, LoadOptions};
pub use ply::SplatRows;
pub use scene_file::{
    BuiltIn, MOST_BUILT_IN_SPLATS, MOST_OBJECTS, MOST_SCENE_FILE_BYTES, ObjectDescription,
    PictureDescription, Polygons, Representation, Samples, SceneFile, Source, is_scene_file, load_scene_file,
};
pub use source::check_there;
pub use text::{Column, Columns};

/// Reads a file whole, or standard input where the path is `-`: PLY, OBJ, rows of numbers (XYZ, PTS, PTX, CSV), PCD, OFF,
/// STL, and with their Cargo features LAS, LAZ and COPC, E57, glTF and GLB, and Potree 2 by its `metadata.json`; gzip or zstd around any of them.
///
/// Elements that can't be drawn (not finite, zero size) stay in: the scene and geometry modules drop and count them.
///
/// # Errors
/// [`crate::ErrorKind::File`] if the file can't be read; [`crate::ErrorKind::Input`], naming element and number or the line, if
/// its content is not what its format demands, or is of a format that surfel does not know.
pub fn load(path: &Path, options: &LoadOptions, progress: &dyn Progress) -> Result<Loaded> {
    parse(source::read(path, &options.limits)?, options, progress)
}

/// The splats of a file, ready to be drawn: without those that can't be.
///
/// # Errors
/// As [`load`]; [`crate::ErrorKind::Input`] for a file of something else.
pub fn object(path: &Path) -> Result<Object> {
    let name = path.display().to_string();
    match load(path, &LoadOptions::default(), &())?.model {
        Model::Splats { mut splats, closed } => {
            splats.drop_defective();
            Ok(Object { name, splats, closed })
        }
        other => {
            let has = other.contents();
            let problem =
                format!("has {has}: expected splats; surfel convert makes them of meshes and points");
            Err(Error::input(path, "all of it", problem))
        }
    }
}

/// As [`load`], of a file that is in memory. `name` is its name in messages, and its ending tells the format where
/// the content leaves that open. No other file is opened.
///
/// # Errors
/// [`crate::ErrorKind::Input`], as [`load`].
pub fn load_bytes(
    name: &Path,
    bytes: Vec<u8>,
    options: &LoadOptions,
    progress: &dyn Progress,
) -> Result<Loaded> {
    parse(source::unpacked(name.to_owned(), None, bytes, &options.limits)?, options, progress)
}

fn parse(source: source::Source, options: &LoadOptions, progress: &dyn Progress) -> Result<Loaded> {
    let folder = source.folder.as_deref();
    let format = sniff::format(&source.path, &source.name, &source.bytes)?;
    let bytes = match format {
        sniff::Format::Ply | sniff::Format::Obj => sniff::without_mark(&source.bytes),
        _ => &source.bytes,
    };
    let input = Input { path: &source.path, folder, bytes, options, progress };
    let mut loaded = match format {
        sniff::Format::Ply => ply::parse(&input),
        sniff::Format::Obj => obj::parse(&input),
        sniff::Format::Rows => text::parse(&input),
        sniff::Format::Stl => stl::parse(&input),
        sniff::Format::Off => off::parse(&input),
        sniff::Format::Pcd => pcd::parse(&input),
        #[cfg(feature = "gltf")]
        sniff::Format::Gltf => gltf::parse(&input),
        #[cfg(feature = "las")]
        sniff::Format::Las => las::parse(&input),
        #[cfg(feature = "e57")]
        sniff::Format::E57 => e57::parse(&input),
        #[cfg(feature = "octrees")]
        sniff::Format::Potree => octree::parse(&input),
        #[cfg(not(all(feature = "e57", feature = "gltf", feature = "las", feature = "octrees")))]
        other => {
            let (name, feature) = (other.name(), other.feature());
            Err(input.fault("", format!("a {name} file, which needs the Cargo feature `{feature}`")))
        }
    }?;
    refuse_nothing(&input, &loaded)?;
    loaded.metres_per_unit = loaded.metres_per_unit.or_else(|| units::told(format, bytes));
    if format != sniff::Format::Rows {
        loaded.notes.extend(options.columns_unused());
    }
    if let Model::Mesh(mesh) = &mut loaded.model {
        let uncut = fans::cut(mesh, &std::mem::take(&mut loaded.fans), fans::MOST_LOOKS);
        let unused = mesh.drop_unused_vertices();
        let what = "bends of polygons that cross themselves or take too long, drawn as fans,";
        loaded.note(Deed::Ignored, uncut, what);
        loaded.note(Deed::Dropped, unused as u64, "vertices without a face");
    }
    show_what_is_invisible(&mut loaded);
    if let Some(packing) = source.packing {
        loaded.format = format!("{} in {}", loaded.format, packing.name());
    }
    Ok(loaded)
}

/// Makes a model opaque whose every alpha is 0: writers that have none leave it so, and nothing would be seen.
fn show_what_is_invisible(loaded: &mut Loaded) {
    let (Model::Splats { splats: Splats { colors, .. }, .. }
    | Model::Points(Points { colors, .. })
    | Model::Mesh(Mesh { colors, .. })) = &mut loaded.model;
    let Colors::Each(colors) = colors else { return };
    if colors.iter().all(|[.., alpha]| *alpha == 0.0) {
        colors.iter_mut().for_each(|[.., alpha]| *alpha = 1.0);
        let count = colors.len() as u64;
        loaded.note(Deed::Replaced, count, "alphas that are all 0, by 1,");
    }
}

/// A model of nothing is no scene, and all that would be said of it later is beside the point.
fn refuse_nothing(input: &Input<'_>, loaded: &Loaded) -> Result<()> {
    let is_empty = match &loaded.model {
        Model::Splats { splats, .. } => splats.positions.is_empty(),
        Model::Mesh(mesh) => mesh.triangles.is_empty(),
        Model::Points(points) => points.positions.is_empty(),
    };
    if !is_empty {
        return Ok(());
    }
    let why = loaded.notes.first().map(|note| format!(" ({note})")).unwrap_or_default();
    let contents = loaded.model.contents();
    Err(input.fault("", format!("a {} file without {contents}{why}; expected some", loaded.format)))
}

/// The file's own name, without its folder.
pub fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
