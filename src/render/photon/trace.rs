//! Photons from the lights through the scene.

use super::Photon;
use crate::math::{Ray, Rgb};
use crate::render::bsdf::{Lobe, Transport};
use crate::render::effects::Effects;
use crate::render::integrator::{Counters, Pass};
use crate::render::media::Media;
use crate::render::sampler::{Dim, Sampler};
use crate::render::world::World;
use rayon::prelude::*;

/// Photons that one thread emits in a row.
const CHUNK: u32 = 4096;
/// A Phong lobe above this exponent, and a microfacet lobe below this α, is too sharp to be estimated from photons.
const SHARP_EXPONENT: f32 = 32.0;
const SHARP_ALPHA: f32 = 0.25;

/// Whether photons are stored for a lobe: those of diffuse and very glossy ones.
///
/// A sharp lobe sees few of the photons around a point, and each as a spot; camera paths follow it instead.
pub fn gathers(lobe: &Lobe) -> bool {
    match *lobe {
        Lobe::Lambert { .. } => true,
        Lobe::Phong { exponent, .. } => exponent <= SHARP_EXPONENT,
        Lobe::Conductor(rough) => rough.alpha >= SHARP_ALPHA,
        Lobe::Substrate(_) => true,
        Lobe::Mirror(_) | Lobe::Dielectric { .. } | Lobe::RoughDielectric(_) | Lobe::Pane(_) => false,
    }
}

/// Emits `count` photons and follows them through the scene; what they leave on surfaces, in the order of emission.
///
/// Light is chosen by power. `max_depth` bounds the vertices of a path from the light to the camera. Once `cancelled`, no
/// more are emitted.
pub fn trace_photons(
    world: &World,
    pass: Pass,
    count: u32,
    max_depth: u32,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> (Vec<Photon>, Counters) {
    let chunks: Vec<_> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .filter(|_| !cancelled())
        .map(|chunk| {
            let mut tracer = Tracer { world, max_depth, photons: Vec::new(), rays: 0 };
            for photon in chunk * CHUNK..count.min((chunk + 1) * CHUNK) {
                tracer.emit(&pass.photon_sampler(photon), 1.0 / count as f32);
            }
            (tracer.photons, tracer.rays)
        })
        .collect();
    let rays = chunks.iter().map(|(_, rays)| rays).sum();
    let photons: Vec<Photon> = chunks.into_iter().flat_map(|(photons, _)| photons).collect();
    let stored_photons = photons.len() as u64;
    (photons, Counters { rays, photons: count.into(), stored_photons })
}

/// Follows photons one after the other.
struct Tracer<'a> {
    world: &'a World,
    max_depth: u32,
    photons: Vec<Photon>,
    rays: u64,
}

impl Tracer<'_> {
    /// One photon, which stands for `share` of all light.
    fn emit(&mut self, sampler: &Sampler, share: f32) {
        let choice = self.world.lights.choose(sampler.get_1d(Dim::PhotonLight));
        let Some((light, pmf)) = choice else { return };
        let (u_pos, u_dir) = (sampler.get_2d(Dim::PhotonPosition), sampler.get_2d(Dim::PhotonDirection));
        let start = light.sample_emission(&self.world.geometry, u_pos, u_dir);
        self.follow(start.ray, start.weight * (share / pmf), sampler);
    }

    /// Along a ray, from surface to surface, leaving a photon on each that gathers them.
    fn follow(&mut self, mut ray: Ray, mut power: Rgb, sampler: &Sampler) {
        let mut media = Media::start(&self.world.materials, sampler);
        for bounce in 0..self.max_depth.saturating_sub(1) {
            self.rays += 1;
            let Some(hit) = self.world.closest_hit(&ray) else { return };
            let surface = self.world.interaction(&ray, &hit);
            let wi = -ray.d;
            let bsdf = self.world.bsdf_between(&surface, wi, &media);
            power *= media.transmittance(hit.t, &self.world.materials);
            if power.is_black() || !power.is_valid() {
                return;
            }
            if bsdf.lobes().iter().any(gathers) {
                let n = if wi.dot(surface.n) < 0.0 { -surface.n } else { surface.n };
                self.photons.push(Photon { p: surface.p, wi, n, power, depth: bounce + 2 });
            }

            let (u, u_lobe) = (sampler.get_2d(Dim::Bsdf(bounce)), sampler.get_1d(Dim::Lobe(bounce)));
            let Some(next) = bsdf.sample(wi, u, u_lobe, Transport::Importance) else { return };
            // What is absorbed ends photons rather than dimming them: those that survive all carry much alike.
            let survival = next.weight.max_component().min(1.0);
            if sampler.get_1d(Dim::Roulette(bounce)) >= survival {
                return;
            }
            if !next.specular && !self.world.effects.has(Effects::INDIRECT) {
                return;
            }
            power *= next.weight / survival;
            ray = surface.spawn(next.wi);
            if next.through {
                power *= media.pass(surface.material, next.wi.dot(surface.n) < 0.0, &self.world.materials);
            }
        }
    }
}
