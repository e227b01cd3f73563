//! All lights of a world, and the choice among them.

use super::{AliasTable, Light, Sky};
use crate::math::{Rgb, Vec3};
use crate::render::bsdf::Materials;
use crate::render::geometry::{Geometry, PrimId, SurfacePoint};
use rustc_hash::FxHashMap;

/// The lights of a world, chosen with probabilities in proportion to their power.
pub struct Lights {
    lights: Vec<Light>,
    table: AliasTable,
    /// Where the light of a primitive stands in `lights`.
    by_prim: FxHashMap<PrimId, u32>,
    /// Where the environment stands in `lights`.
    sky: Option<u32>,
}

impl Lights {
    /// The given lights, one for each primitive that emits, and the sky.
    ///
    /// What emits but cannot be drawn from (a plane, an exact surface of revolution) is not among them: it is seen
    /// where a path meets it, and throws no photons.
    pub fn new(mut lights: Vec<Light>, sky: Option<Sky>, geometry: &Geometry, materials: &Materials) -> Self {
        let mut by_prim = FxHashMap::default();
        for prim in shining_prims(geometry, materials) {
            by_prim.insert(prim, lights.len() as u32);
            lights.push(Light::Area { prim, emission: *materials.emission(geometry.material(prim)) });
        }
        let sky = sky.map(|sky| {
            lights.push(Light::Environment(Box::new(sky)));
            lights.len() as u32 - 1
        });
        let weights: Vec<f64> =
            lights.iter().map(|light| f64::from(light.power(geometry).luminance())).collect();
        Self { lights, table: AliasTable::new(&weights), by_prim, sky }
    }

    /// A light with its probability, by `u` in [0, 1); `None` when none has power.
    pub fn choose(&self, u: f32) -> Option<(&Light, f32)> {
        let (index, pmf) = self.table.sample(u)?;
        Some((&self.lights[index], pmf))
    }

    /// The density, per steradian seen from `from`, with which the point `at` of a shining primitive is drawn.
    ///
    /// Counts the choice of the light; 0 for what is never drawn.
    pub fn pdf_area(&self, geometry: &Geometry, from: Vec3, at: &SurfacePoint) -> f32 {
        match self.by_prim.get(&at.prim) {
            Some(&index) => self.table.pmf(index as usize) * geometry.pdf_toward(at.prim, from, at),
            None => 0.0,
        }
    }

    /// The radiance of the sky in a direction, and the density per steradian with which it is drawn.
    pub fn sky(&self, dir: Vec3) -> (Rgb, f32) {
        let Some(index) = self.sky else { return (Rgb::BLACK, 0.0) };
        match &self.lights[index as usize] {
            Light::Environment(sky) => (sky.radiance(dir), self.table.pmf(index as usize) * sky.pdf(dir)),
            _ => unreachable!("`sky` is the index of the environment"),
        }
    }

    /// Every light.
    pub fn all(&self) -> &[Light] {
        &self.lights
    }
}

/// The primitives that emit and that points can be drawn from.
fn shining_prims(geometry: &Geometry, materials: &Materials) -> Vec<PrimId> {
    let shines = |material| !materials.emission(material).is_none();
    let triangles = geometry
        .mesh_prims()
        .filter(|(material, _)| shines(*material))
        .flat_map(|(_, prims)| prims.map(PrimId));
    let solids = geometry
        .solid_prims()
        .filter(|(solid, _)| shines(solid.material))
        .filter(|(solid, _)| solid.kind.can_be_sampled())
        .map(|(_, prim)| prim);
    triangles.chain(solids).collect()
}
