//! A piece of a mesh within the device's limits.
//!
//! Vertices, 32 bytes: `position 0`, `normal 0`, in local space, f32, as disks have them. Colors as splats have them.
//! Indices, 32 bits.

use std::ops::Range;

use ash::vk;
use glam::Vec3;

use super::{
    memory::{ChunkMemory, Uploader},
    mesh_levels::{CellWords, MeshLevels},
    pack::packed_color,
    rebase::Rebase,
    sites::HOME,
};
use crate::{
    error::Result,
    scene::{Colors, Mesh},
};

/// The most bytes that are uploaded at once.
const BATCH_BYTES: usize = 1 << 22;

/// Triangles of one object in buffers of their own.
pub struct MeshChunk {
    /// The number of its object in [`super::PreparedScene::objects`].
    pub object: usize,
    /// The numbers of its triangles in the object, where they are kept.
    pub(super) numbers: Option<Vec<u32>>,
    /// Its local space.
    pub(crate) rebase: Rebase,
    /// How many triangles.
    pub(crate) triangles: u32,
    /// How many vertices.
    pub(crate) vertices: u32,
    /// They belong to a closed surface whose triangles are counterclockwise seen from outside.
    pub(crate) closed: bool,
    /// Some of the object is transparent.
    pub(crate) transparent: bool,
    /// One color for all.
    pub(crate) uniform_color: bool,
    /// The largest coordinate of a corner, local space.
    pub(crate) farthest: f64,
    /// How long edges are in the mean, world space.
    mean_edge: f64,
    /// The longest edge, world space.
    pub(crate) longest_edge: f64,
    /// Its cells, if it is drawn cell by cell.
    pub(crate) levels: Option<MeshLevels>,
    /// Vertices, colors, indices, cells, but where a frame is only listed.
    memory: Option<ChunkMemory>,
}

/// A piece of a mesh as bytes for the device.
pub(super) struct PackedMesh {
    rebase: Rebase,
    vertices: Vec<[f32; 4]>,
    colors: Vec<[u16; 4]>,
    indices: Vec<[u32; 3]>,
    /// The numbers of its triangles in the mesh.
    pub numbers: Vec<u32>,
}

impl PackedMesh {
    /// The triangles of a range of a mesh that can be drawn. Where one color is for all, it is packed once.
    fn of(mesh: &Mesh, range: Range<usize>, rebase: Rebase) -> Self {
        let uniform = match mesh.colors {
            Colors::Each(_) => None,
            Colors::Uniform(color) => Some(color),
        };
        let mut packed = Self {
            rebase,
            vertices: Vec::new(),
            colors: uniform.map(packed_color).into_iter().collect(),
            indices: Vec::new(),
            numbers: Vec::new(),
        };
        let mut places = std::collections::HashMap::new();
        for i in range {
            let Some(corners) = mesh.corners(i).map(|corners| corners.map(|p| rebase.point(p).as_vec3()))
            else {
                continue;
            };
            // Beyond f32 from where the others are: no shader may meet an infinity.
            let usable = |vertex: u32| {
                let normal = mesh
                    .normals
                    .as_ref()
                    .is_none_or(|of| of.get(vertex as usize).is_some_and(|n| n.is_finite()));
                let color = mesh.colors.get(vertex as usize);
                normal && color.is_some_and(|color| color.iter().all(|c| c.is_finite()))
            };
            if !corners.iter().all(|corner| corner.is_finite()) || !mesh.triangles[i].into_iter().all(usable)
            {
                continue;
            }
            let mut triangle = [0; 3];
            for ((index, vertex), corner) in triangle.iter_mut().zip(mesh.triangles[i]).zip(corners) {
                *index = *places.entry(vertex).or_insert_with(|| {
                    let place = packed.vertices.len() / 2;
                    let normals = mesh.normals.as_deref().unwrap_or_default();
                    let normal = normals.get(vertex as usize).copied().unwrap_or_default();
                    packed.vertices.push(corner.extend(0.0).into());
                    packed.vertices.push(normal.extend(0.0).into());
                    if let Colors::Each(colors) = &mesh.colors {
                        let color = colors.get(vertex as usize).copied().unwrap_or_default();
                        packed.colors.push(packed_color(color));
                    }
                    u32::try_from(place).unwrap_or(u32::MAX)
                });
            }
            packed.indices.push(triangle);
            packed.numbers.push(u32::try_from(i).unwrap_or(u32::MAX));
        }
        packed
    }

