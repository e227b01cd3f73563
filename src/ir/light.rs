//! Lights that are not objects with an emissive material.

use super::{Handle, Texture};
use crate::math::{DVec3, Rgb};
use crate::source::{Span, Spanned};

/// A light.
#[derive(Clone, PartialEq, Debug)]
pub struct Light {
    /// Which, in world space: the transforms around it are applied.
    pub kind: LightKind,
    /// How bright.
    pub brightness: Spanned<Brightness>,
    /// Its colour, linear; scaled by the brightness.
    pub color: Rgb,
    /// Its block.
    pub span: Span,
    /// Who put it there: `place`s, groups, calls, innermost first.
    pub trail: Vec<Span>,
}

/// The kinds of lights.
#[derive(Clone, PartialEq, Debug)]
pub enum LightKind {
    /// From a point, all around.
    Point {
        /// Where.
        position: DVec3,
        /// The a, b and c of the divisor a + b·d + c·d² at a distance of d metres.
        falloff: Spanned<[f64; 3]>,
    },
    /// A glowing ball.
    Sphere {
        /// Its centre.
        center: DVec3,
        /// Its radius in metres.
        radius: Spanned<f64>,
    },
    /// A glowing parallelogram, to the side of `edge_u × edge_v`.
    Rect {
        /// A corner.
        origin: DVec3,
        /// One edge.
        edge_u: DVec3,
        /// The other.
        edge_v: DVec3,
        /// Whether both sides shine.
        two_sided: bool,
    },
    /// From infinitely far away.
    Directional {
        /// The way the light travels.
        direction: Spanned<DVec3>,
    },
}

impl LightKind {
    /// As light fades: by the square of the distance.
    pub const PHYSICAL: [f64; 3] = [0.0, 0.0, 1.0];
}

/// How bright a light is; each is multiplied by its colour.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Brightness {
    /// Watts, luminance-weighted (1 W = 683 lm): the colour is divided by its luminance first.
    Power(f64),
    /// W·m⁻²·sr⁻¹ per channel.
    Radiance(Rgb),
    /// W·sr⁻¹ per channel, for point lights.
    Intensity(Rgb),
    /// W·m⁻² on a surface that faces the light, for directional lights.
    Irradiance(f64),
}

impl Brightness {
    /// Whether it shines at all.
    pub fn is_lit(self) -> bool {
        match self {
            Self::Power(value) | Self::Irradiance(value) => value != 0.0,
            Self::Radiance(color) | Self::Intensity(color) => !color.is_black(),
        }
    }
}

/// The light that comes from everywhere.
#[derive(Clone, PartialEq, Debug)]
pub struct Environment {
    /// Radiance: a colour, or an equirectangular picture with row 0 at the top.
    pub radiance: EnvironmentRadiance,
    /// A factor on it.
    pub scale: Spanned<f64>,
    /// Turn about the y axis, in radians.
    pub rotation: f64,
    /// Its block.
    pub span: Span,
}

impl Environment {
    /// Whether it shines at all; a picture may.
    pub fn is_lit(&self) -> bool {
        let is_black = matches!(self.radiance, EnvironmentRadiance::Constant(color) if color.is_black());
        self.scale.value != 0.0 && !is_black
    }
}

/// What an environment shines with.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum EnvironmentRadiance {
    /// The same from everywhere.
    Constant(Rgb),
    /// A picture; always an image texture.
    Image(Handle<Texture>),
}
