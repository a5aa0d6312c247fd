//! What is rendered, as plain data: splats, meshes, camera, settings. Nothing here knows a device or a file.
//!
//! **World space** is the file's: any unit, `f64` positions (scans come in UTM metres), right-handed.
//! **View space** has the eye at the origin, x to the right, y down, z forward. The image plane is `z = 1`.

mod bounds;
mod camera;
mod mesh;
mod settings;
mod splats;

pub use bounds::{Ball, Bounds};
pub use camera::{Camera, ViewFromWorld};
pub use mesh::{Mesh, MeshColors};
pub use settings::{Accumulate, Backfaces, Epsilon, Filter, Kernel, Settings, Shading};
pub use splats::{Colors, Defect, DefectCounts, Shapes, Splats};

/// One thing in a scene: splats and how they are to be treated.
#[derive(Clone, Debug)]
pub struct Object {
    /// Shown in messages: the file's name, or that of the built-in model.
    pub name: String,
    /// The surface.
    pub splats: Splats,
    /// The splats sample a closed, consistently outward-oriented surface, so that those which face away can't be
    /// seen: [`Backfaces::Auto`] then culls them.
    pub closed: bool,
}

/// All that is rendered together.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// In the order in which they are drawn; the image does not depend on it but for rounding.
    pub objects: Vec<Object>,
}

impl Scene {
    /// How many splats all objects have together.
    pub fn splat_count(&self) -> usize {
        self.objects.iter().map(|object| object.splats.len()).sum()
    }

    /// The box around all disks; `None` where there is no splat.
    pub fn bounds(&self) -> Option<Bounds> {
        self.objects.iter().filter_map(|object| object.splats.bounds()).reduce(Bounds::union)
    }

    /// A ball around all disks, about the middle of their box; `None` where there is no splat.
    pub fn bounding_ball(&self) -> Option<Ball> {
        let center = self.bounds()?.center();
        let radii = self.objects.iter().map(|object| object.splats.radius_around(center));
        Some(Ball { center, radius: radii.fold(0.0, f64::max) })
    }
}
