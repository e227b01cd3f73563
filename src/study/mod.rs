//! How far a picture is from the truth, and what accuracy costs in time.
//!
//! [`Metrics`] compares two pictures; [`welch`] tells noise from a difference in earnest. For a study, [`experiment`]
//! measures runs, [`record`] keeps them, [`curve`] and [`findings`] say what they mean, [`table`] and [`page`] tell it.

pub mod clock;
pub mod curve;
pub mod experiment;
pub mod findings;
pub mod flip;
pub mod heat;
pub mod metrics;
pub mod page;
mod plane;
pub mod record;
pub mod ssim;
pub mod statistics;
pub mod table;
pub mod welch;

pub use metrics::{Metrics, Relative, measure};
