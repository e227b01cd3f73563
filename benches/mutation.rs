//! How well mistakes are told: `cargo bench --bench mutation [-- MUTANTS]` writes `docs/mutation.md`.

#[allow(dead_code)]
#[path = "../tests/mutation/mod.rs"]
mod mutation;

fn main() {
    let count = std::env::args().find_map(|word| word.parse().ok()).unwrap_or(6000);
    let table = mutation::run(count, std::env::var("MOST").ok().map_or(mutation::MOST_FAULTS, |m| m.parse().unwrap()));
    println!("{}\n{}", table.markdown(), table.summary());
    if std::env::var_os("MISSES").is_some() {
        for (kind, what, text) in &table.misses {
            println!("{kind:?}\t{what}\t{text}");
        }
    }
}
