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

impl Input {
    /// Whether it is surely 0 everywhere.
    pub fn is_black(&self) -> bool {
        matches!(self, Self::Constant(color) if color.value.is_black())
    }

    /// Where it is written.
    pub const fn span(&self) -> Span {
        match self {
            Self::Constant(color) => color.span,
            Self::Texture(texture) => texture.span,
        }
    }
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
    /// A dielectric.
    Glass {
        /// Refractive index, at least 1.
        ior: Spanned<f64>,
        /// Perceptual, in [0, 1]: alpha is its square.
        roughness: Input,
        /// Factor at every crossing of the surface.
        tint: Spanned<Rgb>,
        /// Absorption coefficient per metre inside, per channel.
        absorption: Rgb,
        /// Abbe number, by which it spreads colours.
        abbe: Option<Spanned<f64>>,
        /// Whether it is a pane; where that is said.
        thin: Option<Span>,
        /// Of solids that overlap, the highest fills the space.
        priority: i32,
    },
    /// A matt body under a clear coat.
    Plastic {
        /// Albedo of the body.
        color: Input,
        /// Refractive index of the coat.
        ior: Spanned<f64>,
        /// Of the coat.
        roughness: Input,
    },
    /// A clear coat over another material.
    Layer {
        /// What lies under it.
        base: Handle<Material>,
        /// Refractive index of the coat.
        ior: Spanned<f64>,
        /// Of the coat.
        roughness: Input,
        /// The share of the surface that is coated.
        cover: Input,
    },
    /// The metallic-roughness model of glTF.
    Principled(Principled),
    /// A material with holes.
    Mask {
        /// What is there.
        base: Handle<Material>,
        /// The share of the surface that is there.
        opacity: Input,
        /// From this opacity on all is there.
        cutoff: Option<f64>,
    },
    /// A material for each side.
    TwoSided {
        /// On the side of the normal.
        front: Handle<Material>,
        /// On the other.
        back: Handle<Material>,
    },
    /// Normals bent by a picture of normals.
    NormalMap {
        /// What the surface is made of.
        base: Handle<Material>,
        /// The picture.
        map: Spanned<Handle<Texture>>,
        /// A factor on how far normals lean.
        strength: f64,
    },
    /// Normals that follow a picture of heights.
    Bump {
        /// What the surface is made of.
        base: Handle<Material>,
        /// The picture.
        height: Spanned<Handle<Texture>>,
        /// How much higher white is than black, in metres.
        depth: f64,
    },
    /// A light source.
    Emissive {
        /// How bright: power over the whole object, or radiance.
        brightness: Spanned<Brightness>,
        /// What the radiance is multiplied by, from place to place.
        map: Option<Spanned<Handle<Texture>>>,
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
            Self::Metal { color: MetalColor::Color { straight, edge }, roughness } => {
                vec![*straight, *edge, *roughness]
            }
            Self::Metal { color: MetalColor::Named { .. }, roughness } => vec![*roughness],
            Self::Whitted { diffuse, specular, reflection, transmission, .. } => {
                vec![*diffuse, *specular, *reflection, *transmission]
            }
            Self::Mix { amount, .. } => vec![*amount],
            Self::Glass { roughness, .. } => vec![*roughness],
            Self::Plastic { color, roughness, .. } => vec![*color, *roughness],
            Self::Layer { roughness, cover, .. } => vec![*roughness, *cover],
            Self::Principled(of) => vec![
                of.color,
                of.metallic,
                of.roughness,
                of.transmission,
                of.clearcoat,
                of.clearcoat_roughness,
                of.emission,
            ],
            Self::Mask { opacity, .. } => vec![*opacity],
            Self::NormalMap { map: texture, .. } | Self::Bump { height: texture, .. } => {
                vec![Input::Texture(*texture)]
            }
            Self::Emissive { map, .. } => map.iter().map(|map| Input::Texture(*map)).collect(),
            Self::TwoSided { .. } => Vec::new(),
        }
    }

    /// The materials that it is made of.
    pub fn parts(&self) -> Vec<Handle<Material>> {
        match self {
            Self::Mix { a, b, .. } | Self::TwoSided { front: a, back: b } => vec![*a, *b],
            Self::Layer { base, .. }
            | Self::Mask { base, .. }
            | Self::NormalMap { base, .. }
            | Self::Bump { base, .. } => vec![*base],
            _ => Vec::new(),
        }
    }
}

