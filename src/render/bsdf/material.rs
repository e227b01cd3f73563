//! Materials: how the surfaces of a world scatter and emit, before a point on them is known.

use super::conductor::{Conductor, MIRROR_ALPHA};
use super::{Bsdf, Coat, Lobe, Pane, Reflectance, RoughDielectric, Substrate};
use crate::math::Rgb;
use crate::render::effects::Effects;
use crate::render::geometry::SurfacePoint;
pub use crate::render::shape::MaterialId;
pub use crate::render::texture::{Input, TextureId};
use crate::render::texture::{Texture, Textures};

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

/// The refractive index of a clear coat over a principled material (KHR_materials_clearcoat).
const CLEARCOAT_IOR: f32 = 1.5;

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

/// What shines by a picture.
struct Glow {
    /// Where the picture is white.
    emission: Emission,
    map: Input,
}

/// All materials of a world with the textures they look up.
pub struct Materials {
    materials: Vec<Material>,
    textures: Textures,
    /// By material: found once, so that hitting a surface that does not shine costs one look.
    emissions: Vec<Emission>,
    /// By material: how it shines by a picture, if it does.
    glows: Vec<Option<Glow>>,
    /// By material: what fills it, if it is clear.
    interiors: Vec<Option<Interior>>,
    /// By material: whether it matters to its colours how much of a picture is seen at once.
    filtered: Vec<bool>,
    /// What is simulated of them.
    effects: Effects,
}

impl Materials {
    /// Materials and textures that refer to each other by index.
    ///
    /// # Panics
    /// When a mix holds more lobes than a [`Bsdf`] has room for.
    pub fn new(materials: Vec<Material>, textures: Vec<Texture>) -> Self {
        let (emissions, glows) = (Vec::new(), Vec::new());
        let (interiors, filtered) = (Vec::new(), Vec::new());
        let textures = Textures::new(textures);
        let effects = Effects::ALL;
        let mut this = Self { materials, textures, emissions, glows, interiors, filtered, effects };
        let ids = (0..this.materials.len() as u32).map(MaterialId);
        this.emissions = ids.clone().map(|id| this.find_emission(id)).collect();
        this.glows = ids.clone().map(|id| this.find_glow(id)).collect();
        this.filtered = ids.clone().map(|id| this.find_filtered(id)).collect();
        this.interiors = ids.clone().map(|id| this.find_interior(id)).collect();
        let most = ids.map(|id| lobe_count(&this.materials, id)).max().unwrap_or(0);
        assert!(most <= Bsdf::MAX_LOBES, "a mix of materials has at most {} lobes", Bsdf::MAX_LOBES);
        this
    }

    /// The material of an index.
    pub fn get(&self, id: MaterialId) -> &Material {
        &self.materials[id.0 as usize]
    }

    /// What a material emits; on average, if it shines by a picture.
    pub fn emission(&self, id: MaterialId) -> &Emission {
        &self.emissions[id.0 as usize]
    }

    /// Whether a material shines by a picture.
    pub fn glows(&self, id: MaterialId) -> bool {
        self.glows[id.0 as usize].is_some()
    }

    /// What the surface emits at a point.
    pub fn emission_at(&self, surface: &SurfacePoint) -> Emission {
        match &self.glows[surface.material.0 as usize] {
            None => *self.emission(surface.material),
            Some(glow) => glow.emission.times(self.textures.color(glow.map, surface).map(|x| x.max(0.0))),
        }
    }

    /// How the surface scatters at a point: its textures looked up.
    pub fn bsdf(&self, surface: &SurfacePoint) -> Bsdf {
        self.bsdf_of(surface.material, surface)
    }

    /// The same for one of the materials that its own comes down to.
    #[inline]
    pub fn bsdf_of(&self, id: MaterialId, surface: &SurfacePoint) -> Bsdf {
        let mut bsdf = Bsdf::new(surface);
        self.add_lobes(id, 1.0, surface, &mut bsdf);
        bsdf
    }

    /// The material on one side of a surface, and how it bends the normal.
    #[inline]
    pub fn face(&self, id: MaterialId, from_outside: bool) -> (MaterialId, Option<Relief>) {
        match *self.get(id) {
            Material::Mask { base, .. } | Material::Glow { base, .. } => self.face(base, from_outside),
            Material::TwoSided { front, back } => {
                self.face(if from_outside { front } else { back }, from_outside)
            }
            Material::Relief { base, relief } => {
                (base, self.effects.has(Effects::NORMAL_MAPS).then_some(relief))
            }
            _ => (id, None),
        }
    }

