//! Path tracing: paths from the camera, with light and bsdf sampling joined by multiple importance sampling.
//!
//! It may leave caustics to photons: each way of light then belongs to one of the two, see [`Caustics`]. Where what the
//! camera sees is clear, paths fork, see [`fork`]; with photons, light that comes by way of two matt surfaces is
//! gathered, see [`super::gather`].

use super::fork::{self, MOST_WAITING, Way};
use super::gather::{Gathering, MOST_GATHERS};
use super::vertex::{Last, Vertex};
use super::weight::{mis_weight, roulette};
use super::{Counters, End, Event, Integrator, Pass, Witness};
use crate::math::{Ray, Rgb, Vec2, Vec3};
use crate::render::bsdf::{Bsdf, BsdfSample, MaterialId, Transport};
use crate::render::driver::HybridSettings;
use crate::render::effects::Effects;
use crate::render::geometry::{PrimId, SurfacePoint};
use crate::render::light::Viewpoint;
use crate::render::media::Media;
use crate::render::photon::{Caustics, Source, gathers};
use crate::render::sampler::{Dim, Sampler};
use crate::render::world::World;

/// A path tracer.
pub struct PathTracer<'a> {
    pub(super) world: &'a World,
    pub(super) max_depth: u32,
    /// What is left to photons.
    pub(super) caustics: Option<Caustics<'a>>,
    /// How light is gathered that comes by way of two matt surfaces.
    pub(super) gathering: Option<Gathering>,
    /// Whether paths fork.
    forks: bool,
}

/// A path under way.
#[derive(Clone)]
pub(super) struct Walk {
    pub ray: Ray,
    pub sampler: Sampler,
    /// Vertices so far.
    pub depth: u32,
    pub beta: Rgb,
    /// The factor η² that refraction has taken from beta, and will give back.
    pub eta_scale: f32,
    pub last: Last,
    pub media: Media,
    /// Whether a vertex scattered widely.
    pub after_wide: bool,
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

/// After a wide scattering, what a path covers grows by at least this for each metre: what photons bring there is spread
/// over much more when it is seen, so that blur is hidden and a few photons are enough.
const WIDE_ANGLE: f32 = 0.003;

impl<'a> PathTracer<'a> {
    /// A tracer of paths with at most `max_depth` vertices, the one on the light included and the camera not.
    pub fn new(world: &'a World, max_depth: u32) -> Self {
        Self { world, max_depth, caustics: None, gathering: None, forks: true }
    }

    /// One that leaves caustics to photons, if there are any.
    pub fn with_caustics(world: &'a World, settings: HybridSettings, max_depth: u32) -> Self {
        let has_any = world.effects.has(Effects::CAUSTICS);
        let caustics = has_any.then(|| Caustics::new(world, settings, max_depth)).flatten();
        let mut tracer = Self { caustics, ..Self::new(world, max_depth) };
        if tracer.caustics.is_some() && world.effects.has(Effects::INDIRECT) {
            tracer.gathering = Gathering::worthwhile(&tracer, settings.photon_count);
        }
        tracer
    }

    /// One whose paths never fork: of two ways, chance takes one. The same picture with more noise.
    #[must_use]
    pub fn without_forks(self) -> Self {
        Self { forks: false, ..self }
    }
}

impl Integrator for PathTracer<'_> {
    fn begin_pass(&mut self, pass: Pass, counters: &mut Counters, cancelled: &(dyn Fn() -> bool + Sync)) {
        if let Some(caustics) = &mut self.caustics {
            caustics.begin_pass(pass, counters, cancelled);
        }
        if let Some(mut gathering) = self.gathering.take() {
            gathering.begin_pass(self, pass, counters, cancelled);
            self.gathering = Some(gathering);
        }
    }

    fn is_of_a_moment(&self) -> bool {
        self.caustics.is_some()
    }

    fn blur(&self) -> f64 {
        self.caustics.as_ref().map_or(0.0, Caustics::blur)
    }

    fn radiance<W: Witness>(
        &self,
        ray: Ray,
        sampler: &Sampler,
        counters: &mut Counters,
        witness: &mut W,
    ) -> Rgb {
        let mut waiting = Vec::new();
        let mut radiance = self.follow(self.start(ray, sampler), &mut waiting, counters, witness);
        while let Some(walk) = waiting.pop() {
            witness.note(|| Event::Branch { depth: walk.depth });
            radiance += self.follow(walk, &mut waiting, counters, witness);
        }
        radiance
    }
}

