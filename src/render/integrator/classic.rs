//! Recursive ray tracing (Whitted 1980): Phong's illumination by each light, shadows, and a ray each for what a surface
//! mirrors and lets through.
//!
//! It simulates no light between matt surfaces, and promises no energy: it is here for pictures that were made this way.
//! A light's colour is not divided by π: a white matt surface that faces a light of colour 1 is 1.

use super::{Counters, Event, Integrator, Pass, Witness};
use crate::math::{Ray, Rgb, Vec3, float};
use crate::render::bsdf::{Glass, Material, fresnel_dielectric};
use crate::render::geometry::SurfacePoint;
use crate::render::light::Light;
use crate::render::media::Media;
use crate::render::sampler::{Dim, Sampler};
use crate::render::world::World;

/// The formula of highlights.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Shading {
    /// By the angle between the viewer and the mirrored light (Phong 1975).
    Phong,
    /// By the angle between the normal and the half vector (Blinn 1977).
    Blinn,
}

/// Settings of recursive ray tracing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ClassicSettings {
    /// The formula of highlights.
    pub shading: Shading,
    /// Whether surfaces between a point and a light keep the light away.
    pub shadows: bool,
    /// What reaches every point from everywhere; times its diffuse colour.
    pub ambient: Rgb,
    /// Whether normals turn to the viewer, so that surfaces are lit when seen from behind.
    pub lit_backs: bool,
}

/// A recursive ray tracer.
pub struct Classic<'a> {
    world: &'a World,
    settings: ClassicSettings,
    max_depth: u32,
    /// Lights without size: all of them are asked at every point.
    delta_lights: Vec<&'a Light>,
    /// Whether there are lights with a size: a point on one of them is asked.
    has_area_lights: bool,
}

/// A ray of the tree that starts at the camera.
struct Branch {
    ray: Ray,
    /// What it sees counts this much.
    weight: Rgb,
    /// Surfaces met before.
    depth: u32,
    media: Media,
}

/// Rays that count less than this are not followed: a fifth of a step of an 8-bit display.
const LEAST_WEIGHT: f32 = 1e-3;

impl<'a> Classic<'a> {
    /// A tracer of rays that meet at most `max_depth` surfaces in a row.
    pub fn new(world: &'a World, settings: ClassicSettings, max_depth: u32) -> Self {
        let lights = || world.lights.all().iter();
        let delta_lights = lights().filter(|light| light.is_delta()).collect();
        let has_area_lights = lights().any(|light| matches!(light, Light::Area { .. }));
        Self { world, settings, max_depth, delta_lights, has_area_lights }
    }
}

impl Integrator for Classic<'_> {
    fn world(&self) -> &World {
        self.world
    }

    fn begin_pass(&mut self, _: Pass, _: &mut Counters, _: &(dyn Fn() -> bool + Sync)) {}

    fn radiance<W: Witness>(
        &self,
        ray: Ray,
        sampler: &Sampler,
        counters: &mut Counters,
        witness: &mut W,
    ) -> Rgb {
        let mut radiance = Rgb::BLACK;
        let mut tree = Vec::new();
        let mut next = Some(Branch { ray, weight: Rgb::WHITE, depth: 0, media: Media::NONE });
        while let Some(branch) = next {
            radiance += self.follow(&branch, &mut tree, sampler, counters, witness);
            next = tree.pop();
        }
        radiance
    }
}

