//! Path tracing: paths from the camera, with light and bsdf sampling joined by multiple importance sampling.
//!
//! It may leave caustics to photons: each way of light then belongs to one of the two, see [`Caustics`].

use super::{Counters, End, Event, Integrator, Pass, Witness};
use crate::math::{Ray, Rgb, Vec3};
use crate::render::bsdf::{Bsdf, BsdfSample, MaterialId, Transport};
use crate::render::driver::HybridSettings;
use crate::render::geometry::{PrimId, SurfacePoint};
use crate::render::light::Viewpoint;
use crate::render::media::Media;
use crate::render::photon::{Caustics, Source, gathers};
use crate::render::sampler::{Dim, Sampler};
use crate::render::world::World;

/// A path tracer.
pub struct PathTracer<'a> {
    world: &'a World,
    max_depth: u32,
    /// What is left to photons.
    caustics: Option<Caustics<'a>>,
}

/// Where a path is.
struct Vertex<'a> {
    surface: &'a SurfacePoint,
    bsdf: &'a Bsdf,
    wo: Vec3,
    depth: u32,
    /// Whether a vertex before it scattered widely: photons fall there, not on the camera.
    after_wide: bool,
}

/// The vertex a path left last: by what other strategy could light found next have been drawn from there?
struct Last {
    from: Viewpoint,
    /// The density of the direction taken, per steradian; infinite if nothing else could have found it.
    pdf: f32,
    /// The surface, if it and all others back to one that scattered widely are sharp: light from here makes a caustic there.
    sharp: Option<(MaterialId, PrimId)>,
}

/// After a wide scattering, what a path covers grows by at least this for each metre: what photons bring there is spread
/// over much more when it is seen, so that blur is hidden and a few photons are enough.
const WIDE_ANGLE: f32 = 0.003;

impl<'a> PathTracer<'a> {
    /// A tracer of paths with at most `max_depth` vertices, the one on the light included and the camera not.
    pub fn new(world: &'a World, max_depth: u32) -> Self {
        Self { world, max_depth, caustics: None }
    }

    /// One that leaves caustics to photons, if there are any.
    pub fn with_caustics(world: &'a World, settings: HybridSettings, max_depth: u32) -> Self {
        Self { world, max_depth, caustics: Caustics::new(world, settings, max_depth) }
    }
}

