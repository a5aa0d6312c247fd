//! What becomes of a model.

use std::ffi::{c_char, c_void};

use surfel::ash::vk;

use crate::structs::{Struct, SurfelStructureType};

/// Splats, or of a mesh what shows it best: triangles where splats would have to be too large, or too many.
pub const SURFEL_REPRESENTATION_AUTO: u32 = 0;
/// Splats.
pub const SURFEL_REPRESENTATION_SPLATS: u32 = 1;
/// The triangles of a mesh.
pub const SURFEL_REPRESENTATION_MESH: u32 = 2;
/// Triangles of a mesh, and splats in place of the others.
pub const SURFEL_REPRESENTATION_HYBRID: u32 = 3;

/// The view decides, cell by cell: triangles where splats would be larger than levels of detail may be.
pub const SURFEL_POLYGONS_BY_VIEW: u32 = 0;
/// Triangles stay whose middle is not behind `plane`.
pub const SURFEL_POLYGONS_PLANE: u32 = 1;
/// Triangles stay that have an edge longer than `longerThan`.
pub const SURFEL_POLYGONS_LONGER_THAN: u32 = 2;

/// What becomes of a model: how it is placed, colored, and as what it is drawn; as an object of a scene file is described.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SurfelDescription {
    /// `SURFEL_STRUCTURE_TYPE_DESCRIPTION`.
    pub s_type: u32,
    /// `sizeof(SurfelDescription)`.
    pub size: u32,
    /// NULL.
    pub p_next: *const c_void,
    /// Its name, as UTF-8; NULL: that of its file, mesh or points.
    pub name: *const c_char,
    /// A matrix of four columns, from its own coordinates to the scene's: affine, and one that can be undone. NULL: it stays where it is.
    pub world_from_object: *const f64,
    /// So many new splats, spread over the surface of a mesh, or over the part of it that is drawn as splats, up to `UINT32_MAX`; 0: one at each
    /// vertex, or as many as that is.
    pub samples: u64,
    /// Which: the same seed gives the same splats.
    pub seed: u64,
    /// As what it is drawn: `SURFEL_REPRESENTATION_*`.
    pub representation: u32,
    /// Of `SURFEL_REPRESENTATION_HYBRID`, which triangles stay: `SURFEL_POLYGONS_*`.
    pub polygons: u32,
    /// The plane's normal, of any length, and d: triangles stay whose middle x has normal · x ≥ d, in the model's own coordinates.
    pub plane: [f64; 4],
    /// A length in the model's own unit.
    pub longer_than: f64,
    /// No splats are centered on the edges where triangles and splats meet.
    pub without_sampled_edges: vk::Bool32,
    /// `color` is there.
    pub has_color: vk::Bool32,
    /// Replaces its own colors: linear red, green and blue, 0 to 1.
    pub color: [f32; 3],
    /// Multiplies its own alpha, 0 to 1; 0 is 1.
    pub alpha: f32,
    /// The ε of its splats, as in `SurfelSplats`.
    pub epsilon: f64,
    /// The same in mean radii.
    pub epsilon_in_radii: f64,
    /// The same as `auto`.
    pub auto_epsilon: vk::Bool32,
    /// 0; else it is refused.
    pub reserved: u32,
}

// SAFETY: it begins so, and a test looks for padding.
unsafe impl Struct for SurfelDescription {
    const TYPE: SurfelStructureType = SurfelStructureType::Description;

    fn reserved(&self) -> u32 {
        self.reserved
    }
}

#[cfg(feature = "files")]
pub use described::{built, described};

#[cfg(feature = "files")]
mod described {
    use std::path::Path;

    use surfel::{
        Error, Scene,
        compose::BuiltObject,
        glam::{DAffine3, DVec3},
        load::{ObjectDescription, Polygons, Representation, Samples},
        scene::{Epsilon, HybridLevels},
    };

    use super::*;
    use crate::{
        handle::text,
        result::{Failure, Result},
        scene::{affine, epsilon_of},
        structs::read,
    };