    /// What fills a solid of this material; `None` for what has no inside.
    pub fn interior(&self, id: MaterialId) -> Option<&Interior> {
        self.interiors[id.0 as usize].as_ref()
    }

    /// Whether it matters to the colours of a material how much of a picture is seen at once.
    #[inline]
    pub fn is_filtered(&self, id: MaterialId) -> bool {
        self.filtered[id.0 as usize]
    }

    /// What is simulated of them.
    pub fn effects(&self) -> Effects {
        self.effects
    }

    /// Whether paths of different wavelengths go different ways: some glass disperses, and that is simulated.
    pub fn disperses(&self) -> bool {
        let mut interiors = self.interiors.iter().flatten();
        self.effects.has(Effects::DISPERSION) && interiors.any(|interior| interior.spread > 0.0)
    }

    /// The same materials, of which only so much is simulated.
    #[must_use]
    pub fn with_effects(self, effects: Effects) -> Self {
        Self { effects, ..self }
    }

    /// Whether any material may have holes.
    pub fn has_masks(&self) -> bool {
        self.materials.iter().any(|material| matches!(material, Material::Mask { .. }))
    }

    /// Whether a material may have holes.
    pub fn is_mask(&self, id: MaterialId) -> bool {
        matches!(self.get(id), Material::Mask { .. })
    }

    /// The share of the surface that is there, at a point.
    pub fn opacity(&self, surface: &SurfacePoint) -> f32 {
        match *self.get(surface.material) {
            Material::Mask { opacity, cutoff, .. } => match self.scalar(opacity, surface) {
                opacity if cutoff > 0.0 => f32::from(u8::from(opacity >= cutoff)),
                opacity => opacity,
            },
            _ => 1.0,
        }
    }

    /// The textures that materials look up.
    pub fn textures(&self) -> &Textures {
        &self.textures
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
                bsdf.add(Lobe::Mirror(Reflectance::flat(color)));
            }
            Material::Metal { f0, edge, roughness } => {
                let alpha = self.alpha(roughness, surface);
                let reflectance = Reflectance::metal(self.color(f0, surface), self.color(edge, surface));
                bsdf.add(metal(reflectance, alpha, share));
            }
            Material::Glass(glass) => {
                let alpha = self.alpha(glass.roughness, surface);
                bsdf.add(clear(&glass, alpha, share));
            }
            Material::Plastic { color, ior, roughness } => {
                let (color, alpha) = (self.color(color, surface), self.alpha(roughness, surface));
                add_coated(bsdf, color, ior, alpha, share);
            }
            Material::Layer { base, ior, roughness, cover } => {
                let (alpha, cover) = (self.alpha(roughness, surface), self.scalar(cover, surface));
                let first = bsdf.lobes().len();
                self.add_lobes(base, share, surface, bsdf);
                add_coat(bsdf, first, ior, alpha, cover.clamp(0.0, 1.0), share);
            }
            Material::Principled(ref principled) => self.add_principled(principled, share, surface, bsdf),
            Material::Mask { base, .. }
            | Material::TwoSided { front: base, .. }
            | Material::Glow { base, .. }
            | Material::Relief { base, .. } => self.add_lobes(base, share, surface, bsdf),
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