impl Integrator for PathTracer<'_> {
    fn begin_pass(&mut self, pass: Pass, counters: &mut Counters, cancelled: &(dyn Fn() -> bool + Sync)) {
        if let Some(caustics) = &mut self.caustics {
            caustics.begin_pass(pass, counters, cancelled);
        }
    }

    fn blur(&self) -> f64 {
        self.caustics.as_ref().map_or(0.0, Caustics::blur)
    }

    fn radiance<W: Witness>(
        &self,
        mut ray: Ray,
        sampler: &Sampler,
        counters: &mut Counters,
        witness: &mut W,
    ) -> Rgb {
        let materials = &self.world.materials;
        let mut radiance = Rgb::BLACK;
        let mut beta = Rgb::WHITE;
        let mut last = Last { from: Viewpoint { p: ray.o, n: None }, pdf: f32::INFINITY, sharp: None };
        let mut media = Media::start(&self.world.materials, sampler);
        let mut eta_scale = 1.0; // the factor η² that refraction has taken from beta, and will give back
        let mut after_wide = false;
        let (mut footprint, mut angle) = (0.0, self.world.camera.pixel_angle());

        for depth in 0..self.max_depth {
            // Find the next vertex, or take what the sky sends and stop.
            counters.rays += 1;
            let Some(hit) = self.world.closest_hit(&ray) else {
                let added = beta * self.sky(ray.d, &last);
                witness.note(|| Event::Sky { dir: ray.d, added });
                return radiance + added;
            };
            let surface = self.world.interaction(&ray, &hit);
            let wo = -ray.d;
            beta *= media.transmittance(hit.t, materials);
            footprint += angle * hit.t;
            witness.note(|| Event::Vertex { surface, wo, t: hit.t, beta });

            // Add light emitted here, then light straight from the lamps.
            let added = beta * self.emitted(&surface, wo, &last);
            witness.note(|| Event::Emitted { added });
            radiance += added;
            if depth + 1 == self.max_depth {
                witness.note(|| Event::Ended(End::Depth));
                break;
            }
            let bsdf = self.world.bsdf_between(&surface, wo, &media);
            let vertex = Vertex { surface: &surface, bsdf: &bsdf, wo, depth, after_wide };
            witness.note(|| Event::Lobes(bsdf.lobes().to_vec()));
            if bsdf.is_smooth() {
                let added = beta * self.direct(&vertex, &media, sampler, counters, witness);
                witness.note(|| Event::Lit { added });
                radiance += added;
                if let Some(caustics) = &self.caustics {
                    let added = beta * caustics.radiance(&surface, &bsdf, wo, depth + 1, footprint);
                    witness.note(|| Event::Photons { added });
                    radiance += added;
                }
            }

            // Follow one direction onwards.
            let Some(next) = vertex.sample_bsdf(sampler) else {
                witness.note(|| Event::Ended(End::Absorbed));
                break;
            };
            witness.note(|| vertex.scattered(&next, sampler));
            beta *= next.weight;
            eta_scale *= next.eta * next.eta;
            ray = surface.spawn(next.wi);
            last = Last {
                from: vertex.viewpoint(),
                pdf: if next.specular { f32::INFINITY } else { next.pdf },
                sharp: None,
            };
            if self.caustics.is_some() {
                let (is_sharp, share) = vertex.split(&next, sampler);
                beta *= share;
                if is_sharp {
                    last.sharp = after_wide.then_some((surface.material, surface.prim));
                } else {
                    (after_wide, angle) = (true, angle.max(WIDE_ANGLE));
                }
            }
            if next.through {
                beta *= media.pass(surface.material, next.wi.dot(surface.n) < 0.0, &self.world.materials);
            }

            // End dim paths early; the survivors carry their weight.
            let worth = beta.max_component() * eta_scale;
            let Some(survival) =
                roulette(worth, depth, next.specular, || sampler.get_1d(Dim::Roulette(depth)))
            else {
                witness.note(|| Event::Ended(End::Roulette));
                break;
            };
            beta /= survival;
        }
        radiance
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

    /// What one light sends straight to a vertex and on to the viewer, weighed against finding it by the bsdf.
    fn direct(
        &self,
        vertex: &Vertex,
        media: &Media,
        sampler: &Sampler,
        counters: &mut Counters,
        witness: &mut impl Witness,
    ) -> Rgb {
        let (world, depth) = (self.world, vertex.depth);
        let (u_choice, u) = (sampler.get_2d(Dim::LightChoice(depth)), sampler.get_2d(Dim::Light(depth)));
        let Some(drawn) = world.lights.sample_li(&world.geometry, &vertex.viewpoint(), u_choice, u) else {
            return Rgb::BLACK;
        };
        let (value, pdf_bsdf) = self.eval_pdf(vertex, Source::of(&drawn), drawn.wi);
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
        let blocked = world.any_hit(&drawn.shadow_ray(vertex.surface));
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

impl Vertex<'_> {
    /// From where it looks for light: above its surface, unless light may come through it.
    fn viewpoint(&self) -> Viewpoint {
        let ns = self.bsdf.normal();
        let n = if self.wo.dot(self.surface.n) < 0.0 { -ns } else { ns };
        Viewpoint { p: self.surface.p, n: (!self.bsdf.transmits()).then_some(n) }
    }

    /// Draws the direction in which the path goes on.
    fn sample_bsdf(&self, sampler: &Sampler) -> Option<BsdfSample> {
        let u = sampler.get_2d(Dim::Bsdf(self.depth));
        self.bsdf.sample(self.wo, u, self.u_lobe(sampler), Transport::Radiance)
    }

    fn u_lobe(&self, sampler: &Sampler) -> f32 {
        if self.bsdf.has_choice() { sampler.get_1d(Dim::Lobe(self.depth)) } else { 0.0 }
    }

    /// What is told of a drawn direction.
    fn scattered(&self, next: &BsdfSample, sampler: &Sampler) -> Event {
        let lobe = self.bsdf.lobe_chosen(self.wo, self.u_lobe(sampler));
        Event::Scattered { lobe, wi: next.wi, weight: next.weight, pdf: next.pdf, through: next.through }
    }

    /// Whether a drawn direction counts as that of a sharp lobe, and by what to multiply its weight then.
    ///
    /// Where lobes of both kinds scatter that way, chance decides, in proportion to what they send.
    fn split(&self, next: &BsdfSample, sampler: &Sampler) -> (bool, Rgb) {
        let lobes = self.bsdf.lobes();
        if next.specular || !lobes.iter().any(gathers) {
            return (true, Rgb::WHITE);
        }
        if lobes.iter().all(|lobe| gathers(lobe) || lobe.is_specular()) {
            return (false, Rgb::WHITE);
        }
        let all = self.bsdf.eval(self.wo, next.wi);
        let wide = self.bsdf.only(gathers).eval(self.wo, next.wi);
        let chance = (wide.mean() / all.mean()).clamp(0.0, 1.0); // of being wide
        let is_wide = sampler.get_1d(Dim::Share(self.depth)) < chance;
        let (part, chance) = if is_wide { (wide, chance) } else { (all - wide, 1.0 - chance) };
        let share = |part: f32, all: f32| if all > 0.0 { (part / (all * chance)).max(0.0) } else { 0.0 };
        (!is_wide, Rgb::new(share(part.r, all.r), share(part.g, all.g), share(part.b, all.b)))
    }
}

/// The weight of a strategy of density `a` where another has density `b`: the power heuristic a² / (a² + b²).
///
/// The ratio is formed first, so that no square overflows (Veach 1997, eq. 9.20). A density that is infinite belongs to
/// a direction that only its own strategy can find, and weighs 1; of two such, each counts half.
pub fn mis_weight(a: f32, b: f32) -> f32 {
    if a == b {
        return if a == 0.0 { 0.0 } else { 0.5 };
    }
    let ratio = b / a;
    1.0 / (1.0 + ratio * ratio)
}

/// Bounces before a path may be ended by chance; specular ones scatter nothing and wait longer.
const SAFE_BOUNCES: u32 = 3;
const SAFE_SPECULAR_BOUNCES: u32 = 32;
/// After so many bounces even paths that lose nothing end sooner or later.
const ENDLESS_BOUNCES: u32 = 8;

/// The probability with which a path of the given worth (its largest throughput) was allowed to go on; `None` if it ends.
pub(super) fn roulette(worth: f32, depth: u32, specular: bool, u: impl FnOnce() -> f32) -> Option<f32> {
    if worth.is_nan() || worth < 1e-30 {
        return None;
    }
    let safe = if specular { SAFE_SPECULAR_BOUNCES } else { SAFE_BOUNCES };
    if depth < safe {
        return Some(1.0);
    }
    let most = if depth < ENDLESS_BOUNCES { 1.0 } else { 0.95 };
    let survival = worth.clamp(0.05, most);
    (u() < survival).then_some(survival)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_two_strategies_add_up_to_one_at_the_extremes() {
        let densities = [0.0, 1e-38, 1.0, 1e38, f32::INFINITY];
        for a in densities {
            for b in densities {
                let (wa, wb) = (mis_weight(a, b), mis_weight(b, a));
                assert!((0.0..=1.0).contains(&wa), "{a} against {b}: {wa}");
                assert!(
                    a == 0.0 && b == 0.0 || (wa + wb - 1.0).abs() <= f32::EPSILON,
                    "{a} and {b}: {wa} + {wb}"
                );
            }
        }
        assert_eq!(mis_weight(f32::INFINITY, 1e38), 1.0);
        assert_eq!(mis_weight(0.0, 1.0), 0.0);
    }

    #[test]
    fn roulette_gives_back_what_it_takes() {
        // A chain of mirrors that reflect 0.9, each bounce adding what it carries: 1 / (1 − 0.9) = 10 on average.
        for specular in [false, true] {
            let n = 20_000;
            let mut total = 0.0;
            for i in 0..n {
                let sampler = Sampler::new(7, 0, i, 0);
                let mut beta = 1.0_f32;
                for depth in 0..10_000 {
                    total += f64::from(beta);
                    beta *= 0.9;
                    let u = || sampler.get_1d(Dim::Roulette(depth));
                    let Some(survival) = roulette(beta, depth, specular, u) else { break };
                    beta /= survival;
                }
            }
            let mean = total / n as f64;
            assert!((mean - 10.0).abs() < 0.1, "specular {specular}: {mean}");
        }
    }
}
