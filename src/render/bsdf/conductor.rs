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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distribution_keeps_its_digits_at_every_width() {
        for alpha in [1e-4_f32, 1e-3, 1e-2, 0.1, 0.5, 1.0] {
            for i in 0..1_000 {
                // Normals as they are drawn: tan θ up to thirty times the width.
                let tan = alpha * 30.0 * i as f32 / 1_000.0;
                let h = Vec3::new(tan * 0.6, tan * 0.8, 1.0).normalize();
                let [x, y, z] = h.as_dvec3().to_array();
                let a2 = f64::from(alpha) * f64::from(alpha);
                let s = (x * x + y * y) / a2 + z * z;
                let expected = 1.0 / (std::f64::consts::PI * a2 * s * s);
                let error = f64::from(distribution(alpha, h)) / expected - 1.0;
                assert!(error.abs() < 1e-6, "alpha {alpha}, tan {tan}: {error}");
            }
        }
    }

    #[test]
    fn visible_normals_face_the_viewer() {
        for alpha in [1e-3, 0.1, 1.0] {
            for cos in [1.0_f32, 0.3, 1e-3, 1e-6] {
                let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
                for i in 0..1_000 {
                    let u = Vec2::new(i as f32 / 1_000.0, (i as f32 * 0.618_034).fract());
                    let h = sample_visible_normal(alpha, wo, u);
                    assert!(h.is_normalized() && h.z >= 0.0 && wo.dot(h) >= -1e-6, "{alpha} {cos}: {h}");
                }
            }
        }
    }
}
