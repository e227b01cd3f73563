//! Bytes → meshes, pictures and lenses, with every trap of the formats caught.
//!
//! This layer knows files, not scenes: its errors say what is wrong and where in the file, and `load` says which line of
//! the scene asked for it.

pub mod lens;
pub mod obj;
pub mod picture;
pub mod polygon;

pub use lens::{LensError, LensSurface, LensTable};
pub use obj::{Model, ModelMaterial, ObjError, Part};
pub use picture::{Picture, PictureError, Pixels};
