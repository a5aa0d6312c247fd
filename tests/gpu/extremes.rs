//! Random scenes, each extreme in one way, on the device against the oracle: a row a way, a number a scene.
//!
//! A scene is found again by its row and number. `fixed` draws a few of each row in every run of the tests, `sweep` as many as it is
//! asked for (`README.md`).

mod draw;
mod edge_on;
mod errors;
mod extent;
mod field;
mod fixed;
mod least_share;
mod loaded;
mod looking;
mod method;
mod near;
mod ordinary;
mod posed;
mod put;
mod rows;
mod sheets;
mod sizes;
mod skew;
mod sweep;
mod truth;
