//! How fast rays are: trees over a displaced sphere, camera rays and shuffled diffuse bounces, on one thread.
//!
//! `cargo bench --bench rays`; an argument that is a number adds a mesh of about so many triangles.

use snell::math::{DAffine3, Frame, Ray, Vec2, Vec3, warp};
use snell::render::geometry::Geometry;
use snell::render::shape::{MaterialId, Mesh, SourceId};
use std::time::Instant;

const RAYS: usize = 1 << 20;

fn main() {
    let extra = std::env::args().filter_map(|argument| argument.parse().ok());
    println!("triangles   build s   camera Mrays/s   bounce   shadow");
    for triangles in [100_000, 1_000_000].into_iter().chain(extra) {
        let mesh = displaced_sphere(triangles);
        let count = mesh.triangles.len();
        let start = Instant::now();
        let geometry = Geometry::build(vec![mesh], Vec::new());
        let build = start.elapsed().as_secs_f64();
        let camera = camera_rays();
        let bounces = bounce_rays(&geometry, &camera);
        let closest = |ray: &Ray| geometry.closest_hit(ray).is_some();
        let segments: Vec<_> = bounces.iter().map(|ray| Ray { t_max: 1.0, ..*ray }).collect();
        println!(
            "{count:9} {build:9.2} {:16.2} {:8.2} {:8.2}",
            speed(&camera, closest),
            speed(&bounces, closest),
            speed(&segments, |ray| geometry.any_hit(ray))
        );
    }
}

/// Millions of rays a second, the best of three runs.
fn speed(rays: &[Ray], trace: impl Fn(&Ray) -> bool) -> f64 {
    let run = |_| {
        let start = Instant::now();
        let hits = rays.iter().filter(|ray| trace(ray)).count();
        std::hint::black_box(hits);
        rays.len() as f64 / start.elapsed().as_secs_f64() * 1e-6
    };
    (0..3).map(run).fold(0.0, f64::max)
}

/// A sphere of radius about 1, its surface wavy at several scales, of about `triangles` triangles.
fn displaced_sphere(triangles: usize) -> Mesh {
    let rows = ((triangles / 4) as f32).sqrt() as u32;
    let columns = rows * 2;
    let mut positions = Vec::new();
    for row in 0..=rows {
        for column in 0..=columns {
            let theta = std::f32::consts::PI * row as f32 / rows as f32;
            let phi = std::f32::consts::TAU * (column % columns) as f32 / columns as f32;
            let wave = |f: f32| (f * theta).sin() * (f * phi).sin();
            let r = 1.0 + 0.1 * wave(8.0) + 0.02 * wave(47.0) + 0.004 * wave(211.0);
            positions.push(r * Vec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin()));
        }
    }
    let quads = (0..rows).flat_map(|row| (0..columns).map(move |column| row * (columns + 1) + column));
    let triangles = quads.flat_map(|a| {
        let b = a + columns + 1;
        [[a, a + 1, b], [a + 1, b + 1, b]]
    });
    Mesh {
        triangles: triangles.collect(),
        positions,
        normals: None,
        uvs: None,
        material: MaterialId(0),
        object_from_world: DAffine3::IDENTITY,
        source: SourceId(0),
    }
}

/// Rays through the pixels of a square picture that the sphere fills.
fn camera_rays() -> Vec<Ray> {
    let side = 1 << (RAYS.ilog2() / 2);
    let pixel = |i: u32| (i as f32 + 0.5) / side as f32 - 0.5;
    let rays = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    rays.map(|(x, y)| Ray::new(Vec3::new(0.0, 0.0, 3.0), Vec3::new(pixel(x), pixel(y), -1.2))).collect()
}

/// Diffuse bounces, inwards so that each hits, in an order that has nothing to do with space.
fn bounce_rays(geometry: &Geometry, camera: &[Ray]) -> Vec<Ray> {
    let mut bounces = Vec::new();
    for (i, ray) in (0_u32..).zip(camera) {
        let Some(hit) = geometry.closest_hit(ray) else { continue };
        let point = geometry.surface_point(ray, &hit);
        let u = Vec2::new(hash(2 * i), hash(2 * i + 1));
        let dir = Frame::from_normal(-point.n).to_world(warp::square_to_cosine_hemisphere(u));
        bounces.push(point.spawn(dir));
    }
    for i in (1..bounces.len()).rev() {
        bounces.swap(i, (hash(i as u32 ^ 0x9e37_79b9) * i as f32) as usize);
    }
    bounces
}

/// A number in [0, 1) that looks random (Wellons 2018, `lowbias32`).
fn hash(mut x: u32) -> f32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^= x >> 16;
    (x >> 8) as f32 / (1 << 24) as f32
}
