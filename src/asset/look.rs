//! What a material of a mesh file does to light, in the words of the scene language.
//!
//! Every format is brought to this by its reader, and only there; `lower` makes the engine's materials of it, and
//! `convert` the text of a scene.

/// A material of a mesh file. Colours are linear.
#[derive(Clone, PartialEq, Debug)]
pub enum Look {
    /// Matt.
    Diffuse {
        /// Albedo.
        color: Shade,
    },
    /// Matt under a gloss.
    Phong {
        /// Albedo of the matt part.
        diffuse: Shade,
        /// Albedo of the gloss, in [0, 1].
        specular: [f32; 3],
        /// Exponent of the gloss, at least 1.
        shininess: f32,
    },
    /// A light source.
    Emissive {
        /// In W/m²/sr.
        radiance: [f32; 3],
    },
    /// A clear solid, or a pane.
    Glass(GlassLook),
    /// The metallic-roughness model.
    Principled(Box<PrincipledLook>),
    /// A material with holes.
    Mask {
        /// What is there between them.
        base: Box<Look>,
        /// The share of the surface that is there.
        opacity: Shade,
        /// From this opacity on all is there, and nothing below.
        cutoff: Option<f32>,
    },
    /// Normals bent by a picture.
    NormalMap {
        /// What the surface is made of.
        base: Box<Look>,
        /// The picture.
        map: Map,
        /// A factor on how far normals lean.
        strength: f32,
    },
}

/// A clear solid, or a pane.
#[derive(Clone, PartialEq, Debug)]
pub struct GlassLook {
    /// Refractive index, at least 1.
    pub ior: f32,
    /// Perceptual, in [0, 1].
    pub roughness: Shade,
    /// A factor at every crossing, in [0, 1].
    pub tint: [f32; 3],
    /// What is left of white light, in (0, 1], and after how many metres.
    pub attenuation: Option<([f32; 3], f32)>,
    /// Abbe number.
    pub abbe: Option<f32>,
    /// Whether it is a pane, which has no inside.
    pub thin: bool,
}

/// The inputs of the metallic-roughness model.
#[derive(Clone, PartialEq, Debug)]
pub struct PrincipledLook {
    /// Albedo, reflectance or tint.
    pub color: Shade,
    /// The share that is metal.
    pub metallic: Shade,
    /// Perceptual, in [0, 1].
    pub roughness: Shade,
    /// The share of the rest that is clear.
    pub transmission: Shade,
    /// Refractive index, in [1, 4].
    pub ior: f32,
    /// The share of the surface under a coat.
    pub clearcoat: Shade,
    /// Of the coat.
    pub clearcoat_roughness: Shade,
    /// In W/m²/sr, where its picture is white.
    pub emission: [f32; 3],
    /// The picture that it shines by.
    pub emission_map: Option<Map>,
}

/// A colour or number: a factor in [0, 1] times a picture, if there is one.
#[derive(Clone, PartialEq, Debug)]
pub struct Shade {
    /// The factor; grey for a number.
    pub factor: [f32; 3],
    /// The picture.
    pub map: Option<Map>,
    /// What stands for the whole where the picture cannot be read.
    pub without: [f32; 3],
}

impl Shade {
    /// The same everywhere, cut to [0, 1].
    pub fn color(color: [f32; 3]) -> Self {
        let color = color.map(|x| x.clamp(0.0, 1.0));
        Self { factor: color, map: None, without: color }
    }

    /// A number that is the same everywhere, cut to [0, 1].
    pub fn number(x: f32) -> Self {
        Self::color([x; 3])
    }

    /// This times a picture.
    #[must_use]
    pub fn times(self, map: Option<Map>) -> Self {
        Self { map, ..self }
    }

    /// Whether it is 0 everywhere.
    pub fn is_black(&self) -> bool {
        self.factor == [0.0; 3]
    }
}

