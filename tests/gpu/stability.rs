//! Numerical stability: f32 on the device against f64, over everything that makes a splat hard to set up.

mod basis;
mod filtered;
mod measure;
mod pictures;
mod probe;
mod sweep;
mod table;
mod truth;

const GRAY: [f32; 4] = [0.5, 0.5, 0.5, 1.0];
