//! One pixel once more, with everything that happens on its paths.

use super::{Method, Settings, groups, render_group};
use crate::math::Rgb;
use crate::render::film::Region;
use crate::render::integrator::{Classic, Counters, Event, Integrator, Pass, PathTracer, PhotonMapper};
use crate::render::world::World;
use std::ops::Range;

/// One sample of a pixel.
#[derive(Clone, PartialEq, Debug)]
pub struct Replay {
    /// The pass that drew it.
    pub pass: u32,
    /// What it gave to the film, bit for bit; not a number where it counted as bad.
    pub sample: Rgb,
    /// How that came about.
    pub events: Vec<Event>,
}

/// The samples that these passes draw for a pixel. What they share, such as photon maps, is made anew for each.
pub fn replay(world: &World, settings: &Settings, pixel: [u32; 2], passes: Range<u32>) -> Vec<Replay> {
    let depth = settings.max_depth;
    match settings.method {
        Method::Pt => run(PathTracer::new(world, depth), world, settings, pixel, passes),
        Method::Hybrid(hybrid) => {
            run(PathTracer::with_caustics(world, hybrid, depth), world, settings, pixel, passes)
        }
        Method::Classic(classic) => run(Classic::new(world, classic, depth), world, settings, pixel, passes),
        Method::Ppm(ppm) => run(PhotonMapper::new(world, ppm, depth), world, settings, pixel, passes),
    }
}

fn run<I: Integrator>(
    mut integrator: I,
    world: &World,
    settings: &Settings,
    pixel: [u32; 2],
    passes: Range<u32>,
) -> Vec<Replay> {
    let mut counters = Counters::default();
    let mut one = |index| {
        let pass = Pass { index, seed: settings.seed, sampling: settings.sampling };
        integrator.begin_pass(pass, &mut counters, &|| false);
        let mut events = Vec::new();
        let own = Region { x: pixel[0], y: pixel[1], width: 1, height: 1 };
        let group = groups(&integrator, own, pass).first().copied().unwrap_or(own);
        let seen = render_group(&integrator, world, group, pass, Some(pixel), &mut counters, &mut events);
        let sample = seen.into_iter().find(|(of, _)| *of == pixel).map_or(Rgb::BLACK, |(_, sample)| sample);
        Replay { pass: index, sample, events }
    };
    passes.map(&mut one).collect()
}
