//! From sums to the picture, and to data.

pub(crate) mod export;
pub(crate) mod eye_dome;
pub(crate) mod finalize;
pub(crate) mod fullscreen;
pub(crate) mod lights;
pub(crate) mod readback;
pub(crate) mod samples;
