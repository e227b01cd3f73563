//! Any text ends in a tree and a report that can be shown.

#![no_main]

libfuzzer_sys::fuzz_target!(|text: &str| snell_fuzz::parse(text));
