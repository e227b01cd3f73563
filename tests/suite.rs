//! All integration tests, in one binary: linking several costs more than running them.

mod doubts;
mod format;
mod fuzz;
mod laws;
mod laws_geometry;
mod laws_photon;
mod layers;
mod meaning;
mod readme;
mod robust;
mod robust_syntax;
mod snapshots;
