//! What is there where tiles are about to write.

use crate::graph::{Access, Start};

/// What the images hold when a pass writes to their tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TileStart {
    /// Nothing, and what tiles without splats hold then nobody reads.
    Empty,
    /// What polygons show, and nothing elsewhere: all of it is read.
    Polygons,
    /// The same, where tiles read it elsewhere, sample by sample.
    SampledPolygons,
    /// The tiles of other bands; nothing else, as above.
    Bands,
    /// 0 everywhere, but where there are the tiles of other bands: all of it is read.
    Cleared,
}

impl TileStart {
    /// What they hold then.
    pub fn after_a_band(self) -> Self {
        if self == Self::Empty { Self::Bands } else { self }
    }

    /// How a pass writes to them.
    pub fn access(self) -> (Access, Start) {
        match self {
            Self::Empty => (Access::StorageWriteCompute, Start::Discard),
            Self::Polygons => (Access::SampledAndStoredCompute, Start::Load),
            Self::SampledPolygons | Self::Bands | Self::Cleared => {
                (Access::StorageReadWriteCompute, Start::Load)
            }
        }
    }
}
