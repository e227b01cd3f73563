//! The smooth boundary between two clear media.

use super::Transport;
use super::lobe::LobeSample;
use super::mirror::reflect;
use crate::math::{Rgb, Vec3};

/// Fresnel reflectance of unpolarised light, and the cosine of the refracted direction.
///
/// `cos` in [0, 1] is measured on the side of the light; `eta` is the refractive index of the other side over that of
/// this one. The reflectance lies in [0, 1]; under total reflection it is 1 and the cosine 0; exactly 0 at `eta` = 1.
/// cos² θt = (cos² + (η − 1)(η + 1)) / η² in double precision: the textbook 1 − (1 − cos²) / η² is off by 1 at grazing
/// angles near η = 1. Absolute error below 10⁻⁶.
pub fn fresnel_dielectric(cos: f64, eta: f64) -> (f64, f64) {
    if eta == 1.0 {
        return (0.0, cos);
    }
    let cos2_t = (cos * cos + (eta - 1.0) * (eta + 1.0)) / (eta * eta);
    if cos2_t <= 0.0 {
        return (1.0, 0.0);
    }
    let cos_t = cos2_t.sqrt();
    let parallel = (eta * cos - cos_t) / (eta * cos + cos_t);
    let perpendicular = (cos - eta * cos_t) / (cos + eta * cos_t);
    (0.5 * (parallel * parallel + perpendicular * perpendicular), cos_t)
}

/// Reflects with the probability of Fresnel's equations, refracts otherwise.
///
/// `eta` is the refractive index beyond the surface over that of the viewer's side. Radiance that is refracted scales by
/// 1/η² (Veach 1997, eq. 5.1); power does not.
pub(super) fn sample(eta: f64, tint: Rgb, wo: Vec3, u: f32, transport: Transport) -> LobeSample {
    let (reflectance, cos_t) = fresnel_dielectric(f64::from(wo.z), eta);
    if f64::from(u) < reflectance {
        return LobeSample::mirrored(reflect(wo), Rgb::WHITE);
    }
    let eta = eta as f32;
    let wi = Vec3::new(-wo.x / eta, -wo.y / eta, -cos_t as f32);
    let weight = tint * transport.refracted(eta);
    LobeSample { wi, weight, pdf: 1.0, specular: true, through: true, enters: true, eta }
}
