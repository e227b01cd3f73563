//! A path from the camera under way: what all integrators that follow one need to know of it.

use super::fork::{self, MOST_WAITING, Way};
use super::vertex::{Last, Vertex};
use super::weight::roulette;
use super::{End, Event, Witness};
use crate::math::{Ray, Rgb, Vec3};
use crate::render::bsdf::{Bsdf, BsdfSample};
use crate::render::geometry::SurfacePoint;
use crate::render::light::Viewpoint;
use crate::render::media::Media;
use crate::render::sampler::{Dim, Sampler};
use crate::render::world::World;

/// A path under way.
#[derive(Clone)]
pub struct Walk {
    pub ray: Ray,
    pub sampler: Sampler,
    /// Vertices so far.
    pub depth: u32,
    /// What light from where it goes counts.
    pub beta: Rgb,
    /// What `beta` itself counts, where the path is the end of a longer one.
    pub before: Rgb,
    /// The factor η² that refraction has taken from `beta`, and will give back.
    pub eta_scale: f32,
    pub last: Last,
    pub media: Media,
    /// Whether a vertex scattered widely.
    pub after_wide: bool,
    /// How far it went since the last one that did.
    pub since_wide: f32,
    /// The width of what it covers, in metres, and by how much that grows for each metre.
    pub footprint: f32,
    pub angle: f32,
    /// The share of what its camera ray sees that it stands for.
    pub share: f32,
    /// Whether nothing but clear surfaces lies between it and the camera: only then it forks.
    pub is_clear: bool,
    /// Whether it goes no further than to the next surface.
    pub is_last: bool,
}

impl Walk {
    /// A path that leaves the camera.
    pub fn start(world: &World, ray: Ray, sampler: &Sampler) -> Self {
        Self {
            ray,
            sampler: *sampler,
            depth: 0,
            beta: Rgb::WHITE,
            before: Rgb::WHITE,
            eta_scale: 1.0,
            last: Last { from: Viewpoint { p: ray.o, n: None }, pdf: f32::INFINITY, sharp: None },
            media: Media::start(&world.materials, sampler),
            after_wide: false,
            since_wide: 0.0,
            footprint: 0.0,
            angle: world.camera.pixel_angle(),
            share: 1.0,
            is_clear: true,
            is_last: false,
        }
    }

    /// The rest of the path, counted by itself.
    pub fn rest(&self) -> Self {
        Self { beta: Rgb::WHITE, before: self.before * self.beta, ..self.clone() }
    }

    /// The direction in which it came, seen from the surface that it met.
    pub fn wo(&self) -> Vec3 {
        -self.ray.d
    }

    /// Goes `t` metres, to the next surface.
    pub fn pass_through(&mut self, t: f32, world: &World) {
        self.beta *= self.media.transmittance(t, &world.materials);
        self.footprint += self.angle * t;
        self.since_wide += t;
    }

    /// The vertex that it is at.
    pub fn vertex<'a>(&self, surface: &'a SurfacePoint, bsdf: &'a Bsdf) -> Vertex<'a> {
        Vertex { surface, bsdf, wo: self.wo(), depth: self.depth, after_wide: self.after_wide }
    }

    /// Whether it is to be lit where it met a surface that spreads light: a small branch by chance, which it then makes up.
    pub fn is_lit(&mut self) -> bool {
        let chance = fork::lit_chance(self.share);
        if !self.is_clear || chance == 1.0 {
            return true;
        }
        self.beta /= chance;
        self.share /= chance;
        self.sampler.get_1d(Dim::Lit(self.depth)) < chance
    }

    /// Whether it may fork, with so many other ways waiting.
    pub fn may_fork(&self, waiting: &[Self]) -> bool {
        self.is_clear && waiting.len() < MOST_WAITING
    }

    /// Moves on both ways from a clear surface that mirrors a part of the light, or on one of them; `None` if both end.
    /// `step` takes a way by its number; the other one is left in `waiting`.
    pub fn fork(
        &mut self,
        mirrored: f32,
        waiting: &mut Vec<Self>,
        mut step: impl FnMut(&mut Self, f32) -> Option<()>,
    ) -> Option<()> {
        let u = self.sampler.get_1d(Dim::Lobe(self.depth));
        let [mirrored, through] = fork::ways(mirrored, self.share, u);
        let mut take = |Way { u_lobe, factor }: Way, sampler| {
            let (beta, share) = (self.beta * factor, self.share * factor);
            let mut branch = Self { sampler, beta, share, ..self.clone() };
            step(&mut branch, u_lobe).map(|()| branch)
        };
        let beside = if through.is_some() { self.sampler.branch(self.depth) } else { self.sampler };
        let mirrored = mirrored.and_then(|way| take(way, beside));
        match through.and_then(|way| take(way, self.sampler)) {
            Some(through) => {
                waiting.extend(mirrored);
                *self = through;
            }
            None => *self = mirrored?,
        }
        Some(())
    }

    /// Leaves a surface in a drawn direction.
    #[inline]
    pub fn leave(&mut self, surface: &SurfacePoint, next: &BsdfSample, world: &World) {
        self.beta *= next.weight;
        self.eta_scale *= next.eta * next.eta;
        self.is_clear &= next.specular;
        self.ray = surface.spawn(next.wi).as_cone(surface.footprint, next.angle(surface.angle));
        if next.through {
            let inwards = next.wi.dot(surface.n) < 0.0;
            self.beta *= self.media.pass(surface.material, inwards, &world.materials);
        }
    }

    /// Ends dim paths early, by chance; the survivors carry their weight. Counts the vertex that was left.
    #[inline]
    pub fn survive(&mut self, specular: bool, witness: &mut impl Witness) -> Option<()> {
        let worth = (self.beta * self.before).max_component() * self.eta_scale;
        let u = || self.sampler.get_1d(Dim::Roulette(self.depth));
        let Some(survival) = roulette(worth, self.depth, specular, u) else {
            witness.note(|| Event::Ended(End::Roulette));
            return None;
        };
        self.beta /= survival;
        self.depth += 1;
        Some(())
    }
}