    /// What C says of a model that is called so in messages.
    ///
    /// # Safety
    /// `given` is NULL or leads to as much as it says.
    pub unsafe fn described(given: *const SurfelDescription, called: &Path) -> Result<ObjectDescription> {
        let plain = ObjectDescription::of_file(called);
        if given.is_null() {
            return Ok(plain);
        }
        // SAFETY: this function's contract.
        let given = unsafe { read(given, "description") }?;
        let refused = |name: &str, problem: String| -> Failure { Error::option(name, problem).into() };
        if given.samples > u64::from(u32::MAX) {
            return Err(refused("samples", format!("{}: expected at most {}", given.samples, u32::MAX)));
        }
        let is_part = |part: f32| (0.0..=1.0).contains(&part);
        if !is_part(given.alpha) {
            return Err(refused("alpha", format!("{}: expected 0 to 1", given.alpha)));
        }
        let color = (given.has_color != vk::FALSE).then_some(given.color);
        if !color.iter().flatten().all(|part| is_part(*part)) {
            return Err(refused("color", format!("{:?}: expected 0 to 1", given.color)));
        }
        let samples = Samples { count: given.samples, seed: given.seed };
        Ok(ObjectDescription {
            name: match given.name.is_null() {
                true => None,
                // SAFETY: this function's contract.
                false => Some(unsafe { text(given.name, "name") }?.to_owned()),
            },
            representation: representation(&given)?,
            samples: (given.samples > 0).then_some(samples),
            world_from_object: match given.world_from_object.is_null() {
                true => DAffine3::IDENTITY,
                // SAFETY: this function's contract.
                false => unsafe { affine(given.world_from_object) }?,
            },
            color,
            alpha: if given.alpha == 0.0 { 1.0 } else { given.alpha },
            epsilon: epsilon_of((given.auto_epsilon != vk::FALSE, [given.epsilon, given.epsilon_in_radii]))?,
            ..plain
        })
    }

    fn representation(given: &SurfelDescription) -> Result<Representation> {
        let invalid =
            |name: &str, value: u32| Failure::invalid(format!("{name} is {value}: expected a known one"));
        match given.representation {
            SURFEL_REPRESENTATION_AUTO => Ok(Representation::Auto),
            SURFEL_REPRESENTATION_SPLATS => Ok(Representation::Splats),
            SURFEL_REPRESENTATION_MESH => Ok(Representation::Mesh),
            SURFEL_REPRESENTATION_HYBRID => {
                let [x, y, z, d] = given.plane;
                let normal = DVec3::new(x, y, z);
                let polygons = match given.polygons {
                    SURFEL_POLYGONS_BY_VIEW => None,
                    SURFEL_POLYGONS_PLANE if normal.try_normalize().is_some() && d.is_finite() => {
                        Some(Polygons::Plane { normal, d })
                    }
                    SURFEL_POLYGONS_LONGER_THAN if given.longer_than >= 0.0 => {
                        Some(Polygons::LongerThan(given.longer_than))
                    }
                    SURFEL_POLYGONS_PLANE => {
                        let problem = format!("{:?}: expected a normal that is not zero, and d", given.plane);
                        return Err(Error::option("plane", problem).into());
                    }
                    SURFEL_POLYGONS_LONGER_THAN => {
                        let problem = format!("{}: expected a length", given.longer_than);
                        return Err(Error::option("longerThan", problem).into());
                    }
                    other => return Err(invalid("polygons", other)),
                };
                let sample_edges = given.without_sampled_edges == vk::FALSE;
                Ok(Representation::Hybrid { polygons, sample_edges })
            }
            other => Err(invalid("representation", other)),
        }
    }

    /// Puts what was made of a model into a scene.
    pub fn built(scene: &mut Scene, made: BuiltObject, epsilon: Option<Epsilon>) {
        if let Some(object) = made.splats {
            scene.epsilons.resize(scene.objects.len(), None);
            scene.epsilons.push(epsilon);
            scene.objects.push(object);
        }
        let levels = made.levels.map(|levels| HybridLevels { mesh: scene.meshes.len(), ..levels });
        scene.hybrids.extend(levels);
        scene.meshes.extend(made.triangles);
    }
}
