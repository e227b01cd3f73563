//! Photons: traced from the lights, kept in a map, gathered where the camera looks.

mod map;
mod trace;

pub use map::{Disc, Neighbor, Photon, PhotonMap};
pub use trace::{gathers, trace_photons};
