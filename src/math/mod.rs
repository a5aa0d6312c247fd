//! Pure mathematics of the GPU path, on the host. The oracle (`reference/`) shares none of it on purpose.

pub mod kernel;
pub mod morton;
pub mod random;
pub mod size;
pub mod srgb;
pub mod tonemap;
pub(crate) mod within;
