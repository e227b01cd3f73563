//! A pane of glass too thin to shift what is seen through it: light is reflected, or goes on in its own direction.

use super::conductor::{MIRROR_ALPHA, distribution, sample_visible_normal, visibility, visible};
use super::dielectric::fresnel_dielectric;
use super::lobe::LobeSample;
use super::mirror::reflect;
use crate::math::{Rgb, Vec2, Vec3};

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
        (
            color * (self.share * d * visibility(self.alpha, wo.z, above.z) * above.z),
            d * visible(self.alpha, wo.z),
        )
    }

    /// Draws a visible normal if the pane is rough, then reflects or passes.
    pub(super) fn sample(&self, wo: Vec3, u: Vec2, u_choice: f32) -> Option<LobeSample> {
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
