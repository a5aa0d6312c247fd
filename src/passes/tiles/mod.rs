//! Splats drawn by tiles of the image, in compute: projected once, listed by tile, then seen and summed a tile at a time.
//!
//! What it leaves is what the graphics pipeline's passes leave: sums, and a depth. Splats that are too large for that, or not
//! regular, are listed too, by chunk, and drawn by the graphics pipeline into the same images.

pub(crate) mod bins;
pub(crate) mod clear;
pub(crate) mod depth;
pub(crate) mod dispatch;
pub(crate) mod large;
pub(crate) mod layer_work;
pub(crate) mod layers;
pub(crate) mod lists;
pub(crate) mod overflow;
pub(crate) mod project;
pub(crate) mod runs;
pub(crate) mod shaded;
pub(crate) mod splat;
pub(crate) mod start;

pub(crate) use crate::passes::tiles::{
    bins::list,
    depth::depth_buffer,
    large::{see_large, sum_large},
    layers::layers,
    lists::Tiles,
    shaded::{ShadedTiles, shaded},
    splat::{TileImages, fused, see, sum},
};
