//! What can be wrong with a glTF file's meshes, before memory is taken for them.
//!
//! Many nodes may have one mesh, and many primitives one accessor: a small file can ask for more than the memory has.

use std::collections::HashSet;

use super::{
    buffers::Buffers,
    document::Document,
    nodes::Placed,
    primitive::{Mode, base_color, corners, shared, vertices},
};
use crate::{error::Result, load::Input};

/// About how many bytes a vertex takes.
const VERTEX_BYTES: u64 = 52;

/// About how many bytes a corner takes.
const CORNER_BYTES: u64 = 12;

/// How many bytes the meshes of all nodes may take, however small the file is; and for each byte of the file, which is the
/// same mesh about sixty times.
const MOST_BYTES: u64 = 32 << 20;
const MOST_BYTES_A_BYTE: u64 = 64;

/// Refuses meshes that can't be built, or that are too large when all nodes have theirs.
pub(super) fn check(
    input: &Input<'_>,
    document: &Document<'_>,
    buffers: &mut Buffers<'_>,
    placed: &[Placed],
) -> Result<()> {
    let count = |i: u32| document.accessors.get(i as usize).map_or(0, |accessor| accessor.count);
    let mut sizes: Vec<Option<[u64; 2]>> = (0..document.meshes.len()).map(|_| None).collect();
    let (mut all_vertices, mut all_bytes) = (0_u64, 0_u64);
    for placed in placed {
        let Some((mesh, size)) = document.meshes.get(placed.mesh).zip(sizes.get_mut(placed.mesh)) else {
            continue;
        };
        let [vertices, bytes] = *size.get_or_insert_with(|| {
            let mut seen = HashSet::new();
            let (mut vertices, mut corners) = (0_u64, 0_u64);
            for primitive in mesh.primitives.iter() {
                let own = primitive.attributes.position.map_or(0, count);
                corners = corners.saturating_add(primitive.indices.map_or(own, count));
                if seen.insert(shared(primitive)) {
                    vertices = vertices.saturating_add(own);
                }
            }
            let bytes =
                vertices.saturating_mul(VERTEX_BYTES).saturating_add(corners.saturating_mul(CORNER_BYTES));
            [vertices, bytes]
        });
        all_vertices = all_vertices.saturating_add(vertices);
        all_bytes = all_bytes.saturating_add(bytes);
    }
    input.options.limits.check_points(input, all_vertices)?;
    let of_buffers =
        document.buffers.iter().fold(0_u64, |sum, buffer| sum.saturating_add(buffer.byte_length));
    let file = of_buffers.saturating_add(input.bytes.len() as u64);
    let most = file.saturating_mul(MOST_BYTES_A_BYTE).saturating_add(MOST_BYTES);
    if all_bytes > most {
        let problem = format!(
            "{all_vertices} vertices in all nodes together, about {all_bytes} bytes; expected at most {most}, 64 for each byte of the file"
        );
        return Err(input.fault("", problem));
    }
    for (mesh, size) in document.meshes.iter().zip(&sizes) {
        // A mesh that no node has is not read.
        let primitives = mesh.primitives.iter().filter(|_| size.is_some());
        for primitive in primitives {
            Mode::of(input, primitive)?;
            base_color(input, document, primitive)?;
            if let Some(vertices) = vertices(input, document, buffers, primitive)? {
                corners(input, document, buffers, primitive, vertices.positions.count)?;
            }
        }
    }
    Ok(())
}
