//! Final gathering: light that comes by way of two matt surfaces or more.
//!
//! From a matt surface that the camera sees, several paths look around instead of one. Where they meet another matt
//! surface they end: what it sends on is known there, as the mean over [`Cells`] of what a few paths, the probes, found at
//! their second matt vertex before the pass. That mean blurs the light of the second surface, which the first one blurs
//! much more; cells shrink from pass to pass as the discs of photons do, and where one holds too few probes, or the two
//! surfaces are closer than it is wide, paths go on as ever. So the picture converges to the same.

use super::cells::{CellId, Cells, Grid};
use super::path::{PathTracer, Trace};
use super::vertex::Vertex;
use super::walk::Walk;
use super::{Counters, Integrator, Pass};
use crate::math::{Rgb, Vec2, Vec3};
use crate::render::bsdf::{Bsdf, Lobe};
use crate::render::effects::Effects;
use crate::render::sampler::{Dim, Sampler, Sampling};
use rayon::prelude::*;

/// The most paths that look around.
pub const MOST_GATHERS: u32 = 16;

/// Probes that one thread follows in a row.
const CHUNK: u32 = 1024;
/// The width of a cell, seen straight from the camera, at most: in radians. A room holds a few thousand cells.
const CELL_ANGLE: f32 = 0.04;
/// Surfaces that are closer to each other than this, in widths of a cell, see its blur.
const NEAR: f32 = 0.5;
/// Photons of caustics to a probe: so few fill the cells, and more do not make less noise.
const PHOTONS_PER_PROBE: u32 = 2;
/// With so many vertices left, paths do not tell how many there are: those that do as much find the same.
const MANY_VERTICES: u32 = 24;
/// Probes by which is decided whether to gather.
const PILOTS: u32 = 2048;
/// Gathering pays where at least this share of what looks around meets a matt surface.
const LEAST_MET: f32 = 0.25;

/// How light is gathered.
pub struct Gathering {
    probe_count: u32,
    /// The share of what looks around that meets a matt surface.
    met: f32,
    grid: Grid,
    cells: Cells,
    /// The luminance of a white surface in light that comes from others, on average.
    ambient: f32,
}

/// What a probe met.
enum Probe {
    /// No matt surface at first.
    Nothing,
    /// One, and none from there.
    One,
    /// Two: what the second one would send on if it were white.
    Two(CellId, Rgb),
}

impl Gathering {
    /// Decides by a few probes whether gathering pays.
    pub fn worthwhile(tracer: &PathTracer, photon_count: u32) -> Option<Self> {
        if tracer.world.materials.disperses() {
            return None; // paths of different wavelengths have nothing to tell each other
        }
        let eye = tracer.world.camera.position();
        let grid = Grid { eye, angle: CELL_ANGLE, offset: Vec3::ZERO, shrunk: 1.0 };
        let (mut one, mut two) = (0.0, 0.0);
        for i in 0..PILOTS {
            let pass = Pass { index: 0, seed: 0, sampling: Sampling::Sobol };
            let moment = pass.moment(tracer.world);
            match tracer.probe(&grid, &pass.probe_sampler(i), moment, &mut Counters::default()) {
                Probe::Nothing => {}
                Probe::One => one += 1.0,
                Probe::Two(..) => two += 1.0,
            }
        }
        let met: f32 = two / (one + two);
        let probe_count = photon_count.div_ceil(PHOTONS_PER_PROBE);
        (met >= LEAST_MET).then(|| Self { probe_count, met, grid, cells: Cells::default(), ambient: 0.0 })
    }

    /// Follows the probes of a pass.
    pub fn begin_pass(
        &mut self,
        tracer: &PathTracer,
        pass: Pass,
        counters: &mut Counters,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) {
        let sampler = pass.probe_sampler(u32::MAX);
        let offset = sampler.get_2d(Dim::Filter).extend(sampler.get_1d(Dim::PhotonPosition));
        let grid = Grid { offset, shrunk: tracer.blur().sqrt() as f32, ..self.grid };
        let moment = pass.moment(tracer.world);
        let chunks: Vec<_> = (0..self.probe_count.div_ceil(CHUNK))
            .into_par_iter()
            .filter(|_| !cancelled())
            .map(|chunk| {
                let mut counters = Counters::default();
                let probes = chunk * CHUNK..self.probe_count.min((chunk + 1) * CHUNK);
                let found =
                    probes.map(|i| tracer.probe(&grid, &pass.probe_sampler(i), moment, &mut counters));
                (found.collect::<Vec<_>>(), counters)
            })
            .collect();
        chunks.iter().for_each(|(_, of_chunk)| *counters += *of_chunk);
        let values = chunks.into_iter().flat_map(|(probes, _)| probes).filter_map(|probe| match probe {
            Probe::Two(cell, radiance) => Some((cell, radiance)),
            Probe::Nothing | Probe::One => None,
        });
        let values: Vec<_> = values.collect();
        let total: f32 = values.iter().map(|(_, radiance)| radiance.luminance()).sum();
        self.ambient = total / values.len().max(1) as f32;
        (self.grid, self.cells) = (grid, Cells::new(values.into_iter()));
    }
}

