//! All integration tests, in one binary: linking several costs more than running them.

mod allow;
mod classic;
mod command_line;
mod convert_cli;
mod convert_rays;
mod doubts;
mod explain;
mod format;
mod fuzz;
mod generate;
mod hard_cases;
mod laws;
mod laws_geometry;
mod laws_photon;
mod layers;
mod meaning;
mod messages;
mod metrics;
mod mutation;
mod readme;
mod reference;
mod robust;
mod robust_syntax;
mod silhouettes;
mod snapshots;
mod support;
