#![no_main]

libfuzzer_sys::fuzz_target!(init: surfel_fuzz::forgive_foreign_decoders(), |bytes: &[u8]| surfel_fuzz::read_octree(bytes));
