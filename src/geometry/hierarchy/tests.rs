//! Hierarchies of several models, each node of them held against all disks below it.

mod conservative;
mod contrast;
mod drawn;
pub(crate) mod models;
mod moments;
mod selection;
mod tree;
