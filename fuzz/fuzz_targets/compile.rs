//! Any text ends in a world ready for rays or in a report, files and all.

#![no_main]

libfuzzer_sys::fuzz_target!(|text: &str| snell_fuzz::compile(text));
