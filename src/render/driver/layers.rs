//! What a camera sees first at each pixel, apart from its light: layers for denoisers and for putting pictures together.

use super::camera_ray;
use crate::math::{Rgb, Vec3};
use crate::render::bsdf::Transport;
use crate::render::film::Region;
use crate::render::integrator::Pass;
use crate::render::media::Media;
use crate::render::sampler::{Dim, Sampling};
use crate::render::world::World;
use rayon::prelude::*;

/// Passes that are looked at: their camera rays are the picture's own, each at a moment of its own.
const MOST_PASSES: u32 = 16;

/// The first surfaces of a region, `height × width` each, top row first. Means over the rays of a pixel, but for depth.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Layers {
    /// The share of light that the surface sends on along the ray, from whatever direction it comes; 0 where nothing is.
    pub albedo: Vec<Rgb>,
    /// The shading normal, on the viewer's side, in world space: shorter than 1 at edges, 0 where nothing is.
    pub normal: Vec<Vec3>,
    /// The distance to the nearest surface that any ray of the pixel meets, in metres; infinite where nothing is.
    pub depth: Vec<f32>,
}

/// What one ray finds, or all rays of a pixel.
#[derive(Clone, Copy)]
struct First {
    albedo: Rgb,
    normal: Vec3,
    depth: f32,
}

impl First {
    const NOTHING: Self = Self { albedo: Rgb::BLACK, normal: Vec3::ZERO, depth: f32::INFINITY };
}

/// Follows the camera rays of the first passes, at most 16 of them, to what they meet first.
pub fn layers(world: &World, region: Region, seed: u64, passes: u32) -> Layers {
    let count = passes.clamp(1, MOST_PASSES);
    let rows: Vec<Region> =
        (0..region.height).map(|row| Region { y: region.y + row, height: 1, ..region }).collect();
    let pixel = |pixel: [u32; 2]| {
        let mut sum = First::NOTHING;
        for index in 0..count {
            let first = first(world, Pass { index, seed, sampling: Sampling::Sobol }, pixel);
            sum.albedo += first.albedo;
            sum.normal += first.normal;
            sum.depth = sum.depth.min(first.depth);
        }
        let share = 1.0 / count as f32;
        First { albedo: sum.albedo * share, normal: sum.normal * share, ..sum }
    };
    let found: Vec<Vec<First>> = rows.par_iter().map(|row| row.pixels().map(pixel).collect()).collect();
    let found = || found.iter().flatten();
    Layers {
        albedo: found().map(|first| first.albedo).collect(),
        normal: found().map(|first| first.normal).collect(),
        depth: found().map(|first| first.depth).collect(),
    }
}

/// The weight of a drawn direction is the albedo, in the mean over directions; of matt surfaces, each time.
fn first(world: &World, pass: Pass, pixel: [u32; 2]) -> First {
    let (sampler, ray) = camera_ray(world, pass, pixel, false);
    let Some(ray) = ray.map(|camera| camera.ray) else { return First::NOTHING };
    let Some(hit) = world.closest_hit(&ray) else { return First::NOTHING };
    let surface = world.interaction(&ray, &hit);
    let wo = -ray.d;
    let bsdf = world.bsdf_between(&surface, wo, &Media::start(&world.materials, &sampler));
    let drawn =
        bsdf.sample(wo, sampler.get_2d(Dim::Bsdf(0)), sampler.get_1d(Dim::Lobe(0)), Transport::Radiance);
    // Radiance grows by η² as it enters a denser medium: no light comes of that.
    let albedo = drawn.map_or(Rgb::BLACK, |next| next.weight * (next.eta * next.eta));
    let normal = if wo.dot(surface.n) < 0.0 { -bsdf.normal() } else { bsdf.normal() };
    First { albedo, normal, depth: hit.t }
}
