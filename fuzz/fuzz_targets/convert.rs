//! Any text of the arsenal family ends in a scene that compiles, or in a report.

#![no_main]

libfuzzer_sys::fuzz_target!(|text: &str| snell_fuzz::convert(text));
