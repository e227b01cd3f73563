//! The ground boundary between two clear media: microfacets that reflect and refract (Walter et al. 2007), with the
//! visible normals and the masking of the metals, and what light does that meets several facets: it leaves on either side
//! by lobes like those of Kulla & Conty 2017, which give back what single scattering loses.

use super::conductor::{distribution, sample_visible_normal, visibility, visible};
use super::dielectric::fresnel_dielectric;
use super::ground::Facets;
use super::lobe::LobeSample;
use super::{Side, Transport};
use crate::math::{Rgb, Vec2, Vec3, warp};
use std::f32::consts::FRAC_1_PI;

/// A ground boundary.
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
        let (single, pdf) = self.eval_pdf_single(wo, wi, eta);
        let several = Several::new(self.alpha, eta);
        let lost = several.lost(wo.z);
        if lost == 0.0 {
            return (single, pdf);
        }
        let (value, pdf_several) = several.eval_pdf(wi, lost);
        let color = if wi.z > 0.0 { Rgb::WHITE } else { self.tint };
        (single + color * (self.share * value), pdf * (1.0 - lost) + pdf_several * lost)
    }

    /// The same of light that meets one facet.
    fn eval_pdf_single(&self, wo: Vec3, wi: Vec3, eta: f64) -> (Rgb, f32) {
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

    /// Draws a direction after one facet, or after several.
    pub(super) fn sample(
        &self,
        wo: Vec3,
        side: Side,
        mut u: Vec2,
        u_choice: f32,
        transport: Transport,
    ) -> Option<LobeSample> {
        let eta = side.eta(self.ior);
        let several = Several::new(self.alpha, eta);
        let lost = several.lost(wo.z);
        if lost == 0.0 {
            return self.sample_single(wo, eta, u, u_choice, transport);
        }
        let wi = if u.x < lost {
            several.sample(Vec2::new(u.x / lost, u.y), u_choice)
        } else {
            u.x = ((u.x - lost) / (1.0 - lost)).min(super::ONE_MINUS);
            self.sample_single(wo, eta, u, u_choice, transport)?.wi
        };
        let (value, pdf) = self.eval_pdf(wo, wi, side);
        // The value is that of radiance.
        let (through, eta) = (wi.z < 0.0, eta as f32);
        let scale = if through { transport.refracted(eta) * eta * eta } else { 1.0 };
        (pdf > 0.0).then(|| LobeSample {
            through,
            enters: through,
            eta: if through { eta } else { 1.0 },
            ..LobeSample::smooth(wi, value * (scale / pdf), pdf)
        })
    }

    /// Draws a visible normal, then reflects about it with the probability of Fresnel's equations, or refracts.
    fn sample_single(
        &self,
        wo: Vec3,
        eta: f64,
        u: Vec2,
        u_choice: f32,
        transport: Transport,
    ) -> Option<LobeSample> {
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

/// Light that meets several facets, seen from one side. Nothing is absorbed: what one facet does not send on, 1 − E, all
/// leaves, a share T of it on the far side.
///
/// Reflected it is (1 − T) (1 − E(o)) (1 − E(i)) / (π (1 − Ē)), refracted T (1 − E(o)) (1 − E′(i)) / (π (1 − Ē′)), with E′ that
/// of the far side. So that light goes both ways alike, T (1 − Ē) = η² T′ (1 − Ē′); that of a matt boundary, 1 − F̄, is
/// shared out accordingly (Kulla & Conty 2017).
struct Several {
    here: Facets,
    beyond: Facets,
    /// 1 − Ē on both sides.
    lost_here: f32,
    lost_beyond: f32,
    /// T.
    refracted: f32,
    eta: f32,
}

impl Several {
    /// `eta` is the refractive index beyond the boundary over that on this side.
    fn new(alpha: f32, eta: f64) -> Self {
        let eta = eta as f32;
        let (here, beyond) = (Facets::new(alpha, eta), Facets::new(alpha, 1.0 / eta));
        let (lost_here, lost_beyond) = (here.lost_on_average(), beyond.lost_on_average());
        let share = lost_beyond / lost_here.max(lost_beyond).max(f32::MIN_POSITIVE);
        let refracted = share * (1.0 - average_reflectance(eta));
        Self { here, beyond, lost_here, lost_beyond, refracted, eta }
    }

    /// What meets several facets, seen at an angle; 0 where that is too little to matter.
    fn lost(&self, cos: f32) -> f32 {
        /// Below this mean loss the lobes for several facets are left out.
        const NEGLIGIBLE: f32 = 1e-4;
        if self.lost_here.min(self.lost_beyond) < NEGLIGIBLE { 0.0 } else { self.here.lost(cos) }
    }

    /// Value of radiance times `|cos θi|`, and density of what [`Self::sample`] draws.
    fn eval_pdf(&self, wi: Vec3, lost: f32) -> (f32, f32) {
        let cosine = wi.z.abs() * FRAC_1_PI;
        if wi.z > 0.0 {
            let reflected = 1.0 - self.refracted;
            (lost * reflected * cosine * self.here.lost(wi.z) / self.lost_here, cosine * reflected)
        } else {
            let flux = lost * self.refracted * cosine * self.beyond.lost(-wi.z) / self.lost_beyond;
            (flux / (self.eta * self.eta), cosine * self.refracted)
        }
    }

    /// Draws a direction on either side.
    fn sample(&self, u: Vec2, u_choice: f32) -> Vec3 {
        let w = warp::square_to_cosine_hemisphere(u);
        if u_choice < self.refracted { Vec3::new(w.x, w.y, -w.z) } else { w }
    }
}

/// Fresnel's reflectance of light from everywhere, 2 ∫ F(μ) μ dμ: a fit from the thinner side (Kulla & Conty 2017), and from
/// there by what light from within cannot leave (Egan & Hilgeman 1979).
fn average_reflectance(eta: f32) -> f32 {
    let from_thinner = |eta: f32| (eta - 1.0) / (4.085_67 + 1.000_71 * eta);
    if eta >= 1.0 { from_thinner(eta) } else { 1.0 - (1.0 - from_thinner(1.0 / eta)) * (eta * eta) }
}
