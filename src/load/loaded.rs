//! What a file held, and what was done with it on the way in.

use glam::DVec3;

use super::fans::Fan;
use crate::{
    notes::{Deed, Note},
    scene::{Mesh, Points, Splats},
};

/// A file, read.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// Its contents.
    pub model: Model,
    /// Its format in words, such as `PLY, binary, little endian`.
    pub format: String,
    /// The direction that is up, where the file or its format tells one.
    pub up: Option<DVec3>,
    /// How long its unit is in metres, where the file or its format tells it.
    pub metres_per_unit: Option<f64>,
    /// What was done with what the file has, one a kind.
    pub notes: Vec<Note>,
    /// Polygons of a mesh that are cut as fans.
    pub(super) fans: Vec<Fan>,
}

impl Loaded {
    /// A model of which the file tells nothing else.
    pub(super) fn new(model: Model, format: impl Into<String>) -> Self {
        Self {
            model,
            format: format.into(),
            up: None,
            metres_per_unit: None,
            notes: Vec::new(),
            fans: Vec::new(),
        }
    }

    /// Adds a note where there is something to note.
    pub(super) fn note(&mut self, deed: Deed, count: u64, what: impl Into<String>) {
        if count > 0 {
            self.notes.push(Note { deed, count, what: what.into() });
        }
    }
}

/// The contents of a file.
#[derive(Clone, Debug)]
pub enum Model {
    /// Disks, ready to be drawn once [`Splats::drop_defective`] was called.
    Splats {
        /// The disks.
        splats: Splats,
        /// The file says that they sample a closed surface and that their normals point outward, as
        /// [`crate::scene::Object::closed`] wants it.
        closed: bool,
    },
    /// Triangles; [`crate::geometry::splats_from_mesh`] makes splats of them.
    Mesh(Mesh),
    /// Points that lack normals, radii or both; [`crate::geometry::splats_from_points`] makes splats of them.
    Points(Points),
}

impl Model {
    /// What a file of this holds, in the plural, for messages.
    pub fn contents(&self) -> &'static str {
        match self {
            Self::Splats { .. } => "splats",
            Self::Mesh(_) => "triangles",
            Self::Points(_) => "points",
        }
    }
}
