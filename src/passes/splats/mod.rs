//! Splats by the graphics pipeline: visibility and accumulation.

pub(crate) mod accumulate;
pub(crate) mod draw;
pub(crate) mod kernel_texture;
pub(crate) mod visibility;
