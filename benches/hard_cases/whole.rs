//! What each remedy costs in a whole render, and what becomes of the same picture without it.

use crate::scenes::{NAMES, SIDE, Scene};
use crate::support::Random;
use crate::thread_seconds;
use snell::math::{Ray, Rgb};
use snell::render::film::{Film, Region, Tile};
use snell::render::geometry::{Geometry, SurfacePoint};
use snell::render::naive::{self, Remedy};
use snell::render::{Outcome, render};
use std::hint::black_box;

/// Passes of a picture.
const PASSES: u32 = 4;
/// How often each picture is made, in turns; the median of the ratios counts.
const ROUNDS: usize = 9;
/// Two values of a pixel differ by more than noise in the last place from here on.
const FAR: f32 = 0.1;

/// What the table has a row for.
const ROWS: [(&str, &[Remedy]); 5] = [
    ("boxes widened by their rounding (Ize 2013), not one fused multiply-add a face", &[Remedy::Boxes]),
    ("watertight triangles (Woop, Benthin, Wald 2013), not Möller & Trumbore 1997", &[Remedy::Triangles]),
    ("origins by error bounds (Pharr et al. 2023), not 10⁻⁴ along the direction", &[Remedy::Origins]),
    ("spheres in double precision, not b² − 4ac in single", &[Remedy::Spheres]),
    ("all four", &Remedy::ALL),
];

/// A row's cell: its price, and what became of the picture.
struct Cell {
    /// Time with the remedy over time without, and half the distance between the quartiles of that.
    ratio: f64,
    spread: f64,
    rays: Wrong,
    darker: usize,
    brighter: usize,
    bad: u64,
    /// The mean of the picture over that of the careful one.
    mean: f64,
}

/// Rays of paths that go wrong without a remedy.
#[derive(Default)]
struct Wrong {
    /// That meet nothing, and with it something.
    lost: usize,
    /// That meet something else.
    other: usize,
    of: usize,
}

/// Prints both tables.
pub fn print() {
    let columns: Vec<Vec<Cell>> = NAMES.iter().map(|name| column(&Scene::new(name, PASSES))).collect();
    println!("| remedy, and what it replaces | S1 | S2 | S3 | S4 |\n|---|---:|---:|---:|---:|");
    for (i, (name, _)) in ROWS.iter().enumerate() {
        let price = |cells: &Vec<Cell>| {
            let Cell { ratio, spread, .. } = cells[i];
            format!("{:+.1} ± {:.1} %", (ratio - 1.0) * 100.0, spread * 100.0)
        };
        println!("| {name} | {} |", columns.iter().map(price).collect::<Vec<_>>().join(" | "));
    }
    let sums: Vec<String> = NAMES.iter().map(|name| film(&Scene::new(name, PASSES))).collect();
    println!("| sums of samples in double precision, not single | {} |", sums.join(" | "));
    println!(
        "\n| without it | scene | rays lost | rays that meet another thing | of | pixels darker | brighter | no numbers | mean |"
    );
    println!("|---|---|---:|---:|---:|---:|---:|---:|---:|");
    for (i, (name, _)) in ROWS.iter().enumerate() {
        for (scene, cells) in NAMES.iter().zip(&columns) {
            let Cell { rays, darker, brighter, bad, mean, .. } = &cells[i];
            println!(
                "| {} | {scene} | {} | {} | {} | {darker} | {brighter} | {bad} | {:+.3} % |",
                name.split([',', '(']).next().unwrap_or(name).trim(),
                rays.lost,
                rays.other,
                rays.of,
                (mean - 1.0) * 100.0
            );
        }
    }
}

/// Makes all pictures of a scene, in turns.
fn column(scene: &Scene) -> Vec<Cell> {
    on_one_thread(|| {
        let mut ratios: [Vec<f64>; ROWS.len()] = Default::default();
        for _ in 0..ROUNDS {
            for (ratios, (_, remedies)) in ratios.iter_mut().zip(ROWS) {
                // Each naive picture has a careful one before it and one after it.
                let [before, naive, after] = [&[], remedies, &[]].map(|without| timed(scene, without).1);
                ratios.push((before + after) / 2.0 / naive);
            }
        }
        ratios.iter_mut().for_each(|ratios| ratios.sort_by(f64::total_cmp));
        let careful = timed(scene, &[]).0;
        let cells = ROWS.iter().enumerate().map(|(i, (_, remedies))| {
            let naive = timed(scene, remedies).0;
            cell(scene, remedies, &careful, &naive, &ratios[i])
        });
        cells.collect()
    })
}