/// The inputs of the metallic-roughness model.
#[derive(Clone, PartialEq, Debug)]
pub struct Principled {
    /// Albedo, reflectance or tint.
    pub color: Input,
    /// The share that is metal.
    pub metallic: Input,
    /// Perceptual, in [0, 1]: alpha is its square.
    pub roughness: Input,
    /// The share of the rest that is clear.
    pub transmission: Input,
    /// Refractive index of what is not metal.
    pub ior: Spanned<f64>,
    /// The share of the surface under a clear coat.
    pub clearcoat: Input,
    /// Of that coat.
    pub clearcoat_roughness: Input,
    /// The radiance that it emits.
    pub emission: Input,
}

/// Where a metal's colour comes from.
#[derive(Clone, PartialEq, Debug)]
pub enum MetalColor {
    /// A measured metal.
    Named {
        /// What it is called.
        name: Spanned<String>,
        /// The reflectance at normal incidence.
        straight: Rgb,
        /// The reflectance at 82° as a share of what Schlick's formula would make it.
        edge: Rgb,
    },
    /// Said outright.
    Color {
        /// The reflectance at normal incidence.
        straight: Input,
        /// The reflectance at 82° as a share of what Schlick's formula would make it.
        edge: Input,
    },
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
    /// One colour blended into another by a formula.
    Pattern {
        /// Where the pattern is 0.
        a: Input,
        /// Where it is 1.
        b: Input,
        /// Which.
        pattern: Pattern,
    },
    /// One colour blended into another by shares.
    Blend {
        /// Where `amount` is 0.
        a: Input,
        /// Where it is 1.
        b: Input,
        /// The share of `b`.
        amount: Input,
    },
    /// Arithmetic of colours.
    Join {
        /// What is done.
        op: Join,
        /// The left side.
        a: Input,
        /// The right side.
        b: Input,
    },
}

impl TextureKind {
    /// What it is made of.
    pub fn inputs(&self) -> Vec<Input> {
        match self {
            Self::Image(_) => Vec::new(),
            Self::Checker(Checker { a, b, .. }) | Self::Pattern { a, b, .. } | Self::Join { a, b, .. } => {
                vec![*a, *b]
            }
            Self::Blend { a, b, amount } => vec![*a, *b, *amount],
        }
    }
}

/// Arithmetic of two colours, channel by channel.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[expect(missing_docs, reason = "each is its word")]
pub enum Join {
    Add,
    Subtract,
    Multiply,
}

/// Patterns by formula; lengths in metres, in object space.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Pattern {
    /// From v = 0 to v = 1, or from a point to another.
    Gradient(Option<[DVec3; 2]>),
    /// Clouds.
    Noise {
        /// The distance of the largest features.
        size: f64,
        /// How many scales of them.
        octaves: u32,
    },
    /// Veins across x.
    Marble {
        /// Their distance.
        size: f64,
        /// How far they are folded, in veins.
        turbulence: f64,
    },
    /// Rings around y.
    Wood {
        /// Their width.
        size: f64,
        /// How far they are bent, in rings.
        turbulence: f64,
    },
    /// Bricks in texture space.
    Brick {
        /// How many along u and v.
        cells: DVec2,
        /// The width of a joint, as a share of a brick's height.
        mortar: f64,
        /// Width over height of a brick.
        aspect: f64,
    },
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
    /// … turned by this, in radians …
    pub uv_rotation: f64,
    /// … plus this.
    pub uv_offset: DVec2,
    /// Where the texture point comes from.
    pub projection: Projection,
    /// What its numbers are.
    pub space: ColorSpace,
    /// Which of them count.
    pub channel: Channel,
}

/// What the numbers of an 8-bit picture are.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum ColorSpace {
    /// Display values where a colour is wanted, plain numbers elsewhere.
    Auto,
    /// Display values.
    Srgb,
    /// Plain numbers.
    Linear,
}

/// Which channels of a picture count; one alone is a grey.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[expect(missing_docs, reason = "each is its word")]
pub enum Channel {
    Rgb,
    Red,
    Green,
    Blue,
    Alpha,
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
    /// From a point of object space outwards.
    Spherical {
        /// The point.
        center: DVec3,
    },
    /// Onto the six sides of a box in object space.
    Cubic {
        /// Its centre.
        center: DVec3,
        /// Its edges.
        size: DVec3,
    },
}

/// Two colours in turn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Checker {
    /// The colour of the cell at the origin.
    pub a: Input,
    /// The other.
    pub b: Input,
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