    /// glTF 2.0, appendix B, with KHR_materials_transmission, _ior and _clearcoat: metal and dielectric by shares, the
    /// dielectric matt or clear by shares, under a coat.
    fn add_principled(&self, of: &Principled, share: f32, surface: &SurfacePoint, bsdf: &mut Bsdf) {
        let unit = |input| self.scalar(input, surface).clamp(0.0, 1.0);
        let (color, alpha) = (self.color(of.color, surface), self.alpha(of.roughness, surface));
        let (metallic, transmission, clearcoat) =
            (unit(of.metallic), unit(of.transmission), unit(of.clearcoat));
        let first = bsdf.lobes().len();
        if metallic > 0.0 {
            bsdf.add(metal(Reflectance::metal(color, Rgb::WHITE), alpha, share * metallic));
        }
        let (matt, through) = (1.0 - transmission, transmission);
        if metallic < 1.0 && matt > 0.0 {
            add_coated(bsdf, color, of.ior, alpha, share * (1.0 - metallic) * matt);
        }
        if metallic < 1.0 && through > 0.0 {
            // Light that goes into a body and out again takes on the colour once.
            let glass = Glass { tint: color.map(f32::sqrt), ..Glass::of_ior(of.ior) };
            bsdf.add(clear(&glass, alpha, share * (1.0 - metallic) * through));
        }
        if clearcoat > 0.0 {
            let alpha = self.alpha(of.clearcoat_roughness, surface);
            add_coat(bsdf, first, CLEARCOAT_IOR, alpha, clearcoat, share);
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
            Material::Layer { base, .. }
            | Material::Mask { base, .. }
            | Material::TwoSided { front: base, .. }
            | Material::Glow { base, .. }
            | Material::Relief { base, .. } => self.add_parts(*base, share, surface, parts),
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
                let amount = self.textures.mean(amount);
                let (a, b) = (self.find_emission(a), self.find_emission(b));
                let amount = amount.mean().clamp(0.0, 1.0);
                Emission { front: a.front.lerp(b.front, amount), back: a.back.lerp(b.back, amount) }
            }
            Material::Principled(Principled { emission, .. }) => {
                Emission { front: emission, back: Rgb::BLACK }
            }
            Material::TwoSided { front, back } => {
                Emission { front: self.find_emission(front).front, back: self.find_emission(back).front }
            }
            Material::Relief { base, .. } => self.find_emission(base),
            Material::Glow { base, map } => self.find_emission(base).times(self.textures.mean(map)),
            _ => Emission::NONE,
        }
    }

    fn find_glow(&self, id: MaterialId) -> Option<Glow> {
        match *self.get(id) {
            Material::Glow { base, map } => Some(Glow { emission: self.find_emission(base), map }),
            Material::Relief { base, .. } => self.find_glow(base),
            _ => None,
        }
    }

    fn find_filtered(&self, id: MaterialId) -> bool {
        let any = |inputs: &[Input]| {
            inputs.iter().any(|input| matches!(input, Input::Texture(id) if self.textures.is_filtered(*id)))
        };
        match *self.get(id) {
            Material::Diffuse { color } | Material::Mirror { color } | Material::Plastic { color, .. } => {
                any(&[color])
            }
            Material::Whitted { diffuse, specular, .. } | Material::Phong { diffuse, specular, .. } => {
                any(&[diffuse, specular])
            }
            Material::Metal { f0, edge, .. } => any(&[f0, edge]),
            Material::Principled(of) => any(&[of.color]),
            Material::Mix { a, b, .. } | Material::TwoSided { front: a, back: b } => {
                self.find_filtered(a) || self.find_filtered(b)
            }
            Material::Layer { base, .. }
            | Material::Mask { base, .. }
            | Material::Glow { base, .. }
            | Material::Relief { base, .. } => self.find_filtered(base),
            Material::Glass(_) | Material::Emissive { .. } => false,
        }
    }

    /// What fills a material. Of what is only partly clear, nothing is known.
    fn find_interior(&self, id: MaterialId) -> Option<Interior> {
        match *self.get(id) {
            Material::Glass(Glass { ior, absorption, priority, spread, thin: false, .. }) => {
                Some(Interior { ior, absorption, priority, spread })
            }
            Material::Whitted { ior, .. } => {
                Some(Interior { ior, absorption: Rgb::BLACK, priority: 0, spread: 0.0 })
            }
            Material::Principled(Principled { ior, transmission, .. })
                if transmission != Input::Constant(Rgb::BLACK) =>
            {
                Some(Interior { ior, absorption: Rgb::BLACK, priority: 0, spread: 0.0 })
            }
            Material::Relief { base, .. } | Material::Mask { base, .. } | Material::Glow { base, .. } => {
                self.find_interior(base)
            }
            _ => None,
        }
    }

    /// An input at a point, held to [0, 1] where it is looked up.
    pub fn color(&self, input: Input, surface: &SurfacePoint) -> Rgb {
        match input {
            Input::Constant(color) => color,
            // Reflectances beyond 1 were reported; they must not light the scene.
            Input::Texture(id) => self.textures.eval(id, surface).map(|x| x.clamp(0.0, 1.0)),
        }
    }

    fn scalar(&self, input: Input, surface: &SurfacePoint) -> f32 {
        self.color(input, surface).mean()
    }

    /// The width of slopes from a perceptual roughness.
    fn alpha(&self, roughness: Input, surface: &SurfacePoint) -> f32 {
        let roughness = self.scalar(roughness, surface).clamp(0.0, 1.0);
        roughness * roughness
    }
}

