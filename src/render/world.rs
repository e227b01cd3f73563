//! Everything a render needs, from plain data to ready tables.

use super::bsdf::{Bsdf, Emission, Material, MaterialId, Materials, Relief, facing};
use super::camera::Camera;
use super::effects::Effects;
use super::geometry::{Geometry, Hit, PrimId, Shapes, SurfacePoint};
use super::ledger;
use super::light::{EmissionSample, Environment, Light, LightEnd, LightSample, Lights, Sky, Viewpoint};
use super::media::Media;
use super::sampler::hash_unit;
use super::shape::solid::orthogonal_tangent;
use super::shape::{Instance, Mesh, Solid};
use super::texture::Texture;
use crate::math::{Ray, Rgb, Vec2, Vec3};
use std::time::Instant;

/// A world as plain data: what [`World::new`] is made of.
pub struct Parts {
    /// Triangles.
    pub meshes: Vec<Mesh>,
    /// Meshes that instances place.
    pub shared: Vec<Mesh>,
    /// Their places.
    pub instances: Vec<Instance>,
    /// Exact shapes.
    pub solids: Vec<Solid>,
    /// What shapes refer to.
    pub materials: Vec<Material>,
    /// What materials refer to.
    pub textures: Vec<Texture>,
    /// Point and directional lights; what emits by its material need not be named.
    pub lights: Vec<Light>,
    /// What surrounds it all.
    pub environment: Option<Environment>,
    /// Who looks.
    pub camera: Camera,
    /// What rays have to ask about; [`Effects::ALL`] is always right.
    pub effects: Effects,
}

/// A world ready for rays.
pub struct World {
    /// All that can be hit.
    pub geometry: Geometry,
    /// How surfaces scatter and emit.
    pub materials: Materials,
    /// Where light comes from.
    pub lights: Lights,
    /// Who looks.
    pub camera: Camera,
    /// What is simulated.
    pub effects: Effects,
    /// Whether the costs of its objects are booked, in the [`ledger`] of the thread.
    pub is_watched: bool,
    /// How long the tree and the tables took to build, in seconds.
    pub build_seconds: f64,
}

impl World {
    /// Builds the tree over the shapes, a light for each primitive that emits, and the table to choose among lights.
    pub fn new(parts: Parts) -> Self {
        let start = Instant::now();
        let Parts { meshes, shared, instances, solids, .. } = parts;
        let geometry = Geometry::new(Shapes { meshes, shared, instances, solids });
        let materials = Materials::new(parts.materials, parts.textures).with_effects(parts.effects);
        let lights = Lights::new(parts.lights, parts.environment.map(Sky::new), &geometry, &materials);
        let build_seconds = start.elapsed().as_secs_f64();
        Self {
            geometry,
            materials,
            lights,
            camera: parts.camera,
            effects: parts.effects,
            is_watched: false,
            build_seconds,
        }
    }

    /// A path leaves the camera.
    pub fn begin_path(&self) {
        if self.is_watched {
            ledger::begin_path();
        }
    }

