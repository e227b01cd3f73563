//! Cones of directions, for what a group of lights may send where.

use crate::math::{Vec3, float};
use std::f32::consts::PI;

/// The directions within an angle of an axis.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Cone {
    /// A unit vector.
    pub axis: Vec3,
    /// The cosine of the angle; −1 for all directions.
    pub cos: f32,
}

impl Cone {
    /// All directions.
    pub const ALL: Self = Self { axis: Vec3::Z, cos: -1.0 };

    /// One direction, a unit vector.
    pub fn around(axis: Vec3) -> Self {
        Self { axis, cos: 1.0 }
    }

    /// The angle between axis and edge, in radians.
    pub fn angle(&self) -> f32 {
        float::acos(self.cos)
    }

    /// A cone that holds both (Pharr, Jakob, Humphreys 2023, section 3.8.4).
    pub fn union(self, other: Self) -> Self {
        let (a, b) = (self.angle(), other.angle());
        let between = float::acos(self.axis.dot(other.axis));
        if (between + b).min(PI) <= a {
            return self;
        }
        if (between + a).min(PI) <= b {
            return other;
        }
        // From the far edge of one to the far edge of the other; its axis lies on the arc between theirs.
        let angle = (a + between + b) / 2.0;
        let Some(side) = self.axis.cross(other.axis).try_normalize() else { return Self::ALL };
        if angle >= PI {
            return Self::ALL;
        }
        let (sin, cos) = float::sin_cos(angle - a);
        let axis = self.axis * cos + side.cross(self.axis) * sin;
        Self { axis: axis.normalize(), cos: float::sin_cos(angle).1 }
    }
}

/// The cosine of the angle a − b, and 1 where b is the larger; from the sines and cosines of both, in [0, π].
pub fn cos_less(sin_a: f32, cos_a: f32, sin_b: f32, cos_b: f32) -> f32 {
    if cos_a > cos_b { 1.0 } else { cos_a * cos_b + sin_a * sin_b }
}

/// The sine of the angle a − b, and 0 where b is the larger.
pub fn sin_less(sin_a: f32, cos_a: f32, sin_b: f32, cos_b: f32) -> f32 {
    if cos_a > cos_b { 0.0 } else { sin_a * cos_b - cos_a * sin_b }
}

/// The sine of an angle in [0, π] from its cosine.
pub fn sin_of(cos: f32) -> f32 {
    (1.0 - cos * cos).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::warp;
    use crate::render::sampler::{Dim, Sampler};

    #[test]
    fn a_union_holds_the_edges_of_both() {
        for i in 0..2_000 {
            let sampler = Sampler::new(1, 0, i, 0);
            let draw = |k| {
                let axis = warp::square_to_uniform_sphere(sampler.get_2d(Dim::Bsdf(k)));
                Cone { axis, cos: 1.0 - 2.0 * sampler.get_1d(Dim::Lobe(k)).powi(2) }
            };
            let (a, b) = (draw(0), draw(1));
            let union = a.union(b);
            for cone in [a, b] {
                let farthest = (float::acos(union.axis.dot(cone.axis)) + cone.angle()).min(PI);
                assert!(farthest <= union.angle() + 2e-3, "{a:?} and {b:?} in {union:?}");
            }
        }
    }
}
