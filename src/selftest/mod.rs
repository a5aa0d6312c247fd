//! The self-test: every method on every hard scene against the oracle, on the device at hand, under validation.
//!
//! A [`Case`] is one scene drawn by one method. Its name is a path, such as `methods.perspective.adjust.edge-on-disks`: a
//! group, the rasterizer, the filter, the scene. [`run`] draws the cases of a [`Suite`] and judges each by its tolerance
//! ([`tolerance`]), by what the validation layer said meanwhile, and by what is [`Known`] of the driver.
//!
//! | group | what is checked |
//! |---|---|
//! | `device` | opening and closing the device: what the layer says outside of all other cases |
//! | `methods` | against the oracle, with 32-bit sums |
//! | `psi-e`, `unit-weight`, `kernel-texture`, `sums-16` and their combinations | the same with that option of a method |
//! | `tile-invocations` | tiles drawn an invocation a pixel, a column and a short one have the same bits; of clipped splats a short one has them but for the order of sums |
//! | `repeat` | uploading and drawing again gives the same bits |
//! | `layers` | the picture of transparent layers, polygons, both beside splats, a scene's own lights; with 32-bit sums |
//! | `layers-16` | the same with 16-bit sums and the default method |
//! | `layers-auto` | as many layers as the device finds give the same bits as the fixed number |

pub mod agreement;
mod case;
mod check;
pub mod half;
mod known;
mod layers;
pub mod light;
mod pattern;
mod report;
mod run;
pub mod tolerance;

pub use case::{Case, SIZE_PX, Suite};
pub use check::of_oracle;
pub use known::{BUILT_IN, Entry, Expectation, Known, KnownList};
pub use pattern::Pattern;
pub use report::{CaseResult, Counts, SelftestReport, Status, ValidationReport};
pub use run::{Event, Outcome, run};

/// Tables of numerical stability, which the test `gpu stability` has measured: JSON of [`crate::report::Grid`]s.
pub const STABILITY_TABLES: &str = include_str!("stability_tables.json");