/// Metal of any roughness.
fn metal(reflectance: Reflectance, alpha: f32, share: f32) -> Lobe {
    if alpha < MIRROR_ALPHA {
        Lobe::Mirror(reflectance * share)
    } else {
        Lobe::Conductor(Conductor::metal(reflectance, alpha, share))
    }
}

/// Glass of any roughness and thickness.
fn clear(glass: &Glass, alpha: f32, share: f32) -> Lobe {
    let &Glass { ior, tint, thin, .. } = glass;
    if thin {
        Lobe::Pane(Pane { share, ior, tint, alpha })
    } else if alpha < MIRROR_ALPHA || (ior - 1.0).abs() < RoughDielectric::LEAST_BEND {
        Lobe::Dielectric { share, ior, tint }
    } else {
        Lobe::RoughDielectric(RoughDielectric { share, ior, tint, alpha })
    }
}

/// The outside of something clear.
fn shine(ior: f32, alpha: f32, share: f32) -> Lobe {
    let reflectance = Reflectance::of_ior(ior);
    if alpha < MIRROR_ALPHA {
        Lobe::Mirror(reflectance * share)
    } else {
        Lobe::Conductor(Conductor::coat(reflectance, alpha, share))
    }
}

/// A matt body under its own coat.
fn add_coated(bsdf: &mut Bsdf, color: Rgb, ior: f32, alpha: f32, share: f32) {
    bsdf.add(Lobe::Substrate(Substrate::new(color, ior, Coat::new(ior, alpha, 1.0), share)));
    bsdf.add(shine(ior, alpha, share));
}

/// A coat over the lobes from `first` on.
fn add_coat(bsdf: &mut Bsdf, first: usize, ior: f32, alpha: f32, cover: f32, share: f32) {
    if cover > 0.0 {
        bsdf.cover(Coat::new(ior, alpha, cover), first);
        bsdf.add(shine(ior, alpha, share * cover));
    }
}

/// The most lobes that a material can have at a point: each glossy part and each glass is one, all diffuse parts
/// together are one, and all mirrors are, apart from those under a coat. A world takes no material with more than
/// [`Bsdf::MAX_LOBES`], and none with two coats.
pub fn lobe_count(materials: &[Material], id: MaterialId) -> usize {
    let mut parts = Vec::new();
    collect_parts(materials, id, false, &mut parts);
    let any = |wanted: fn(&Material) -> bool, under| {
        usize::from(parts.iter().any(|(part, covered)| *covered == under && wanted(part)))
    };
    let matt = |part: &Material| {
        matches!(part, Material::Diffuse { .. } | Material::Phong { .. } | Material::Whitted { .. })
    };
    let mirror = |part: &Material| matches!(part, Material::Mirror { .. });
    let own = |(part, _): &(Material, bool)| match part {
        Material::Phong { .. } | Material::Metal { .. } | Material::Glass(_) | Material::Layer { .. } => 1,
        Material::Plastic { .. } => 2,
        Material::Principled(_) => 5,
        _ => 0,
    };
    let alike: usize = [false, true].into_iter().map(|under| any(matt, under) + any(mirror, under)).sum();
    alike + parts.iter().map(own).sum::<usize>()
}

/// The materials that a mix or layer comes down to, each with whether it lies under a coat; layers count as themselves.
fn collect_parts(materials: &[Material], id: MaterialId, covered: bool, parts: &mut Vec<(Material, bool)>) {
    match materials[id.0 as usize] {
        Material::Mix { a, b, .. } => {
            collect_parts(materials, a, covered, parts);
            collect_parts(materials, b, covered, parts);
        }
        layer @ Material::Layer { base, .. } => {
            collect_parts(materials, base, true, parts);
            parts.push((layer, covered));
        }
        Material::Mask { base, .. }
        | Material::TwoSided { front: base, .. }
        | Material::Glow { base, .. }
        | Material::Relief { base, .. } => collect_parts(materials, base, covered, parts),
        part => parts.push((part, covered)),
    }
}
