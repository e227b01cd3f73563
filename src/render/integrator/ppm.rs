//! Progressive photon mapping: all light, direct light too, comes from photons.
//!
//! Each pass emits photons of its own and looks for them from the camera, through smaller discs every time; the mean of
//! the passes converges to the truth (Hachisuka, Ogaki, Jensen 2008; Knaus, Zwicker 2011). Passes know nothing of each
//! other but their number.
//!
//! A camera path gathers at its vertices through the lobes that [`gathers`] names and follows the others, mirrors and
//! sharp reflections, by sampling. Each way of light is thus counted once: what a vertex emits is always added, for no
//! photon is ever gathered through the lobe that led there.

use super::path::roulette;
use super::{Counters, End, Event, Integrator, Pass, Witness};
use crate::math::{Ray, Rgb};
use crate::render::bsdf::{BsdfSample, Transport};
use crate::render::driver::PpmSettings;
use crate::render::media::Media;
use crate::render::photon::{Gather, PhotonMap, Schedule, gathers, trace_photons};
use crate::render::sampler::{Dim, Sampler};
use crate::render::world::World;

/// A photon mapper.
pub struct PhotonMapper<'a> {
    world: &'a World,
    settings: PpmSettings,
    max_depth: u32,
    schedule: Schedule,
    map: PhotonMap,
}

impl<'a> PhotonMapper<'a> {
    /// A mapper of light along paths with at most `max_depth` vertices, the one on the light included and the camera not.
    pub fn new(world: &'a World, settings: PpmSettings, max_depth: u32) -> Self {
        let schedule = Schedule::new(settings.radius, settings.shrink);
        Self { world, settings, max_depth, schedule, map: PhotonMap::default() }
    }
}

impl Integrator for PhotonMapper<'_> {
    fn begin_pass(&mut self, pass: Pass, counters: &mut Counters, cancelled: &(dyn Fn() -> bool + Sync)) {
        self.schedule.radius2(pass.index);
        let count = self.settings.photon_count;
        let (photons, emitted) = trace_photons(self.world, pass, count, self.max_depth, cancelled);
        self.map = PhotonMap::new(&photons);
        *counters += emitted;
    }

    fn blur(&self) -> f64 {
        self.schedule.shrunk()
    }

    fn radiance<W: Witness>(
        &self,
        mut ray: Ray,
        sampler: &Sampler,
        counters: &mut Counters,
        witness: &mut W,
    ) -> Rgb {
        let mut radiance = Rgb::BLACK;
        let mut beta = Rgb::WHITE;
        let mut media = Media::start(&self.world.materials, sampler);
        let mut eta_scale = 1.0; // the factor η² that refraction has taken from beta, and will give back

        for depth in 0..self.max_depth {
            // Find the next vertex, or take what the sky sends and stop.
            counters.rays += 1;
            let Some(hit) = self.world.closest_hit(&ray) else {
                let added = beta * self.world.lights.sky(ray.d).0;
                witness.note(|| Event::Sky { dir: ray.d, added });
                return radiance + added;
            };
            let surface = self.world.interaction(&ray, &hit);
            let wo = -ray.d;
            beta *= media.transmittance(hit.t, &self.world.materials);

            witness.note(|| Event::Vertex { surface, wo, t: hit.t, beta });

            // Add light emitted here, then light that photons brought.
            let added = beta * self.world.emitted(&surface, wo);
            witness.note(|| Event::Emitted { added });
            radiance += added;
            let bsdf = self.world.bsdf_between(&surface, wo, &media);
            witness.note(|| Event::Lobes(bsdf.lobes().to_vec()));
            let rough = bsdf.only(gathers);
            if !rough.lobes().is_empty() {
                let gather = Gather {
                    radius2: self.schedule.current() as f32,
                    k: self.settings.k.max(2) as usize,
                    max_depth: self.max_depth - depth, // this vertex belongs to both paths
                };
                let added = beta * gather.radiance(&self.map, &surface, &rough, wo);
                witness.note(|| Event::Photons { added });
                radiance += added;
            }

            // Follow one sharp reflection onwards.
            let sharp = bsdf.only(|lobe| !gathers(lobe));
            let (u, u_lobe) = (sampler.get_2d(Dim::Bsdf(depth)), sampler.get_1d(Dim::Lobe(depth)));
            let Some(next) = sharp.sample(wo, u, u_lobe, Transport::Radiance) else {
                witness.note(|| Event::Ended(End::Absorbed));
                break;
            };
            witness.note(|| {
                let BsdfSample { wi, weight, pdf, through, .. } = next;
                Event::Scattered { lobe: sharp.lobe_chosen(wo, u_lobe), wi, weight, pdf, through }
            });
            beta *= next.weight;
            eta_scale *= next.eta * next.eta;
            ray = surface.spawn(next.wi);
            if next.through {
                beta *= media.pass(surface.material, next.wi.dot(surface.n) < 0.0, &self.world.materials);
            }

            // End dim paths early; the survivors carry their weight.
            let worth = beta.max_component() * eta_scale;
            let u = || sampler.get_1d(Dim::Roulette(depth));
            let Some(survival) = roulette(worth, depth, next.specular, u) else {
                witness.note(|| Event::Ended(End::Roulette));
                break;
            };
            beta /= survival;
        }
        radiance
    }
}
