//! All integration tests, in one binary: linking several costs more than running them.

mod laws_geometry;
mod layers;
