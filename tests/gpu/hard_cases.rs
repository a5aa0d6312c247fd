//! Numerical cases that systems like this one are known to fail on, one test each, named by number.
//!
//! | case | where it is tested, or why it cannot occur |
//! |---|---|
//! | N1 a splat seen edge-on, det → 0 | `shape.rs` |
//! | N2 a splat that crosses the eye or near plane | `shape.rs`; the self-test: "ground", "cut by the near plane" |
//! | N3 the center of the projection is not the projected center | `shape.rs` |
//! | N4 radius 100 × distance | `shape.rs`; the self-test: "larger than the screen" |
//! | N5 center off-screen, disk visible | `shape.rs`; the self-test: "centers off-screen" |
//! | N6 points above the device's limit | `large.rs` |
//! | N7 subpixel splats | `shape.rs` |
//! | N8 depth range 1e7 | `depth.rs`; beyond f32's squares: `range.rs` |
//! | N9 far from the origin | `depth.rs`; with a stray point: `range.rs` |
//! | N10 no extent | `numbers.rs` |
//! | N11 odd normals | `numbers.rs` |
//! | N12 NaN and infinity | `numbers.rs`; the self-test: "degenerate" |
//! | N13 sums of 16 bits | `f16.rs` |
//! | N14 pixels covered by rims alone | `numbers.rs` |
//! | N15 ε: parallel sheets | `depth.rs`; below a step of f32: `range.rs` |
//! | N16 depth of a tilted splat | `depth.rs` |
//! | N17 equal depths in peeling | the self-test: "coincident transparent sheets"; the proof: `glsl/inc/peel.glsl` |
//! | N18 order and repetition | `large.rs` |
//! | N19 orthographic camera | cannot occur: the camera is a pinhole |
//! | N20 radius 0, negative, infinite; needles | `shape.rs`; dropped radii: `numbers.rs`, N12 |
//! | N21 culling by center | cannot occur: only whole splats behind the near plane are left out; N5 would see it |
//! | N22 large targets | `large.rs` |
//! | N23 counts beyond 32 bits | arithmetic, in `src/prepare/chunk.rs`: a chunk has at most 2²² splats |
//! | N24 mirrored transforms | in f64 before drawing: `src/scene/transform/tests.rs`; slanted and left-handed tangents: `shape.rs` |
//! | N25 extreme fields of view | `shape.rs` |
//! | N26 denormals | `numbers.rs` |
//! | N27 other devices' last bits | tolerances are those of f32, byte equality is asked only of one device |
//! | N28 thin walls | `oracle.rs`: back faces; N15 |
//! | N29 image edges | `large.rs` |
//! | N30 attributes at the ends of their range | `numbers.rs` |
//! | triangles seen exactly edge-on | `triangles.rs` |
//!
//! What files bring of N9 to N12, N20 and N30 is in `program/tests/cli/hard_files.rs`.

mod depth;
mod large;
mod numbers;
mod range;
mod shape;
mod triangles;

use crate::common::{
    builder::{Builder, camera, settings},
    scenes::Hard,
};
use surfel::scene::Settings;

/// Splats seen along −z from (0, 0, 3), the middle of the image at the origin.
fn hard(name: &'static str, builder: Builder, settings: Settings) -> Hard {
    Hard { name, scene: builder.scene(false), camera: camera([0.0, 0.0, 3.0], [0.0; 3]), settings }
}

/// Settings for a square image of this many pixels.
fn of_size(side_px: u32) -> Settings {
    Settings { size_px: [side_px; 2], ..settings() }
}

const GRAY: [f32; 4] = [0.5, 0.5, 0.5, 1.0];
