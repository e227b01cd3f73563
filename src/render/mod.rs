//! The engine: from a world to a film. It knows rays and radiance, and nothing of scene texts.
//!
//! Opaque `u32` ids lead back to where a thing was written; `lower` holds that table.

pub mod accel;
pub mod bsdf;
pub mod camera;
pub mod driver;
pub mod effects;
pub mod film;
pub mod geometry;
pub mod integrator;
pub mod ledger;
pub mod light;
pub mod media;
#[cfg(feature = "naive")]
pub mod naive;
pub mod photon;
pub mod sampler;
pub mod shape;
pub mod texture;
pub mod world;

pub use driver::{
    GatherRadius, HybridSettings, Layers, Method, Monitor, Outcome, PpmSettings, Progress, Replay, Settings,
    Stats, Stop, StoppedBy, layers, render, replay,
};
pub use effects::Effects;
pub use sampler::Sampling;
pub use world::{Parts, World};
