//! Lists of splats, made in compute before any is set up: those that may be seen, those that nothing hides, those that are too large.

pub(crate) mod dispatch;
pub(crate) mod hidden;
pub(crate) mod large;
pub(crate) mod lists;
pub(crate) mod visible;
