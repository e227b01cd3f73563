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
use super::{Counters, Integrator, Pass};
use crate::math::{Ray, Rgb, Vec3};
use crate::render::bsdf::{Bsdf, Transport};
use crate::render::driver::PpmSettings;
use crate::render::geometry::SurfacePoint;
use crate::render::media::Media;
use crate::render::photon::{Disc, Neighbor, Photon, PhotonMap, gathers, trace_photons};
use crate::render::sampler::{Dim, Sampler};
use crate::render::world::World;
use std::cell::RefCell;
use std::f32::consts::{FRAC_1_PI, PI};

/// Surfaces whose normals differ by more than 60° do not share photons.
const COS_MOST_BENT: f32 = 0.5;

/// A photon mapper.
pub struct PhotonMapper<'a> {
    world: &'a World,
    settings: PpmSettings,
    max_depth: u32,
    schedule: Schedule,
    map: PhotonMap,
}

/// The squares of the radii, pass after pass: r²ᵢ₊₁ = r²ᵢ · (i + α) / (i + 1), i from 1 (Knaus, Zwicker 2011, eq. 15).
///
/// In double precision: in single precision the recursion drifts by 1 % within a million passes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Schedule {
    alpha: f64,
    first: f64,
    pass: u32,
    radius2: f64,
}

impl Schedule {
    /// Starts at `radius`; `alpha` in (0, 1) is the share of photons kept.
    pub fn new(radius: f32, alpha: f64) -> Self {
        let first = f64::from(radius) * f64::from(radius);
        Self { alpha, first, pass: 0, radius2: first }
    }

    /// The square of the radius of a pass, counted from 0. The bits do not depend on what was asked before.
    pub fn radius2(&mut self, pass: u32) -> f64 {
        if pass < self.pass {
            (self.pass, self.radius2) = (0, self.first);
        }
        while self.pass < pass {
            self.pass += 1;
            let i = f64::from(self.pass);
            self.radius2 *= (i + self.alpha) / (i + 1.0);
        }
        self.radius2
    }
}

thread_local! {
    /// Room for the photons of one gather; kept, so that gathering allocates nothing.
    static FOUND: RefCell<Vec<Neighbor>> = const { RefCell::new(Vec::new()) };
}

impl<'a> PhotonMapper<'a> {
    /// A mapper of light along paths with at most `max_depth` vertices, the one on the light included and the camera not.
    pub fn new(world: &'a World, settings: PpmSettings, max_depth: u32) -> Self {
        let schedule = Schedule::new(settings.radius, settings.shrink);
        Self { world, settings, max_depth, schedule, map: PhotonMap::default() }
    }
}

impl Integrator for PhotonMapper<'_> {
    fn begin_pass(&mut self, pass: Pass, counters: &mut Counters) {
        self.schedule.radius2(pass.index);
        let (photons, emitted) = trace_photons(self.world, pass, self.settings.photon_count, self.max_depth);
        self.map = PhotonMap::new(&photons);
        *counters += emitted;
    }

    fn radiance(&self, mut ray: Ray, sampler: &Sampler, counters: &mut Counters) -> Rgb {
        let mut radiance = Rgb::BLACK;
        let mut beta = Rgb::WHITE;
        let mut media = Media::start(&self.world.materials, sampler);
        let mut eta_scale = 1.0; // the factor η² that refraction has taken from beta, and will give back

        for depth in 0..self.max_depth {
            // Find the next vertex, or take what the sky sends and stop.
            counters.rays += 1;
            let Some(hit) = self.world.closest_hit(&ray) else {
                return radiance + beta * self.world.lights.sky(ray.d).0;
            };
            let surface = self.world.interaction(&ray, &hit);
            let wo = -ray.d;
            beta *= media.transmittance(hit.t, &self.world.materials);

            // Add light emitted here, then light that photons brought.
            radiance += beta * self.world.emitted(&surface, wo);
            let bsdf = self.world.bsdf_between(&surface, wo, &media);
            let rough = bsdf.only(gathers);
            if !rough.lobes().is_empty() {
                radiance += beta * self.gather(&surface, &rough, wo, depth + 1);
            }

            // Follow one sharp reflection onwards.
            let sharp = bsdf.only(|lobe| !gathers(lobe));
            let (u, u_lobe) = (sampler.get_2d(Dim::Bsdf(depth)), sampler.get_1d(Dim::Lobe(depth)));
            let Some(next) = sharp.sample(wo, u, u_lobe, Transport::Radiance) else { break };
            beta *= next.weight;
            eta_scale *= next.eta * next.eta;
            ray = surface.spawn(next.wi);
            if next.through {
                beta *= media.pass(surface.material, next.wi.dot(surface.n) < 0.0, &self.world.materials);
            }

            // End dim paths early; the survivors carry their weight.
            let worth = beta.max_component() * eta_scale;
            let u = || sampler.get_1d(Dim::Roulette(depth));
            let Some(survival) = roulette(worth, depth, next.specular, u) else { break };
            beta /= survival;
        }
        radiance
    }
}

impl PhotonMapper<'_> {
    /// The radiance along `wo` of light that photons brought: their number, weighed by the bsdf, over the area of the disc.
    ///
    /// When the k-th photon bounds the disc, only the k − 1 inside count: k over that area would be too bright by k / (k − 1).
    /// `camera_depth` is the number of vertices of the camera path, this one included.
    fn gather(&self, surface: &SurfacePoint, bsdf: &Bsdf, wo: Vec3, camera_depth: u32) -> Rgb {
        let n = if wo.dot(surface.n) < 0.0 { -surface.n } else { surface.n };
        let longest = self.max_depth + 1 - camera_depth; // this vertex belongs to both paths
        let accepts = |photon: &Photon| {
            photon.depth <= longest && photon.wi.dot(n) > 0.0 && photon.n.dot(n) >= COS_MOST_BENT
        };
        let radius2 = self.schedule.radius2 as f32;
        let k = self.settings.k.max(2) as usize;
        let disc = Disc { p: surface.p, n, radius: radius2.sqrt(), k };
        FOUND.with_borrow_mut(|found| {
            self.map.nearest(&disc, accepts, found);
            let (counted, disc2) = bounding_disc(found, k, radius2);
            let photons = counted.iter().map(|neighbor| &self.map.photons()[neighbor.index as usize]);
            reflected(photons, bsdf, wo, n) / (PI * disc2)
        })
    }
}

/// The photons that count, and the squared radius of the disc over which they are spread.
fn bounding_disc(found: &[Neighbor], k: usize, radius2: f32) -> (&[Neighbor], f32) {
    match found.split_last() {
        // Photons on one spot bound no disc.
        Some((farthest, inside)) if found.len() == k && farthest.radius2 >= f32::MIN_POSITIVE => {
            (inside, farthest.radius2)
        }
        _ => (found, radius2),
    }
}

/// The sum of what photons send along `wo`, each its power times the bsdf.
///
/// Photons arrive in proportion to the cosine with the geometric normal, `eval` counts that with the shading normal: their
/// ratio remains. Where both are the same and the surface is diffuse, the bsdf is the same for all.
fn reflected<'p>(photons: impl Iterator<Item = &'p Photon>, bsdf: &Bsdf, wo: Vec3, n: Vec3) -> Rgb {
    if let Some(albedo) = bsdf.matt_albedo() {
        return photons.map(|photon| photon.power).sum::<Rgb>() * albedo * FRAC_1_PI;
    }
    photons.map(|photon| photon.power * bsdf.eval(wo, photon.wi) / photon.wi.dot(n)).sum()
}
