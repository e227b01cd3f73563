//! A vertex of a path, and what the next one must know of it.

use crate::math::{Rgb, Vec3};
use crate::render::bsdf::{Bsdf, BsdfSample, MaterialId, Transport};
use crate::render::geometry::{PrimId, SurfacePoint};
use crate::render::light::Viewpoint;
use crate::render::photon::gathers;
use crate::render::sampler::{Dim, Sampler};

/// Where a path is.
pub struct Vertex<'a> {
    pub surface: &'a SurfacePoint,
    pub bsdf: &'a Bsdf,
    pub wo: Vec3,
    pub depth: u32,
    /// Whether a vertex before it scattered widely: photons fall there, not on the camera.
    pub after_wide: bool,
}

/// The vertex a path left last: by what other strategy could light found next have been drawn from there?
#[derive(Clone, Copy)]
pub struct Last {
    pub from: Viewpoint,
    /// The density of the direction taken, per steradian; infinite if nothing else could have found it.
    pub pdf: f32,
    /// The surface, if it and all others back to one that scattered widely are sharp: light from here makes a caustic there.
    pub sharp: Option<(MaterialId, PrimId)>,
}

impl Vertex<'_> {
    /// From where it looks for light: above its surface, unless light may come through it.
    pub fn viewpoint(&self) -> Viewpoint {
        let ns = self.bsdf.normal();
        let n = if self.wo.dot(self.surface.n) < 0.0 { -ns } else { ns };
        Viewpoint { p: self.surface.p, n: (!self.bsdf.transmits()).then_some(n) }
    }

    /// Draws the direction in which the path goes on, from the lobe that `u_lobe` chooses.
    pub fn sample_bsdf(&self, sampler: &Sampler, u_lobe: f32) -> Option<BsdfSample> {
        let u = sampler.get_2d(Dim::Bsdf(self.depth));
        self.bsdf.sample(self.wo, u, u_lobe, Transport::Radiance)
    }

    /// The number that chooses a lobe.
    pub fn u_lobe(&self, sampler: &Sampler) -> f32 {
        if self.bsdf.has_choice() { sampler.get_1d(Dim::Lobe(self.depth)) } else { 0.0 }
    }

    /// Whether a drawn direction counts as that of a sharp lobe, and by what to multiply its weight then.
    ///
    /// Where lobes of both kinds scatter that way, chance decides, in proportion to what they send.
    pub fn split(&self, next: &BsdfSample, sampler: &Sampler) -> (bool, Rgb) {
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
