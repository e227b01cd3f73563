//! How fine a texture is: what differences in it are taken over.

use crate::math::Vec2;

/// The size of the finest features of a texture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Detail {
    /// In texture space; infinite where it does not matter.
    pub uv: f32,
    /// In object space, in metres; infinite where it does not matter.
    pub space: f32,
}

impl Detail {
    /// A texture that is the same everywhere.
    pub const NONE: Self = Self { uv: f32::INFINITY, space: f32::INFINITY };

    /// Details in texture space.
    pub fn of_uv(size: Vec2) -> Self {
        Self { uv: size.abs().min_element(), ..Self::NONE }
    }

    /// Details in object space.
    pub fn of_space(size: f32) -> Self {
        Self { space: size, ..Self::NONE }
    }

    /// The finer of two.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self { uv: self.uv.min(other.uv), space: self.space.min(other.space) }
    }
}
