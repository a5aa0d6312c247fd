//! Where a pass finds its resources: in which set of descriptors, or as what draws and copies take.

/// Where a pass finds a resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct At {
    pub place: Place,
    pub binding: u32,
}

/// A set of descriptors, or where draws and copies look.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Place {
    /// `BIND_LIST_*`, of a chunk; of all chunks under number 0.
    Lists(u32),
    /// The same set with nothing in it, for chunks without lists.
    NoLists,
    /// `BIND_READ_*`.
    Read,
    /// `BIND_SUMS_*`.
    Sums,
    /// `BIND_CELLS_*`.
    Cells,
    /// Those of tiles, of a band where a pass draws several.
    Tiles(u32),
    /// The arguments of draws and dispatches.
    Arguments,
    /// Those of the visible splats of all chunks.
    VisibleArguments,
    /// Those of all draws of layers, and the fragments of the layer before.
    LayerArguments,
    LayerFragments,
    /// What is drawn by index.
    Indices,
    /// What is copied, cleared or filled.
    Transfer,
}

impl Place {
    /// A binding of it.
    pub const fn at(self, binding: u32) -> At {
        At { place: self, binding }
    }
}

/// A binding of the lists of all chunks.
pub(crate) const fn lists(binding: u32) -> At {
    Place::Lists(0).at(binding)
}

/// A binding of what fragments read.
pub(crate) const fn read(binding: u32) -> At {
    Place::Read.at(binding)
}

/// A binding of the sums.
pub(crate) const fn sums(binding: u32) -> At {
    Place::Sums.at(binding)
}

/// A binding of the tiles.
pub(crate) const fn tiles(binding: u32) -> At {
    Place::Tiles(0).at(binding)
}

/// The arguments with this number, often a chunk's.
pub(crate) const fn arguments(number: u32) -> At {
    Place::Arguments.at(number)
}

/// The list that points are drawn by.
pub(crate) const INDICES: At = Place::Indices.at(0);

/// What a copy takes and what it gives, or the only one of a pass.
pub(crate) const fn transfer(number: u32) -> At {
    Place::Transfer.at(number)
}

/// Planes that cut what is seen: how many, and the buffer that holds them, which is the frame slot's; null in a frame that is only listed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Planes {
    /// How many there are.
    pub count: u32,
    /// A uniform buffer of `PLANES_BYTES`.
    pub buffer: ash::vk::Buffer,
}

/// What colors of chunks are multiplied by, in the order of the chunks' numbers in their part of the frame: a buffer of four floats each, and its bytes.
#[derive(Clone, Copy, Debug)]
pub struct Tints {
    /// A storage buffer.
    pub buffer: ash::vk::Buffer,
    /// How long it is.
    pub bytes: u64,
}

/// Bytes of as many planes as there may be.
pub(crate) const PLANES_BYTES: u64 = crate::shaders::config::MOST_PLANES as u64 * 16;
