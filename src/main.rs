//! Snell.
fn main() {}
