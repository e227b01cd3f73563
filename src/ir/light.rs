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
    /// The first `moving` around it, as it stands when a frame begins.
    pub moves: Option<Span>,
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
    /// From a point into a cone.
    Spot {
        /// Where.
        position: DVec3,
        /// The way its middle shines, not necessarily a unit vector.
        direction: Spanned<DVec3>,
        /// From one edge of the cone to the other, in radians.
        angle: Spanned<f64>,
        /// The share of the half-angle over which it fades at the edge.
        blend: Spanned<f64>,
        /// As for a point.
        falloff: Spanned<[f64; 3]>,
    },
    /// A glowing disk, to the side of `edge_u × edge_v`; an ellipse where a transform squeezes it.
    Disk {
        /// Its centre.
        center: DVec3,
        /// From there to its rim.
        edge_u: DVec3,
        /// From there to its rim, across; both of the length `radius` before a transform.
        edge_v: DVec3,
        /// As it was written.
        radius: Spanned<f64>,
        /// Whether both sides shine.
        two_sided: bool,
    },
    /// Sun and sky.
    SunSky(Daylight),
    /// From infinitely far away.
    Directional {
        /// The way the light travels.
        direction: Spanned<DVec3>,
    },
}

/// The light of a clear day (Preetham, Shirley, Smits 1999).
#[derive(Clone, PartialEq, Debug)]
pub struct Daylight {
    /// The direction to the sun, not necessarily a unit vector.
    pub to_sun: Spanned<DVec3>,
    /// How hazy the air is: 2 is clear, 10 is haze.
    pub turbidity: Spanned<f64>,
    /// The albedo of the ground.
    pub ground: Rgb,
    /// Whether the sun itself is there.
    pub sun: bool,
    /// The angle under which the sun is seen, from rim to rim, in radians.
    pub sun_size: Spanned<f64>,
}

impl LightKind {
    /// As light fades: by the square of the distance.
    pub const PHYSICAL: [f64; 3] = [0.0, 0.0, 1.0];

    /// Whether no path can meet it.
    pub const fn is_sizeless(&self) -> bool {
        matches!(self, Self::Point { .. } | Self::Spot { .. } | Self::Directional { .. })
    }

    /// How it fades with the distance, where that can be said.
    pub const fn falloff(&self) -> Option<Spanned<[f64; 3]>> {
        match self {
            Self::Point { falloff, .. } | Self::Spot { falloff, .. } => Some(*falloff),
            _ => None,
        }
    }
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