impl PathTracer<'_> {
    /// A path that leaves the camera.
    pub(super) fn start(&self, ray: Ray, sampler: &Sampler) -> Walk {
        Walk {
            ray,
            sampler: *sampler,
            depth: 0,
            beta: Rgb::WHITE,
            eta_scale: 1.0,
            last: Last { from: Viewpoint { p: ray.o, n: None }, pdf: f32::INFINITY, sharp: None },
            media: Media::start(&self.world.materials, sampler),
            after_wide: false,
            footprint: 0.0,
            angle: self.world.camera.pixel_angle(),
            share: 1.0,
            is_clear: true,
            is_last: false,
        }
    }

    /// Follows a path to its end: the light it finds. Other ways to go are left in `waiting`.
    pub(super) fn follow(
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
                let added = walk.beta * self.sky(walk.ray.d, &walk.last);
                witness.note(|| Event::Sky { dir: walk.ray.d, added });
                return radiance + added;
            };
            let surface = self.world.interaction(&walk.ray, &hit);
            let wo = -walk.ray.d;
            walk.pass_through(hit.t, self.world);
            witness.note(|| Event::Vertex { surface, wo, t: hit.t, beta: walk.beta });

            // Add light emitted here, then light straight from the lamps.
            let added = walk.beta * self.emitted(&surface, wo, &walk.last);
            witness.note(|| Event::Emitted { added });
            radiance += added;
            if walk.depth + 1 == self.max_depth || walk.is_last {
                witness.note(|| Event::Ended(End::Depth));
                break;
            }
            let bsdf = self.world.bsdf_between(&surface, wo, &walk.media);
            let vertex = walk.vertex(&surface, &bsdf, wo);
            witness.note(|| Event::Lobes(bsdf.lobes().to_vec()));
            let mut lit = Rgb::BLACK;
            if bsdf.is_smooth() {
                if !walk.is_lit() {
                    witness.note(|| Event::Ended(End::Roulette));
                    break;
                }
                if let Some(known) = self.gathered(&walk, &vertex, hit.t) {
                    let added = walk.beta * known;
                    witness.note(|| Event::Gathered { added });
                    return radiance + added;
                }
                lit = self.lit(&walk, &vertex, counters, witness);
                radiance += walk.beta * lit;
            }

            // Follow one direction onwards, or several.
            if self.go_on(&mut walk, &vertex, lit, waiting, witness).is_none() {
                break;
            }
        }
        radiance
    }

    /// What lamps and photons send to a vertex and on to the viewer.
    pub(super) fn lit(
        &self,
        walk: &Walk,
        vertex: &Vertex,
        counters: &mut Counters,
        witness: &mut impl Witness,
    ) -> Rgb {
        let direct = self.direct(vertex, &walk.media, &walk.sampler, counters, witness);
        witness.note(|| Event::Lit { added: walk.beta * direct });
        let Some(caustics) = &self.caustics else { return direct };
        let Vertex { surface, bsdf, wo, depth, .. } = *vertex;
        let thrown = caustics.radiance(surface, bsdf, wo, depth + 1, walk.footprint);
        witness.note(|| Event::Photons { added: walk.beta * thrown });
        direct + thrown
    }

    /// Moves a path on from a vertex; `None` if it ends there. Other ways to go are left in `waiting`.
    fn go_on(
        &self,
        walk: &mut Walk,
        vertex: &Vertex,
        lit: Rgb,
        waiting: &mut Vec<Walk>,
        witness: &mut impl Witness,
    ) -> Option<()> {
        let count = self.gather_count(walk, vertex, lit);
        if count > 1 {
            walk.beta /= count as f32;
            for i in 1..count {
                let sampler = walk.sampler.part(i, MOST_GATHERS);
                let mut part = Walk { sampler, ..walk.clone() };
                waiting.extend(self.scatter(&mut part, vertex, witness).map(|()| part));
            }
            walk.sampler = walk.sampler.part(0, MOST_GATHERS);
        } else if self.forks
            && walk.is_clear
            && waiting.len() < MOST_WAITING
            && let Some(mirrored) = vertex.bsdf.mirrored_share(vertex.wo)
        {
            return self.fork(walk, vertex, mirrored, waiting, witness);
        }
        self.scatter(walk, vertex, witness)
    }

    /// Moves a path on both ways from a clear surface that mirrors a part of the light, or on one of them.
    fn fork(
        &self,
        walk: &mut Walk,
        vertex: &Vertex,
        mirrored: f32,
        waiting: &mut Vec<Walk>,
        witness: &mut impl Witness,
    ) -> Option<()> {
        let u = walk.sampler.get_1d(Dim::Lobe(walk.depth));
        let [mirrored, through] = fork::ways(mirrored, walk.share, u);
        let mut take = |Way { u_lobe, factor }: Way, sampler| {
            let next = vertex.bsdf.sample(vertex.wo, Vec2::ZERO, u_lobe, Transport::Radiance)?;
            let (beta, share) = (walk.beta * factor, walk.share * factor);
            let mut branch = Walk { sampler, beta, share, ..walk.clone() };
            self.step(&mut branch, vertex, &next, u_lobe, witness).map(|()| branch)
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

    /// Moves a path on in a direction that its bsdf draws; `None` if it ends.
    #[inline]
    pub(super) fn scatter(&self, walk: &mut Walk, vertex: &Vertex, witness: &mut impl Witness) -> Option<()> {
        let u_lobe = vertex.u_lobe(&walk.sampler);
        let Some(next) = vertex.sample_bsdf(&walk.sampler, u_lobe) else {
            witness.note(|| Event::Ended(End::Absorbed));
            return None;
        };
        self.step(walk, vertex, &next, u_lobe, witness)
    }

    /// Moves a path on in a direction drawn from the lobe that `u_lobe` chose; `None` if it ends.
    #[inline]
    fn step(
        &self,
        walk: &mut Walk,
        vertex: &Vertex,
        next: &BsdfSample,
        u_lobe: f32,
        witness: &mut impl Witness,
    ) -> Option<()> {
        let Vertex { surface, depth, .. } = *vertex;
        witness.note(|| {
            let BsdfSample { wi, weight, pdf, through, .. } = *next;
            Event::Scattered { lobe: vertex.bsdf.lobe_chosen(vertex.wo, u_lobe), wi, weight, pdf, through }
        });
        walk.beta *= next.weight;
        walk.eta_scale *= next.eta * next.eta;
        walk.is_clear &= next.specular;
        walk.is_last = !next.specular && !self.world.effects.has(Effects::INDIRECT);
        walk.ray = surface.spawn(next.wi).as_cone(surface.footprint, next.angle(surface.angle));
        let pdf = if next.specular { f32::INFINITY } else { next.pdf };
        walk.last = Last { from: vertex.viewpoint(), pdf, sharp: None };
        if self.caustics.is_some() {
            let (is_sharp, share) = vertex.split(next, &walk.sampler);
            walk.beta *= share;
            if is_sharp {
                walk.last.sharp = walk.after_wide.then_some((surface.material, surface.prim));
            } else {
                (walk.after_wide, walk.angle) = (true, walk.angle.max(WIDE_ANGLE));
            }
        }
        if next.through {
            let inwards = next.wi.dot(surface.n) < 0.0;
            walk.beta *= walk.media.pass(surface.material, inwards, &self.world.materials);
        }

        // End dim paths early; the survivors carry their weight.
        let worth = walk.beta.max_component() * walk.eta_scale;
        let u = || walk.sampler.get_1d(Dim::Roulette(depth));
        let Some(survival) = roulette(worth, depth, next.specular, u) else {
            witness.note(|| Event::Ended(End::Roulette));
            return None;
        };
        walk.beta /= survival;
        walk.depth += 1;
        Some(())
    }
}

impl Walk {
    /// Goes `t` metres, to the next surface.
    pub fn pass_through(&mut self, t: f32, world: &World) {
        self.beta *= self.media.transmittance(t, &world.materials);
        self.footprint += self.angle * t;
    }

    /// The vertex that it is at.
    pub fn vertex<'a>(&self, surface: &'a SurfacePoint, bsdf: &'a Bsdf, wo: Vec3) -> Vertex<'a> {
        Vertex { surface, bsdf, wo, depth: self.depth, after_wide: self.after_wide }
    }

    /// Whether it is to be lit where it met a surface that spreads light: a small branch by chance, which it then makes up.
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

impl PathTracer<'_> {
    /// What the sky sends along a direction taken at the last vertex, weighed against drawing it as a light.
    fn sky(&self, dir: Vec3, last: &Last) -> Rgb {
        let (radiance, _) = self.world.lights.sky(dir);
        if last.sharp.is_some() && self.is_left(Source::Sky, last.sharp) {
            return Rgb::BLACK;
        }
        if radiance.is_black() || last.pdf == f32::INFINITY {
            return radiance;
        }
        radiance * mis_weight(last.pdf, self.world.lights.pdf_sky(&last.from, dir))
    }

    /// What the surface emits towards the last vertex, weighed against drawing it as a light.
    fn emitted(&self, surface: &SurfacePoint, wo: Vec3, last: &Last) -> Rgb {
        let radiance = self.world.emitted(surface, wo);
        if radiance.is_black() {
            return radiance;
        }
        let lights = &self.world.lights;
        if last.sharp.is_some() && lights.draws(surface.prim) && self.is_left(Source::Near, last.sharp) {
            return Rgb::BLACK;
        }
        if last.pdf == f32::INFINITY {
            return radiance;
        }
        radiance * mis_weight(last.pdf, lights.pdf_area(&self.world.geometry, &last.from, surface))
    }

    /// Whether light that went by way of `sharp` to a surface that scatters widely is left to photons.
    fn is_left(&self, source: Source, sharp: Option<(MaterialId, PrimId)>) -> bool {
        match (&self.caustics, sharp) {
            (Some(caustics), Some((material, prim))) => caustics.owns(source, material, prim),
            _ => false,
        }
    }

    /// The lobes of a vertex for light straight from `source`, and the density with which the bsdf finds it.
    ///
    /// Where a path came from a vertex that scattered widely, light by way of the sharp lobes may be left to photons.
    fn eval_pdf(&self, vertex: &Vertex, source: Source, wi: Vec3) -> (Rgb, f32) {
        let (value, pdf) = vertex.bsdf.eval_pdf(vertex.wo, wi);
        let sharp = vertex.after_wide.then_some((vertex.surface.material, vertex.surface.prim));
        if sharp.is_none() || vertex.bsdf.lobes().iter().all(gathers) || !self.is_left(source, sharp) {
            return (value, pdf);
        }
        (vertex.bsdf.only(gathers).eval(vertex.wo, wi), pdf)
    }

    /// The point of the round surface that a facet stands for, if that is lit along `wi` and the facet is not.
    fn rounded(&self, vertex: &Vertex, wi: Vec3) -> Option<SurfacePoint> {
        let (n, ns) = (vertex.surface.n, vertex.bsdf.normal());
        let faces = |n: Vec3| vertex.wo.dot(n) * wi.dot(n) > 0.0;
        if ns == n || faces(n) || !faces(ns) || vertex.bsdf.transmits() {
            return None;
        }
        self.world.geometry.rounded(vertex.surface, vertex.wo)
    }

    /// What one light sends straight to a vertex and on to the viewer, weighed against finding it by the bsdf.
    pub(super) fn direct(
        &self,
        vertex: &Vertex,
        media: &Media,
        sampler: &Sampler,
        counters: &mut Counters,
        witness: &mut impl Witness,
    ) -> Rgb {
        let (world, depth) = (self.world, vertex.depth);
        let (u_choice, u) = (sampler.get_2d(Dim::LightChoice(depth)), sampler.get_2d(Dim::Light(depth)));
        let Some(drawn) = world.sample_li(&vertex.viewpoint(), u_choice, u) else {
            return Rgb::BLACK;
        };
        let (mut value, mut pdf_bsdf) = self.eval_pdf(vertex, Source::of(&drawn), drawn.wi);
        // A facet that turns away from light which the round surface above it receives. Nothing else finds that light.
        let rounded = if value.is_black() { self.rounded(vertex, drawn.wi) } else { None };
        if rounded.is_some() {
            (value, pdf_bsdf) = (vertex.bsdf.rounded().eval(vertex.wo, drawn.wi), 0.0);
        }
        let mut arriving = value * drawn.radiance;
        let told = |blocked| Event::Light {
            wi: drawn.wi,
            distance: drawn.distance(),
            arriving: value * drawn.radiance,
            pdf: drawn.pdf,
            pdf_bsdf,
            blocked,
        };
        if arriving.is_black() {
            witness.note(|| told(false));
            return Rgb::BLACK;
        }
        counters.rays += 1;
        let blocked = world.any_hit(&drawn.shadow_ray(rounded.as_ref().unwrap_or(vertex.surface)));
        witness.note(|| told(blocked));
        if blocked {
            return Rgb::BLACK;
        }
        let weight = if drawn.delta { 1.0 } else { mis_weight(drawn.pdf, pdf_bsdf) };
        let mut media = *media;
        let n = vertex.surface.n;
        if vertex.wo.dot(n) * drawn.wi.dot(n) < 0.0 && vertex.bsdf.spreads_through() {
            arriving *= media.pass(vertex.surface.material, drawn.wi.dot(n) < 0.0, &world.materials);
        }
        arriving * media.transmittance(drawn.distance(), &world.materials) * (weight / drawn.pdf)
    }
}
