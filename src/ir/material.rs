//! Materials and textures.

use super::Handle;
use super::light::Brightness;
use crate::math::{DVec2, DVec3, Rgb};
use crate::source::{Span, Spanned};

/// A material.
#[derive(Clone, PartialEq, Debug)]
pub struct Material {
    /// Which.
    pub kind: MaterialKind,
    /// Where it was written; for the implied grey one, the object.
    pub span: Span,
    /// The name that a `let` gave it.
    pub name: Option<String>,
    /// The calls of functions in which it was made, the innermost first: the function's name, where it is called.
    pub calls: Vec<Spanned<String>>,
}

/// A material's input: the same everywhere, or a texture. Scalar inputs are grey.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Input {
    /// The same everywhere.
    Constant(Spanned<Rgb>),
    /// Looked up.
    Texture(Spanned<Handle<Texture>>),
}

/// The kinds of materials.
#[derive(Clone, PartialEq, Debug)]
pub enum MaterialKind {
    /// Lambert.
    Diffuse {
        /// Albedo.
        color: Input,
    },
    /// Diffuse plus a normalised Phong lobe.
    Phong {
        /// Albedo of the diffuse part.
        diffuse: Input,
        /// Albedo of the lobe.
        specular: Input,
        /// Exponent of the lobe.
        shininess: Spanned<f64>,
    },
    /// A perfect mirror.
    Mirror {
        /// Reflectance.
        color: Input,
    },
    /// A rough conductor.
    Metal {
        /// Reflectance at normal incidence.
        color: MetalColor,
        /// Perceptual, in [0, 1]: alpha is its square.
        roughness: Input,
    },
    /// A smooth dielectric.
    Glass {
        /// Refractive index, at least 1.
        ior: Spanned<f64>,
        /// Factor at every crossing of the surface.
        tint: Spanned<Rgb>,
        /// Absorption coefficient per metre inside, per channel.
        absorption: Rgb,
    },
    /// A light source.
    Emissive {
        /// How bright: power over the whole object, or radiance.
        brightness: Spanned<Brightness>,
        /// Its colour.
        color: Rgb,
    },
    /// The sum of the terms of recursive ray tracing.
    Whitted {
        /// The factor of the cosine towards each light.
        diffuse: Input,
        /// The factor of the highlight.
        specular: Input,
        /// The exponent of the highlight.
        shininess: Spanned<f64>,
        /// The factor of what is seen mirrored.
        reflection: Input,
        /// The factor of what is seen through it.
        transmission: Input,
        /// Refractive index, at least 1.
        ior: Spanned<f64>,
        /// Whether Fresnel's equations share light between the two.
        fresnel: bool,
    },
    /// Two materials by shares.
    Mix {
        /// Where `amount` is 0.
        a: Handle<Material>,
        /// Where it is 1.
        b: Handle<Material>,
        /// The share of `b`, in [0, 1].
        amount: Input,
    },
}

impl MaterialKind {
    /// The inputs, each of which may be a texture.
    pub fn inputs(&self) -> Vec<Input> {
        match self {
            Self::Diffuse { color } | Self::Mirror { color } => vec![*color],
            Self::Phong { diffuse, specular, .. } => vec![*diffuse, *specular],
            Self::Metal { color: MetalColor::Color(color), roughness } => vec![*color, *roughness],
            Self::Metal { color: MetalColor::Named(..), roughness } => vec![*roughness],
            Self::Whitted { diffuse, specular, reflection, transmission, .. } => {
                vec![*diffuse, *specular, *reflection, *transmission]
            }
            Self::Mix { amount, .. } => vec![*amount],
            Self::Glass { .. } | Self::Emissive { .. } => Vec::new(),
        }
    }

    /// The two materials of a mix; none of any other.
    pub fn parts(&self) -> Vec<Handle<Material>> {
        match self {
            Self::Mix { a, b, .. } => vec![*a, *b],
            _ => Vec::new(),
        }
    }
}

/// Where a metal's colour comes from.
#[derive(Clone, PartialEq, Debug)]
pub enum MetalColor {
    /// A measured metal by name: reflectance at normal incidence.
    Named(Spanned<String>, Rgb),
    /// Said outright.
    Color(Input),
}

/// A texture.
#[derive(Clone, PartialEq, Debug)]
pub struct Texture {
    /// Which.
    pub kind: TextureKind,
    /// Where it was written.
    pub span: Span,
}

/// The kinds of textures.
#[derive(Clone, PartialEq, Debug)]
pub enum TextureKind {
    /// A picture.
    Image(ImageUse),
    /// Two colours in turn.
    Checker(Checker),
}

/// A picture, and how it lies on things.
#[derive(Clone, PartialEq, Debug)]
pub struct ImageUse {
    /// The file as written, with the place of the string.
    pub file: Spanned<String>,
    /// Whether a missing file is a warning only (`missing: skip`).
    pub skip_missing: bool,
    /// What lies beyond its edges.
    pub wrap: Wrap,
    /// Whether neighbouring pixels are blended.
    pub linear_filter: bool,
    /// Texture point times this …
    pub uv_scale: DVec2,
    /// … plus this.
    pub uv_offset: DVec2,
    /// Where the texture point comes from.
    pub projection: Projection,
}

/// What lies beyond the edges of a picture.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Wrap {
    /// The picture again.
    Repeat,
    /// Its edge.
    Clamp,
    /// The picture, turned over.
    Mirror,
    /// A colour.
    Border(Rgb),
}

/// Where texture points come from.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Projection {
    /// From the shape's own parameters.
    Uv,
    /// From the object-space point `p`: ((p − origin)·u/|u|², (p − origin)·v/|v|²).
    Planar {
        /// Where the lower left corner of the picture lies.
        origin: DVec3,
        /// From its left to its right edge.
        u: DVec3,
        /// From its lower to its upper edge.
        v: DVec3,
    },
}

/// Two colours in turn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Checker {
    /// The colour of the cell at the origin.
    pub a: Spanned<Rgb>,
    /// The other.
    pub b: Spanned<Rgb>,
    /// How large the cells are.
    pub cells: CheckerCells,
}

/// How large the cells of a checker are.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum CheckerCells {
    /// This many along u and v.
    Uv(DVec2),
    /// Cubes of this edge in object space, in metres.
    Solid(f64),
}
