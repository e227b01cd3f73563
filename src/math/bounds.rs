//! Axis-aligned boxes.

use super::Vec3;

/// An axis-aligned box; empty when `min > max` in some axis.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bounds {
    /// The lowest corner.
    pub min: Vec3,
    /// The highest corner.
    pub max: Vec3,
}

impl Bounds {
    /// The box that holds nothing.
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// The box between two corners.
    pub const fn new(min: Vec3, max: Vec3) -> Self {
        Self { min, max }
    }

    /// The smallest box that holds all points.
    pub fn of(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, Self::grow)
    }

    /// The smallest box that holds this one and a point.
    #[must_use]
    pub fn grow(self, p: Vec3) -> Self {
        Self::new(self.min.min(p), self.max.max(p))
    }

    /// The smallest box that holds both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self::new(self.min.min(other.min), self.max.max(other.max))
    }

    /// Whether the box holds no point.
    pub fn is_empty(self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// Edge lengths; negative where empty.
    pub fn size(self) -> Vec3 {
        self.max - self.min
    }

    /// The middle.
    pub fn center(self) -> Vec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// The radius of the sphere about the centre that holds the box; 0 when empty.
    pub fn radius(self) -> f32 {
        if self.is_empty() { 0.0 } else { self.size().length() * 0.5 }
    }
}
