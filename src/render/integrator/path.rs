//! Path tracing: paths from the camera, with light and bsdf sampling joined by multiple importance sampling.

use super::{Counters, Integrator, Pass};
use crate::math::{Ray, Rgb, Vec3};
use crate::render::bsdf::{Bsdf, BsdfSample, Transport};
use crate::render::geometry::SurfacePoint;
use crate::render::light::Viewpoint;
use crate::render::media::Media;
use crate::render::sampler::{Dim, Sampler};
use crate::render::world::World;

/// A path tracer.
pub struct PathTracer<'a> {
    world: &'a World,
    max_depth: u32,
}

/// Where a path is.
struct Vertex<'a> {
    surface: &'a SurfacePoint,
    bsdf: &'a Bsdf,
    wo: Vec3,
    depth: u32,
}

/// The vertex a path left last: by what other strategy could light found next have been drawn from there?
struct Last {
    from: Viewpoint,
    /// The density of the direction taken, per steradian; infinite if nothing else could have found it.
    pdf: f32,
}

impl<'a> PathTracer<'a> {
    /// A tracer of paths with at most `max_depth` vertices, the one on the light included and the camera not.
    pub fn new(world: &'a World, max_depth: u32) -> Self {
        Self { world, max_depth }
    }
}

impl Integrator for PathTracer<'_> {
    fn begin_pass(&mut self, _: Pass, _: &mut Counters) {}

    fn radiance(&self, mut ray: Ray, sampler: &Sampler, counters: &mut Counters) -> Rgb {
        let materials = &self.world.materials;
        let mut radiance = Rgb::BLACK;
        let mut beta = Rgb::WHITE;
        let mut last = Last { from: Viewpoint { p: ray.o, n: None }, pdf: f32::INFINITY };
        let mut media = Media::start(&self.world.materials, sampler);
        let mut eta_scale = 1.0; // the factor η² that refraction has taken from beta, and will give back

        for depth in 0..self.max_depth {
            // Find the next vertex, or take what the sky sends and stop.
            counters.rays += 1;
            let Some(hit) = self.world.closest_hit(&ray) else {
                return radiance + beta * self.sky(ray.d, &last);
            };
            let surface = self.world.interaction(&ray, &hit);
            let wo = -ray.d;
            beta *= media.transmittance(hit.t, materials);

            // Add light emitted here, then light straight from the lamps.
            radiance += beta * self.emitted(&surface, wo, &last);
            if depth + 1 == self.max_depth {
                break;
            }
            let bsdf = self.world.bsdf_between(&surface, wo, &media);
            let vertex = Vertex { surface: &surface, bsdf: &bsdf, wo, depth };
            if bsdf.is_smooth() {
                radiance += beta * self.direct(&vertex, &media, sampler, counters);
            }

            // Follow one direction onwards.
            let Some(next) = vertex.sample_bsdf(sampler) else { break };
            beta *= next.weight;
            eta_scale *= next.eta * next.eta;
            ray = surface.spawn(next.wi);
            last =
                Last { from: vertex.viewpoint(), pdf: if next.specular { f32::INFINITY } else { next.pdf } };
            if next.through {
                beta *= media.pass(surface.material, next.wi.dot(surface.n) < 0.0, &self.world.materials);
            }

            // End dim paths early; the survivors carry their weight.
            let worth = beta.max_component() * eta_scale;
            let Some(survival) =
                roulette(worth, depth, next.specular, || sampler.get_1d(Dim::Roulette(depth)))
            else {
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
        if radiance.is_black() || last.pdf == f32::INFINITY {
            return radiance;
        }
        radiance * mis_weight(last.pdf, self.world.lights.pdf_sky(&last.from, dir))
    }

    /// What the surface emits towards the last vertex, weighed against drawing it as a light.
    fn emitted(&self, surface: &SurfacePoint, wo: Vec3, last: &Last) -> Rgb {
        let radiance = self.world.emitted(surface, wo);
        if radiance.is_black() || last.pdf == f32::INFINITY {
            return radiance;
        }
        radiance * mis_weight(last.pdf, self.world.lights.pdf_area(&self.world.geometry, &last.from, surface))
    }

    /// What one light sends straight to a vertex and on to the viewer, weighed against finding it by the bsdf.
    fn direct(&self, vertex: &Vertex, media: &Media, sampler: &Sampler, counters: &mut Counters) -> Rgb {
        let (world, depth) = (self.world, vertex.depth);
        let (u_choice, u) = (sampler.get_2d(Dim::LightChoice(depth)), sampler.get_2d(Dim::Light(depth)));
        let Some(drawn) = world.lights.sample_li(&world.geometry, &vertex.viewpoint(), u_choice, u) else {
            return Rgb::BLACK;
        };
        let (value, pdf_bsdf) = vertex.bsdf.eval_pdf(vertex.wo, drawn.wi);
        let mut arriving = value * drawn.radiance;
        if arriving.is_black() {
            return Rgb::BLACK;
        }
        counters.rays += 1;
        if world.any_hit(&drawn.shadow_ray(vertex.surface)) {
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
        let u_lobe = if self.bsdf.has_choice() { sampler.get_1d(Dim::Lobe(self.depth)) } else { 0.0 };
        self.bsdf.sample(self.wo, u, u_lobe, Transport::Radiance)
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
