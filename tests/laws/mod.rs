//! What physics and sampling theory promise.

mod choice;
mod forks;
mod lamps;
pub mod light;
mod replay;
pub mod scattering;
mod sharing;
pub mod statistics;
mod transport;
pub mod worlds;
