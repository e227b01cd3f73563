//! Finding what a ray meets among many: a partition of it all ([`build`]), put into the shape that rays like ([`wide`]).

pub mod build;
mod clip;
mod collapse;
mod kernel;
mod objects;
mod sah;
#[cfg(target_arch = "x86_64")]
mod simd;
mod spatial;
mod walk;
pub mod wide;

pub use build::{Items, partition};
pub use wide::Wide;
