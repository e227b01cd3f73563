//! Materials: how the surfaces of a world scatter and emit, before a point on them is known.

use super::conductor::MIRROR_ALPHA;
use super::{Bsdf, Lobe};
use crate::math::Rgb;
use crate::render::geometry::SurfacePoint;
pub use crate::render::shape::MaterialId;
use crate::render::texture::Texture;
pub use crate::render::texture::TextureId;

/// A colour that is the same everywhere, or looked up at each point. Scalars take the mean of the channels.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Input {
    /// The same everywhere.
    Constant(Rgb),
    /// Looked up.
    Texture(TextureId),
}

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
        /// The reflectance at normal incidence, in [0, 1]; grazing goes to 1 (Schlick 1994).
        f0: Input,
        /// Perceptual roughness in [0, 1]; α is its square, and below α = 10⁻³ the metal is a mirror.
        roughness: Input,
    },
    /// A smooth dielectric around a clear or coloured inside.
    Glass {
        /// The refractive index of the side against the normal; at least 1.
        ior: f32,
        /// The factor at every crossing of the surface, in [0, 1].
        tint: Rgb,
        /// The absorption coefficient of the inside, per metre.
        absorption: Rgb,
    },
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

    /// Whether no side emits.
    pub fn is_none(&self) -> bool {
        self.front.is_black() && self.back.is_black()
    }
}

/// All materials of a world with the textures they look up.
pub struct Materials {
    materials: Vec<Material>,
    textures: Vec<Texture>,
    /// By material: found once, so that hitting a surface that does not shine costs one look.
    emissions: Vec<Emission>,
}

impl Materials {
    /// Materials and textures that refer to each other by index.
    ///
    /// # Panics
    /// When a mix holds more lobes than a [`Bsdf`] has room for.
    pub fn new(materials: Vec<Material>, textures: Vec<Texture>) -> Self {
        let mut this = Self { materials, textures, emissions: Vec::new() };
        let ids = (0..this.materials.len() as u32).map(MaterialId);
        this.emissions = ids.clone().map(|id| this.find_emission(id)).collect();
        let most = ids.map(|id| lobe_count(&this.materials, id)).max().unwrap_or(0);
        assert!(most <= Bsdf::MAX_LOBES, "a mix of materials has at most {} lobes", Bsdf::MAX_LOBES);
        this
    }

    /// The material of an index.
    pub fn get(&self, id: MaterialId) -> &Material {
        &self.materials[id.0 as usize]
    }

    /// What a material emits.
    pub fn emission(&self, id: MaterialId) -> &Emission {
        &self.emissions[id.0 as usize]
    }

    /// How the surface scatters at a point: its textures looked up.
    pub fn bsdf(&self, surface: &SurfacePoint) -> Bsdf {
        let mut bsdf = Bsdf::new(surface);
        self.add_lobes(surface.material, 1.0, surface, &mut bsdf);
        bsdf
    }

    /// The absorption coefficient inside a material, per metre; `None` for what has no inside.
    pub fn absorption(&self, id: MaterialId) -> Option<Rgb> {
        match *self.get(id) {
            Material::Glass { absorption, .. } => Some(absorption),
            _ => None,
        }
    }

    /// The refractive index inside a material; `None` for what has no inside.
    pub fn ior(&self, id: MaterialId) -> Option<f32> {
        match *self.get(id) {
            Material::Glass { ior, .. } | Material::Whitted { ior, .. } => Some(ior),
            _ => None,
        }
    }

