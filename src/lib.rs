//! Snell: a scene language with a compiler that shows every mistake, and a renderer that shows its error.
//!
//! A scene travels one way: text → `syntax` → `resolve` → `check` → `load` → `plan` → `lower` → `render` → `output`.
//! Each of these is a module with one verb; the language half has never heard of a ray, the engine half never of a
//! span, and they meet in [`lower`].

pub mod asset;
pub mod check;
pub mod cli;
pub mod convert;
pub mod diag;
pub mod ir;
pub mod load;
pub mod lower;
pub mod math;
pub mod output;
pub mod plan;
pub mod render;
pub mod resolve;
pub mod schema;
pub mod source;
pub mod syntax;
