//! Rays.

use super::Vec3;

/// A half-line, or the open segment (0, `t_max`) of one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ray {
    /// The origin, in metres.
    pub o: Vec3,
    /// The direction; `t` counts in its lengths. Not necessarily a unit vector.
    pub d: Vec3,
    /// Hits at `t ≥ t_max` do not count.
    pub t_max: f32,
}

impl Ray {
    /// The half-line from `o` along `d`.
    pub const fn new(o: Vec3, d: Vec3) -> Self {
        Self { o, d, t_max: f32::INFINITY }
    }

    /// The point at parameter `t`.
    pub fn at(&self, t: f32) -> Vec3 {
        self.o + self.d * t
    }
}
