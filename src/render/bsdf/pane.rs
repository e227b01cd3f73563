//! A pane of glass too thin to shift what is seen through it: light is reflected, or goes on in its own direction.

use super::albedo;
use super::conductor::{MIRROR_ALPHA, distribution, sample_visible_normal, visibility, visible};
use super::dielectric::fresnel_dielectric;
use super::lobe::LobeSample;
use super::mirror::reflect;
use crate::math::{Rgb, Vec2, Vec3, warp};
use std::f32::consts::FRAC_1_PI;

/// Both surfaces of a pane as one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pane {
    /// Its share among the lobes.
    pub share: f32,
    /// The refractive index of the glass, relative to what is around.
    pub ior: f32,
    /// The factor of light that passes.
    pub tint: Rgb,
    /// The width of the distribution of slopes; below the threshold of mirrors the pane is smooth.
    pub alpha: f32,
}

impl Pane {
    /// Whether it scatters into two directions only.
    pub fn is_specular(&self) -> bool {
        self.alpha < MIRROR_ALPHA
    }

    /// The share reflected, off the one side or the other of the glass however often: 2R / (1 + R), the sum of
    /// R + T² R + T² R³ + … with T = 1 − R (Stokes 1862).
    pub(super) fn reflected(&self, cos: f32) -> f32 {
        let (once, _) = fresnel_dielectric(f64::from(cos), f64::from(self.ior));
        (2.0 * once / (1.0 + once)) as f32
    }

    /// Value times `|cos θi|`, and density: that of a rough mirror, and for light that passes the same turned through.
    pub(super) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Rgb, f32) {
        let above = Vec3::new(wi.x, wi.y, wi.z.abs());
        if self.is_specular() {
            return (Rgb::BLACK, 0.0);
        }
        let Some(h) = (wo + above).try_normalize() else { return (Rgb::BLACK, 0.0) };
        let reflected = self.reflected(wo.dot(h));
        let (part, color) = if wi.z > 0.0 { (reflected, Rgb::WHITE) } else { (1.0 - reflected, self.tint) };
        let d = distribution(self.alpha, h) * part;
        let single = d * visibility(self.alpha, wo.z, above.z) * above.z;
        // (1 − E(o)) (1 − E(i)) / (π (1 − Ē)): after several facets all of it leaves, on either side (Kulla & Conty 2017).
        let lost = self.lost(wo.z);
        let part = if wi.z > 0.0 { self.reflected_on_average() } else { 1.0 - self.reflected_on_average() };
        let cosine = above.z * FRAC_1_PI * part * lost;
        let several = if lost > 0.0 { cosine * self.lost(above.z) / self.lost_on_average() } else { 0.0 };
        (color * (self.share * (single + several)), d * visible(self.alpha, wo.z) * (1.0 - lost) + cosine)
    }

    /// What one facet does not send on, seen at an angle; 0 where that is too little to matter.
    fn lost(&self, cos: f32) -> f32 {
        /// Below this mean loss the lobes for several facets are left out.
        const NEGLIGIBLE: f32 = 1e-6;
        if self.lost_on_average() < NEGLIGIBLE {
            return 0.0;
        }
        (1.0 - albedo::directional(self.alpha, cos).all).max(0.0)
    }

    fn lost_on_average(&self) -> f32 {
        1.0 - albedo::average(self.alpha).all
    }

    /// The share reflected of light from everywhere: about that of a slanted ray, 2 ∫ F(μ) μ dμ having half its weight
    /// below μ = 1/√2.
    fn reflected_on_average(&self) -> f32 {
        self.reflected(std::f32::consts::FRAC_1_SQRT_2)
    }

    /// Draws a direction after one facet, or after several.
    pub(super) fn sample(&self, wo: Vec3, mut u: Vec2, u_choice: f32) -> Option<LobeSample> {
        let lost = if self.is_specular() { 0.0 } else { self.lost(wo.z) };
        if lost == 0.0 {
            return self.sample_single(wo, u, u_choice);
        }
        let wi = if u.x < lost {
            let w = warp::square_to_cosine_hemisphere(Vec2::new(u.x / lost, u.y));
            if u_choice < self.reflected_on_average() { w } else { Vec3::new(w.x, w.y, -w.z) }
        } else {
            u.x = ((u.x - lost) / (1.0 - lost)).min(super::ONE_MINUS);
            self.sample_single(wo, u, u_choice)?.wi
        };
        let (value, pdf) = self.eval_pdf(wo, wi);
        (pdf > 0.0).then(|| LobeSample { through: wi.z < 0.0, ..LobeSample::smooth(wi, value / pdf, pdf) })
    }

    /// Draws a visible normal if the pane is rough, then reflects or passes.
    fn sample_single(&self, wo: Vec3, u: Vec2, u_choice: f32) -> Option<LobeSample> {
        let specular = self.is_specular();
        let h = if specular { Vec3::Z } else { sample_visible_normal(self.alpha, wo, u) };
        let cos = wo.dot(h);
        let above = if specular { reflect(wo) } else { h * (2.0 * cos) - wo };
        if above.z <= 0.0 {
            return None;
        }
        let reflected = self.reflected(cos);
        let through = u_choice >= reflected;
        let (wi, color, part) = match through {
            true => (Vec3::new(above.x, above.y, -above.z), self.tint, 1.0 - reflected),
            false => (above, Rgb::WHITE, reflected),
        };
        let (masking, pdf) = match specular {
            true => (1.0, 1.0),
            false => {
                let visible = visible(self.alpha, wo.z);
                let pdf = distribution(self.alpha, h) * visible * part;
                (visibility(self.alpha, wo.z, above.z) * above.z / visible, pdf)
            }
        };
        let sample = LobeSample::smooth(wi, color * (self.share * masking), pdf);
        Some(LobeSample { specular, through, ..sample })
    }
}