/// A picture, and how it lies on things.
#[derive(Clone, PartialEq, Debug)]
pub struct Map {
    /// Index into the model's pictures.
    pub picture: usize,
    /// Which of its numbers count.
    pub channel: MapChannel,
    /// What lies beyond its edges.
    pub wrap: MapWrap,
    /// Whether neighbouring pixels are blended.
    pub is_blended: bool,
    /// Texture point times this …
    pub uv_scale: [f32; 2],
    /// … turned by this, in radians …
    pub uv_rotation: f32,
    /// … plus this.
    pub uv_offset: [f32; 2],
}

impl Map {
    /// All of a picture as it is, again and again.
    pub fn plain(picture: usize) -> Self {
        Self {
            picture,
            channel: MapChannel::Rgb,
            wrap: MapWrap::Repeat,
            is_blended: true,
            uv_scale: [1.0; 2],
            uv_rotation: 0.0,
            uv_offset: [0.0; 2],
        }
    }

    /// The same picture, of which only one channel counts.
    #[must_use]
    pub fn only(&self, channel: MapChannel) -> Self {
        Self { channel, ..self.clone() }
    }
}

/// Which channels of a picture count.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[expect(missing_docs, reason = "each is its word")]
pub enum MapChannel {
    Rgb,
    Red,
    Green,
    Blue,
    Alpha,
}

/// What lies beyond the edges of a picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum MapWrap {
    /// The picture again.
    Repeat,
    /// Its edge.
    Clamp,
    /// The picture, turned over.
    Mirror,
}

impl Look {
    /// What says nothing.
    pub fn gray() -> Self {
        Self::Diffuse { color: Shade::number(0.5) }
    }

    /// The material that holes and bent normals are in.
    pub fn innermost(&self) -> &Self {
        match self {
            Self::Mask { base, .. } | Self::NormalMap { base, .. } => base.innermost(),
            _ => self,
        }
    }

    /// Whether it shines.
    pub fn shines(&self) -> bool {
        match self.innermost() {
            Self::Emissive { radiance } => *radiance != [0.0; 3],
            Self::Principled(of) => of.emission != [0.0; 3],
            _ => false,
        }
    }

    /// Whether light goes through it into a body.
    pub fn is_clear(&self) -> bool {
        match self.innermost() {
            Self::Glass(of) => !of.thin,
            Self::Principled(of) => !of.transmission.is_black(),
            _ => false,
        }
    }

    /// Whether light gets through it without there being an inside: panes, and what has holes.
    pub fn is_pierced(&self) -> bool {
        matches!(self, Self::Mask { .. })
            || matches!(self.innermost(), Self::Glass(GlassLook { thin: true, .. }))
    }

    /// Every picture that it looks up, with the shade it is part of, if it is one.
    pub fn shades(&mut self) -> Vec<&mut Shade> {
        match self {
            Self::Diffuse { color } => vec![color],
            Self::Phong { diffuse, .. } => vec![diffuse],
            Self::Emissive { .. } => Vec::new(),
            Self::Glass(of) => vec![&mut of.roughness],
            Self::Principled(of) => vec![
                &mut of.color,
                &mut of.metallic,
                &mut of.roughness,
                &mut of.transmission,
                &mut of.clearcoat,
                &mut of.clearcoat_roughness,
            ],
            Self::Mask { base, opacity, .. } => {
                let mut shades = base.shades();
                shades.push(opacity);
                shades
            }
            Self::NormalMap { base, .. } => base.shades(),
        }
    }

    /// Indices of the pictures that it looks up.
    pub fn pictures(&self) -> Vec<usize> {
        let mut copy = self.clone();
        let mut found: Vec<usize> =
            copy.shades().iter().filter_map(|shade| shade.map.as_ref()).map(|map| map.picture).collect();
        found.extend(self.normal_map().map(|map| map.picture));
        found.extend(self.emission_map().map(|map| map.picture));
        found
    }

    /// The picture that it shines by.
    pub fn emission_map(&self) -> Option<&Map> {
        match self.innermost() {
            Self::Principled(of) => of.emission_map.as_ref(),
            _ => None,
        }
    }

    /// The picture that bends its normals.
    pub fn normal_map(&self) -> Option<&Map> {
        match self {
            Self::NormalMap { map, .. } => Some(map),
            Self::Mask { base, .. } => base.normal_map(),
            _ => None,
        }
    }
}
