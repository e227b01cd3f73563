//! How far a picture is from the truth, and what accuracy costs in time.
//!
//! [`Metrics`] compares two pictures; [`welch`] tells noise from a difference in earnest.

pub mod flip;
pub mod heat;
pub mod metrics;
mod plane;
pub mod ssim;
pub mod statistics;
pub mod welch;

pub use metrics::{Metrics, Relative, measure};
