//! The places of results: checked before the long work, so that it is not done in vain.

use std::{
    ffi::OsStr,
    io,
    path::{Path, PathBuf},
};

use surfel::{
    Error, Result,
    load::{LoadOptions, ObjectDescription, Source, is_scene_file, load_scene_file},
    save,
    scene::{Encoding, OptionTable as _},
};

use crate::picture::PictureArguments;

/// The format of the picture, from its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// 8-bit sRGB.
    Png,
    /// Linear 32-bit floats.
    Exr,
}

/// The files of `--dump`.
pub const DUMPED: [&str; 5] = ["weight.exr", "albedo.exr", "normal.exr", "depth.exr", "final.exr"];

/// Checks that everything asked for can be written, and gives the picture's place, `default` where nobody says it, and format.
///
/// # Errors
/// A picture whose format is unknown; as [`check_places`].
pub fn check(
    arguments: &PictureArguments,
    default: &str,
    timings: &Option<PathBuf>,
) -> Result<(PathBuf, PictureFormat)> {
    let PictureArguments { input, camera, output, dump, .. } = arguments;
    let output = output.clone().unwrap_or_else(|| default.into());
    check_name("--output", &output, &["png", "exr"])?;
    let inputs = input.inputs.iter().chain(&camera.camera);
    check_places([&output].into_iter().chain(timings), dump.as_deref(), &DUMPED, inputs)?;
    let is_exr = output.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("exr"));
    check_encoding(&arguments.encoding(), is_exr.then_some(&output))?;
    Ok((output, if is_exr { PictureFormat::Exr } else { PictureFormat::Png }))
}

/// Refuses an encoding out of range, and one that is not plain for a picture that stays linear.
///
/// # Errors
/// In the name of the option.
fn check_encoding(encoding: &Encoding, linear: Option<&PathBuf>) -> Result<()> {
    let plain = Encoding::default();
    for option in Encoding::OPTIONS {
        let problem = match linear {
            Some(file) if (option.get)(encoding) != (option.get)(&plain) => {
                let value = (option.get)(encoding);
                Err(format!("{value}: {} stays linear; expected a picture in .png", file.display()))
            }
            _ => (option.check)(encoding),
        };
        problem.map_err(|problem| Error::option(format!("--{}", option.name), problem))?;
    }
    Ok(())
}

/// Refuses a file whose name has none of these endings.
///
/// # Errors
/// In the name of the option.
pub fn check_name(option: &str, file: &Path, endings: &[&str]) -> Result<()> {
    let has = |ending: &&str| file.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending));
    match endings.iter().any(has) {
        true => Ok(()),
        false => {
            let expected = endings.join(" or .");
            Err(Error::option(option, format!("{}: expected a name in .{expected}", file.display())))
        }
    }
}

/// Checks that `files`, and those of these names in `folder`, can be written, and that none of them is an input (a model
/// of a scene file is one too) or written twice.
///
/// # Errors
/// A folder that is missing or can't be written to; a folder in a file's place; a file that is also an input or written
/// twice.
pub fn check_places<'a>(
    files: impl IntoIterator<Item = &'a PathBuf>,
    folder: Option<&Path>,
    names: &[&str],
    inputs: impl IntoIterator<Item = &'a PathBuf>,
) -> Result<()> {
    let mut files: Vec<PathBuf> = files.into_iter().cloned().collect();
    files.iter().try_for_each(|file| save::check_place(file))?;
    let mut taken: Vec<PathBuf> = Vec::new();
    for input in inputs {
        taken.extend(input.canonicalize());
        if is_scene_file(input) {
            taken.extend(models_of(input));
        }
    }
    if let Some(folder) = folder {
        check_folder(folder)?;
        for file in names.iter().map(|name| folder.join(name)) {
            if file.is_dir() {
                return Err(Error::file(file, "write", io::ErrorKind::IsADirectory.into()));
            }
            files.push(file);
        }
    }
    for file in files {
        let place = place_of(&file);
        if taken.contains(&place) {
            return Err(Error::option(file.display().to_string(), "is an input, or written twice"));
        }
        taken.push(place);
    }
    Ok(())
}

/// Files, and those that scene files among them name.
pub fn with_models(files: &[PathBuf]) -> Vec<PathBuf> {
    let models = files.iter().filter(|file| is_scene_file(file)).flat_map(|file| models_of(file));
    files.iter().cloned().chain(models).collect()
}

/// The files that a scene file names. What is wrong with it is told when it is loaded.
fn models_of(scene_file: &Path) -> Vec<PathBuf> {
    let options = LoadOptions { allow_outside: true, ..LoadOptions::default() };
    let objects = load_scene_file(scene_file, &options).map(|file| file.objects).unwrap_or_default();
    let model = |object: ObjectDescription| match object.source {
        Source::File(path) => Some(path),
        Source::BuiltIn { .. } => None,
    };
    objects.into_iter().filter_map(model).collect()
}

/// Checks that a file of splats can be written, and that it is not the input.
///
/// # Errors
/// A name that is not .ply; a place that can't be written to; the input's own.
pub fn check_converted(input: &Path, output: &Path) -> Result<()> {
    check_name("OUTPUT", output, &["ply", "surfel"])?;
    save::check_place(output)?;
    match input.canonicalize().is_ok_and(|input| input == place_of(output)) {
        true => Err(Error::option(output.display().to_string(), "is the input; expected another name")),
        false => Ok(()),
    }
}

/// A folder that can be written to, or created.
fn check_folder(path: &Path) -> Result<()> {
    let fail = |e: io::Error| Error::file(path, "write", e);
    match path.ancestors().find(|ancestor| named(ancestor).exists()) {
        // Nothing is left of a file without a name.
        Some(there) => tempfile::tempfile_in(named(there)).map(|_| ()).map_err(fail),
        None => Err(fail(io::ErrorKind::NotFound.into())),
    }
}

fn folder_of(file: &Path) -> &Path {
    named(file.parent().unwrap_or(Path::new("")))
}

/// The empty path is the current folder.
fn named(folder: &Path) -> &Path {
    if folder.as_os_str().is_empty() { Path::new(".") } else { folder }
}

/// The one name of a file that need not exist yet; a link is followed.
fn place_of(file: &Path) -> PathBuf {
    let folder = folder_of(file).canonicalize().unwrap_or_else(|_| folder_of(file).to_owned());
    file.canonicalize().unwrap_or_else(|_| folder.join(file.file_name().unwrap_or(OsStr::new(""))))
}
