//! Progressive photon mapping: all light, direct light too, comes from photons.
//!
//! Each pass emits photons of its own and looks for them from the camera, through smaller discs every time; the mean of
//! the passes converges to the truth (Hachisuka, Ogaki, Jensen 2008; Knaus, Zwicker 2011). Passes know nothing of each
//! other but their number.
//!
//! A camera path gathers at its vertices through the lobes that [`gathers`] names and follows the others, mirrors and
//! sharp reflections, by sampling. Each way of light is thus counted once: what a vertex emits is always added, for no
//! photon is ever gathered through the lobe that led there.

use super::fork::{self, MOST_WAITING, Way};
use super::weight::roulette;
use super::{Counters, End, Event, Integrator, Pass, Witness};
use crate::math::{Ray, Rgb, Vec2};
use crate::render::bsdf::{Bsdf, BsdfSample, Transport};
use crate::render::driver::PpmSettings;
use crate::render::geometry::SurfacePoint;
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

    fn is_of_a_moment(&self) -> bool {
        true
    }

    fn blur(&self) -> f64 {
        self.schedule.shrunk()
    }

    fn radiance<W: Witness>(
        &self,
        ray: Ray,
        sampler: &Sampler,
        counters: &mut Counters,
        witness: &mut W,
    ) -> Rgb {
        let media = Media::start(&self.world.materials, sampler);
        let (beta, sampler) = (Rgb::WHITE, *sampler);
        let start = Walk { ray, sampler, depth: 0, beta, eta_scale: 1.0, media, share: 1.0, is_clear: true };
        let mut waiting = Vec::new();
        let mut radiance = self.follow(start, &mut waiting, counters, witness);
        while let Some(walk) = waiting.pop() {
            witness.note(|| Event::Branch { depth: walk.depth });
            radiance += self.follow(walk, &mut waiting, counters, witness);
        }
        radiance
    }
}

/// A camera path under way, as those of a path tracer.
#[derive(Clone)]
struct Walk {
    ray: Ray,
    sampler: Sampler,
    depth: u32,
    beta: Rgb,
    /// The factor η² that refraction has taken from beta, and will give back.
    eta_scale: f32,
    media: Media,
    share: f32,
    is_clear: bool,
}