    /// The pieces of a mesh, none with more vertices than `capacity`, which is at least 3.
    pub fn pieces(mesh: &Mesh, capacity: usize) -> impl Iterator<Item = Self> + '_ {
        // One local space for all pieces: a vertex that two of them share is rounded alike, so that no gap opens between.
        let corners: Vec<_> = (0..mesh.triangles.len()).filter_map(|i| mesh.corners(i)).flatten().collect();
        let rebase = Rebase::of_points(&corners);
        // A triangle brings three vertices at most.
        let triangles = (capacity / 3).max(1);
        super::pieces(0..mesh.triangles.len(), triangles).map(move |range| Self::of(mesh, range, rebase))
    }

    /// The largest coordinate of a corner, local space.
    fn farthest(&self) -> f64 {
        self.vertices.iter().step_by(2).flatten().fold(0.0, |most, x| f32::max(most, x.abs())).into()
    }

    /// The lengths of its triangles' edges, world space.
    fn edges(&self) -> impl Iterator<Item = f64> + '_ {
        let corner = |index: u32| Vec3::from_slice(&self.vertices[2 * index as usize][..3]).as_dvec3();
        let edges = self.indices.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
        edges.map(move |[a, b]| corner(a).distance(corner(b)) / self.rebase.scale)
    }

    /// Its local space.
    pub fn rebase(&self) -> &Rebase {
        &self.rebase
    }

    /// Nothing of it can be drawn.
    pub fn is_empty(&self) -> bool {
        self.indices.is_empty()
    }

    /// Buffers of device memory with all of it.
    fn upload(
        &self,
        uploader: &mut Uploader<'_>,
        number: usize,
        cells: Option<&[u32]>,
    ) -> Result<Option<ChunkMemory>> {
        let buffer = |what: &str, size: usize, usage: vk::BufferUsageFlags| {
            uploader.buffer(&format!("{what} of mesh {number}"), size as u64, usage)
        };
        let storage = vk::BufferUsageFlags::STORAGE_BUFFER;
        let mut contents: Vec<&[u8]> = vec![
            bytemuck::cast_slice(&self.vertices),
            bytemuck::cast_slice(&self.colors),
            bytemuck::cast_slice(&self.indices),
        ];
        let mut buffers = vec![
            buffer("vertices", contents[0].len(), storage)?,
            buffer("colors", contents[1].len(), storage)?,
            buffer("indices", contents[2].len(), vk::BufferUsageFlags::INDEX_BUFFER | storage)?,
        ];
        if let Some(cells) = cells {
            contents.push(bytemuck::cast_slice(cells));
            buffers.push(buffer("cells", contents[3].len(), storage)?);
        }
        let named = buffers.len();
        for (buffer, content) in buffers.iter().zip(contents) {
            for (i, batch) in content.chunks(BATCH_BYTES).enumerate() {
                let staging = uploader.staging("upload of a mesh", batch.len() as u64)?;
                let (Some(mut staging), Some(buffer)) = (staging, buffer) else { continue };
                staging.push(buffer, (i * BATCH_BYTES) as u64, batch)?;
                uploader.submit(staging)?;
            }
        }
        ChunkMemory::new(uploader, &format!("mesh {number}"), buffers, named)
    }
}

