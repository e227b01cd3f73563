//! Light straight from lamps and the sky: drawn as a light, or met by chance, each weighed against the other.

use super::path::PathTracer;
use super::vertex::{Last, Vertex};
use super::weight::mis_weight;
use super::{Counters, Event, Witness};
use crate::math::{Rgb, Vec3};
use crate::render::bsdf::MaterialId;
use crate::render::geometry::{PrimId, SurfacePoint};
use crate::render::media::Media;
use crate::render::photon::{Source, gathers};
use crate::render::sampler::{Dim, Sampler};

impl PathTracer<'_> {
    /// What the sky sends along a direction taken at the last vertex, weighed against drawing it as a light.
    pub(super) fn sky(&self, dir: Vec3, last: &Last) -> Rgb {
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
    pub(super) fn emitted(&self, surface: &SurfacePoint, wo: Vec3, last: &Last) -> Rgb {
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

    /// What one light sends straight to a vertex and on to the viewer, weighed against finding it by the bsdf, which tries
    /// `finders` times for each light drawn.
    pub(super) fn direct(
        &self,
        vertex: &Vertex,
        media: &Media,
        sampler: &Sampler,
        finders: f32,
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
        let weight = if drawn.delta { 1.0 } else { mis_weight(drawn.pdf, pdf_bsdf * finders) };
        let mut media = *media;
        let n = vertex.surface.n;
        if vertex.wo.dot(n) * drawn.wi.dot(n) < 0.0 && vertex.bsdf.spreads_through() {
            arriving *= media.pass(vertex.surface.material, drawn.wi.dot(n) < 0.0, &world.materials);
        }
        arriving * media.transmittance(drawn.distance(), &world.materials) * (weight / drawn.pdf)
    }
}
