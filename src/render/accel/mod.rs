//! Finding what a ray meets among many: space is split first ([`build`]), then put into the shape that rays like ([`wide`]).

pub mod build;
mod clip;
mod collapse;
mod sah;
pub mod wide;

pub use build::{Items, partition};
pub use wide::Wide;
