//! Caustics: light that falls on a matt surface by way of something sharp, L S⁺ D, from photons that are aimed at it.
//!
//! The path tracer leaves exactly these ways of light to the photons, and finds all others itself. Which are they? Call a
//! lobe sharp if photons are not gathered through it ([`gathers`]), and follow a path from the light: the first vertex is
//! a target, light leaves it and all further ones through their sharp lobes, and arrives at one that is seen through its
//! other lobes. A surface with lobes of both kinds takes part in both roles, each lobe in its own.

use super::aim::{Aim, Source};
use super::trace::Flight;
use super::{Gather, Photon, PhotonMap, Schedule, gathers};
use crate::math::{Rgb, Vec3};
use crate::render::bsdf::{Bsdf, MaterialId};
use crate::render::driver::{GatherRadius, HybridSettings};
use crate::render::geometry::{PrimId, SurfacePoint};
use crate::render::integrator::{Counters, Pass};
use crate::render::sampler::Sampler;
use crate::render::world::World;
use rayon::prelude::*;

/// Photons that one thread emits in a row.
const CHUNK: u32 = 1024;

/// A map of caustics, made anew for each pass.
pub struct Caustics<'a> {
    world: &'a World,
    aim: Aim<'a>,
    settings: HybridSettings,
    max_depth: u32,
    schedule: Schedule,
    map: PhotonMap,
}

impl<'a> Caustics<'a> {
    /// Caustics of light along paths with at most `max_depth` vertices, the one on the light included and the camera not;
    /// `None` when no light reaches anything that could throw one.
    pub fn new(world: &'a World, settings: HybridSettings, max_depth: u32) -> Option<Self> {
        let aim = Aim::new(world);
        let first = match settings.radius {
            GatherRadius::Meters(radius) => radius,
            GatherRadius::Pixels(_) => 1.0, // times what a pixel covers
        };
        let schedule = Schedule::new(first, settings.shrink);
        let map = PhotonMap::default();
        (!aim.is_idle()).then_some(Self { world, aim, settings, max_depth, schedule, map })
    }

    /// What is left of the square of the first pass's radius in this one.
    pub fn blur(&self) -> f64 {
        self.schedule.shrunk()
    }

    /// Makes the map of a pass; leaves it unfinished once `cancelled`.
    pub fn begin_pass(&mut self, pass: Pass, counters: &mut Counters, cancelled: &(dyn Fn() -> bool + Sync)) {
        self.schedule.radius2(pass.index);
        let count = self.settings.photon_count;
        let chunks: Vec<_> = (0..count.div_ceil(CHUNK))
            .into_par_iter()
            .filter(|_| !cancelled())
            .map(|chunk| {
                let time = pass.moment(self.world);
                let counters = Counters::default();
                let mut tracer = Tracer { caustics: self, time, photons: Vec::new(), counters };
                for photon in chunk * CHUNK..count.min((chunk + 1) * CHUNK) {
                    tracer.emit(&pass.photon_sampler(photon), 1.0 / count as f32);
                }
                (tracer.photons, tracer.counters)
            })
            .collect();
        chunks.iter().for_each(|(_, of_chunk)| *counters += *of_chunk);
        let photons: Vec<Photon> = chunks.into_iter().flat_map(|(photons, _)| photons).collect();
        counters.photons += u64::from(count);
        counters.stored_photons += photons.len() as u64;
        self.map = PhotonMap::new(&photons);
    }

    /// Whether photons bring what such light sends by way of this surface as the first: then nothing else may.
    pub fn owns(&self, source: Source, material: MaterialId, prim: PrimId) -> bool {
        self.aim.owns(source, material, prim)
    }

    /// The radiance of the caustics on a surface along `wo`.
    ///
    /// `camera_depth` is the number of vertices of the camera path, this one included; `footprint` is the width of what a
    /// pixel covers here, in metres.
    pub fn radiance(
        &self,
        surface: &SurfacePoint,
        bsdf: &Bsdf,
        wo: Vec3,
        camera_depth: u32,
        footprint: f32,
    ) -> Rgb {
        if self.map.photons().is_empty() {
            return Rgb::BLACK;
        }
        let shrunk = self.schedule.current() as f32;
        let radius2 = match self.settings.radius {
            GatherRadius::Meters(_) => shrunk,
            GatherRadius::Pixels(pixels) => shrunk * (pixels * footprint) * (pixels * footprint),
        };
        let max_depth = self.max_depth + 1 - camera_depth; // this vertex belongs to both paths
        let gather = Gather { radius2, k: self.settings.k.max(2) as usize, max_depth };
        if bsdf.lobes().iter().all(gathers) {
            return gather.radiance(&self.map, surface, bsdf, wo);
        }
        let wide = bsdf.only(gathers);
        if wide.lobes().is_empty() { Rgb::BLACK } else { gather.radiance(&self.map, surface, &wide, wo) }
    }
}

/// Follows photons one after the other.
struct Tracer<'a> {
    caustics: &'a Caustics<'a>,
    /// When all of them are under way.
    time: f32,
    photons: Vec<Photon>,
    counters: Counters,
}

impl Tracer<'_> {
    /// One photon, which stands for `share` of all light; left on the surfaces that it reaches by way of sharp lobes alone.
    fn emit(&mut self, sampler: &Sampler, share: f32) {
        let Caustics { world, aim, max_depth, .. } = self.caustics;
        let Some(start) = aim.emit(sampler, self.time) else { return };
        let mut flight = Flight::new(world, start.ray, start.power * share, sampler);
        while flight.bounce + 1 < *max_depth {
            let Some((surface, bsdf)) = flight.arrive(&mut self.counters) else { return };
            let is_first = flight.bounce == 0;
            if is_first && !aim.holds(surface.material, surface.prim, start.from_infinity) {
                return;
            }
            if !is_first && bsdf.lobes().iter().any(gathers) {
                self.photons.push(flight.photon(&surface));
            }
            // Go on through a sharp lobe.
            if flight.go_on(&surface, &bsdf.only(|lobe| !gathers(lobe))).is_none() {
                return;
            }
        }
    }
}
