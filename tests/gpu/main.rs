//! What is drawn, and all else that needs a device. Two renderers draw for all tests, under validation; a few have a device
//! of their own.

#[path = "../common/mod.rs"]
mod common;

mod bands;
mod beside;
mod borders;
mod by_design;
mod clipped_levels;
mod clips;
mod clips_measured;
mod cull;
mod culling;
mod edges;
mod edges_inside;
mod edges_measured;
mod edges_of_layers;
mod edges_of_polygons;
mod embedding;
mod extremes;
mod eye_dome;
mod f16;
mod floor;
mod frame_graph;
mod hard_cases;
mod hierarchy_files;
mod hybrid_cells;
mod hybrid_levels;
mod in_parts;
mod in_use;
mod levels;
mod lifetime;
mod memory;
mod off_center;
mod oracle;
mod orthographic;
mod outlines;
mod packed;
mod paged;
mod paper_form;
mod pick;
mod pictures;
mod pipelines;
mod planes;
mod samples;
mod seam;
mod selftest;
mod stability;
mod tiles;
mod transparency;
mod transparent_parts;
mod validation;
mod vertex_splats;
