//! (to come)
pub mod curve;
pub mod tessellate;
