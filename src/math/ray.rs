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
    /// When it is under way: the share of the time the shutter is open that has gone by, in [0, 1).
    pub time: f32,
    /// The width of what it stands for, at its origin, in metres; 0 of a line.
    pub width: f32,
    /// By how much that grows for each metre.
    pub angle: f32,
}

impl Ray {
    /// The half-line from `o` along `d`, at the moment when the shutter opens.
    pub const fn new(o: Vec3, d: Vec3) -> Self {
        Self { o, d, t_max: f32::INFINITY, time: 0.0, width: 0.0, angle: 0.0 }
    }

    /// The same ray at another time.
    #[must_use]
    pub const fn at_time(self, time: f32) -> Self {
        Self { time, ..self }
    }

    /// The same ray as a cone, of this width at its origin and so much more for each metre (Akenine-Möller et al. 2021).
    #[must_use]
    pub const fn as_cone(self, width: f32, angle: f32) -> Self {
        Self { width, angle, ..self }
    }

    /// The point at parameter `t`.
    pub fn at(&self, t: f32) -> Vec3 {
        self.o + self.d * t
    }
}