    /// The nearest surface along a ray; through the holes of masks it goes on.
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        let hit = self.geometry.closest_hit(ray)?;
        if self.effects.has(Effects::ALPHA) { self.beyond_holes(ray, hit) } else { Some(hit) }
    }

    /// Whether anything lies on the ray before its end.
    pub fn any_hit(&self, ray: &Ray) -> bool {
        if self.is_watched {
            ledger::look();
        }
        self.geometry.any_hit(ray) && (!self.effects.has(Effects::ALPHA) || self.closest_hit(ray).is_some())
    }

    /// The first hit that is no hole. `t` counts from the start of the ray.
    fn beyond_holes(&self, ray: &Ray, mut hit: Hit) -> Option<Hit> {
        /// More holes in a row than any foliage has: rays end.
        const MOST: u32 = 1_000;
        let (mut rest, mut behind) = (*ray, 0.0);
        for _ in 0..MOST {
            if !self.materials.is_mask(self.geometry.material(hit.prim)) {
                return Some(Hit { t: behind + hit.t, ..hit });
            }
            let surface = self.geometry.surface_point(&rest, &hit);
            if !self.is_hole(&rest, &surface) {
                return Some(Hit { t: behind + hit.t, ..hit });
            }
            behind += hit.t;
            rest = Ray { t_max: ray.t_max - behind, ..surface.spawn(ray.d) };
            hit = self.geometry.closest_hit(&rest)?;
        }
        None
    }

    /// Whether a ray slips through. Of what is half there, half the rays do: a hash of the ray decides, so that no path
    /// needs a number for it.
    fn is_hole(&self, ray: &Ray, surface: &SurfacePoint) -> bool {
        let opacity = self.materials.opacity(surface);
        opacity < 1.0 && hash_unit(ray.o, ray.d, surface.prim.0) >= opacity
    }

    /// The full surface point of a hit.
    pub fn interaction(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let surface = self.geometry.surface_point(ray, hit);
        if self.is_watched {
            ledger::arrive(surface.source);
        }
        surface
    }

    /// How the surface scatters there.
    pub fn bsdf(&self, surface: &SurfacePoint) -> Bsdf {
        self.materials.bsdf(surface)
    }

    /// How the surface scatters there, seen along `wo` from within `media`.
    pub fn bsdf_between(&self, surface: &SurfacePoint, wo: Vec3, media: &Media) -> Bsdf {
        let from_outside = wo.dot(surface.n) > 0.0;
        let (material, relief) = self.materials.face(surface.material, from_outside);
        let wide = self.is_filtered(surface, material).then(|| self.widened(surface));
        let surface = wide.as_ref().unwrap_or(surface);
        let bent = relief.map(|relief| self.bent(surface, relief, wo));
        // A bsdf is large: it is made once, and changed where it lies.
        let mut bsdf = self.materials.bsdf_of(material, bent.as_ref().unwrap_or(surface));
        match media.boundary(surface.material, from_outside, &self.materials) {
            Some(boundary) if boundary.hidden => bsdf.hide(),
            Some(boundary) => bsdf.set_ior(boundary.ior),
            None => {}
        }
        bsdf
    }

    /// Whether more than a point of the pictures of a material is seen at once.
    fn is_filtered(&self, surface: &SurfacePoint, material: MaterialId) -> bool {
        surface.footprint > 0.0 && self.materials.is_filtered(material)
    }

    /// The surface with how far its footprint reaches over textures.
    fn widened(&self, surface: &SurfacePoint) -> SurfacePoint {
        SurfacePoint { spread: self.geometry.spread(surface), ..*surface }
    }

    /// The surface with its normal bent by a relief, for a viewer along `wo`.
    fn bent(&self, surface: &SurfacePoint, relief: Relief, wo: Vec3) -> SurfacePoint {
        let gradient = self.geometry.gradient(surface);
        let ns = self.materials.bent_normal(surface, relief, &gradient);
        let ns = facing(ns, surface.n, wo);
        SurfacePoint { ns, tangent: orthogonal_tangent(surface.tangent.as_dvec3(), ns), ..*surface }
    }

    /// The radiance that the surface emits along `wo`.
    pub fn emitted(&self, surface: &SurfacePoint, wo: Vec3) -> Rgb {
        let cos = wo.dot(surface.n);
        match self.materials.glows(surface.material) {
            false => self.materials.emission(surface.material).radiance(cos),
            true => self.materials.emission_at(surface).radiance(cos),
        }
    }

    /// What a primitive emits at a point `p` on it, which may be off by its rounding, with the unit normal `n` there.
    pub fn emission_at(&self, prim: PrimId, p: Vec3, n: Vec3) -> Emission {
        let material = self.geometry.material(prim);
        match self.materials.glows(material).then(|| self.geometry.point_near(prim, p, n)) {
            Some(Some(surface)) => self.materials.emission_at(&surface),
            _ => *self.materials.emission(material),
        }
    }

    /// Draws a direction in which a point may see a light, see [`Lights::sample_li`].
    pub fn sample_li(&self, from: &Viewpoint, u_choice: Vec2, u: Vec2) -> Option<LightSample> {
        let drawn = self.lights.sample_li(&self.geometry, from, u_choice, u)?;
        let (Some(prim), LightEnd::At { p, n, .. }) = (drawn.prim, drawn.end) else { return Some(drawn) };
        if !self.materials.glows(self.geometry.material(prim)) {
            return Some(drawn);
        }
        let radiance = self.emission_at(prim, p, n).radiance(-drawn.wi.dot(n));
        Some(LightSample { radiance, ..drawn })
    }

    /// Draws a ray that leaves a light, see [`Light::sample_emission`].
    pub fn sample_emission(&self, light: &Light, u_pos: Vec2, u_dir: Vec2) -> EmissionSample {
        let drawn = light.sample_emission(&self.geometry, u_pos, u_dir);
        let Light::Area { prim, emission } = light else { return drawn };
        if !self.materials.glows(self.geometry.material(*prim)) {
            return drawn;
        }
        let at = self.geometry.sample_area(*prim, u_pos);
        let side = drawn.ray.d.dot(at.n);
        let [here, mean] = [self.emission_at(*prim, at.p, at.n).radiance(side), emission.radiance(side)];
        let share = |here: f32, mean: f32| if mean > 0.0 { here / mean } else { 0.0 };
        let share = Rgb::new(share(here.r, mean.r), share(here.g, mean.g), share(here.b, mean.b));
        EmissionSample { weight: drawn.weight * share, ..drawn }
    }
}
