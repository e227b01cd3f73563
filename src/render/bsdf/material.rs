//! Materials: how the surfaces of a world scatter and emit, before a point on them is known.

use crate::math::Rgb;
pub use crate::render::shape::MaterialId;
pub use crate::render::texture::{Input, TextureId};

/// What a surface is made of. All but glass look the same from both sides.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Material {
    /// Scatters equally in all directions (Lambert).
    Diffuse {
        /// The albedo, in [0, 1].
        color: Input,
    },
    /// Diffuse with a glossy lobe about the mirror direction; scaled down where the two together exceed 1.
    Phong {
        /// The albedo of the diffuse part, in [0, 1].
        diffuse: Input,
        /// The albedo of the glossy part at normal incidence, in [0, 1].
        specular: Input,
        /// The exponent of the lobe's cosine, in [0, 10⁵].
        shininess: f32,
    },
    /// A perfect mirror.
    Mirror {
        /// The reflectance, in [0, 1].
        color: Input,
    },
    /// A metal with microfacets of the GGX distribution.
    Metal {
        /// The reflectance at normal incidence, in [0, 1]; grazing goes to 1.
        f0: Input,
        /// The reflectance at 82°, as a share in [0, 1] of what Schlick's formula would make it.
        edge: Input,
        /// Perceptual roughness in [0, 1]; α is its square, and below α = 10⁻³ the metal is a mirror.
        roughness: Input,
    },
    /// A dielectric around a clear or coloured inside, or a pane of it.
    Glass(Glass),
    /// A matt body under a clear coat.
    Plastic {
        /// The albedo of the body, in [0, 1].
        color: Input,
        /// The refractive index of the coat; at least 1.
        ior: f32,
        /// Perceptual roughness of the coat, in [0, 1].
        roughness: Input,
    },
    /// A clear coat over something else.
    Layer {
        /// What lies under it.
        base: MaterialId,
        /// Its refractive index; at least 1.
        ior: f32,
        /// Its perceptual roughness, in [0, 1].
        roughness: Input,
        /// How much of the surface it covers, in [0, 1].
        cover: Input,
    },
    /// The metallic-roughness model of glTF 2.0, with transmission and a clear coat.
    Principled(Principled),
    /// Emits, and scatters nothing.
    Emissive {
        /// The emitted radiance, in W·m⁻²·sr⁻¹.
        radiance: Rgb,
        /// Whether the side against the normal shines too.
        two_sided: bool,
    },
    /// The illumination model of recursive ray tracing (Whitted 1980). Nothing holds it to keep the energy; the other
    /// integrators see its diffuse part alone.
    Whitted {
        /// The factor of the cosine towards each light.
        diffuse: Input,
        /// The factor of the highlight.
        specular: Input,
        /// The exponent of the highlight.
        shininess: f32,
        /// The factor of what the mirrored ray sees.
        reflection: Input,
        /// The factor of what the refracted ray sees.
        transmission: Input,
        /// The refractive index of the side against the normal; at least 1.
        ior: f32,
        /// Whether Fresnel's equations, as Schlick 1994 fits them, share light between the two rays.
        fresnel: bool,
    },
    /// Two materials, side by side too finely to tell apart.
    Mix {
        /// The one at amount 0.
        a: MaterialId,
        /// The one at amount 1.
        b: MaterialId,
        /// The share of `b`, in [0, 1].
        amount: Input,
    },
    /// A material with holes. Outermost.
    Mask {
        /// Where there is no hole.
        base: MaterialId,
        /// The share of the surface that is there, in [0, 1].
        opacity: Input,
        /// Everything from this opacity on is there and all below is a hole, unless it is 0.
        cutoff: f32,
    },
    /// One material for each side. Outermost but for a mask.
    TwoSided {
        /// On the side of the normal.
        front: MaterialId,
        /// On the other.
        back: MaterialId,
    },
    /// A material with a finer shape than its surface. Outermost but for a mask and sides.
    Relief {
        /// What it is made of.
        base: MaterialId,
        /// How it bends the normal.
        relief: Relief,
    },
    /// A material that shines by a picture.
    Glow {
        /// What it is apart from that; what it emits is multiplied.
        base: MaterialId,
        /// The factor at each point; not negative.
        map: Input,
    },
}

