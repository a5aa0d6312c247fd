//! Pipelines: what they are made of, the layouts that they share, and those that were made.

pub(crate) mod cache;
pub(crate) mod constants;
pub(crate) mod formats;
#[cfg(feature = "test-formulas")]
pub(crate) mod formula;
pub(crate) mod key;
pub(crate) mod last_sets;
mod made;
pub(crate) mod recipe;
pub(crate) mod splat_shaders;
pub(crate) mod tile_layouts;
pub(crate) mod variant;
