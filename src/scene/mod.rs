//! The scene and its settings, as plain data: splats, meshes, camera, settings. Nothing here knows a device or a file.
//!
//! **World space** is the file's: any unit, `f64` positions (scans come in UTM metres), right-handed.
//! **View space** has the eye at the origin, x to the right, y down, z forward. The image plane is `z = 1`.

mod bounds;
mod budget;
mod camera;
mod camera_parts;
#[cfg_attr(not(feature = "inside"), allow(dead_code, reason = "a part of it is the program's"))]
mod camera_view;
#[cfg_attr(not(feature = "inside"), allow(dead_code, reason = "a part of it is the program's"))]
mod clip;
mod clip_planes;
mod colors;
#[cfg_attr(not(feature = "inside"), allow(dead_code, reason = "a part of it is the program's"))]
mod crop;
mod encoding;
mod gather;
mod host_camera;
mod hybrid;
mod kept;
mod layers;
mod lengths;
mod level_settings;
mod levels;
mod light;
mod lod;
mod lod_steps;
mod mesh;
mod methods;
mod opacity;
#[cfg_attr(not(feature = "inside"), allow(dead_code, reason = "a part of it is the program's"))]
mod option;
mod outlines;
#[cfg_attr(not(feature = "inside"), allow(dead_code, reason = "a part of it is the program's"))]
mod path;
mod placement;
mod points;
mod refusals;
mod room;
mod samples;
#[cfg_attr(not(feature = "inside"), allow(dead_code, reason = "a part of it is the program's"))]
mod settings;
mod splats;
mod storage;
mod tile_memory;
#[cfg_attr(not(feature = "inside"), allow(dead_code, reason = "a part of it is the program's"))]
mod transform;
mod values;
mod window;

pub use bounds::{Ball, Bounds};
pub use budget::Budget;
pub use camera::{Camera, ViewFromWorld};
pub use camera_parts::{CameraParts, PictureHeight};
pub use clip::{Clip, ClipCurve, Clips};
pub use clip_planes::{ClipBox, ClipPlanes, MOST_PLANES};
pub use colors::{Colors, UNKNOWN_SRGB};
pub use encoding::{Encoding, Stops, Tonemap};
pub use host_camera::{DepthOfHost, HostCamera};
pub use hybrid::{HybridLevels, PolygonCell};
pub use layers::{Layers, MOST_LAYERS};
pub use levels::{ErrorBall, LeveledObject, NodeBalls};
pub use light::{Light, LightKind, MOST_LIGHTS};
pub use lod::Lod;
pub use lod_steps::LodSteps;
pub use mesh::Mesh;
pub use methods::{
    Accumulate, Backfaces, Cull, Edges, Filter, FilterWeight, KernelEval, LastLayer, Rasterizer, Shading,
    TileInvocations, Transition,
};
pub use opacity::Opacity;
#[cfg(feature = "files")]
pub(crate) use option::named;
pub use outlines::Outlines;
pub use placement::Placement;
pub use points::{Points, Viewpoint};
pub use room::Room;
pub use samples::{MOST_SAMPLES, Samples};
pub use settings::Settings;
pub use splats::{Defect, DefectCounts, Shapes, Splats};
pub use storage::{Order, SplatFormat, Storage};
pub use tile_memory::TileMemory;
#[cfg(feature = "files")]
pub(crate) use transform::is_similarity;
pub use values::{Epsilon, Kernel};
pub use window::Window;

/// What the program reads and says, and no host needs: public by the feature `inside` alone.
macro_rules! inside {
    ($($path:ident::{$($name:ident),*};)*) => {$(
        #[cfg(feature = "inside")]
        pub use $path::{$($name),*};
        #[cfg(not(feature = "inside"))]
        #[allow(unused_imports, reason = "a part of it is the program's")]
        pub(crate) use $path::{$($name),*};
    )*};
}

inside! {
    camera_view::{AXES, View, toward_eye};
    clip::{ClipTest};
    crop::{Crop, CropView};
    methods::{Floors};
    option::{Choice, OptionTable, OptionValue, Setting};
    path::{CameraPath, Interpolation};
    settings::{with_each};
    transform::{is_invertible};
    window::{LARGEST_WHOLE_PX};
}

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

/// A thing in a scene that is drawn as triangles.
#[derive(Clone, Debug)]
pub struct MeshObject {
    /// Shown in messages: the file's name, or that of the built-in model.
    pub name: String,
    /// The surface. Its normals are there, one a vertex, unit or zero, on the side from which its triangles are
    /// counterclockwise: [`crate::geometry::shaded_mesh`] makes a file's mesh so.
    pub mesh: Mesh,
    /// The surface is closed and its triangles are counterclockwise seen from outside: if it is opaque,
    /// [`Backfaces::Auto`] culls those that face away.
    pub closed: bool,
}

