//! Programs that measure: the floor, the device's limits, the papers' own programs, what lists hold, and the listing and counting of
//! pipelines. Nothing of a picture is drawn by them.

mod catalog;
mod counting;
mod floor;
mod floor_passes;
mod in_use;
#[cfg(feature = "counts")]
mod instructions;
mod limit_points;
mod limits;
mod list_occupancy;
mod paper;
mod paper_passes;

pub use catalog::{Traits, frame_pipelines, papers_pipelines};
pub use counting::Counting;
pub use floor::Floor;
#[cfg(feature = "counts")]
pub use instructions::{Counter, counts_of};
pub use limits::{LimitProbes, Probe};
pub use list_occupancy::{ListOccupancy, TileOccupancy};
pub use paper::draw_as_published;
