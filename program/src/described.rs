//! What the inputs on the command line describe, before any model is read.

use std::path::PathBuf;

use surfel::{
    Error, Progress as _, Result,
    compose::ball_of_target,
    levels_file::LevelsFile,
    load::{
        BuiltIn, ObjectDescription, PictureDescription, Representation, Source, check_there, file_name,
        is_scene_file, load_scene_file,
    },
    scene::{Ball, CameraParts, Light, Scene},
};

use crate::{console::Bars, inputs::Inputs, unused};

/// The descriptions in the inputs.
#[derive(Default)]
pub struct Described {
    pub objects: Vec<ObjectDescription>,
    pub lights: Vec<Light>,
    pub camera: Option<DescribedCamera>,
    /// With the file that says it.
    pub picture: (PathBuf, PictureDescription),
}

/// What a scene file says of the camera.
pub struct DescribedCamera {
    file: PathBuf,
    parts: CameraParts,
    /// The object that it looks at.
    object: Option<String>,
}

impl DescribedCamera {
    /// With the place of the object, which is in the scene or a file that views read.
    ///
    /// # Errors
    /// As [`ball_of_target`].
    pub fn of(self, scene: &Scene, hierarchies: &[LevelsFile]) -> Result<(PathBuf, CameraParts)> {
        let Some(name) = &self.object else { return Ok((self.file, self.parts)) };
        let of_files = hierarchies.iter().filter(|file| file.name() == name).map(LevelsFile::ball);
        let found = of_files.chain(scene.ball_named(name)).reduce(Ball::union);
        let subject = Some(found.map_or_else(|| ball_of_target(scene, name, &self.file), Ok)?);
        Ok((self.file, CameraParts { subject, ..self.parts }))
    }
}

/// Reads scene files, and no other input.
///
/// # Errors
/// As [`load_scene_file`]; two scene files that both have a camera; a file that is not there.
pub fn describe(inputs: &Inputs, bars: &Bars) -> Result<Described> {
    let mut described = Described::default();
    let (representation, samples) = (inputs.representation, inputs.samples);
    let built_in = "the built-in model is made of splats; expected an input";
    match (inputs.files.is_empty(), representation, samples) {
        (true, Representation::Mesh | Representation::Hybrid { .. }, _) => {
            let name = if representation == Representation::Mesh { "mesh" } else { "hybrid" };
            return Err(Error::option("--representation", format!("{name}: {built_in}")));
        }
        (true, _, Some(_)) => return Err(Error::option("--resample", built_in)),
        (_, Representation::Mesh, Some(_)) => {
            let problem =
                "has no meaning for meshes that are drawn as triangles; expected no --representation mesh";
            return Err(Error::option("--resample", problem));
        }
        (true, ..) if inputs.options.columns.is_some() => {
            return Err(Error::option("--columns", built_in));
        }
        (true, ..) => described.objects.push(ObjectDescription::of_built_in(BuiltIn::Relief)),
        _ => {}
    }
    if let (Some(file), options @ [_, ..]) =
        (inputs.files.iter().find(|file| is_scene_file(file)), &inputs.not_for_scene_files[..])
    {
        let options = unused::joined(options);
        bars.note(&format!(
            "{}: without {options}, as the keys of its objects say how they are drawn",
            file_name(file)
        ));
    }
    for path in &inputs.files {
        if !is_scene_file(path) {
            let object = ObjectDescription::of_file(path);
            described.objects.push(ObjectDescription { representation, samples, ..object });
            continue;
        }
        let file = load_scene_file(path, &inputs.options)?;
        described.objects.extend(file.objects);
        described.lights.extend(file.lights);
        if file.picture != PictureDescription::default() {
            let (other, said) = &described.picture;
            if *said != PictureDescription::default() {
                let problem = format!("{} has some too; expected them in one file", other.display());
                return Err(Error::input(path, "epsilon, background, shading or clips", problem));
            }
            described.picture = (file.path.clone(), file.picture);
        }
        if let Some(parts) = file.camera {
            if let Some(other) = &described.camera {
                let problem = format!("{} has one too; expected one camera", other.file.display());
                return Err(Error::input(path, "camera", problem));
            }
            described.camera = Some(DescribedCamera { file: file.path, parts, object: file.camera_target });
        }
    }
    let files = described.objects.iter().filter_map(|object| match &object.source {
        Source::File(path) => Some(path.as_path()),
        _ => None,
    });
    if inputs.options.columns.is_some() && files.clone().next().is_none() {
        bars.note("without --columns, as no object is of a file");
    }
    files.into_iter().try_for_each(check_there)?;
    Ok(described)
}
