//! The inputs on the command line, and how they are to be taken.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use surfel::load::{Columns, LoadOptions, Representation, Samples};

use crate::parse;

/// The manual of inputs.
pub const INPUTS: &str = "Inputs are models (PLY, OBJ, glTF and GLB, STL, OFF), scans (PLY, LAS, LAZ, COPC, E57, PCD; XYZ, PTS, CSV and other rows of numbers), all of them also compressed by gzip or zstd, octrees of points (COPC, and Potree 2 by its metadata.json; \
`surfel render` reads the nodes that the view needs for --lod, all of them for --lod 0; others read all), `-` for standard input, and scene files (.toml: objects, each \
with its place and looks, lights and a camera; `surfel render --help` has their keys). A mesh is drawn as what shows it best: as \
disks at its vertices where it is dense or smooth, as disks spread evenly over it where its vertices are too uneven for that, and as its triangles \
where it is coarse, as furniture and machine parts are; --representation decides it otherwise. Points become disks that close their \
surface, with normals from their neighbors. Several inputs are one scene; none is the built-in model. A line each says what was \
done. Lengths are in the files' own unit. The camera looks at the whole scene unless told otherwise.";

/// The inputs.
#[derive(Args)]
pub struct InputArguments {
    /// Models, scans or scene files (.toml), - for standard input; none is the built-in model
    #[arg(value_name = "INPUT")]
    pub inputs: Vec<PathBuf>,

    /// The primitives of inputs that are no scene files
    #[arg(long, value_name = "WHAT", default_value = "auto")]
    representation: Primitives,

    /// Draw meshes that are no scene files as that many disks, spread evenly over their area; 500k or 1.4M will do
    #[arg(long, value_name = "N", value_parser = parse::splats, allow_hyphen_values = true)]
    resample: Option<u64>,

    /// Which disks --resample takes [default: 0]
    #[arg(long, value_name = "S", requires = "resample")]
    #[arg(value_parser = parse::whole::<u64>(0..=u64::MAX), allow_hyphen_values = true)]
    seed: Option<u64>,

    #[command(flatten)]
    reading: ReadingArguments,
}

/// How files are read.
#[derive(Args)]
pub struct ReadingArguments {
    /// Fail where anything of a file is left out, merged, replaced, clamped or ignored
    #[arg(long)]
    pub strict: bool,

    /// The columns of rows of numbers, such as x,y,z,-,r,g,b; all: x y z r g b nx ny nz i (intensity) and - [default: as the file tells]
    #[arg(long, value_name = "LIST", value_parser = parse::columns, allow_hyphen_values = true)]
    columns: Option<Columns>,

    /// Scene files and models may name files outside of their folder
    #[arg(long)]
    allow_outside: bool,
}

impl ReadingArguments {
    /// The options as they were given.
    pub fn options(&self) -> LoadOptions {
        LoadOptions {
            allow_outside: self.allow_outside,
            columns: self.columns.clone(),
            ..LoadOptions::default()
        }
    }
}

/// The primitives of an input.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Primitives {
    /// What shows a mesh best: splats or its triangles
    Auto,
    /// Splats; a mesh with a disk at each vertex
    Splats,
    /// The triangles of a mesh
    Mesh,
    /// The triangles of a mesh where its splats would be larger on the screen than --lod, else splats
    Hybrid,
}

/// Files, and how they are to be taken.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    /// None: the built-in model.
    pub files: Vec<PathBuf>,
    /// As what files that are no scene files are drawn.
    pub representation: Representation,
    /// New splats of meshes that are no scene files.
    pub samples: Option<Samples>,
    /// Options that the user gave, and that mean nothing for scene files.
    pub not_for_scene_files: Vec<&'static str>,
    /// How files are read.
    pub options: LoadOptions,
    /// Fail where anything of a file is not drawn as it says.
    pub strict: bool,
}

impl Inputs {
    /// Files as splats, a mesh with a disk at each vertex: what methods of splats are measured on.
    pub fn splats_of(files: Vec<PathBuf>) -> Self {
        Self { files, representation: Representation::Splats, ..Self::default() }
    }
}

impl InputArguments {
    /// The inputs as they were given.
    pub fn inputs(&self) -> Inputs {
        Inputs {
            files: self.inputs.clone(),
            representation: match self.representation {
                Primitives::Auto => Representation::Auto,
                Primitives::Splats => Representation::Splats,
                Primitives::Mesh => Representation::Mesh,
                Primitives::Hybrid => Representation::Hybrid { polygons: None, sample_edges: true },
            },
            samples: self.resample.map(|count| Samples { count, seed: self.seed.unwrap_or(0) }),
            not_for_scene_files: self.not_for_scene_files(),
            options: self.reading.options(),
            strict: self.reading.strict,
        }
    }

    /// The inputs for what compares methods of splats: `auto` is splats, whatever a mesh is.
    pub fn as_splats(&self) -> Inputs {
        let inputs = self.inputs();
        match inputs.representation {
            Representation::Auto => Inputs { representation: Representation::Splats, ..inputs },
            _ => inputs,
        }
    }

    /// Whether an option says something of inputs.
    pub fn has_options(&self) -> bool {
        self.representation != Primitives::Auto
            || self.resample.is_some()
            || self.reading.strict
            || self.reading.columns.is_some()
            || self.reading.allow_outside
    }

    /// The options that were given and of which scene files have keys of their own.
    fn not_for_scene_files(&self) -> Vec<&'static str> {
        let given = [
            ("--representation", self.representation != Primitives::Auto),
            ("--resample", self.resample.is_some()),
        ];
        given.into_iter().filter(|(_, is_given)| *is_given).map(|(option, _)| option).collect()
    }
}
