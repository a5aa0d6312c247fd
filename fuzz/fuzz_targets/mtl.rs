#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| surfel_fuzz::read_materials(bytes));
