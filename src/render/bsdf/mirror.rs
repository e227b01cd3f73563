//! Perfect reflection.

use super::fresnel::Reflectance;
use super::lobe::LobeSample;
use crate::math::Vec3;

/// The mirror direction about +z.
pub(super) fn reflect(wo: Vec3) -> Vec3 {
    Vec3::new(-wo.x, -wo.y, wo.z)
}

/// The only direction there is.
pub(super) fn sample(reflectance: &Reflectance, wo: Vec3) -> LobeSample {
    LobeSample::mirrored(reflect(wo), reflectance.at(wo.z))
}
