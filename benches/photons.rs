//! How fast photon maps are built and searched, on photons spread evenly over the unit square.
//!
//! `cargo bench --bench photons`. Queries have no order, so that neighbours in time are none in space.

use snell::math::{Rgb, Vec3};
use snell::render::photon::{Disc, Photon, PhotonMap};
use std::time::Instant;

const QUERIES: u32 = 100_000;

fn main() {
    println!(" photons   build s     k   µs a query");
    for count in [200_000_u32, 1_000_000, 3_000_000] {
        let place = |i: u32| Vec3::new(hash(2 * i), hash(2 * i + 1), 0.0);
        let photon = |i| Photon { p: place(i), wi: Vec3::Z, n: Vec3::Z, power: Rgb::WHITE, depth: 2 };
        let photons: Vec<_> = (0..count).map(photon).collect();
        let start = Instant::now();
        let map = PhotonMap::new(&photons);
        let build = start.elapsed().as_secs_f64();
        for k in [10, 50, 200] {
            println!("{count:8} {build:9.2} {k:5} {:12.2}", microseconds(&map, k));
        }
    }
}

/// The time of one search, where the radius holds about four times as many as are wanted.
fn microseconds(map: &PhotonMap, k: usize) -> f64 {
    let radius = (4.0 * k as f32 / (std::f32::consts::PI * map.photons().len() as f32)).sqrt();
    let mut found = Vec::new();
    let start = Instant::now();
    for i in 0..QUERIES {
        let p = Vec3::new(hash(!i), hash(i ^ 0x9e37_79b9), 0.0);
        map.nearest(&Disc { p, n: Vec3::Z, radius, k }, |photon| photon.depth < 9, &mut found);
        std::hint::black_box(&found);
    }
    start.elapsed().as_secs_f64() * 1e6 / f64::from(QUERIES)
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
