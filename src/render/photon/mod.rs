//! Photons: traced from the lights, kept in a map, gathered where the camera looks.

mod aim;
mod caustics;
mod gather;
mod map;
mod occupancy;
mod schedule;
mod targets;
mod trace;

pub use aim::{Aim, Aimed, Source};
pub use caustics::Caustics;
pub use gather::Gather;
pub use map::{Disc, Neighbor, Photon, PhotonMap};
pub use schedule::Schedule;
pub use targets::{Ball, Targets};
pub use trace::{gathers, trace_photons};
