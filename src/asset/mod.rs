//! Bytes → meshes, pictures and lenses, with every trap of the formats caught.
//!
//! This layer knows files, not scenes: its errors say what is wrong and where in the file, and `load` says which line of
//! the scene asked for it.

pub mod gltf;
pub mod lens;
pub mod look;
pub mod mesh;
mod model;
pub mod obj;
pub mod picture;
pub mod polygon;
mod report;

pub use lens::{LensError, LensSurface, LensTable};
pub use look::Look;
pub use model::{MeshError, Model, ModelMaterial, ModelPicture, Part, PictureSource};
pub use picture::{Picture, PictureError, Pixels};
pub use report::{About, Fate, ImportReport, Remark};
