//! Formatting changes no tree and loses nothing.

#![no_main]

libfuzzer_sys::fuzz_target!(|text: &str| snell_fuzz::fmt(text));
