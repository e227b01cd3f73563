//! Mistakes and how they are shown.
//!
//! Each phase describes its mistakes in its own `error.rs` (an enum that derives `thiserror::Error` and
//! `miette::Diagnostic`), and notes them in [`Problems`]. [`Report`] puts them in source order and renders them.

mod human;
mod json;
mod problems;
mod report;
#[cfg(test)]
mod samples;
mod sarif;
mod silence;
mod suggest;
mod view;

pub use human::Style;
pub use problems::{Problem, Problems, Severity, Trail};
pub use report::Report;
pub use sarif::{Rule, sarif};
pub use silence::Allow;
pub use suggest::{
    did_you_mean, did_you_mean_one_of, is_slip_of, nearest, nearest_of_kind, where_it_was_sought,
};