/// The things that are rendered together.
///
/// ```
/// use surfel::{Scene, glam::{DVec3, Vec3}, scene::{Colors, Object, Shapes, Splats}};
///
/// let shapes = Shapes::Disks { normals: vec![Vec3::Z], radii: vec![0.5] };
/// let splats = Splats::new(vec![DVec3::ZERO], shapes, Colors::Uniform([0.2, 0.4, 0.9, 1.0]));
/// let scene = Scene::from(Object { name: "a disk".to_owned(), splats, closed: false });
/// assert_eq!(scene.objects[0].splats.positions.len(), 1);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Splats, in the order in which they are drawn; the image does not depend on it but for rounding.
    pub objects: Vec<Object>,
    /// Triangles.
    pub meshes: Vec<MeshObject>,
    /// None: [`Light::DEFAULT`]. At most [`MOST_LIGHTS`].
    pub lights: Vec<Light>,
    /// How the splats are kept on a device.
    pub storage: Storage,
    /// The ε of objects of splats that have one of their own, by their place in [`Self::objects`]; others, and those beyond its end, have
    /// [`Settings::epsilon`].
    pub epsilons: Vec<Option<Epsilon>>,
    /// No frame asks for [`Epsilon::Auto`] of objects that have no ε of their own: nothing is looked for near their splats when the scene is
    /// prepared.
    pub without_auto_epsilon: bool,
    /// Objects of splats get levels of detail when the scene is prepared: [`Settings::lod`] then has something to choose from.
    pub levels: bool,
    /// Frames of it may have a [`Settings::budget`]: for each node of levels of detail the host keeps 40 bytes.
    pub budget: bool,
    /// For [`crate::renderer::Renderer::plan_pick`]: for each splat and triangle the host keeps 4 bytes, its number in its object, when the scene is
    /// prepared.
    pub numbered: bool,
    /// For [`crate::renderer::Renderer::update`]: for each splat the host keeps what the device has of it, 40 bytes of a disk and 56 of an ellipse, and 8 of where that is.
    /// Each has a color of its own on the device. Not for levels of detail, nor for [`SplatFormat::Packed`].
    pub updatable: bool,
    /// Of objects of splats of an updatable scene, by their place in [`Self::objects`], room for splats that come later; others, and those beyond its end, have none.
    pub rooms: Vec<Option<Room>>,
    /// Splats that have their levels of detail already, drawn behind [`Self::objects`].
    pub leveled: Vec<LeveledObject>,
    /// Levels of detail of meshes, at most one of each.
    pub hybrids: Vec<HybridLevels>,
}

/// A scene of one object of splats.
impl From<Object> for Scene {
    fn from(object: Object) -> Self {
        Self { objects: vec![object], ..Self::default() }
    }
}

impl Scene {
    /// Whether something in it came with its levels of detail.
    pub fn has_levels(&self) -> bool {
        !self.leveled.is_empty() || !self.hybrids.is_empty()
    }

    /// How many splats all objects have together, those without levels of detail.
    pub fn splat_count(&self) -> usize {
        self.objects.iter().map(|object| object.splats.len()).sum()
    }

    /// The ε of an object of splats in a frame with these settings.
    pub fn epsilon(&self, object: usize, settings: &Settings) -> Epsilon {
        self.own_epsilon(object).unwrap_or(settings.epsilon)
    }

    /// The ε that an object of splats has of its own.
    pub fn own_epsilon(&self, object: usize) -> Option<Epsilon> {
        self.epsilons.get(object).copied().flatten()
    }

    /// The box around all disks and triangles; `None` where there is neither.
    pub fn bounds(&self) -> Option<Bounds> {
        let disks = self.objects.iter().filter_map(|object| object.splats.bounds());
        disks.chain(self.meshes.iter().filter_map(|object| object.mesh.bounds())).reduce(Bounds::union)
    }

    /// The smallest ball around all disks and triangles that has its center in the middle of [`Scene::bounds`]: less
    /// than the ball around that box, for a round thing by √3. `None` where there is neither.
    pub fn ball(&self) -> Option<Ball> {
        self.ball_of(&|_| true)
    }

    /// As [`Scene::ball`], of the objects and meshes of this name; `None` where there is none.
    pub fn ball_named(&self, name: &str) -> Option<Ball> {
        self.ball_of(&|own| own == name)
    }

    fn ball_of(&self, is_meant: &dyn Fn(&str) -> bool) -> Option<Ball> {
        let objects = || self.objects.iter().filter(|object| is_meant(&object.name));
        let meshes = || self.meshes.iter().filter(|object| is_meant(&object.name));
        let disks = objects().filter_map(|object| object.splats.bounds());
        let bounds = disks.chain(meshes().filter_map(|object| object.mesh.bounds())).reduce(Bounds::union)?;
        let center = bounds.center();
        let reach = |splats: &Splats| {
            let drawn = (0..splats.len()).filter(|&i| splats.defect(i).is_none());
            drawn.map(|i| splats.reach_from(i, center)).fold(0.0, f64::max)
        };
        let reach_of_triangles = |mesh: &Mesh| {
            let corners = (0..mesh.triangles.len()).filter_map(|i| mesh.corners(i)).flatten();
            corners.map(|corner| corner.distance(center)).fold(0.0, f64::max)
        };
        let disks = objects().map(|object| reach(&object.splats)).fold(0.0, f64::max);
        let radius = meshes().map(|object| reach_of_triangles(&object.mesh)).fold(disks, f64::max);
        Some(Ball { center, radius })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Vec3};

    #[test]
    fn the_ball_holds_every_disk_that_can_be_drawn_and_touches_one() {
        let disks = |centers: &[[f64; 3]], radius: f32| Object {
            name: String::new(),
            closed: false,
            splats: Splats::new(
                centers.iter().map(|center| DVec3::from(*center)).collect(),
                Shapes::Disks { normals: vec![Vec3::Z; centers.len()], radii: vec![radius; centers.len()] },
                Colors::Uniform([1.0; 4]),
            ),
        };
        let ends = [[2.0, 0.0, 0.0], [-2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, -2.0, 0.0]];
        let defective = disks(&[[f64::NAN, 0.0, 0.0], [9.0, f64::INFINITY, 0.0]], 1.0);
        let scene = Scene {
            objects: vec![disks(&ends, 0.5), defective, disks(&[[0.0; 3]], 0.5)],
            ..Scene::default()
        };
        assert_eq!(scene.ball(), Some(Ball { center: DVec3::ZERO, radius: 2.5 }));
        assert!(scene.bounds().unwrap().radius() > 3.5);
        assert_eq!(Scene::default().ball(), None);
    }
}
