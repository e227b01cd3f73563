//! What the programs that draw the scenes' assets share: polygon meshes, surfaces of fields, noise and pictures.
#![allow(dead_code)] // each program includes this module whole and uses its own part of it

pub mod curve;
pub mod field;
pub mod glb;
pub mod mesh;
pub mod noise;
pub mod paint;
pub mod sky;

use std::path::PathBuf;

/// The path of an asset: `scenes/assets/NAME` of this crate, wherever the program is started.
pub fn asset(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scenes/assets").join(name)
}

/// 0 up to `a`, 1 from `b` on, and a smooth cubic between (Perlin's smoothstep).
pub fn smoothstep(a: f32, b: f32, x: f32) -> f32 {
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
