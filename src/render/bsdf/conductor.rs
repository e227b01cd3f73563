//! Rough metal: microfacets of the GGX distribution (Walter et al. 2007), height-correlated masking and shadowing
//! (Heitz 2014), visible normals drawn by spherical caps (Dupuy & Benyoub 2023), Schlick's Fresnel term.

use super::lobe::LobeSample;
use super::mirror::schlick;
use crate::math::{Rgb, Vec2, Vec3, float};
use std::f32::consts::{PI, TAU};

/// Below this width the distribution counts as a perfect mirror.
pub(super) const MIRROR_ALPHA: f32 = 1e-3;

/// The density of microfacet normals, D(h), per steradian.
///
/// In the form by slopes, 1 / (π α² ((hₓ² + h_y²) / α² + h_z²)²): the usual one, with (n·h)² (α² − 1) + 1, loses all its
/// digits below α = 10⁻² in single precision. Relative error below 10⁻⁶.
pub(super) fn distribution(alpha: f32, h: Vec3) -> f32 {
    let a2 = alpha * alpha;
    let s = (h.x * h.x + h.y * h.y) / a2 + h.z * h.z;
    1.0 / (PI * a2 * s * s)
}

/// √(α² + (1 − α²) cos²), the root in Smith's Λ for GGX, with digits kept where cos is near 1.
fn root(alpha: f32, cos: f32) -> f32 {
    (cos * cos + alpha * alpha * (1.0 - cos) * (1.0 + cos)).sqrt()
}

/// G₂ / (4 cos θo cos θi), as one expression that stays finite at grazing angles.
fn visibility(alpha: f32, cos_o: f32, cos_i: f32) -> f32 {
    0.5 / (cos_o * root(alpha, cos_i) + cos_i * root(alpha, cos_o))
}

/// G₁(wo) / (4 cos θo): times D this is the density of reflected visible normals.
fn visible(alpha: f32, cos_o: f32) -> f32 {
    0.5 / (cos_o + root(alpha, cos_o))
}

/// Value times `cos θi`, and density, per steradian.
pub(super) fn eval_pdf(f0: Rgb, f90: Rgb, alpha: f32, wo: Vec3, wi: Vec3) -> (Rgb, f32) {
    let Some(h) = (wo + wi).try_normalize() else { return (Rgb::BLACK, 0.0) };
    let d = distribution(alpha, h);
    let value = schlick(f0, f90, wo.dot(h)) * (d * visibility(alpha, wo.z, wi.z) * wi.z);
    (value, d * visible(alpha, wo.z))
}

/// Draws a visible normal and reflects about it; `None` below the horizon.
pub(super) fn sample(f0: Rgb, f90: Rgb, alpha: f32, wo: Vec3, u: Vec2) -> Option<LobeSample> {
    let h = sample_visible_normal(alpha, wo, u);
    let wi = h * (2.0 * wo.dot(h)) - wo;
    if wi.z <= 0.0 {
        return None;
    }
    let pdf = distribution(alpha, h) * visible(alpha, wo.z);
    let masking = visibility(alpha, wo.z, wi.z) * wi.z / visible(alpha, wo.z);
    Some(LobeSample::smooth(wi, schlick(f0, f90, wo.dot(h)) * masking, pdf))
}

/// A microfacet normal, in proportion to its area seen from `wo` (Dupuy & Benyoub 2023, listing 3).
fn sample_visible_normal(alpha: f32, wo: Vec3, u: Vec2) -> Vec3 {
    // Stretch to the hemisphere, draw from the cap of its visible reflections, halve, and stretch back.
    let wo_std = Vec3::new(alpha * wo.x, alpha * wo.y, wo.z).normalize();
    let z = (1.0 - u.x) * (1.0 + wo_std.z) - wo_std.z;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin_phi, cos_phi) = float::sin_cos(TAU * u.y);
    let h_std = Vec3::new(r * cos_phi, r * sin_phi, z) + wo_std;
    Vec3::new(alpha * h_std.x, alpha * h_std.y, h_std.z).normalize_or(Vec3::Z)
}