    fn add_lobes(&self, id: MaterialId, share: f32, surface: &SurfacePoint, bsdf: &mut Bsdf) {
        match *self.get(id) {
            Material::Diffuse { color } | Material::Whitted { diffuse: color, .. } => {
                bsdf.add(Lobe::Lambert { albedo: self.color(color, surface) * share });
            }
            Material::Phong { diffuse, specular, shininess } => {
                let (diffuse, specular) = (self.color(diffuse, surface), self.color(specular, surface));
                let scale = share / (diffuse + specular).max_component().max(1.0);
                bsdf.add(Lobe::Lambert { albedo: diffuse * scale });
                bsdf.add(Lobe::Phong { albedo: specular * scale, exponent: shininess });
            }
            Material::Mirror { color } => {
                let color = self.color(color, surface) * share;
                bsdf.add(Lobe::Mirror { f0: color, f90: color });
            }
            Material::Metal { f0, roughness } => {
                let alpha = self.scalar(roughness, surface).powi(2).min(1.0);
                let (f0, f90) = (self.color(f0, surface) * share, Rgb::gray(share));
                bsdf.add(if alpha < MIRROR_ALPHA {
                    Lobe::Mirror { f0, f90 }
                } else {
                    Lobe::Conductor { f0, f90, alpha }
                });
            }
            Material::Glass { ior, tint, .. } => bsdf.add(Lobe::Dielectric { share, ior, tint }),
            Material::Emissive { .. } => {}
            Material::Mix { a, b, amount } => {
                let amount = self.scalar(amount, surface).clamp(0.0, 1.0);
                if amount < 1.0 {
                    self.add_lobes(a, share * (1.0 - amount), surface, bsdf);
                }
                if amount > 0.0 {
                    self.add_lobes(b, share * amount, surface, bsdf);
                }
            }
        }
    }

    /// The materials that one comes down to at a point, each with its share.
    pub fn parts(&self, id: MaterialId, surface: &SurfacePoint) -> Vec<(f32, &Material)> {
        let mut parts = Vec::new();
        self.add_parts(id, 1.0, surface, &mut parts);
        parts
    }

    fn add_parts<'a>(
        &'a self,
        id: MaterialId,
        share: f32,
        surface: &SurfacePoint,
        parts: &mut Vec<(f32, &'a Material)>,
    ) {
        match self.get(id) {
            Material::Mix { a, b, amount } => {
                let amount = self.scalar(*amount, surface).clamp(0.0, 1.0);
                self.add_parts(*a, share * (1.0 - amount), surface, parts);
                self.add_parts(*b, share * amount, surface, parts);
            }
            part => parts.push((share, part)),
        }
    }

    /// The emission of a material. A mix by a texture counts by the texture's mean, wherever light is found or drawn.
    fn find_emission(&self, id: MaterialId) -> Emission {
        match *self.get(id) {
            Material::Emissive { radiance, two_sided } => {
                Emission { front: radiance, back: if two_sided { radiance } else { Rgb::BLACK } }
            }
            Material::Mix { a, b, amount } => {
                let amount = match amount {
                    Input::Constant(color) => color,
                    Input::Texture(id) => self.textures[id.0 as usize].mean(),
                };
                let (a, b) = (self.find_emission(a), self.find_emission(b));
                let amount = amount.mean().clamp(0.0, 1.0);
                Emission { front: a.front.lerp(b.front, amount), back: a.back.lerp(b.back, amount) }
            }
            _ => Emission::NONE,
        }
    }

    /// An input at a point.
    pub fn color(&self, input: Input, surface: &SurfacePoint) -> Rgb {
        match input {
            Input::Constant(color) => color,
            Input::Texture(id) => self.textures[id.0 as usize].eval(surface),
        }
    }

    fn scalar(&self, input: Input, surface: &SurfacePoint) -> f32 {
        self.color(input, surface).mean()
    }
}

/// The most lobes that a material can have at a point: each glossy part and each glass is one, all diffuse parts
/// together are one, and all mirrors are. A world takes no material with more than [`Bsdf::MAX_LOBES`].
pub fn lobe_count(materials: &[Material], id: MaterialId) -> usize {
    let mut parts = Vec::new();
    collect_parts(materials, id, &mut parts);
    let any = |wanted: fn(&Material) -> bool| usize::from(parts.iter().any(wanted));
    let glossy = |part: &&Material| {
        matches!(part, Material::Phong { .. } | Material::Metal { .. } | Material::Glass { .. })
    };
    let matt = |part: &Material| {
        matches!(part, Material::Diffuse { .. } | Material::Phong { .. } | Material::Whitted { .. })
    };
    any(matt) + any(|part| matches!(part, Material::Mirror { .. })) + parts.iter().filter(glossy).count()
}

/// The materials that a mix comes down to.
fn collect_parts(materials: &[Material], id: MaterialId, parts: &mut Vec<Material>) {
    match materials[id.0 as usize] {
        Material::Mix { a, b, .. } => {
            collect_parts(materials, a, parts);
            collect_parts(materials, b, parts);
        }
        part => parts.push(part),
    }
}
