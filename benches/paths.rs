//! How many camera paths a second: the room of Cornell, matt and with glass and mirror.
//!
//! `cargo bench --bench paths [-- SIDE PASSES]`; run it with `RAYON_NUM_THREADS=1` to compare machines.

#[allow(dead_code)]
#[path = "../tests/laws/worlds.rs"]
mod worlds;

use snell::render::{World, render};

fn main() {
    let numbers: Vec<u32> = std::env::args().filter_map(|word| word.parse().ok()).collect();
    let (side, passes) = match numbers[..] {
        [side, passes, ..] => (side, passes),
        _ => (256, 16),
    };
    for (name, specular) in [("matt", false), ("glass and mirror", true)] {
        let world = World::new(worlds::cornell(side, specular));
        let outcome = render(&world, &worlds::path_tracing(passes, 32), &());
        let stats = outcome.stats;
        let per_second = |count: u64| count as f64 / stats.seconds / 1e6;
        println!(
            "{name}: {:.3} M samples/s, {:.3} M rays/s, {:.1} rays a sample, error {:.4}",
            per_second(stats.samples),
            per_second(stats.counters.rays),
            stats.counters.rays as f64 / stats.samples as f64,
            outcome.error.map_or(f64::NAN, |estimate| estimate.error),
        );
    }
}
