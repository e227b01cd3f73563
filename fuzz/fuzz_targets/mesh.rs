//! Any bytes end in a mesh whose indices are inside, or in an error.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| snell_fuzz::mesh(bytes));