/// All of it on one thread, whose clock tells the whole time.
fn on_one_thread<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can be started");
    pool.install(work)
}

fn timed(scene: &Scene, without: &[Remedy]) -> (Outcome, f64) {
    naive::leave_out(without);
    let start = thread_seconds();
    let outcome = render(&scene.lowered.world, &scene.settings, &());
    let seconds = thread_seconds() - start;
    naive::leave_out(&[]);
    (outcome, seconds)
}

fn cell(scene: &Scene, remedies: &[Remedy], careful: &Outcome, naive: &Outcome, ratios: &[f64]) -> Cell {
    let (reference, picture) = (careful.film.mean(), naive.film.mean());
    let is = |far: fn(f32, f32) -> bool| {
        let pairs = reference.iter().zip(&picture);
        pairs.filter(|(r, x)| far(x.luminance(), r.luminance())).count()
    };
    let mean = |picture: &[Rgb]| picture.iter().map(|pixel| f64::from(pixel.luminance())).sum::<f64>();
    Cell {
        ratio: ratios[ROUNDS / 2],
        spread: (ratios[ROUNDS * 3 / 4] - ratios[ROUNDS / 4]) / 2.0,
        rays: wrong(scene, remedies),
        darker: is(|x, r| x < r * (1.0 - FAR)),
        brighter: is(|x, r| x > r * (1.0 + FAR)),
        bad: naive.stats.bad_samples,
        mean: mean(&picture) / mean(&reference),
    }
}

/// Compares what rays meet with all remedies and without some: those through pixels, and two that leave what they meet.
fn wrong(scene: &Scene, without: &[Remedy]) -> Wrong {
    let geometry = &scene.lowered.world.geometry;
    let (mut random, mut wrong) = (Random(7), Wrong::default());
    for ray in scene.camera_rays() {
        let mut leave: Box<dyn Fn() -> Ray> = Box::new(move || ray);
        for _ in 0..3 {
            let careful = meet(geometry, &leave());
            naive::leave_out(without);
            let naive = meet(geometry, &leave());
            naive::leave_out(&[]);
            wrong.of += 1;
            wrong.lost += usize::from(careful.is_some() && naive.is_none());
            wrong.other += usize::from(careful.map(prim) != naive.map(prim) && naive.is_some());
            let Some(surface) = careful else { break };
            let dir = random.direction();
            leave = Box::new(move || surface.spawn(dir));
        }
    }
    wrong
}

fn meet(geometry: &Geometry, ray: &Ray) -> Option<SurfacePoint> {
    geometry.closest_hit(ray).map(|hit| geometry.surface_point(ray, &hit))
}

fn prim(surface: SurfacePoint) -> u32 {
    surface.prim.0
}

/// The part of a render that sums in double precision add, and by how much those in single are off.
fn film(scene: &Scene) -> String {
    let whole = on_one_thread(|| timed(scene, &[]));
    let region = Region { x: 0, y: 0, width: SIDE, height: SIDE };
    let samples = whole.0.film.mean();
    let tiles = [Tile { region, samples: samples.clone() }];
    let repeats = 64;
    let (mut double, mut single) = (Film::new(region), vec![[0.0_f32; 3]; region.area() * 8]);
    let [mut by_double, mut by_single] = [f64::INFINITY; 2];
    for _ in 0..ROUNDS {
        by_double = by_double.min(seconds(|| (0..repeats).for_each(|_| double.add_pass(&tiles))));
        by_single = by_single.min(seconds(|| {
            for pass in 0..repeats {
                let sums = &mut single[pass % 8 * region.area()..][..region.area()];
                for (sum, sample) in sums.iter_mut().zip(&samples).filter(|(_, sample)| sample.is_finite()) {
                    *sum = [0, 1, 2].map(|channel| sum[channel] + sample[channel]);
                }
            }
        }));
    }
    black_box((&double, &single));
    let a_pass = (by_double - by_single) / repeats as f64;
    format!("{:+.1} %", a_pass * f64::from(PASSES) / whole.1 * 100.0)
}

fn seconds(work: impl FnOnce()) -> f64 {
    let start = thread_seconds();
    work();
    thread_seconds() - start
}