impl PathTracer<'_> {
    /// How paths may look around from a vertex, and its albedo.
    pub(super) fn looks_around(&self, walk: &Walk, vertex: &Vertex) -> Option<(&Gathering, Rgb)> {
        let gathering = self.gathering.as_ref().filter(|_| !walk.after_wide)?;
        Some((gathering, vertex.bsdf.matt_albedo()?))
    }

    /// How many paths look around from a vertex that sends `lit` on, of the light that lamps and photons brought.
    ///
    /// The fewer the more of its light that is: noise counts in proportion to the whole.
    pub(super) fn gather_count(&self, walk: &Walk, vertex: &Vertex, lit: Rgb) -> u32 {
        let Some((gathering, albedo)) = self.looks_around(walk, vertex) else { return 1 };
        let indirect = albedo.luminance() * gathering.ambient;
        let part = if indirect > 0.0 { indirect / (indirect + lit.luminance()) } else { 0.0 };
        let most = MOST_GATHERS as f32 * gathering.met * walk.share.min(1.0);
        ((most * part).ceil() as u32).clamp(1, MOST_GATHERS)
    }

    /// The radiance that a vertex sends to the viewer, if it is known well enough from where the path is.
    pub(super) fn gathered(&self, walk: &Walk, vertex: &Vertex) -> Option<Rgb> {
        let gathering = self.gathering.as_ref().filter(|_| walk.after_wide)?;
        let albedo = vertex.bsdf.matt_albedo()?;
        if walk.since_wide < NEAR * gathering.grid.side(vertex.surface.p) {
            return None;
        }
        gathering.cells.mean(&self.cell(&gathering.grid, vertex)).map(|white| albedo * white)
    }

    fn cell(&self, grid: &Grid, vertex: &Vertex) -> CellId {
        let surface = vertex.surface;
        let n = if vertex.wo.dot(surface.n) < 0.0 { -surface.n } else { surface.n };
        let left = self.max_depth - vertex.depth;
        grid.cell(surface.p, n, left.min(MANY_VERTICES))
    }

    /// Follows a path from anywhere in the picture, at a moment, to its second matt vertex, and asks for the light there.
    fn probe(&self, grid: &Grid, sampler: &Sampler, moment: f32, counters: &mut Counters) -> Probe {
        let camera = &self.world.camera;
        let [width, height] = [camera.width(), camera.height()];
        let at = sampler.get_2d(Dim::Filter) * Vec2::new(width as f32, height as f32);
        let pixel = [(at.x as u32).min(width - 1), (at.y as u32).min(height - 1)];
        let blurs = self.world.effects.has(Effects::LENS_BLUR);
        let u_lens = if blurs { sampler.get_2d(Dim::Lens) } else { Vec2::ZERO };
        let Some(camera_ray) = camera.ray(pixel, at.fract(), u_lens) else { return Probe::Nothing };
        let camera_ray = camera.at(camera_ray, moment);
        let mut walk = Walk { is_clear: false, ..Walk::start(self.world, camera_ray.ray, sampler) };
        while walk.depth + 1 < self.max_depth {
            counters.rays += 1;
            let Some(hit) = self.world.closest_hit(&walk.ray) else { break };
            let surface = self.world.interaction(&walk.ray, &hit);
            walk.pass_through(hit.t, self.world);
            let bsdf = self.world.bsdf_between(&surface, walk.wo(), &walk.media);
            let vertex = walk.vertex(&surface, &bsdf);
            if walk.after_wide && bsdf.matt_albedo().is_some() {
                let mut white = Bsdf::new(&surface);
                white.add(Lobe::Lambert { albedo: Rgb::WHITE });
                let vertex = Vertex { bsdf: &white, ..vertex };
                return Probe::Two(self.cell(grid, &vertex), self.sent_by(walk, &vertex, counters));
            }
            if self.scatter(&mut walk, &vertex, &mut ()).is_none() {
                break;
            }
        }
        if walk.after_wide { Probe::One } else { Probe::Nothing }
    }

    /// The radiance that a vertex sends on, whatever the path did before.
    fn sent_by(&self, mut walk: Walk, vertex: &Vertex, counters: &mut Counters) -> Rgb {
        (walk.beta, walk.eta_scale) = (Rgb::WHITE, 1.0);
        let mut trace = Trace { radiance: Rgb::BLACK, waiting: Vec::new(), counters, witness: &mut () };
        trace.radiance = self.lit(&walk, vertex, &mut trace);
        if self.scatter(&mut walk, vertex, &mut ()).is_some() {
            self.follow(walk, None, &mut trace);
        }
        if !trace.radiance.is_valid() {
            counters.bad_light += 1;
            return Rgb::BLACK;
        }
        trace.radiance
    }
}
