//! Path tracing: paths from the camera, with light and bsdf sampling joined by multiple importance sampling.
//!
//! It may leave caustics to photons: each way of light then belongs to one of the two, see [`Caustics`]. Where what the
//! camera sees is clear, paths fork, see [`super::fork`]. Neighbouring pixels share what their paths find, see
//! [`super::share`]; beside photons, light that comes by way of two matt surfaces is gathered instead, see [`super::gather`].

use super::gather::{Gathering, MOST_GATHERS};
use super::share::{self, Group};
use super::vertex::{Last, Vertex};
use super::walk::Walk;
use super::{Counters, End, Event, Integrator, Pass, Witness};
use crate::math::{Ray, Rgb, Vec2};
use crate::render::bsdf::{BsdfSample, Transport};
use crate::render::driver::HybridSettings;
use crate::render::effects::Effects;
use crate::render::geometry::SurfacePoint;
use crate::render::photon::Caustics;
use crate::render::sampler::Sampler;
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
    /// Whether neighbouring pixels share what their paths find.
    shares: bool,
}

/// What the paths of a camera ray have found, and have yet to do.
pub(super) struct Trace<'a, W> {
    pub radiance: Rgb,
    /// Other ways to go.
    pub waiting: Vec<Walk>,
    pub counters: &'a mut Counters,
    pub witness: &'a mut W,
}

/// After a wide scattering, what a path covers grows by at least this for each metre: what photons bring there is spread
/// over much more when it is seen, so that blur is hidden and a few photons are enough.
const WIDE_ANGLE: f32 = 0.003;

/// Lights drawn where many paths tell what comes from elsewhere: one would be the worst of the noise.
pub(super) const LIGHTS: u32 = 4;

impl<'a> PathTracer<'a> {
    /// A tracer of paths with at most `max_depth` vertices, the one on the light included and the camera not.
    pub fn new(world: &'a World, max_depth: u32) -> Self {
        let shares = share::can_share(world);
        Self { world, max_depth, caustics: None, gathering: None, forks: true, shares }
    }

    /// One that leaves caustics to photons, if there are any.
    pub fn with_caustics(world: &'a World, settings: HybridSettings, max_depth: u32) -> Self {
        let has_any = world.effects.has(Effects::CAUSTICS);
        let caustics = has_any.then(|| Caustics::new(world, settings, max_depth)).flatten();
        let mut tracer = Self { caustics, ..Self::new(world, max_depth) };
        if tracer.caustics.is_some() && world.effects.has(Effects::INDIRECT) {
            tracer.gathering = Gathering::worthwhile(&tracer, settings.photon_count);
        }
        tracer.shares &= tracer.gathering.is_none();
        tracer
    }

    /// One whose paths never fork: of two ways, chance takes one. The same picture with more noise.
    #[must_use]
    pub fn without_forks(self) -> Self {
        Self { forks: false, ..self }
    }

    /// One whose pixels share nothing. The same picture with more noise, and each pixel's noise its own.
    #[must_use]
    pub fn without_sharing(self) -> Self {
        Self { shares: false, ..self }
    }
}

impl Integrator for PathTracer<'_> {
    fn world(&self) -> &World {
        self.world
    }

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
        self.trace(ray, sampler, None, counters, witness)
    }

    fn group_side(&self) -> u32 {
        if self.shares { share::SIDE } else { 1 }
    }

    fn radiances<W: Witness>(
        &self,
        cameras: &[(Ray, Sampler)],
        told: Option<usize>,
        counters: &mut Counters,
        witness: &mut W,
    ) -> Vec<Rgb> {
        if self.shares {
            self.shared_radiances(cameras, told, counters, witness)
        } else {
            super::each_alone(self, cameras, told, counters, witness)
        }
    }
}

