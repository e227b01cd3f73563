//! Rough metal: microfacets of the GGX distribution (Walter et al. 2007), height-correlated masking and shadowing
//! (Heitz 2014), visible normals drawn by spherical caps (Dupuy & Benyoub 2023), and what light does that meets several
//! facets: it leaves by the lobe of Kulla & Conty 2017, which gives back what single scattering loses.

use super::albedo;
use super::fresnel::Reflectance;
use super::lobe::LobeSample;
use crate::math::{Rgb, Vec2, Vec3, float, warp};
use std::f32::consts::{FRAC_1_PI, PI, TAU};

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
pub(super) fn visibility(alpha: f32, cos_o: f32, cos_i: f32) -> f32 {
    0.5 / (cos_o * root(alpha, cos_i) + cos_i * root(alpha, cos_o))
}

/// G₁(wo) / (4 cos θo): times D this is the density of reflected visible normals.
pub(super) fn visible(alpha: f32, cos_o: f32) -> f32 {
    0.5 / (cos_o + root(alpha, cos_o))
}

/// A rough surface that reflects.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Conductor {
    /// Of each facet.
    pub reflectance: Reflectance,
    /// The width of the distribution of slopes, at least [`MIRROR_ALPHA`].
    pub alpha: f32,
    /// The share of what one bounce loses that more bounces bring back.
    regained: Rgb,
    /// 1 − the mean of E over the hemisphere: what one bounce loses on average.
    lost: f32,
}

impl Conductor {
    /// Metal, which keeps for itself what its facets do not reflect. It is `share` of the material.
    pub fn metal(reflectance: Reflectance, alpha: f32, share: f32) -> Self {
        // After the first bounce the rest stays between the facets: each further one reflects F̄, and Ē of that leaves
        // (Kulla & Conty 2017, with the first bounce's F̄ of Fdez-Agüera 2019).
        let (back, average) = (albedo::average(alpha).all, reflectance.average());
        let regained = average.map(|f| f * f * back / (1.0 - f * (1.0 - back)));
        Self { reflectance: reflectance * share, alpha, regained: regained * share, lost: 1.0 - back }
    }

    /// The outside of something clear: what is not reflected goes in, for another lobe.
    pub fn coat(reflectance: Reflectance, alpha: f32, share: f32) -> Self {
        Self { reflectance: reflectance * share, alpha, regained: Rgb::BLACK, lost: 0.0 }
    }

    /// About how much light is reflected, seen at an angle.
    pub fn albedo(&self, cos: f32) -> f32 {
        self.reflectance.at(cos).mean()
    }

    /// Value times `cos θi`, and density, per steradian.
    pub(super) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Rgb, f32) {
        let Some(h) = (wo + wi).try_normalize() else { return (Rgb::BLACK, 0.0) };
        let d = distribution(self.alpha, h);
        let single = self.reflectance.at(wo.dot(h)) * (d * visibility(self.alpha, wo.z, wi.z) * wi.z);
        let pdf = d * visible(self.alpha, wo.z);
        let lost = self.lost_from(wo.z);
        let share = self.share_of_several(wo.z, lost);
        if share == 0.0 {
            return (single, pdf);
        }
        // (1 − E(o)) (1 − E(i)) / (π (1 − Ē)).
        let several = self.regained * (lost * self.lost_from(wi.z) / self.lost);
        let cosine = wi.z * FRAC_1_PI;
        (single + several * cosine, share * cosine + (1.0 - share) * pdf)
    }

    /// Draws a visible normal and reflects about it, or a direction for light after several bounces; `None` below the
    /// horizon.
    pub(super) fn sample(&self, wo: Vec3, mut u: Vec2) -> Option<LobeSample> {
        let share = self.share_of_several(wo.z, self.lost_from(wo.z));
        if share > 0.0 {
            let wi = if u.x < share {
                warp::square_to_cosine_hemisphere(Vec2::new(u.x / share, u.y))
            } else {
                u.x = ((u.x - share) / (1.0 - share)).min(super::ONE_MINUS);
                let h = sample_visible_normal(self.alpha, wo, u);
                h * (2.0 * wo.dot(h)) - wo
            };
            let (value, pdf) = if wi.z > 0.0 { self.eval_pdf(wo, wi) } else { (Rgb::BLACK, 0.0) };
            return (pdf > 0.0).then(|| LobeSample::smooth(wi, value / pdf, pdf));
        }
        let h = sample_visible_normal(self.alpha, wo, u);
        let wi = h * (2.0 * wo.dot(h)) - wo;
        if wi.z <= 0.0 {
            return None;
        }
        let pdf = distribution(self.alpha, h) * visible(self.alpha, wo.z);
        let masking = visibility(self.alpha, wo.z, wi.z) * wi.z / visible(self.alpha, wo.z);
        Some(LobeSample::smooth(wi, self.reflectance.at(wo.dot(h)) * masking, pdf))
    }

    /// What one bounce loses, 1 − E; 0 where that is too little to matter.
    fn lost_from(&self, cos: f32) -> f32 {
        /// Below this mean loss the lobe for more bounces is left out.
        const NEGLIGIBLE: f32 = 1e-6;
        if self.lost < NEGLIGIBLE { 0.0 } else { (1.0 - albedo::directional(self.alpha, cos).all).max(0.0) }
    }

    /// The chance of drawing a direction for light after several bounces.
    fn share_of_several(&self, cos: f32, lost: f32) -> f32 {
        let several = self.regained.mean() * lost;
        if several > 0.0 { several / (several + self.albedo(cos) * (1.0 - lost)) } else { 0.0 }
    }
}

/// A microfacet normal, in proportion to its area seen from `wo` (Dupuy & Benyoub 2023, listing 3).
pub(super) fn sample_visible_normal(alpha: f32, wo: Vec3, u: Vec2) -> Vec3 {
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
