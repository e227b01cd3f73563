//! How much of the light is reflected, by the angle.

use crate::math::Rgb;
use std::ops::{Add, Mul};

/// Reflectance by angle: F(μ) = F₀ + (F₉₀ − F₀) (1 − μ)⁵ − d μ (1 − μ)⁶.
///
/// The first two terms are those of Schlick 1994, eq. 15. The third is the dip before grazing that metals have
/// (Lazányi & Szirmay-Kalos 2005), set by the reflectance at μ = 1/7, 82° (Kutz, Hašan, Edmondson 2021). All three are
/// linear: what is shared among lobes may be scaled and added.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Reflectance {
    /// Straight on.
    pub f0: Rgb,
    /// Edge-on.
    pub f90: Rgb,
    /// The factor d of the dip.
    pub dip: Rgb,
}

impl Reflectance {
    /// The same at every angle.
    pub fn flat(color: Rgb) -> Self {
        Self { f0: color, f90: color, dip: Rgb::BLACK }
    }

    /// A clear boundary: that of Schlick with F₀ = ((η − 1) / (η + 1))², white.
    pub fn of_ior(eta: f32) -> Self {
        let root = (eta - 1.0) / (eta + 1.0);
        Self { f0: Rgb::gray(root * root), f90: Rgb::WHITE, dip: Rgb::BLACK }
    }

    /// A metal that reflects `f0` straight on, everything edge-on, and at 82° `edge` of what the first two alone would
    /// make there; both in [0, 1].
    pub fn metal(f0: Rgb, edge: Rgb) -> Self {
        /// μ (1 − μ)⁶ at 1/7.
        const AT_82: f32 = 46_656.0 / 823_543.0;
        let plain = Self { f0, f90: Rgb::WHITE, dip: Rgb::BLACK };
        let missing = Rgb::WHITE - edge;
        Self { dip: plain.at(1.0 / 7.0) * missing / AT_82, ..plain }
    }

    /// The share reflected where the cosine of the angle is `cos`, in [0, 1].
    pub fn at(&self, cos: f32) -> Rgb {
        let m = (1.0 - cos).max(0.0);
        let m2 = m * m;
        let m5 = m2 * m2 * m;
        let plain = self.f0.lerp(self.f90, m5);
        // Most have no dip, and rounding must not leave less than nothing of the others.
        if self.dip.is_black() { plain } else { (plain - self.dip * (cos * m5 * m)).map(|x| x.max(0.0)) }
    }

    /// The mean over the hemisphere, weighted by the cosine: 2 ∫ F(μ) μ dμ.
    pub fn average(&self) -> Rgb {
        self.f0.lerp(self.f90, 1.0 / 21.0) - self.dip * (1.0 / 126.0)
    }

    /// Whether nothing is reflected at any angle.
    pub fn is_black(&self) -> bool {
        self.f0.is_black() && self.f90.is_black()
    }
}

impl Mul<f32> for Reflectance {
    type Output = Self;

    fn mul(self, share: f32) -> Self {
        Self { f0: self.f0 * share, f90: self.f90 * share, dip: self.dip * share }
    }
}

impl Add for Reflectance {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { f0: self.f0 + other.f0, f90: self.f90 + other.f90, dip: self.dip + other.dip }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_metal_reflects_what_was_asked_for_at_its_three_angles() {
        let (f0, edge) = (Rgb::new(0.9, 0.6, 0.3), Rgb::new(1.0, 0.9, 0.8));
        let metal = Reflectance::metal(f0, edge);
        let plain = Reflectance::metal(f0, Rgb::WHITE);
        assert_eq!(metal.at(1.0), f0);
        assert_eq!(metal.at(0.0), Rgb::WHITE);
        for channel in 0..3 {
            let ratio = metal.at(1.0 / 7.0)[channel] / plain.at(1.0 / 7.0)[channel];
            assert!((ratio - edge[channel]).abs() < 1e-5, "{ratio}");
        }
    }

    #[test]
    fn the_average_is_that_of_all_angles() {
        let metal = Reflectance::metal(Rgb::new(0.9, 0.6, 0.3), Rgb::new(1.0, 0.9, 0.8));
        let n = 1_000;
        let angles = (0..n).map(|i| (i as f32 + 0.5) / n as f32);
        let sum = angles.fold(Rgb::BLACK, |sum, mu| sum + metal.at(mu) * (2.0 * mu / n as f32));
        for channel in 0..3 {
            assert!((sum[channel] - metal.average()[channel]).abs() < 1e-4, "{sum:?}");
        }
    }
}
