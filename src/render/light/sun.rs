//! A disc at infinity.

use crate::math::{Frame, Rgb, Vec2, Vec3, float};
use std::f32::consts::TAU;

/// The sun: a disc of one radiance, infinitely far away.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Sun {
    /// The unit direction to its middle.
    pub direction: Vec3,
    /// The square of the sine of the half-angle under which it is seen; less than 1.
    pub sin2: f64,
    /// In W·m⁻²·sr⁻¹.
    pub radiance: Rgb,
}

impl Sun {
    /// Whether a unit direction meets it: by the sine of the angle between them, which keeps its digits.
    pub fn meets(&self, dir: Vec3) -> bool {
        let (a, b) = (self.direction.as_dvec3(), dir.as_dvec3());
        a.dot(b) > 0.0 && a.cross(b).length_squared() <= self.sin2 * b.length_squared()
    }

    /// The solid angle that it fills, in steradians: 2π(1 − cos), where 1 − cos = sin² / (1 + cos).
    pub fn solid_angle(&self) -> f64 {
        f64::from(TAU) * self.one_minus_cos()
    }

    fn one_minus_cos(&self) -> f64 {
        self.sin2 / (1.0 + (1.0 - self.sin2).sqrt())
    }

    /// A unit direction to a uniform point of it.
    ///
    /// Those at its very rim are drawn a hair inside, so that rounding leaves none outside.
    pub fn sample(&self, u: Vec2) -> Vec3 {
        const INSIDE: f64 = 1.0 - 1e-3;
        let below = f64::from(u.x) * self.one_minus_cos() * INSIDE;
        let sin = (below * (2.0 - below)).sqrt();
        let (sin_phi, cos_phi) = float::sin_cos64(std::f64::consts::TAU * f64::from(u.y));
        let frame = Frame::from_normal(self.direction);
        let (x, y, z) = (frame.x.as_dvec3(), frame.y.as_dvec3(), self.direction.as_dvec3());
        ((x * cos_phi + y * sin_phi) * sin + z * (1.0 - below)).normalize().as_vec3()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_drawn_from_it_meets_it() {
        for sine in [0.00465_f64, 0.0001, 0.3] {
            let direction = Vec3::new(0.3, 0.7, -0.2).normalize();
            let sun = Sun { direction, sin2: sine * sine, radiance: Rgb::WHITE };
            let mut widest = 0.0_f64;
            for i in 0..1_000 {
                let u = Vec2::new(i as f32 / 1_000.0, (i as f32 * 0.618).fract());
                let dir = sun.sample(u);
                assert!(sun.meets(dir));
                widest = widest.max(f64::from(dir.cross(direction).length()));
            }
            assert!(widest > 0.99 * sine && !sun.meets(-direction));
            assert!((sun.solid_angle() / (std::f64::consts::PI * sine * sine) - 1.0).abs() < 0.03);
        }
    }
}
