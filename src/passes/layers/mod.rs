//! Transparent layers by the graphics pipeline.

pub(crate) mod accumulate;
pub(crate) mod compose;
pub(crate) mod frame;
pub(crate) mod layer;
pub(crate) mod rest;
pub(crate) mod visibility;
