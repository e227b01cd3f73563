//! Axis-aligned boxes.

use super::{DVec3, Vec3};

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

    /// The smallest single-precision box that holds the box between two corners in double precision.
    pub fn enclosing(min: DVec3, max: DVec3) -> Self {
        let down = |x: f64| if f64::from(x as f32) > x { (x as f32).next_down() } else { x as f32 };
        let up = |x: f64| if f64::from(x as f32) < x { (x as f32).next_up() } else { x as f32 };
        Self::new(
            Vec3::new(down(min.x), down(min.y), down(min.z)),
            Vec3::new(up(max.x), up(max.y), up(max.z)),
        )
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

    /// What both hold.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        Self::new(self.min.max(other.min), self.max.min(other.max))
    }

    /// The parts below and above a plane orthogonal to `axis`, which cuts the box.
    pub fn split(self, axis: usize, position: f32) -> [Self; 2] {
        let (mut low, mut high) = (self, self);
        low.max[axis] = position;
        high.min[axis] = position;
        [low, high]
    }

    /// Whether the box holds no point.
    pub fn is_empty(self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// Half of the surface area, in double precision; 0 when empty.
    pub fn half_area(self) -> f64 {
        let s = self.size().max(Vec3::ZERO).as_dvec3();
        if self.is_empty() { 0.0 } else { s.x * s.y + s.y * s.z + s.z * s.x }
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
