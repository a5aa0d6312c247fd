//! Every method on every hard scene against the oracle.

pub mod agreement;
pub mod half;
pub mod tolerance;
