//! Mistakes put into well-formed scenes, and how well the compiler tells of them.
//!
//! The corpus is every scene of the repository that compiles, and a few more in `scenes/` beside this file. Each
//! mutant is one of them with 1 to 8 faults of 18 kinds, drawn from one seed. `cargo bench --bench mutation` runs all
//! of it and writes `docs/mutation.md`; the test below runs a few hundred.

mod corpus;
mod faults;
mod judge;
mod mutant;
mod random;
mod roles;
mod table;
mod tokens;
mod typo;

use corpus::Scene;
use mutant::Mutant;
use random::Random;
pub use table::Table;

/// Which faults there are.
pub const SEED: u64 = 1621;
/// How many faults a scene gets at most.
const MOST_FAULTS: usize = 8;

/// Makes `count` mutants, has them compiled, and counts what comes of their faults.
pub fn run(count: usize) -> Table {
    let scenes = corpus::scenes();
    let mut table = Table::new(&scenes);
    for number in 0..count {
        let mutant = mutant(&scenes, number);
        let said = mutant.scene.say(&mutant.texts());
        let judgement = judge::judge(&mutant, &said);
        table.add(number, &mutant, &said, &judgement);
    }
    table
}

/// The mutant of this number; each has a seed of its own, so that any of them can be looked at alone.
fn mutant(scenes: &[Scene], number: usize) -> Mutant<'_> {
    Mutant::new(scenes, MOST_FAULTS, &mut Random(SEED + ((number as u64) << 32)))
}

/// The faults of one mutant, and the report that it gets.
pub fn show(number: usize) -> String {
    let scenes = corpus::scenes();
    let mutant = mutant(&scenes, number);
    let faults: Vec<String> = mutant.faults.iter().map(|fault| mutant.describe(fault)).collect();
    format!("{}\n\n{}", faults.join("\n"), mutant.scene.report(&mutant.texts()))
}

#[test]
fn most_mistakes_are_told_where_they_are_with_their_cure() {
    run(400).assert_good();
}

#[test]
fn a_number_stands_for_the_same_mutant_every_time() {
    assert_eq!(show(17), show(17));
    assert_ne!(show(17), show(18));
}
