//! What physics and sampling theory promise.

mod choice;
mod forks;
mod lamps;
mod light;
mod scattering;
mod statistics;
mod transport;
pub mod worlds;
