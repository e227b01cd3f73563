//! The glossy lobe of Phong, normalised so that it conserves energy (Lafortune & Willems 1994):
//! f = ρ (n + 2) / 2π · cosⁿ α, with α measured from the mirror direction.

use super::lobe::LobeSample;
use super::mirror::reflect;
use crate::math::{Frame, Rgb, Vec2, Vec3, float};
use std::f32::consts::TAU;

/// Value times `cos θi`, and density (n + 1) / 2π · cosⁿ α, per steradian.
///
/// The density is that of the whole lobe: what is drawn below the horizon is lost, not drawn again.
pub(super) fn eval_pdf(albedo: Rgb, exponent: f32, wo: Vec3, wi: Vec3) -> (Rgb, f32) {
    let cos_power = cos_power(wi, reflect(wo), exponent);
    let pdf = (exponent + 1.0) / TAU * cos_power;
    (albedo * ((exponent + 2.0) / TAU * cos_power * wi.z), pdf)
}

/// Draws from the whole lobe; `None` below the horizon.
pub(super) fn sample(albedo: Rgb, exponent: f32, wo: Vec3, u: Vec2) -> Option<LobeSample> {
    // cos α = (1 − u)^(1 / (n + 1)), by way of 1 − cos α, which keeps its digits in a sharp lobe.
    let one_minus_cos = -float::exp_m1(float::ln_1p(-u.x) / (exponent + 1.0));
    let sin = (one_minus_cos * (2.0 - one_minus_cos)).max(0.0).sqrt();
    let (sin_phi, cos_phi) = float::sin_cos(TAU * u.y);
    let local = Vec3::new(sin * cos_phi, sin * sin_phi, 1.0 - one_minus_cos);
    let wi = Frame::from_normal(reflect(wo)).to_world(local);
    let pdf = (exponent + 1.0) / TAU * cos_power(wi, reflect(wo), exponent);
    if wi.z <= 0.0 || pdf <= 0.0 {
        return None;
    }
    let weight = albedo * ((exponent + 2.0) / (exponent + 1.0) * wi.z);
    Some(LobeSample::smooth(wi, weight, pdf))
}

/// cosⁿ of the angle between two unit vectors; 0 beyond a right angle.
///
/// From the chord, 1 − cos α = |a − b|² / 2: the cosine itself has too few digits for large powers.
fn cos_power(a: Vec3, b: Vec3, exponent: f32) -> f32 {
    let one_minus_cos = 0.5 * (a - b).length_squared();
    if one_minus_cos >= 1.0 { 0.0 } else { float::exp(exponent * float::ln_1p(-one_minus_cos)) }
}
