//! Whether there is room for what is described.

use std::fs;

use crate::{
    error::{Error, Result},
    load::{ObjectDescription, Representation, Source, builtin::BYTES_PER_SPLAT},
};

/// The bytes of a splat that was taken from a mesh's surface, with what finds its neighbors.
const BYTES_PER_SAMPLE: u64 = 76;

/// The bytes of a triangle of the built-in ball with its share of the vertices, while its surface is looked at.
const BYTES_PER_TRIANGLE: u64 = 100;

/// Asks for the memory of all objects at once, before any is made: a few lines may describe more than a machine has, and
/// systems refuse what they can't have as a whole, but not its parts one after the other. A file counts with its size.
///
/// # Errors
/// [`crate::ErrorKind::Option`], with the number of bytes.
pub fn check_memory(objects: &[ObjectDescription]) -> Result<()> {
    let total = objects.iter().map(bytes).fold(0, u64::saturating_add);
    let room = usize::try_from(total).is_ok_and(|total| Vec::<u8>::new().try_reserve_exact(total).is_ok());
    match room {
        true => Ok(()),
        false => {
            let problem = format!("no memory for the {} described ({total} bytes)", objects.len());
            Err(Error::option("objects", problem))
        }
    }
}

fn bytes(object: &ObjectDescription) -> u64 {
    let own = match &object.source {
        Source::File(path) => fs::metadata(path).map_or(0, |metadata| metadata.len()),
        Source::BuiltIn { splats, triangles, .. } => match object.representation {
            Representation::Splats | Representation::Auto => splats.saturating_mul(BYTES_PER_SPLAT as u64),
            Representation::Mesh => triangles.saturating_mul(BYTES_PER_TRIANGLE),
            Representation::Hybrid { .. } => {
                let splats = splats.saturating_mul(BYTES_PER_SAMPLE);
                splats.saturating_add(triangles.saturating_mul(BYTES_PER_TRIANGLE))
            }
        },
    };
    let samples = object.samples.map_or(0, |samples| samples.count);
    own.saturating_add(samples.saturating_mul(BYTES_PER_SAMPLE))
}