impl MeshChunk {
    /// Puts a piece of an object on the device, if there is one, with its cells; it has one triangle at least.
    pub(super) fn new(
        uploader: Option<&mut Uploader<'_>>,
        number: usize,
        (closed, transparent): (bool, bool),
        (packed, cells): (&PackedMesh, Option<CellWords>),
    ) -> Result<Self> {
        let words = cells.as_ref().map(|cells| cells.words.as_slice());
        Ok(Self {
            object: 0,
            numbers: None,
            rebase: packed.rebase,
            triangles: packed.indices.len() as u32,
            vertices: (packed.vertices.len() / 2) as u32,
            closed,
            transparent,
            uniform_color: packed.colors.len() == 1,
            farthest: packed.farthest(),
            mean_edge: packed.edges().sum::<f64>() / (3 * packed.indices.len()) as f64,
            longest_edge: packed.edges().fold(0.0, f64::max),
            memory: uploader.map(|uploader| packed.upload(uploader, number, words)).transpose()?.flatten(),
            levels: cells.map(|cells| cells.levels),
        })
    }

    /// How far a corner is rounded at most, and how long edges are in the mean, where that is too much: world space.
    pub fn rounding(&self) -> Option<[f64; 2]> {
        let farthest = self.farthest / self.rebase.scale;
        (farthest > HOME * self.mean_edge).then_some([farthest / 16_777_216.0, self.mean_edge])
    }

    /// The number in its object of a triangle of this piece, where it is kept ([`crate::scene::Scene::numbered`]).
    pub fn number_of(&self, triangle: usize) -> Option<u32> {
        self.numbers.as_ref()?.get(triangle).copied()
    }

    /// The descriptor set; null without memory.
    pub fn set(&self) -> vk::DescriptorSet {
        self.memory.as_ref().map_or(vk::DescriptorSet::null(), |memory| memory.set)
    }

    /// Three 32-bit indices a triangle; null without memory.
    pub fn indices(&self) -> vk::Buffer {
        self.memory.as_ref().map_or(vk::Buffer::null(), |memory| memory.buffers[2].raw())
    }

    /// Bytes of device memory.
    pub fn bytes(&self) -> u64 {
        self.memory.as_ref().map_or(0, ChunkMemory::bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Vec3};

    fn mesh() -> Mesh {
        let positions = vec![
            DVec3::ZERO,
            DVec3::X,
            DVec3::Y,
            DVec3::new(f64::NAN, 0.0, 0.0),
            DVec3::splat(1e300),
            DVec3::X + DVec3::Y,
        ];
        Mesh {
            normals: Some(vec![Vec3::Z; positions.len()]),
            triangles: vec![[0, 1, 2], [0, 1, 3], [0, 1, 4], [1, 5, 2], [7, 0, 1]],
            positions,
            ..Mesh::default()
        }
    }

    fn whole(mesh: &Mesh) -> PackedMesh {
        PackedMesh::pieces(mesh, 1 << 20).next().unwrap()
    }

    #[test]
    fn shared_vertices_are_kept_once_and_what_cannot_be_drawn_is_left_out() {
        let packed = whole(&mesh());
        assert_eq!(packed.indices, [[0, 1, 2], [1, 3, 2]]);
        assert_eq!((packed.vertices.len(), packed.colors.len()), (8, 1));
        assert!(packed.vertices.iter().flatten().all(|x| x.is_finite()));
    }

    #[test]
    fn what_has_no_finite_normal_or_color_at_a_corner_is_left_out() {
        let mut mesh = mesh();
        let mut normals = vec![Vec3::Z; 6];
        normals[0].x = f32::NAN;
        mesh.normals = Some(normals);
        assert_eq!(whole(&mesh).indices.len(), 1);
        let mut colors = vec![[0.5; 4]; 6];
        colors[5][1] = f32::INFINITY;
        mesh.colors = Colors::Each(colors);
        assert!(whole(&mesh).is_empty());
    }

    #[test]
    fn pieces_hold_all_triangles_within_the_limit() {
        let pieces: Vec<_> = PackedMesh::pieces(&mesh(), 3).collect();
        assert_eq!(pieces.len(), 5);
        assert_eq!(pieces.iter().map(|piece| piece.indices.len()).sum::<usize>(), 2);
        assert!(pieces.iter().all(|piece| piece.rebase == pieces[0].rebase));
        assert!(pieces.iter().all(|piece| piece.vertices.len() <= 6));
    }
}
