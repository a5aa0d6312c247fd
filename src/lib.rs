//! A Vulkan-native splat renderer whose every method carries a measured cost and a measured error.
//!
//! ```text
//!  load ──> scene ──> prepare ──> graph ──> passes ──> frame ──> report
//!  files    plain     buffers     order,    shaders    targets   figures
//!           data                  barriers
//!                 └─> reference: the same picture in f64, slow and obvious
//! ```
//!
//! A [`scene::Scene`] of [`scene::Splats`] is uploaded once ([`Renderer::upload`]) and then recorded into a
//! command buffer that the caller gives, as often as wanted ([`embed`]). The library never submits
//! and never waits; [`Headless`] is a small host that does, and gives pictures back:
//!
//! ```no_run
//! use surfel::{Headless, HeadlessOptions, Scene, Settings, Validation, Wanted, Camera};
//!
//! # fn main() -> surfel::Result<()> {
//! # let scene = Scene::default();
//! # let ball = surfel::scene::Ball { center: glam::DVec3::ZERO, radius: 1.0 };
//! let settings = Settings::default();
//! let camera = Camera::fit(&ball, settings.size_px, Camera::DEFAULT_FOV_Y_RAD);
//! let options = HeadlessOptions { validation: Validation::Off, device: None, cache_folder: None };
//! let mut headless = Headless::new(&options)?;
//! let prepared = headless.prepare(&scene, &|_done, _total| {})?;
//! let frame = headless.render(&prepared, &camera, &settings, Wanted::PICTURE)?;
//! assert_eq!(frame.srgb.len(), 1024 * 1024);
//! # Ok(())
//! # }
//! ```
//!
//! **Conventions.** World space is the file's, `f64`. View space: eye at the origin, x right, y down, z forward; the image
//! plane is z = 1. Depth is reversed and infinite, near / z. Colors are linear inside, sRGB in files. Pixel centers lie at
//! half integers.
//!
//! **What is public** by default is what a host needs. The feature `inside` shows the program, the library for C and the tests more, which may change in any version.
#![cfg_attr(
    not(feature = "inside"),
    allow(rustdoc::private_intra_doc_links, reason = "links lead inside, too")
)]

#[cfg(feature = "files")]
pub mod compose;
pub mod embed;
pub mod error;
pub mod geometry;
#[cfg(feature = "files")]
pub mod load;
pub mod progress;
#[cfg(feature = "files")]
pub mod save;
pub mod scene;

// What the program, the library for C and the tests use beyond that, and no host: public by a feature that promises nothing.
#[cfg_attr(not(feature = "inside"), allow(dead_code, unused_imports, reason = "a part of it is theirs"))]
#[path = ""]
mod inside {
    pub mod arena;
    #[cfg(feature = "counts")]
    pub mod count;
    pub mod frame;
    pub mod graph;
    #[cfg(feature = "selftest")]
    pub mod hard_scenes;
    pub mod inline_vec;
    pub mod instruments;
    #[cfg(feature = "files")]
    pub mod levels_file;
    pub mod math;
    pub mod notes;
    pub mod passes;
    pub mod prepare;
    pub mod reference;
    pub mod renderer;
    pub mod report;
    #[cfg(feature = "selftest")]
    pub mod selftest;
    pub mod shaders;
    pub mod small_file;
    pub mod vk;
}

#[cfg(feature = "inside")]
pub use inside::*;
#[cfg(not(feature = "inside"))]
use inside::*;

pub use ash;
pub use error::{Error, ErrorKind, Result};
pub use glam;
pub use progress::Progress;
pub use renderer::{Frame, Headless, HeadlessOptions, Renderer, Wanted};
pub use scene::{Camera, Scene, Settings};
pub use vk::{Validation, requirements};