/// A clear solid, or a pane.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Glass {
    /// The refractive index of the side against the normal; at least 1.
    pub ior: f32,
    /// The factor at every crossing of the surface, in [0, 1].
    pub tint: Rgb,
    /// The absorption coefficient of the inside, per metre.
    pub absorption: Rgb,
    /// Perceptual roughness, in [0, 1]; below α = 10⁻³ the glass is smooth.
    pub roughness: Input,
    /// Whether it is a pane, which has no inside.
    pub thin: bool,
    /// Of solids that overlap, the one of highest priority fills the space; of equals, that entered last.
    pub priority: i32,
    /// How much more it refracts blue (the F line) than red (the C line): the difference of the indices.
    pub spread: f32,
}

impl Glass {
    /// Smooth, clear and solid.
    pub const fn of_ior(ior: f32) -> Self {
        Self {
            ior,
            tint: Rgb::WHITE,
            absorption: Rgb::BLACK,
            roughness: Input::Constant(Rgb::BLACK),
            thin: false,
            priority: 0,
            spread: 0.0,
        }
    }
}

/// The inputs of the metallic-roughness model.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Principled {
    /// Albedo of what is matt, reflectance of what is metal, tint of what is clear; in [0, 1].
    pub color: Input,
    /// The share that is metal, in [0, 1].
    pub metallic: Input,
    /// Perceptual roughness, in [0, 1].
    pub roughness: Input,
    /// The share of the rest that is clear, in [0, 1].
    pub transmission: Input,
    /// The refractive index of what is not metal; at least 1.
    pub ior: f32,
    /// How much of the surface a coat of index 1.5 covers, in [0, 1].
    pub clearcoat: Input,
    /// The coat's perceptual roughness, in [0, 1].
    pub clearcoat_roughness: Input,
    /// The emitted radiance, on the side of the normal, in W·m⁻²·sr⁻¹.
    pub emission: Rgb,
}

/// How a surface's normal is bent.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Relief {
    /// By a picture of normals: red along u, green along v, blue outwards, each from −1 at 0 to 1 at 1.
    NormalMap {
        /// The picture.
        map: TextureId,
        /// A factor on how far normals lean.
        strength: f32,
    },
    /// By a picture of heights.
    Bump {
        /// The picture; its mean over the channels counts.
        height: TextureId,
        /// How much higher 1 is than 0, in metres.
        depth: f32,
    },
}

/// What fills a solid.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Interior {
    /// The refractive index.
    pub ior: f32,
    /// The absorption coefficient, per metre.
    pub absorption: Rgb,
    /// Which of several that overlap counts: the highest.
    pub priority: i32,
    /// The difference of the indices for blue and red.
    pub spread: f32,
}

/// What a surface emits: the same radiance at every point and in every direction of its side.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Emission {
    /// The radiance in the hemisphere of the normal.
    pub front: Rgb,
    /// The radiance in the other one.
    pub back: Rgb,
}

impl Emission {
    /// No light.
    pub const NONE: Self = Self { front: Rgb::BLACK, back: Rgb::BLACK };

    /// The radiance on the side that `cos`, measured from the normal, points to; edge-on there is none.
    pub fn radiance(&self, cos: f32) -> Rgb {
        if cos > 0.0 {
            self.front
        } else if cos < 0.0 {
            self.back
        } else {
            Rgb::BLACK
        }
    }

    /// The same times a colour.
    #[must_use]
    pub fn times(&self, color: Rgb) -> Self {
        Self { front: self.front * color, back: self.back * color }
    }

    /// Whether no side emits.
    pub fn is_none(&self) -> bool {
        self.front.is_black() && self.back.is_black()
    }
}