impl PathTracer<'_> {
    /// The radiance that arrives along a camera ray, but for what its group is to share.
    pub(super) fn trace(
        &self,
        ray: Ray,
        sampler: &Sampler,
        mut group: Option<&mut Group>,
        counters: &mut Counters,
        witness: &mut impl Witness,
    ) -> Rgb {
        let mut trace = Trace { radiance: Rgb::BLACK, waiting: Vec::new(), counters, witness };
        let mut next = Some(Walk::start(self.world, ray, sampler));
        while let Some(walk) = next {
            self.follow(walk, group.as_deref_mut(), &mut trace);
            next = trace.waiting.pop();
            if let Some(Walk { depth, .. }) = next {
                trace.witness.note(|| Event::Branch { depth });
            }
        }
        trace.radiance
    }

    /// Follows a path to its end.
    pub(super) fn follow(
        &self,
        mut walk: Walk,
        mut group: Option<&mut Group>,
        trace: &mut Trace<impl Witness>,
    ) {
        let mut next = self.arrive(&mut walk, trace);
        while let Some(surface) = next {
            next = self.go_on(&mut walk, &surface, group.as_deref_mut(), trace);
        }
    }

    /// Follows a path from a vertex to its end.
    pub(super) fn follow_from(
        &self,
        walk: &mut Walk,
        surface: SurfacePoint,
        trace: &mut Trace<impl Witness>,
    ) {
        let mut next = Some(surface);
        while let Some(surface) = next {
            next = self.go_on(walk, &surface, None, trace);
        }
    }

    /// Finds the next vertex, and the light that it emits; `None` where the path ends, in the sky or at its last vertex.
    #[inline]
    fn arrive(&self, walk: &mut Walk, trace: &mut Trace<impl Witness>) -> Option<SurfacePoint> {
        trace.counters.rays += 1;
        let Some(hit) = self.world.closest_hit(&walk.ray) else {
            let added = walk.beta * self.sky(walk.ray.d, &walk.last);
            trace.witness.note(|| Event::Sky { dir: walk.ray.d, added });
            trace.radiance += added;
            return None;
        };
        let surface = self.world.interaction(&walk.ray, &hit);
        walk.pass_through(hit.t, self.world);
        trace.witness.note(|| Event::Vertex { surface, wo: walk.wo(), t: hit.t, beta: walk.beta });
        self.shine(walk, &surface, trace).map(|()| surface)
    }

    /// Adds what is emitted where a path has arrived; `None` if that is its last vertex.
    #[inline]
    pub(super) fn shine(
        &self,
        walk: &Walk,
        surface: &SurfacePoint,
        trace: &mut Trace<impl Witness>,
    ) -> Option<()> {
        let added = walk.beta * self.emitted(surface, walk.wo(), &walk.last);
        trace.witness.note(|| Event::Emitted { added });
        trace.radiance += added;
        if self.ends(walk) {
            trace.witness.note(|| Event::Ended(End::Depth));
            return None;
        }
        Some(())
    }

    /// Whether a path has all its vertices, with the one that it is at.
    pub(super) fn ends(&self, walk: &Walk) -> bool {
        walk.depth + 1 >= self.max_depth || walk.is_last
    }

    /// Lights a vertex, and goes on from it to the next; `None` where the path ends.
    #[inline]
    fn go_on(
        &self,
        walk: &mut Walk,
        surface: &SurfacePoint,
        group: Option<&mut Group>,
        trace: &mut Trace<impl Witness>,
    ) -> Option<SurfacePoint> {
        let bsdf = self.world.bsdf_between(surface, walk.wo(), &walk.media);
        trace.witness.note(|| Event::Lobes(bsdf.lobes().to_vec()));
        if bsdf.is_smooth() {
            if !walk.is_lit() {
                trace.witness.note(|| Event::Ended(End::Roulette));
                return None;
            }
            if let Some(group) = group
                && walk.is_clear
                && share::receives(&bsdf)
            {
                return self.receive(walk, surface, bsdf, group, trace);
            }
            let vertex = walk.vertex(surface, &bsdf);
            if let Some(known) = self.gathered(walk, &vertex) {
                let added = walk.beta * known;
                trace.witness.note(|| Event::Gathered { added });
                trace.radiance += added;
                return None;
            }
            let lit = if self.looks_around(walk, &vertex).is_some() {
                self.lit_by(LIGHTS, 1.0, walk, &vertex, trace)
            } else {
                self.lit(walk, &vertex, trace)
            };
            trace.radiance += walk.beta * lit;
            let count = self.gather_count(walk, &vertex, lit);
            if count > 1 {
                self.look_around(walk, &vertex, count, trace)?;
                return self.arrive(walk, trace);
            }
        }
        let vertex = walk.vertex(surface, &bsdf);
        if self.forks
            && walk.may_fork(&trace.waiting)
            && let Some(mirrored) = bsdf.mirrored_share(vertex.wo)
        {
            let Trace { waiting, witness, .. } = trace;
            walk.fork(mirrored, waiting, |branch, u_lobe| {
                let next = bsdf.sample(vertex.wo, Vec2::ZERO, u_lobe, Transport::Radiance)?;
                self.turn(branch, &vertex, &next, u_lobe, *witness);
                branch.survive(next.specular, *witness)
            })?;
        } else {
            self.scatter(walk, &vertex, trace.witness)?;
        }
        self.arrive(walk, trace)
    }

    /// Sends a path on in several directions; `None` if the first of them ends.
    fn look_around(
        &self,
        walk: &mut Walk,
        vertex: &Vertex,
        count: u32,
        trace: &mut Trace<impl Witness>,
    ) -> Option<()> {
        walk.beta /= count as f32;
        for i in 1..count {
            let sampler = walk.sampler.part(i, MOST_GATHERS);
            let mut part = Walk { sampler, ..walk.clone() };
            trace.waiting.extend(self.scatter(&mut part, vertex, trace.witness).map(|()| part));
        }
        walk.sampler = walk.sampler.part(0, MOST_GATHERS);
        self.scatter(walk, vertex, trace.witness)
    }

    /// What lamps and photons send to a vertex and on to the viewer.
    pub(super) fn lit(&self, walk: &Walk, vertex: &Vertex, trace: &mut Trace<impl Witness>) -> Rgb {
        let direct = self.direct(vertex, &walk.media, &walk.sampler, 1.0, trace.counters, trace.witness);
        trace.witness.note(|| Event::Lit { added: walk.beta * direct });
        direct + self.thrown(walk, vertex, trace.witness)
    }

    /// The same by several lights, beside each of which the bsdf tries `finders` times.
    pub(super) fn lit_by(
        &self,
        lights: u32,
        finders: f32,
        walk: &Walk,
        vertex: &Vertex,
        trace: &mut Trace<impl Witness>,
    ) -> Rgb {
        let mut direct = Rgb::BLACK;
        for i in 0..lights {
            let sampler = walk.sampler.part(i, LIGHTS);
            direct += self.direct(vertex, &walk.media, &sampler, finders, trace.counters, trace.witness);
        }
        let direct = direct / lights as f32;
        trace.witness.note(|| Event::Lit { added: walk.beta * direct });
        direct + self.thrown(walk, vertex, trace.witness)
    }

    /// What photons bring to a vertex.
    pub(super) fn thrown(&self, walk: &Walk, vertex: &Vertex, witness: &mut impl Witness) -> Rgb {
        let Some(caustics) = &self.caustics else { return Rgb::BLACK };
        let Vertex { surface, bsdf, wo, depth, .. } = *vertex;
        let thrown = caustics.radiance(surface, bsdf, wo, depth + 1, walk.footprint);
        witness.note(|| Event::Photons { added: walk.beta * thrown });
        thrown
    }

    /// Sends a path on in a direction that its bsdf draws; `None` if it ends, by chance if it is dim.
    #[inline]
    pub(super) fn scatter(&self, walk: &mut Walk, vertex: &Vertex, witness: &mut impl Witness) -> Option<()> {
        let next = self.draw(walk, vertex, witness)?;
        walk.survive(next.specular, witness)
    }

    /// Turns a path in a direction that its bsdf draws; `None` if it ends.
    #[inline]
    pub(super) fn draw(
        &self,
        walk: &mut Walk,
        vertex: &Vertex,
        witness: &mut impl Witness,
    ) -> Option<BsdfSample> {
        let u_lobe = vertex.u_lobe(&walk.sampler);
        let Some(next) = vertex.sample_bsdf(&walk.sampler, u_lobe) else {
            witness.note(|| Event::Ended(End::Absorbed));
            return None;
        };
        self.turn(walk, vertex, &next, u_lobe, witness);
        Some(next)
    }

    /// Turns a path in a direction drawn from the lobe that `u_lobe` chose.
    #[inline]
    fn turn(
        &self,
        walk: &mut Walk,
        vertex: &Vertex,
        next: &BsdfSample,
        u_lobe: f32,
        witness: &mut impl Witness,
    ) {
        witness.note(|| {
            let BsdfSample { wi, weight, pdf, through, .. } = *next;
            Event::Scattered { lobe: vertex.bsdf.lobe_chosen(vertex.wo, u_lobe), wi, weight, pdf, through }
        });
        let surface = vertex.surface;
        walk.is_last = !next.specular && !self.world.effects.has(Effects::INDIRECT);
        let pdf = if next.specular { f32::INFINITY } else { next.pdf };
        walk.last = Last { from: vertex.viewpoint(), pdf, sharp: None };
        if self.caustics.is_some() {
            let (is_sharp, share) = vertex.split(next, &walk.sampler);
            walk.beta *= share;
            if is_sharp {
                walk.last.sharp = walk.after_wide.then_some((surface.material, surface.prim));
            } else {
                (walk.after_wide, walk.angle, walk.since_wide) = (true, walk.angle.max(WIDE_ANGLE), 0.0);
            }
        }
        walk.leave(surface, next, self.world);
    }
}
