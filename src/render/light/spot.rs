//! A lamp in a shade: shines from a point into a cone, and fades towards its edge.

use super::{EmissionSample, Falloff, LightEnd, LightSample};
use crate::math::{Frame, Ray, Rgb, Vec2, Vec3, float};
use std::f32::consts::{PI, TAU};

/// A light that shines from one point into a cone.
///
/// In the inner cone the intensity is constant; from there to the outer one it falls to 0 as 3x² − 2x³ of the cosine.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Spot {
    /// Where, in metres.
    pub p: Vec3,
    /// The unit direction in which the middle of its light travels.
    pub axis: Vec3,
    /// The cosine of the half-angle where it begins to fade.
    pub cos_inner: f32,
    /// The cosine of the half-angle where it is dark; less than `cos_inner`, or the same for a hard edge.
    pub cos_outer: f32,
    /// Radiant intensity in the inner cone, in W·sr⁻¹.
    pub intensity: Rgb,
    /// How it fades with the distance.
    pub falloff: Falloff,
}

impl Spot {
    /// The share of the intensity in a unit direction.
    pub fn share(&self, dir: Vec3) -> f32 {
        let cos = dir.dot(self.axis);
        if cos >= self.cos_inner {
            return 1.0;
        }
        let x = ((cos - self.cos_outer) / (self.cos_inner - self.cos_outer)).clamp(0.0, 1.0);
        if cos <= self.cos_outer { 0.0 } else { x * x * (3.0 - 2.0 * x) }
    }

    /// The power, in watts: 2π·I·((1 − cᵢ) + (cᵢ − cₒ)/2), for the fading part has the mean 1/2.
    pub fn power(&self) -> Rgb {
        self.intensity * (TAU * (1.0 - 0.5 * (self.cos_inner + self.cos_outer)))
    }

    /// The direction in which `from` sees it; `None` outside of the cone.
    pub(super) fn sample_li(&self, from: Vec3) -> Option<LightSample> {
        let to = self.p - from;
        let distance = to.length();
        let wi = to.try_normalize()?;
        let share = self.share(-wi);
        let end = LightEnd::At { p: self.p, p_error: Vec3::ZERO, n: Vec3::ZERO, distance };
        let radiance = self.intensity * (share / self.falloff.divisor(distance));
        (share > 0.0).then_some(LightSample { wi, radiance, pdf: 1.0, delta: true, end, prim: None })
    }

    /// A ray that leaves it, uniform in the outer cone.
    pub(super) fn sample_emission(&self, u: Vec2) -> EmissionSample {
        let below = u.x * (1.0 - self.cos_outer);
        let sin = (below * (2.0 - below)).max(0.0).sqrt();
        let (sin_phi, cos_phi) = float::sin_cos(TAU * u.y);
        let local = Vec3::new(sin * cos_phi, sin * sin_phi, 1.0 - below);
        let dir = Frame::from_normal(self.axis).to_world(local).normalize();
        let angle = 2.0 * PI * (1.0 - self.cos_outer);
        EmissionSample { ray: Ray::new(self.p, dir), weight: self.intensity * (self.share(dir) * angle) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn photons_carry_its_power() {
        for (cos_inner, cos_outer) in [(0.9, 0.7), (0.5, 0.5), (0.3, -0.2), (1.0, 0.999)] {
            let (p, axis) = (Vec3::ONE, Vec3::new(0.6, -0.8, 0.0));
            let intensity = Rgb::gray(3.0);
            let spot = Spot { p, axis, cos_inner, cos_outer, intensity, falloff: Falloff::PHYSICAL };
            let n = 128;
            let weights = (0..n * n).map(|i| {
                let u = Vec2::new((i % n) as f32 + 0.5, (i / n) as f32 + 0.5) / n as f32;
                f64::from(spot.sample_emission(u).weight.r)
            });
            let (mean, power) = (weights.sum::<f64>() / f64::from(n * n), f64::from(spot.power().r));
            assert!((mean / power - 1.0).abs() < 1e-3, "{mean} is not {power}");
        }
    }

    #[test]
    fn it_is_dark_outside_of_its_cone_and_fades_at_the_edge() {
        let axis = Vec3::NEG_Y;
        let (intensity, falloff) = (Rgb::WHITE, Falloff::PHYSICAL);
        let spot = Spot { p: Vec3::Y * 2.0, axis, cos_inner: 0.9, cos_outer: 0.8, intensity, falloff };
        assert_eq!(spot.sample_li(Vec3::ZERO).expect("straight below").radiance, Rgb::gray(0.25));
        assert!(spot.sample_li(Vec3::new(2.0, 0.0, 0.0)).is_none());
        assert!(spot.sample_li(Vec3::Y * 3.0).is_none());
        let at = |cos: f32| spot.share(Vec3::new((1.0 - cos * cos).sqrt(), -cos, 0.0));
        assert!((at(0.85) - 0.5).abs() < 1e-5 && at(0.89) > at(0.81) && at(0.79) == 0.0);
    }
}
