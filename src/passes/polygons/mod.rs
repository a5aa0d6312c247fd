//! Polygons.

pub(crate) mod cells;
pub(crate) mod copy_depth;
pub(crate) mod draw;
pub(crate) mod mesh_pass;
pub(crate) mod sampled;
