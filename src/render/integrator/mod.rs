//! How the radiance along a camera ray is found.

mod cells;
mod classic;
mod direct;
mod fork;
mod gather;
mod path;
mod ppm;
mod share;
mod vertex;
mod walk;
mod weight;
mod witness;

pub use classic::{Classic, ClassicSettings, Shading};
pub use path::PathTracer;
pub use ppm::PhotonMapper;
pub use weight::mis_weight;
pub use witness::{End, Event, Witness};

use super::effects::Effects;
use super::film::STREAMS;
use super::sampler::{Dim, Sampler, Sampling};
use super::world::World;
use crate::math::{Ray, Rgb};
use std::ops::AddAssign;

/// A way to find radiance. One value serves a whole render, pass after pass.
pub trait Integrator: Sync {
    /// What it looks at.
    fn world(&self) -> &World;

    /// Prepares what all camera rays of a pass share. Once `cancelled`, leaves it unfinished: no ray will ask for it.
    fn begin_pass(&mut self, pass: Pass, counters: &mut Counters, cancelled: &(dyn Fn() -> bool + Sync));

    /// Whether all rays of a pass are of one moment, [`Pass::moment`], for they share what was found then: photons. The mean
    /// over the passes is that over the time all the same.
    fn is_of_a_moment(&self) -> bool {
        false
    }

    /// Of photons: the squared radius of this pass's discs over that of the first pass's. 0 of no photons.
    fn blur(&self) -> f64 {
        0.0
    }

    /// The radiance that arrives along a camera ray; how it comes about is told to `witness`.
    fn radiance<W: Witness>(
        &self,
        ray: Ray,
        sampler: &Sampler,
        counters: &mut Counters,
        witness: &mut W,
    ) -> Rgb;

    /// The side of the squares of pixels whose camera rays [`Self::radiances`] wants together.
    fn group_side(&self) -> u32 {
        1
    }

    /// The radiances that arrive along the camera rays of such a square, each with the numbers of its path. How that of
    /// one of them comes about is `told` to `witness`.
    fn radiances<W: Witness>(
        &self,
        cameras: &[(Ray, Sampler)],
        told: Option<usize>,
        counters: &mut Counters,
        witness: &mut W,
    ) -> Vec<Rgb> {
        each_alone(self, cameras, told, counters, witness)
    }
}

/// One of the passes of a render; all its random numbers follow from it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Pass {
    /// Counted from 0.
    pub index: u32,
    /// The seed of the render.
    pub seed: u64,
    /// How its samples are spread among those of the other passes.
    pub sampling: Sampling,
}

impl Pass {
    /// The numbers of the camera path through pixel `item`. Passes take turns among the streams of the film.
    pub fn camera_sampler(&self, item: u64) -> Sampler {
        match self.sampling {
            Sampling::Sobol => Sampler::new(self.seed, self.index % STREAMS, item, self.index / STREAMS),
            Sampling::Independent => Sampler::new(self.seed, self.index, item, 0),
        }
    }

    /// The moment that all rays of a pass share where they have to, in [0, 1): 0 where nothing moves.
    pub fn moment(&self, world: &World) -> f32 {
        const EVERYWHERE: u64 = u64::MAX; // no pixel's number
        let moves = world.effects.has(Effects::MOTION);
        if moves { self.camera_sampler(EVERYWHERE).get_1d(Dim::Time) } else { 0.0 }
    }

    /// The numbers of a probe, counted from 0 in each pass: a path that tells about light for all of a pass.
    pub fn probe_sampler(&self, probe: u32) -> Sampler {
        const PROBE_STREAMS: u32 = 1 << 30; // apart from those of photons and camera paths
        Sampler::new(self.seed, PROBE_STREAMS | self.index, 0, probe)
    }

    /// By how many pixels the grid of groups of this side, which starts at the top left of the picture, is moved to the left
    /// and upwards: by others in each stream, so that no pixel is in the same company in all of them.
    pub fn grid_shift(&self, side: u32) -> [u32; 2] {
        const QUARTERS: [[u32; 2]; STREAMS as usize] =
            [[0, 0], [2, 2], [2, 0], [0, 2], [1, 1], [3, 3], [3, 1], [1, 3]];
        QUARTERS[(self.index % STREAMS) as usize].map(|quarters| quarters * side / 4)
    }

    /// The numbers of a photon, counted from 0 in each pass; passes are independent of each other.
    pub fn photon_sampler(&self, photon: u32) -> Sampler {
        const PHOTON_STREAMS: u32 = 1 << 31; // apart from those of camera paths
        let stream = PHOTON_STREAMS | self.index;
        match self.sampling {
            Sampling::Sobol => Sampler::new(self.seed, stream, 0, photon),
            Sampling::Independent => Sampler::new(self.seed, stream, u64::from(photon), 0),
        }
    }
}

/// What was done, for the report.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Counters {
    /// Rays sent from cameras and surfaces, and towards lights.
    pub rays: u64,
    /// Photons emitted.
    pub photons: u64,
    /// Photons left on surfaces.
    pub stored_photons: u64,
    /// Photons, and paths that tell about light for all of a pass, whose light was infinite, negative, or not a number; it
    /// counts as none.
    pub bad_light: u64,
}

impl AddAssign for Counters {
    fn add_assign(&mut self, other: Self) {
        self.rays += other.rays;
        self.photons += other.photons;
        self.stored_photons += other.stored_photons;
        self.bad_light += other.bad_light;
    }
}

/// The radiances of camera rays that have nothing to do with each other.
fn each_alone<I: Integrator + ?Sized, W: Witness>(
    integrator: &I,
    cameras: &[(Ray, Sampler)],
    told: Option<usize>,
    counters: &mut Counters,
    witness: &mut W,
) -> Vec<Rgb> {
    let radiance = |(i, (ray, sampler)): (usize, &(Ray, Sampler))| {
        integrator.world().begin_path();
        if told == Some(i) {
            integrator.radiance(*ray, sampler, counters, witness)
        } else {
            integrator.radiance(*ray, sampler, counters, &mut ())
        }
    };
    cameras.iter().enumerate().map(radiance).collect()
}
