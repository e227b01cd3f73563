//! The engine: from a world to a film. It knows rays and radiance, and nothing of scene texts.
//!
//! Opaque `u32` ids lead back to where a thing was written; `lower` holds that table.

pub mod geometry;
pub mod shape;