impl PhotonMapper<'_> {
    /// Follows a path to its end: the light it finds. Other ways to go are left in `waiting`.
    fn follow(
        &self,
        mut walk: Walk,
        waiting: &mut Vec<Walk>,
        counters: &mut Counters,
        witness: &mut impl Witness,
    ) -> Rgb {
        let mut radiance = Rgb::BLACK;
        while walk.depth < self.max_depth {
            // Find the next vertex, or take what the sky sends and stop.
            counters.rays += 1;
            let Some(hit) = self.world.closest_hit(&walk.ray) else {
                let added = walk.beta * self.world.lights.sky(walk.ray.d).0;
                witness.note(|| Event::Sky { dir: walk.ray.d, added });
                return radiance + added;
            };
            let surface = self.world.interaction(&walk.ray, &hit);
            let wo = -walk.ray.d;
            walk.beta *= walk.media.transmittance(hit.t, &self.world.materials);
            witness.note(|| Event::Vertex { surface, wo, t: hit.t, beta: walk.beta });

            // Add light emitted here, then light that photons brought.
            let added = walk.beta * self.world.emitted(&surface, wo);
            witness.note(|| Event::Emitted { added });
            radiance += added;
            let bsdf = self.world.bsdf_between(&surface, wo, &walk.media);
            witness.note(|| Event::Lobes(bsdf.lobes().to_vec()));
            let rough = bsdf.only(gathers);
            if !rough.lobes().is_empty() {
                if !walk.is_lit() {
                    witness.note(|| Event::Ended(End::Roulette));
                    break;
                }
                let gather = Gather {
                    radius2: self.schedule.current() as f32,
                    k: self.settings.k.max(2) as usize,
                    max_depth: self.max_depth - walk.depth, // this vertex belongs to both paths
                };
                let added = walk.beta * gather.radiance(&self.map, &surface, &rough, wo);
                witness.note(|| Event::Photons { added });
                radiance += added;
            }

            // Follow one sharp reflection onwards, or what is mirrored and what is let through.
            let sharp = bsdf.only(|lobe| !gathers(lobe));
            let forks = walk.is_clear && waiting.len() < MOST_WAITING;
            let ended = match sharp.mirrored_share(wo).filter(|_| forks) {
                Some(mirrored) => self.fork(&mut walk, &surface, &sharp, mirrored, waiting, witness),
                None => {
                    let (u, u_lobe) = walk.drawn();
                    self.step(&mut walk, &surface, &sharp, u, u_lobe, witness)
                }
            };
            if ended.is_none() {
                break;
            }
        }
        radiance
    }

    /// Moves a path on both ways from a clear surface that mirrors a part of the light, or on one of them.
    fn fork(
        &self,
        walk: &mut Walk,
        surface: &SurfacePoint,
        sharp: &Bsdf,
        mirrored: f32,
        waiting: &mut Vec<Walk>,
        witness: &mut impl Witness,
    ) -> Option<()> {
        let (_, u) = walk.drawn();
        let [mirrored, through] = fork::ways(mirrored, walk.share, u);
        let mut take = |Way { u_lobe, factor }: Way, sampler| {
            let (beta, share) = (walk.beta * factor, walk.share * factor);
            let mut branch = Walk { sampler, beta, share, ..walk.clone() };
            self.step(&mut branch, surface, sharp, Vec2::ZERO, u_lobe, witness).map(|()| branch)
        };
        let beside = if through.is_some() { walk.sampler.branch(walk.depth) } else { walk.sampler };
        let mirrored = mirrored.and_then(|way| take(way, beside));
        match through.and_then(|way| take(way, walk.sampler)) {
            Some(through) => {
                waiting.extend(mirrored);
                *walk = through;
            }
            None => *walk = mirrored?,
        }
        Some(())
    }

    /// Moves a path on in the direction that two numbers draw; `None` if it ends.
    fn step(
        &self,
        walk: &mut Walk,
        surface: &SurfacePoint,
        sharp: &Bsdf,
        u: Vec2,
        u_lobe: f32,
        witness: &mut impl Witness,
    ) -> Option<()> {
        let wo = -walk.ray.d;
        let Some(next) = sharp.sample(wo, u, u_lobe, Transport::Radiance) else {
            witness.note(|| Event::Ended(End::Absorbed));
            return None;
        };
        witness.note(|| {
            let BsdfSample { wi, weight, pdf, through, .. } = next;
            Event::Scattered { lobe: sharp.lobe_chosen(wo, u_lobe), wi, weight, pdf, through }
        });
        walk.beta *= next.weight;
        walk.eta_scale *= next.eta * next.eta;
        walk.is_clear &= next.specular;
        walk.ray = surface.spawn(next.wi);
        if next.through {
            let inwards = next.wi.dot(surface.n) < 0.0;
            walk.beta *= walk.media.pass(surface.material, inwards, &self.world.materials);
        }

        // End dim paths early; the survivors carry their weight.
        let worth = walk.beta.max_component() * walk.eta_scale;
        let u = || walk.sampler.get_1d(Dim::Roulette(walk.depth));
        let Some(survival) = roulette(worth, walk.depth, next.specular, u) else {
            witness.note(|| Event::Ended(End::Roulette));
            return None;
        };
        walk.beta /= survival;
        walk.depth += 1;
        Some(())
    }
}

impl Walk {
    /// The numbers that draw a direction.
    fn drawn(&self) -> (Vec2, f32) {
        (self.sampler.get_2d(Dim::Bsdf(self.depth)), self.sampler.get_1d(Dim::Lobe(self.depth)))
    }

    /// Whether it is to be lit where photons are gathered: a small branch by chance, which it then makes up.
    fn is_lit(&mut self) -> bool {
        let chance = fork::lit_chance(self.share);
        if !self.is_clear || chance == 1.0 {
            return true;
        }
        self.beta /= chance;
        self.share /= chance;
        self.sampler.get_1d(Dim::Lit(self.depth)) < chance
    }
}
