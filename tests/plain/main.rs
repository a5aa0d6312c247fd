//! What needs no device: files, the shaders' build, instructions counted, and the direction of imports.

#[path = "../../src/shaders/build/mod.rs"]
mod shader_build;

mod guide;
mod import_direction;
mod instructions;
mod public_items;
mod public_names;
mod report;
mod shaders;
mod splat_file;
