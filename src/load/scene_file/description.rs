//! The contents of a scene file, as plain data.

use std::path::PathBuf;

use glam::{DAffine3, DVec3};

use crate::{
    load::builtin::{DEFAULT_RELIEF_SPLATS, DEFAULT_SPHERE_SPLATS},
    scene::{CameraParts, ClipBox, ClipPlanes, Epsilon, Light, Settings, Shading, named},
};

/// A scene file: what is drawn, under which light and from where.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// Where it was read.
    pub path: PathBuf,
    /// The camera, where it says anything of it.
    pub camera: Option<CameraParts>,
    /// The name of the object that the camera looks at, where it says one: [`crate::scene::Scene::ball_named`] is its
    /// [`CameraParts::subject`].
    pub camera_target: Option<String>,
    /// At most [`crate::scene::MOST_LIGHTS`]; none: [`Light::DEFAULT`].
    pub lights: Vec<Light>,
    /// At least one, at most [`super::MOST_OBJECTS`], in the order of the file.
    pub objects: Vec<ObjectDescription>,
    /// What it says of the picture.
    pub picture: PictureDescription,
}

/// What a scene file says of the picture: of settings those that belong to a scene. Options replace them key by key.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PictureDescription {
    /// As [`Settings::epsilon`](crate::scene::Settings::epsilon).
    pub epsilon: Option<Epsilon>,
    /// As [`Settings::background`](crate::scene::Settings::background).
    pub background: Option<Option<[f32; 3]>>,
    /// As [`Settings::shading`](crate::scene::Settings::shading).
    pub shading: Option<Shading>,
    /// As [`Settings::clip_box`](crate::scene::Settings::clip_box).
    pub clip_box: Option<ClipBox>,
    /// As [`Settings::clip_planes`](crate::scene::Settings::clip_planes).
    pub clip_planes: Option<ClipPlanes>,
}

impl PictureDescription {
    /// These settings, but for what it says.
    pub fn over(&self, mut settings: Settings) -> Settings {
        settings.epsilon = self.epsilon.unwrap_or(settings.epsilon);
        settings.background = self.background.unwrap_or(settings.background);
        settings.shading = self.shading.unwrap_or(settings.shading);
        settings.clip_box = self.clip_box.unwrap_or(settings.clip_box);
        settings.clip_planes = self.clip_planes.clone().unwrap_or(settings.clip_planes);
        settings
    }
}

/// One object: a model, and how it is placed, colored and drawn. [`crate::compose::make`] makes it.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectDescription {
    /// The model.
    pub source: Source,
    /// Its name in messages; without, that of its file or built-in model.
    pub name: Option<String>,
    /// As what it is drawn.
    pub representation: Representation,
    /// New splats of a mesh's surface, or of the part of it that is drawn as splats; without, a disk at each vertex, and as
    /// many for such a part as it has vertices. Only for meshes that are not drawn as triangles.
    pub samples: Option<Samples>,
    /// Where it is: from the model's own coordinates to the world's; invertible.
    pub world_from_object: DAffine3,
    /// Replaces its own colors: linear, 0–1.
    pub color: Option<[f32; 3]>,
    /// Multiplies its own alpha: 0–1.
    pub alpha: f32,
    /// Of its splats, in place of the picture's.
    pub epsilon: Option<Epsilon>,
}

/// Where a model comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// From a file of a model. A scene file's are canonical paths: no link is followed any more when they are opened.
    File(PathBuf),
    /// From the program itself.
    BuiltIn {
        /// Which.
        model: BuiltIn,
        /// How many splats, if it is made of splats: 1 to [`MOST_BUILT_IN_SPLATS`]; a part has its share by area.
        splats: u64,
        /// How many triangles at least, if it is made of triangles: at least 1.
        triangles: u64,
    },
}

named! {
    /// The built-in models by their names in scene files, see [`crate::load::builtin`].
    BuiltIn {
        /// A ball carved like agate; splats alone.
        Relief = "relief",
        /// A ball of radius 1, as splats or triangles.
        Sphere = "sphere",
        /// A flat board of splats one unit apart: as many as fit a square of the number that is asked for.
        Checkerboard = "checkerboard",
    }
}

impl BuiltIn {
    /// How many splats it has where no number is given.
    pub fn default_splats(self) -> u64 {
        let splats = match self {
            Self::Relief => DEFAULT_RELIEF_SPLATS,
            Self::Sphere => DEFAULT_SPHERE_SPLATS,
            Self::Checkerboard => 10_000,
        };
        splats as u64
    }

    /// Whether it can be made of triangles.
    pub fn has_triangles(self) -> bool {
        self == Self::Sphere
    }
}

/// The most splats of a built-in model: their numbers are kept in 32 bits.
pub const MOST_BUILT_IN_SPLATS: u64 = u32::MAX as u64;

/// As what an object is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Representation {
    /// Splats, or a mesh as what shows it best: [`crate::geometry::Fitness`] has the rule.
    #[default]
    Auto,
    /// Splats; a mesh becomes disks.
    Splats,
    /// The triangles of a mesh.
    Mesh,
    /// Triangles of a mesh, splats in place of the others, with a smooth transition.
    Hybrid {
        /// Which stay triangles; else the view decides: where splats would be larger than levels of detail may be.
        polygons: Option<Polygons>,
        /// Splats are centered on the edges where both meet, as a smooth transition needs it.
        sample_edges: bool,
    },
}

/// Which triangles of a mesh stay polygons, in the mesh's own coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Polygons {
    /// Triangles whose middle (the mean of the corners) `x` has `normal · x ≥ d`.
    Plane {
        /// The plane's normal, of any length above 0.
        normal: DVec3,
        /// In the normal's length times the model's unit.
        d: f64,
    },
    /// Triangles with an edge longer than that, in the model's unit.
    LongerThan(f64),
}

/// New splats, spread evenly over a mesh's area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Samples {
    /// How many: 1 to 2³² − 1.
    pub count: u64,
    /// Which: the same seed gives the same splats.
    pub seed: u64,
}

impl ObjectDescription {
    /// A file as it is.
    pub fn of_file(path: impl Into<PathBuf>) -> Self {
        Self::of(Source::File(path.into()))
    }

    /// A built-in model with its usual number of splats.
    pub fn of_built_in(model: BuiltIn) -> Self {
        let triangles = crate::load::builtin::DEFAULT_SPHERE_TRIANGLES;
        Self::of(Source::BuiltIn { model, splats: model.default_splats(), triangles })
    }

    fn of(source: Source) -> Self {
        Self {
            source,
            name: None,
            representation: Representation::default(),
            samples: None,
            world_from_object: DAffine3::IDENTITY,
            color: None,
            alpha: 1.0,
            epsilon: None,
        }
    }
}
