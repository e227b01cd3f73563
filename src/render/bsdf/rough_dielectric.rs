//! The ground boundary between two clear media: microfacets that reflect and refract (Walter et al. 2007), with the
//! visible normals and the masking of the metals.

use super::conductor::{distribution, sample_visible_normal, visibility, visible};
use super::dielectric::fresnel_dielectric;
use super::lobe::LobeSample;
use super::{Side, Transport};
use crate::math::{Rgb, Vec2, Vec3};

/// A ground boundary. What bounces between its facets more than once is lost.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RoughDielectric {
    /// Its share among the lobes.
    pub share: f32,
    /// The refractive index of the side against the normal, relative to the other.
    pub ior: f32,
    /// The factor of light that passes.
    pub tint: Rgb,
    /// The width of the distribution of slopes.
    pub alpha: f32,
}

impl RoughDielectric {
    /// Nearer to 1 than this, an index bends light less than roughness could show: the boundary counts as smooth.
    pub const LEAST_BEND: f32 = 0.01;

    /// Value times `|cos θi|`, and density, per steradian, for `wi` on either side.
    pub(super) fn eval_pdf(&self, wo: Vec3, wi: Vec3, side: Side) -> (Rgb, f32) {
        let eta = side.eta(self.ior);
        if wi.z > 0.0 {
            let Some(h) = (wo + wi).try_normalize() else { return (Rgb::BLACK, 0.0) };
            let (reflectance, _) = fresnel_dielectric(f64::from(wo.dot(h)), eta);
            let d = distribution(self.alpha, h) * reflectance as f32;
            let value = d * visibility(self.alpha, wo.z, wi.z) * wi.z;
            return (Rgb::gray(self.share * value), d * visible(self.alpha, wo.z));
        }
        let eta_single = eta as f32;
        let Some(h) = (wo + wi * eta_single).try_normalize() else { return (Rgb::BLACK, 0.0) };
        let h = if h.z < 0.0 { -h } else { h };
        let (cos_o, cos_i) = (wo.dot(h), wi.dot(h));
        if cos_o <= 0.0 || cos_i >= 0.0 {
            return (Rgb::BLACK, 0.0);
        }
        let (reflectance, _) = fresnel_dielectric(f64::from(cos_o), eta);
        let pdf = self.refracted_pdf(wo.z, h, cos_o, cos_i, eta_single, reflectance as f32);
        let masking = visibility(self.alpha, wo.z, -wi.z) * -wi.z / visible(self.alpha, wo.z);
        (self.tint * (self.share * pdf * masking / (eta_single * eta_single)), pdf)
    }

    /// The density of a refracted direction: that of the visible normal h, (1 − F), and |dh/dwi| (Walter et al. 2007,
    /// eq. 17).
    fn refracted_pdf(&self, z: f32, h: Vec3, cos_o: f32, cos_i: f32, eta: f32, reflectance: f32) -> f32 {
        let bend = cos_o + eta * cos_i;
        let jacobian = eta * eta * -cos_i / (bend * bend);
        4.0 * visible(self.alpha, z) * distribution(self.alpha, h) * cos_o * jacobian * (1.0 - reflectance)
    }

    /// Draws a visible normal, then reflects about it with the probability of Fresnel's equations, or refracts.
    pub(super) fn sample(
        &self,
        wo: Vec3,
        side: Side,
        u: Vec2,
        u_choice: f32,
        transport: Transport,
    ) -> Option<LobeSample> {
        let eta = side.eta(self.ior);
        let h = sample_visible_normal(self.alpha, wo, u);
        let cos_o = wo.dot(h);
        let (reflectance, cos_t) = fresnel_dielectric(f64::from(cos_o), eta);
        let (reflectance, cos_t) = (reflectance as f32, cos_t as f32);
        if u_choice < reflectance {
            let wi = h * (2.0 * cos_o) - wo;
            if wi.z <= 0.0 {
                return None;
            }
            let pdf = distribution(self.alpha, h) * visible(self.alpha, wo.z) * reflectance;
            let masking = visibility(self.alpha, wo.z, wi.z) * wi.z / visible(self.alpha, wo.z);
            return Some(LobeSample::smooth(wi, Rgb::gray(self.share * masking), pdf));
        }
        let eta = eta as f32;
        let wi = (h * (cos_o / eta - cos_t) - wo / eta).normalize();
        if wi.z >= 0.0 {
            return None;
        }
        let pdf = self.refracted_pdf(wo.z, h, cos_o, -cos_t, eta, reflectance);
        let masking = visibility(self.alpha, wo.z, -wi.z) * -wi.z / visible(self.alpha, wo.z);
        let weight = self.tint * (self.share * masking * transport.refracted(eta));
        (pdf > 0.0).then_some(LobeSample {
            through: true,
            enters: true,
            eta,
            ..LobeSample::smooth(wi, weight, pdf)
        })
    }
}
