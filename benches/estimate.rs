//! What it costs to know the error: the shares of a render's processor time that its estimates take.
//!
//! ```text
//! cargo bench --bench estimate [-- SIDE PASSES]
//! valgrind --tool=callgrind --toggle-collect='*Film::error*' target/release/deps/estimate-… 64 64
//! ```
//!
//! The first counts time on one thread, the second instructions, which are the same in every run. A render looks at its
//! error at the end, and one with `--error`, or a bar of progress, at every doubling as well. The streams, which all
//! estimates come from, cost eight sums where one would do; that is the price of a pass added to the film beside one added
//! to plain sums.

#[allow(dead_code)]
#[path = "../tests/laws/worlds.rs"]
mod worlds;

use cpu_time::ThreadTime;
use snell::math::Rgb;
use snell::render::film::{Film, Region, Tile};
use snell::render::{World, render};
use std::hint::black_box;

/// Seconds of this thread.
fn seconds() -> f64 {
    ThreadTime::now().as_duration().as_secs_f64()
}

/// The least seconds of `work` in a few tries.
fn timed(mut work: impl FnMut()) -> f64 {
    let once = |_| {
        let start = seconds();
        work();
        seconds() - start
    };
    (0..5).map(once).fold(f64::INFINITY, f64::min)
}

fn main() {
    let numbers: Vec<u32> = std::env::args().filter_map(|word| word.parse().ok()).collect();
    let (side, passes) = match numbers[..] {
        [side, passes, ..] => (side, passes),
        _ => (128, 64),
    };
    // The thread that asks is the one that works, so that its clock sees all.
    let pool = rayon_of_one();
    pool.install(|| measure(side, passes));
}

fn rayon_of_one() -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can be started")
}

fn measure(side: u32, passes: u32) {
    let world = World::new(worlds::cornell(side, false));
    let start = seconds();
    let film = render(&world, &worlds::path_tracing(passes, 32), &()).film;
    let whole = seconds() - start;
    let share = |seconds: f64| 100.0 * seconds / whole;
    println!("Cornell, {side} × {side} pixels, {passes} passes: {whole:.2} s");

    let error = timed(|| _ = black_box(film.error()));
    println!("error of the picture: {:.2} ms, {:.2} % of the render", 1e3 * error, share(error));
    let looks = f64::from(passes.max(16).ilog2() - 3);
    println!("  looked at from 16 passes on at doublings: {:.2} %", share(looks * error));
    let margin = timed(|| _ = black_box(film.margin()));
    println!("intervals of pixels: {:.2} ms, {:.2} %", 1e3 * margin, share(margin));

    let region = Region { x: 0, y: 0, width: side, height: side };
    let tiles = vec![Tile { region, samples: vec![Rgb::WHITE; region.area()] }];
    let mut streams = Film::new(region);
    let mut plain = vec![[0.0_f64; 3]; region.area()];
    let into_streams = timed(|| (0..passes).for_each(|_| streams.add_pass(black_box(&tiles))));
    let into_sums = timed(|| {
        for _ in 0..passes {
            for (sum, sample) in plain.iter_mut().zip(&black_box(&tiles)[0].samples) {
                if sample.is_finite() {
                    *sum = [0, 1, 2].map(|c| sum[c] + f64::from(sample[c]));
                }
            }
        }
    });
    black_box(&plain);
    let more = into_streams - into_sums;
    println!("sums in streams: {:.2} ms more than plain ones, {:.2} %", 1e3 * more, share(more));
    println!("all together: {:.2} %", share(looks * error + margin + more));
}
