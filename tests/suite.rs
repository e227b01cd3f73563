//! All integration tests, in one binary: linking several costs more than running them.

mod format;
mod laws;
mod laws_geometry;
mod laws_photon;
mod layers;
mod meaning;
mod mutation;
mod readme;
mod robust;
mod robust_syntax;
mod snapshots;
