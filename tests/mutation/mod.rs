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

use mutant::Mutant;
use random::Random;
pub use table::Table;

/// Which faults there are.
pub const SEED: u64 = 1621;

/// How many faults a scene gets at most.
pub const MOST_FAULTS: usize = 8;

/// Makes `count` mutants with 1 to `most` faults, has them compiled, and counts what comes of their faults.
pub fn run(count: usize, most: usize) -> Table {
    let scenes = corpus::scenes();
    let mut table = Table::new(&scenes);
    for number in 0..count {
        // A seed of its own for each: any of them can be looked at alone.
        let mut random = Random(SEED + ((number as u64) << 32));
        let mutant = Mutant::new(&scenes, most, &mut random);
        let texts = mutant.texts();
        let said = mutant.scene.say(&texts);
        let judgement = judge::judge(&mutant, &said);
        table.add(number, &mutant, &said, &judgement);
    }
    table
}

#[test]
fn most_mistakes_are_told_where_they_are_with_their_cure() {
    let table = run(400, MOST_FAULTS);
    table.assert_good();
}
