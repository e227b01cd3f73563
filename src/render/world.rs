//! Everything a render needs, from plain data to ready tables.

use super::bsdf::{Bsdf, Material, Materials};
use super::camera::Camera;
use super::geometry::{Geometry, Hit, Shapes, SurfacePoint};
use super::light::{Environment, Light, Lights, Sky};
use super::media::Media;
use super::shape::{Instance, Mesh, Solid};
use super::texture::Texture;
use crate::math::{Ray, Rgb, Vec3};
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
    /// How long the tree and the tables took to build, in seconds.
    pub build_seconds: f64,
}

impl World {
    /// Builds the tree over the shapes, a light for each primitive that emits, and the table to choose among lights.
    pub fn new(parts: Parts) -> Self {
        let start = Instant::now();
        let Parts { meshes, shared, instances, solids, .. } = parts;
        let geometry = Geometry::new(Shapes { meshes, shared, instances, solids });
        let materials = Materials::new(parts.materials, parts.textures);
        let lights = Lights::new(parts.lights, parts.environment.map(Sky::new), &geometry, &materials);
        let build_seconds = start.elapsed().as_secs_f64();
        Self { geometry, materials, lights, camera: parts.camera, build_seconds }
    }

    /// The nearest surface along a ray.
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        self.geometry.closest_hit(ray)
    }

    /// Whether anything lies on the ray before its end.
    pub fn any_hit(&self, ray: &Ray) -> bool {
        self.geometry.any_hit(ray)
    }

    /// The full surface point of a hit.
    pub fn interaction(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        self.geometry.surface_point(ray, hit)
    }

    /// How the surface scatters there.
    pub fn bsdf(&self, surface: &SurfacePoint) -> Bsdf {
        self.materials.bsdf(surface)
    }

    /// How the surface scatters there, seen along `wo` from within `media`.
    pub fn bsdf_between(&self, surface: &SurfacePoint, wo: Vec3, media: &Media) -> Bsdf {
        let bsdf = self.materials.bsdf(surface);
        let from_outside = wo.dot(surface.n) > 0.0;
        match media.relative_ior(surface.material, from_outside, &self.materials) {
            Some(ior) => bsdf.with_ior(ior),
            None => bsdf,
        }
    }

    /// The radiance that the surface emits along `wo`.
    pub fn emitted(&self, surface: &SurfacePoint, wo: Vec3) -> Rgb {
        self.materials.emission(surface.material).radiance(wo.dot(surface.n))
    }
}
