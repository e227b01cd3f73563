//! All materials of a world, and what is asked of them at a point.

use super::material::{Emission, Glass, Interior, Material, Principled, Relief};
use super::{Bsdf, lobe_count};
use crate::math::Rgb;
use crate::render::effects::Effects;
use crate::render::geometry::SurfacePoint;
use crate::render::shape::MaterialId;
use crate::render::texture::{Input, Texture, Textures};

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

    pub(super) fn scalar(&self, input: Input, surface: &SurfacePoint) -> f32 {
        self.color(input, surface).mean()
    }

    /// The width of slopes from a perceptual roughness.
    pub(super) fn alpha(&self, roughness: Input, surface: &SurfacePoint) -> f32 {
        let roughness = self.scalar(roughness, surface).clamp(0.0, 1.0);
        roughness * roughness
    }
}