impl Classic<'_> {
    /// What a branch adds to the picture; the branches that grow from its end are left in `tree`.
    fn follow(
        &self,
        branch: &Branch,
        tree: &mut Vec<Branch>,
        sampler: &Sampler,
        counters: &mut Counters,
        witness: &mut impl Witness,
    ) -> Rgb {
        let world = self.world;
        counters.rays += 1;
        let Some(hit) = world.closest_hit(&branch.ray) else {
            let added = branch.weight * world.lights.sky(branch.ray.d).0;
            witness.note(|| Event::Sky { dir: branch.ray.d, added });
            return added;
        };
        let surface = world.interaction(&branch.ray, &hit);
        let wo = -branch.ray.d;
        let weight = branch.weight * branch.media.transmittance(hit.t, &world.materials);
        witness.note(|| Event::Vertex { surface, wo, t: hit.t, beta: weight });
        let parts = world.materials.parts(surface.material, &surface);
        let vertex = Vertex { surface: &surface, parts: &parts, wo, depth: branch.depth };

        if branch.depth + 1 < self.max_depth {
            for &(share, part) in &parts {
                self.grow(&vertex, part, weight * share, &branch.media, tree);
            }
        }
        let added = weight * (world.emitted(&surface, wo) + self.lit(&vertex, sampler, counters));
        witness.note(|| Event::Lit { added });
        added
    }

    /// What the lights make of a point, by the materials' own colours.
    fn lit(&self, vertex: &Vertex, sampler: &Sampler, counters: &mut Counters) -> Rgb {
        let mut color = self.settings.ambient * self.diffuse(vertex);
        for light in &self.delta_lights {
            color += self.lit_by(light, 1.0, vertex, sampler, counters);
        }
        // Of lights with a size one is drawn; each pass draws anew, and their mean is a soft shadow (Cook et al. 1984).
        if self.has_area_lights {
            let u = sampler.get_1d(Dim::LightChoice(vertex.depth));
            if let Some((light @ Light::Area { .. }, pmf)) = self.world.lights.choose(u) {
                color += self.lit_by(light, pmf, vertex, sampler, counters);
            }
        }
        color
    }

    /// What one light, chosen with probability `pmf`, makes of a point.
    fn lit_by(
        &self,
        light: &Light,
        pmf: f32,
        vertex: &Vertex,
        sampler: &Sampler,
        counters: &mut Counters,
    ) -> Rgb {
        let u = sampler.get_2d(Dim::Light(vertex.depth));
        let Some(drawn) = light.sample_li(&self.world.geometry, vertex.surface.p, u) else {
            return Rgb::BLACK;
        };
        let color = self.reflected(vertex, drawn.wi) * drawn.radiance / (drawn.pdf * pmf);
        if color.is_black() || !self.settings.shadows {
            return color;
        }
        counters.rays += 1;
        if self.world.any_hit(&drawn.shadow_ray(vertex.surface)) { Rgb::BLACK } else { color }
    }

    /// The share of light from `wi` that goes to the viewer: diffuse · max(0, n·l) + specular · highlight.
    ///
    /// The highlight of an exponent of 0 is 1 everywhere, even where the light is behind the surface.
    fn reflected(&self, vertex: &Vertex, wi: Vec3) -> Rgb {
        let n = self.normal(vertex);
        let cos = n.dot(wi);
        let highlight = match self.settings.shading {
            Shading::Phong => vertex.wo.dot(n * (2.0 * cos) - wi),
            Shading::Blinn => n.dot((vertex.wo + wi).normalize_or_zero()),
        };
        let materials = &self.world.materials;
        let mut color = self.diffuse(vertex) * cos.max(0.0);
        for &(share, part) in vertex.parts {
            if let Material::Phong { specular, shininess, .. }
            | Material::Whitted { specular, shininess, .. } = *part
            {
                let specular = materials.color(specular, vertex.surface);
                color += specular * (share * float::pow(highlight.max(0.0), shininess));
            }
        }
        color
    }

    /// The sum of the matt colours at a point.
    fn diffuse(&self, vertex: &Vertex) -> Rgb {
        let mut sum = Rgb::BLACK;
        for &(share, part) in vertex.parts {
            if let Material::Diffuse { color: diffuse }
            | Material::Phong { diffuse, .. }
            | Material::Plastic { color: diffuse, .. }
            | Material::Whitted { diffuse, .. } = *part
            {
                sum += self.world.materials.color(diffuse, vertex.surface) * share;
            }
        }
        sum
    }

    /// The normal that light is measured by.
    fn normal(&self, vertex: &Vertex) -> Vec3 {
        let behind = vertex.wo.dot(vertex.surface.n) < 0.0;
        if behind && self.settings.lit_backs { -vertex.surface.ns } else { vertex.surface.ns }
    }

    /// Adds the rays by which a part of a material sees on.
    fn grow(&self, vertex: &Vertex, part: &Material, weight: Rgb, media: &Media, tree: &mut Vec<Branch>) {
        let (surface, wo) = (vertex.surface, vertex.wo);
        let from_outside = wo.dot(surface.n) > 0.0;
        let n = if from_outside { surface.ns } else { -surface.ns };
        let cos = wo.dot(n).clamp(0.0, 1.0);
        let eta = self.eta(surface, part, media, from_outside);
        let (fresnel, cos_t) = fresnel_dielectric(f64::from(cos), f64::from(eta));
        let crossing = Crossing { eta, cos, cos_t: cos_t as f32, fresnel: fresnel as f32 };
        let (reflection, transmission) = self.see_on(surface, part, &crossing);

        let mut add = |wi: Vec3, factor: Rgb, media: Media| {
            let weight = weight * factor;
            if weight.max_component() >= LEAST_WEIGHT {
                let ray = surface.spawn(wi.normalize());
                tree.push(Branch { ray, weight, depth: vertex.depth + 1, media });
            }
        };
        add(n * (2.0 * cos) - wo, reflection, *media);
        if crossing.cos_t > 0.0 {
            let mut beyond = *media;
            beyond.cross(surface.material, from_outside);
            add(n * (cos / eta - crossing.cos_t) - wo / eta, transmission, beyond);
        }
    }

    /// The refractive index beyond the surface over that on the viewer's side.
    fn eta(&self, surface: &SurfacePoint, part: &Material, media: &Media, from_outside: bool) -> f32 {
        let (Material::Glass(Glass { ior, thin: false, .. }) | Material::Whitted { ior, .. }) = *part else {
            return 1.0;
        };
        let between = media.relative_ior(surface.material, from_outside, &self.world.materials);
        let ior = between.unwrap_or(ior);
        if from_outside { ior } else { 1.0 / ior }
    }

    /// The factors of what is seen mirrored, and of what is seen through the surface.
    fn see_on(&self, surface: &SurfacePoint, part: &Material, crossing: &Crossing) -> (Rgb, Rgb) {
        let color = |input| self.world.materials.color(input, surface);
        match *part {
            Material::Mirror { color: reflection } | Material::Metal { f0: reflection, .. } => {
                (color(reflection), Rgb::BLACK)
            }
            Material::Glass(Glass { tint, thin: true, .. }) => (Rgb::BLACK, tint),
            Material::Glass(Glass { tint, .. }) => {
                (Rgb::gray(crossing.fresnel), tint * (1.0 - crossing.fresnel))
            }
            Material::Whitted { reflection, transmission, fresnel, .. } => {
                let (mirrored, through) = match fresnel {
                    true => (crossing.schlick(), 1.0 - crossing.schlick()),
                    false => (1.0, 1.0),
                };
                (color(reflection) * mirrored, color(transmission) * through)
            }
            _ => (Rgb::BLACK, Rgb::BLACK),
        }
    }
}

/// How a ray meets the boundary of two media.
struct Crossing {
    /// The refractive index beyond over that on the viewer's side.
    eta: f32,
    /// The cosine of the ray, and that of the refracted one; 0 under total reflection.
    cos: f32,
    cos_t: f32,
    /// Fresnel's reflectance.
    fresnel: f32,
}

impl Crossing {
    /// Fresnel reflectance as r₀ + (1 − r₀)(1 − cos θ)⁵, with θ the angle on the thinner side (Schlick 1994, eq. 15).
    fn schlick(&self) -> f32 {
        if self.cos_t == 0.0 {
            return 1.0;
        }
        let r0 = ((self.eta - 1.0) / (self.eta + 1.0)).powi(2);
        let x = 1.0 - if self.eta < 1.0 { self.cos_t } else { self.cos };
        r0 + (1.0 - r0) * x.powi(5)
    }
}

/// A point where a branch met a surface.
struct Vertex<'a> {
    surface: &'a SurfacePoint,
    parts: &'a [(f32, &'a Material)],
    wo: Vec3,
    depth: u32,
}
