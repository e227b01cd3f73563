//! Numbers, vectors and colours: what both halves of the program share.
//!
//! Right-handed world, +y up; cameras look along −z; the local shading frame has its normal along +z.
//! Metres, seconds, radians. Colours are linear with Rec. 709 primaries.

pub mod bounds;
pub mod float;
pub mod frame;
pub mod motion;
pub mod ray;
pub mod rgb;
pub mod warp;

pub use bounds::Bounds;
pub use frame::Frame;
pub use glam::{Affine3A, DAffine3, DMat3, DVec2, DVec3, Vec2, Vec3};
pub use motion::Motion;
pub use ray::Ray;
pub use rgb::Rgb;
