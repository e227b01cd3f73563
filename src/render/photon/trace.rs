//! Photons from the lights through the scene.

use super::Photon;
use crate::math::{Ray, Rgb};
use crate::render::bsdf::{Bsdf, Lobe, Transport};
use crate::render::effects::Effects;
use crate::render::geometry::SurfacePoint;
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
            let time = pass.moment(world);
            let counters = Counters::default();
            let mut tracer = Tracer { world, max_depth, time, photons: Vec::new(), counters };
            for photon in chunk * CHUNK..count.min((chunk + 1) * CHUNK) {
                tracer.emit(&pass.photon_sampler(photon), 1.0 / count as f32);
            }
            (tracer.photons, tracer.counters)
        })
        .collect();
    let mut counters = Counters { photons: count.into(), ..Counters::default() };
    chunks.iter().for_each(|(_, of_chunk)| counters += *of_chunk);
    let photons: Vec<Photon> = chunks.into_iter().flat_map(|(photons, _)| photons).collect();
    counters.stored_photons = photons.len() as u64;
    (photons, counters)
}

/// Follows photons one after the other.
struct Tracer<'a> {
    world: &'a World,
    max_depth: u32,
    /// When all of them are under way.
    time: f32,
    photons: Vec<Photon>,
    counters: Counters,
}

impl Tracer<'_> {
    /// One photon, which stands for `share` of all light, from surface to surface; left on each that gathers photons.
    fn emit(&mut self, sampler: &Sampler, share: f32) {
        let choice = self.world.lights.choose(sampler.get_1d(Dim::PhotonLight));
        let Some((light, pmf)) = choice else { return };
        let (u_pos, u_dir) = (sampler.get_2d(Dim::PhotonPosition), sampler.get_2d(Dim::PhotonDirection));
        let start = self.world.sample_emission(light, u_pos, u_dir);
        let ray = start.ray.at_time(self.time);
        let mut flight = Flight::new(self.world, ray, start.weight * (share / pmf), sampler);
        while flight.bounce + 1 < self.max_depth {
            let Some((surface, bsdf)) = flight.arrive(&mut self.counters) else { return };
            if bsdf.lobes().iter().any(gathers) {
                self.photons.push(flight.photon(&surface));
            }
            let Some(specular) = flight.go_on(&surface, &bsdf) else { return };
            if !specular && !self.world.effects.has(Effects::INDIRECT) {
                return;
            }
        }
    }
}

/// A photon under way.
pub(super) struct Flight<'a> {
    world: &'a World,
    sampler: &'a Sampler,
    ray: Ray,
    power: Rgb,
    media: Media,
    /// Surfaces left so far.
    pub bounce: u32,
}

impl<'a> Flight<'a> {
    /// A photon that leaves its light.
    pub fn new(world: &'a World, ray: Ray, power: Rgb, sampler: &'a Sampler) -> Self {
        Self { world, sampler, ray, power, media: Media::start(&world.materials, sampler), bounce: 0 }
    }

    /// Goes to the next surface; `None` if there is none, or if nothing arrives.
    #[inline]
    pub fn arrive(&mut self, counters: &mut Counters) -> Option<(SurfacePoint, Bsdf)> {
        counters.rays += 1;
        let hit = self.world.closest_hit(&self.ray)?;
        let surface = self.world.interaction(&self.ray, &hit);
        let bsdf = self.world.bsdf_between(&surface, -self.ray.d, &self.media);
        self.power *= self.media.transmittance(hit.t, &self.world.materials);
        let is_valid = self.power.is_valid();
        counters.bad_light += u64::from(!is_valid);
        (is_valid && !self.power.is_black()).then_some((surface, bsdf))
    }

    /// What it leaves on the surface it is at.
    pub fn photon(&self, surface: &SurfacePoint) -> Photon {
        let wi = -self.ray.d;
        let n = if wi.dot(surface.n) < 0.0 { -surface.n } else { surface.n };
        Photon { p: surface.p, wi, n, power: self.power, depth: self.bounce + 2 }
    }

    /// Leaves the surface it is at in a direction that `bsdf` draws, and says whether that was the only one possible;
    /// `None` if it ends there.
    ///
    /// What is absorbed ends photons rather than dimming them: those that survive all carry much alike.
    #[inline]
    pub fn go_on(&mut self, surface: &SurfacePoint, bsdf: &Bsdf) -> Option<bool> {
        let bounce = self.bounce;
        let (u, u_lobe) = (self.sampler.get_2d(Dim::Bsdf(bounce)), self.sampler.get_1d(Dim::Lobe(bounce)));
        let next = bsdf.sample(-self.ray.d, u, u_lobe, Transport::Importance)?;
        let survival = next.weight.max_component().min(1.0);
        if self.sampler.get_1d(Dim::Roulette(bounce)) >= survival {
            return None;
        }
        self.power *= next.weight / survival;
        self.ray = surface.spawn(next.wi);
        if next.through {
            let inwards = next.wi.dot(surface.n) < 0.0;
            self.power *= self.media.pass(surface.material, inwards, &self.world.materials);
        }
        self.bounce += 1;
        Some(next.specular)
    }
}
