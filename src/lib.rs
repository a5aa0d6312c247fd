//! A Vulkan-native splat renderer whose every method carries a measured cost and a measured error.

pub mod error;
pub mod frame;
pub mod geometry;
pub mod graph;
#[cfg(feature = "files")]
pub mod load;
pub mod math;
pub mod passes;
pub mod prepare;
pub mod progress;
pub mod reference;
pub mod renderer;
pub mod report;
#[cfg(feature = "files")]
pub mod save;
pub mod scene;
pub mod shaders;
pub mod vk;

pub use error::{Error, ErrorKind, Result};
pub use progress::Progress;
