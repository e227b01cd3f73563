//! Perfect reflection.

use super::lobe::LobeSample;
use crate::math::{Rgb, Vec3};

/// Reflectance at an angle, from those at normal and at grazing incidence (Schlick 1994, eq. 15).
pub(super) fn schlick(f0: Rgb, f90: Rgb, cos: f32) -> Rgb {
    let m = (1.0 - cos).max(0.0);
    let m2 = m * m;
    f0.lerp(f90, m2 * m2 * m)
}

/// The mirror direction about +z.
pub(super) fn reflect(wo: Vec3) -> Vec3 {
    Vec3::new(-wo.x, -wo.y, wo.z)
}

/// The only direction there is.
pub(super) fn sample(f0: Rgb, f90: Rgb, wo: Vec3) -> LobeSample {
    LobeSample::mirrored(reflect(wo), schlick(f0, f90, wo.z))
}
