//! Push constants: the host's mirrors of the structs in `glsl/`, whose offsets the build compares.

use bytemuck::{Pod, Zeroable};

use crate::shaders::config::{MOST_TILES_SHIFT, RECT_CHUNK};

// Numbers of chunks that rects tell apart, and whether they have color 0, lie below.
const _: () = assert!(2 * (u32::MAX - RECT_CHUNK) < 1 << MOST_TILES_SHIFT);

/// What every splat pass is told of the frame; see `glsl/inc/frame.glsl` for spaces and units.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct FrameConstants {
    /// Row of the rotation from local to view space, then the translation, view unit.
    pub view_from_local_x: [f32; 4],
    /// As above.
    pub view_from_local_y: [f32; 4],
    /// As above.
    pub view_from_local_z: [f32; 4],
    /// Where the view's axis meets the image.
    pub middle_px: [f32; 2],
    /// An image-plane unit in pixels.
    pub focal_px: f32,
    /// Depth of the near plane, view unit; of an orthographic camera where w is 0.
    pub near: f32,
    /// √2 pixels, image-plane unit.
    pub filter_radius: f32,
    /// ε as a multiple of the splat's larger radius.
    pub epsilon_radii: f32,
    /// ε as a length, view unit.
    pub epsilon_length: f32,
    /// The image's width less 1, and in the upper half its height less 1.
    pub size_less_1_px: u32,
    /// Where the image's corner lies in the whole picture: whole pixels to the right, and in the upper half down.
    pub corner_px: u32,
    /// Splats of the chunk.
    pub splat_count: u32,
    /// Twice the chunk's number in its part of the frame; plus 1 where all its splats have color 0.
    pub chunk_color: u32,
    /// What local lengths are multiplied by in view space: a power of two.
    pub view_from_local_scale: f32,
    /// The local origin seen from the eye, in local space's axes and the view unit: x, y, z in f32, then what f32 left of
    /// each.
    pub origin_from_eye: [f32; 6],
    /// The number of the chunk's first splat among those of all chunks; of listed blocks, among theirs.
    pub first_record: u32,
    /// Blocks of the chunk that are looked at for splats that may be seen, below 2¹⁶; in the upper half what inverse overlaps
    /// are multiplied by.
    pub blocks_overlap: u32,
}

impl FrameConstants {
    /// Blocks of the chunk that are looked at for splats that may be seen.
    pub(crate) fn listed_blocks(&self) -> u32 {
        self.blocks_overlap & 0xffff
    }

    /// Lets so many blocks of the chunk be looked at; a chunk has 2¹⁴ at most.
    #[inline]
    pub(crate) fn list_blocks(&mut self, blocks: u32) {
        self.blocks_overlap = self.blocks_overlap & 0xffff_0000 | blocks;
    }

    /// Gives the chunk its number in its part of the frame.
    #[inline]
    pub(crate) fn number_chunk(&mut self, number: u32) {
        self.chunk_color = 2 * number + self.chunk_color % 2;
    }

    /// The same where splats are projected, which touch so many tiles at most.
    pub(crate) fn with_most_tiles(self, most: u32) -> Self {
        let chunk_color = self.chunk_color & ((1 << MOST_TILES_SHIFT) - 1) | most << MOST_TILES_SHIFT;
        Self { chunk_color, ..self }
    }
}

/// Two numbers below 2¹⁶ in one word, the first in its lower half.
pub(crate) fn in_one_word([low, high]: [u32; 2]) -> u32 {
    low | high << 16
}

/// What the paper's own programs are told; see `glsl/paper.vert.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct PaperConstants {
    /// Row of the rotation from local to view space, then the translation, local unit.
    pub view_from_local_x: [f32; 4],
    /// As above.
    pub view_from_local_y: [f32; 4],
    /// As above.
    pub view_from_local_z: [f32; 4],
    /// What view space is multiplied by: 2 f / width, 2 f / height, 1/2, 1.
    pub clip_from_view: [f32; 4],
    /// Of the map's rows: b / f, b / f, b, with b the depth of the near plane, local unit, and f in pixels.
    pub scale: [f32; 3],
    /// f in pixels.
    pub size_px: f32,
    /// Of the image.
    pub middle_px: [f32; 2],
    /// Twice √2 pixels, image-plane unit.
    pub filter_radius: f32,
    /// ε as a multiple of the splat's radius.
    pub epsilon_radii: f32,
}

/// What finalization is told; see `glsl/inc/finalize.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct FinalizeConstants {
    /// Linear color of empty pixels.
    pub background: [f32; 4],
    /// Half of width and height.
    pub half_size_px: [f32; 2],
    /// Where the view's axis meets the image.
    pub middle_px: [f32; 2],
    /// An image-plane unit in pixels.
    pub focal_px: f32,
    /// Pixels of a tile's column; 0 without tiles.
    pub tile_height: u32,
    /// Depth of the near plane, world unit; of an orthographic camera where w is 0, from the plane where it is 1.
    pub near: f32,
    /// How far that plane is from the eye.
    pub eye_to_depth: f32,
}

/// How a host's depth follows from ours, w: `scale` w + `offset`; see `glsl/inc/host.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct HostDepth {
    /// Where the picture's corner lies in the host's image.
    pub corner_px: [i32; 2],
    /// The host's depth where w is 1, less that where it is 0.
    pub scale: f32,
    /// The host's depth where w is 0.
    pub offset: f32,
    /// The picture's columns, where it is a mirror's; else 0.
    pub columns: i32,
}

/// An object of a host's, and how it has moved since a frame before; see `glsl/inc/host_objects.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct HostObject {
    /// Rows of a matrix less that of what stands still, times a pixel's place from the view's corner, 1 and w: of where it was, in pixels.
    pub x: [f32; 4],
    /// As above.
    pub y: [f32; 4],
    /// As above; of what divides both.
    pub over: [f32; 4],
    /// The host's own number.
    pub id: u32,
    /// 0.
    pub unused: [u32; 3],
}

/// What the passes over tiles are told; see `glsl/tile/constants.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct TileConstants {
    /// Half of width and height.
    pub half_size_px: [f32; 2],
    /// Where the view's axis meets the image.
    pub middle_px: [f32; 2],
    /// Tiles in a row.
    pub tiles_x: u32,
    /// The first tile of the band.
    pub first_tile: u32,
    /// Tiles of the band.
    pub tile_count: u32,
    /// Lists: of tiles, then of chunks.
    pub bin_count: u32,
    /// Splats of all chunks.
    pub record_count: u32,
    /// Segments of records.
    pub segments: u32,
    /// Records of a segment.
    pub segment_length: u32,
    /// Pieces of a segment, each of which one walk goes over.
    pub pieces: u32,
    /// Where in its piece a walk begins.
    pub round_first: u32,
    /// Records of one walk.
    pub round_length: u32,
    /// Of an overflow tile; of layers.
    pub part: u32,
    /// An image-plane unit in pixels.
    pub focal_px: f32,
    /// Layers of one surface each, in this dispatch; in parts, before it.
    pub surfaces: u32,
    /// 1: and all that is left.
    pub blends_rest: u32,
    /// Of a layer in parts.
    pub step: u32,
    /// 1: the last part.
    pub ends: u32,
    /// Bins that walks count in.
    pub count_bins: u32,
    /// By how much splats are shifted toward polygons at most, for each pixel of their image's size, where edges are covered in part.
    pub polygon_reach: f32,
}
