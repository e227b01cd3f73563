//! What a world calls for. An effect that is absent is not simulated: no data, no random numbers, no work.

use std::ops::{BitOr, BitOrAssign};

/// A set of effects that rays may have to ask about.
///
/// Whoever leaves one out promises that it would change no bit of the picture, or means to change the picture. [`Self::ALL`]
/// is always right.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Effects(u16);

impl Effects {
    /// None of them.
    pub const NONE: Self = Self(0);
    /// Cameras with an opening: without, every ray goes through the middle of the lens.
    pub const LENS_BLUR: Self = Self(1);
    /// Surfaces with holes: without, masks are whole.
    pub const ALPHA: Self = Self(1 << 1);
    /// Glass that bends each wavelength in its own way: without, by its index alone.
    pub const DISPERSION: Self = Self(1 << 2);
    /// Glass that darkens light on its way.
    pub const ABSORPTION: Self = Self(1 << 3);
    /// Normals bent by pictures.
    pub const NORMAL_MAPS: Self = Self(1 << 4);
    /// Photons for light that reaches a matt surface by way of something sharp, where the method has any.
    pub const CAUSTICS: Self = Self(1 << 5);
    /// Light that goes on from surfaces which scatter widely: without, only what comes straight from lights does.
    pub const INDIRECT: Self = Self(1 << 6);
    /// Things or a camera that move while the shutter is open: without, all is as when it opens.
    pub const MOTION: Self = Self(1 << 7);
    /// Pictures of which a pixel covers many texels: without, each look takes a point of them.
    pub const TEXTURE_FILTERING: Self = Self(1 << 8);
    /// All of them.
    pub const ALL: Self = Self((1 << 9) - 1);

    /// Whether one of them is among these.
    #[inline]
    pub const fn has(self, effect: Self) -> bool {
        self.0 & effect.0 != 0
    }

    /// These without some.
    #[must_use]
    pub const fn without(self, effects: Self) -> Self {
        Self(self.0 & !effects.0)
    }
}

impl BitOr for Effects {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitOrAssign for Effects {
    fn bitor_assign(&mut self, other: Self) {
        *self = *self | other;
    }
}
