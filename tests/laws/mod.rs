//! What physics and sampling theory promise.

mod choice;
mod forks;
mod lamps;
pub mod light;
mod replay;
pub mod scattering;
pub mod statistics;
mod transport;
pub mod worlds;
