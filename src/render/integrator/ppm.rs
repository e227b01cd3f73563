//! Progressive photon mapping: all light, direct light too, comes from photons.
//!
//! Each pass emits photons of its own and looks for them from the camera, through smaller discs every time; the mean of
//! the passes converges to the truth (Hachisuka, Ogaki, Jensen 2008; Knaus, Zwicker 2011). Passes know nothing of each
//! other but their number.
//!
//! A camera path gathers at its vertices through the lobes that [`gathers`] names and follows the others, mirrors and
//! sharp reflections, by sampling. Each way of light is thus counted once: what a vertex emits is always added, for no
//! photon is ever gathered through the lobe that led there.

use super::vertex::Vertex;
use super::walk::Walk;
use super::{Counters, End, Event, Integrator, Pass, Witness};
use crate::math::{Ray, Rgb, Vec2};
use crate::render::bsdf::{BsdfSample, Transport};
use crate::render::driver::PpmSettings;
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
    fn world(&self) -> &World {
        self.world
    }

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
        let mut waiting = Vec::new();
        let start = Walk::start(self.world, ray, sampler);
        let mut radiance = self.follow(start, &mut waiting, counters, witness);
        while let Some(walk) = waiting.pop() {
            witness.note(|| Event::Branch { depth: walk.depth });
            radiance += self.follow(walk, &mut waiting, counters, witness);
        }
        radiance
    }
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
            walk.pass_through(hit.t, self.world);
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
            let vertex = walk.vertex(&surface, &sharp);
            let mut step = |walk: &mut Walk, u, u_lobe| self.step(walk, &vertex, u, u_lobe, witness);
            let ended = match sharp.mirrored_share(wo).filter(|_| walk.may_fork(waiting)) {
                Some(mirrored) => {
                    walk.fork(mirrored, waiting, |branch, u_lobe| step(branch, Vec2::ZERO, u_lobe))
                }
                None => {
                    let u = walk.sampler.get_2d(Dim::Bsdf(walk.depth));
                    let u_lobe = walk.sampler.get_1d(Dim::Lobe(walk.depth));
                    step(&mut walk, u, u_lobe)
                }
            };
            if ended.is_none() {
                break;
            }
        }
        radiance
    }

    /// Moves a path on in the direction that two numbers draw; `None` if it ends.
    fn step(
        &self,
        walk: &mut Walk,
        vertex: &Vertex,
        u: Vec2,
        u_lobe: f32,
        witness: &mut impl Witness,
    ) -> Option<()> {
        let Vertex { surface, bsdf, wo, .. } = *vertex;
        let Some(next) = bsdf.sample(wo, u, u_lobe, Transport::Radiance) else {
            witness.note(|| Event::Ended(End::Absorbed));
            return None;
        };
        witness.note(|| {
            let BsdfSample { wi, weight, pdf, through, .. } = next;
            Event::Scattered { lobe: bsdf.lobe_chosen(wo, u_lobe), wi, weight, pdf, through }
        });
        walk.leave(surface, &next, self.world);
        walk.survive(next.specular, witness)
    }
}
