//! What it costs to be right: each remedy of `tests/hard_cases` beside the form that is mostly written, with the failures and
//! the time of both, as a page.
//!
//! ```text
//! cargo bench --bench hard_cases --features naive > docs/hard-cases.md
//! ```
//!
//! Nanoseconds are those of the thread alone, the least of five runs that take turns. Both forms get the same input.

#[allow(dead_code, unused_imports)]
#[path = "../../tests/support/mod.rs"]
mod support;

mod precision;
mod remedies;
mod scenes;
mod whole;

use cpu_time::ThreadTime;
use std::hint::black_box;

/// One way to do a thing.
struct Form {
    /// What it is called.
    name: &'static str,
    /// How it fails, in words with numbers.
    failures: String,
    /// Nanoseconds a call.
    nanoseconds: f64,
}

/// A remedy beside what it replaces.
struct Remedy {
    /// The hard case.
    case: &'static str,
    /// What one call is.
    call: &'static str,
    naive: Form,
    robust: Form,
}

/// Times both forms over `count` calls each, in turns.
fn time_both(
    count: usize,
    mut naive: impl FnMut(usize) -> f64,
    mut robust: impl FnMut(usize) -> f64,
) -> [f64; 2] {
    let mut best = [f64::INFINITY; 2];
    for _ in 0..5 {
        best[0] = best[0].min(nanoseconds(count, &mut naive));
        best[1] = best[1].min(nanoseconds(count, &mut robust));
    }
    best
}

fn nanoseconds(count: usize, call: &mut impl FnMut(usize) -> f64) -> f64 {
    let start = thread_seconds();
    let sum: f64 = (0..count).map(call).sum();
    black_box(sum);
    (thread_seconds() - start) * 1e9 / count as f64
}

/// The time that this thread has computed.
fn thread_seconds() -> f64 {
    ThreadTime::now().as_duration().as_secs_f64()
}

fn main() {
    println!("{}", include_str!("preamble.md"));
    println!("| case | one call is | form | fails | ns | price |");
    println!("|---|---|---|---|---:|---:|");
    for Remedy { case, call, naive, robust } in remedies::all() {
        println!("| {case} | {call} | {} | {} | {:.1} | |", naive.name, naive.failures, naive.nanoseconds);
        let price = (robust.nanoseconds / naive.nanoseconds - 1.0) * 100.0;
        println!(
            "| | | **{}** | {} | {:.1} | {price:+.0} % |",
            robust.name, robust.failures, robust.nanoseconds
        );
    }
    println!("\n{}", include_str!("whole.md"));
    whole::print();
    println!("\n{}", include_str!("precision.md"));
    precision::print();
    print!("\n{}", include_str!("at_length.md"));
}
