//! Situations in which numbers get unpleasant, each with what the renderer promises there.
//!
//! A test carries the number of its case, its source and where its threshold comes from, and shows that a program without
//! the remedy fails: a case that the naive form passes too would test nothing. `--ignored` runs the long versions.

mod a_scale;
mod a_triangles;
mod a_watertight;
mod b_solids;
mod c_leaving;
mod d_transforms;
mod e_scattering;
mod f_sampling;
mod g_photons;
mod h_film;
