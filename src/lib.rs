//! A Vulkan-native splat renderer whose every method carries a measured cost and a measured error.

pub mod error;
pub mod geometry;
pub mod graph;
#[cfg(feature = "files")]
pub mod load;
pub mod math;
pub mod reference;
pub mod report;
#[cfg(feature = "files")]
pub mod save;
pub mod scene;

pub use error::{Error, ErrorKind, Result};
