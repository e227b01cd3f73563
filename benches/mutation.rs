//! How well mistakes are told: `cargo bench --bench mutation` writes `docs/mutation.md`.
//!
//! With a number, as in `cargo bench --bench mutation -- 17`, it shows that mutant and what is said of it.

#[allow(dead_code)]
#[path = "../tests/mutation/mod.rs"]
mod mutation;

/// How many scenes are made wrong.
const MUTANTS: usize = 6000;

fn main() {
    if let Some(number) = std::env::args().find_map(|word| word.parse().ok()) {
        return println!("{}", mutation::show(number));
    }
    let table = mutation::run(MUTANTS);
    println!("{}\n{}", table.markdown(), table.summary());
    std::fs::write("docs/mutation.md", page(&table)).expect("the page can be written");
    table.assert_good();
}

/// The page of the scores.
fn page(table: &mutation::Table) -> String {
    format!(
        "# How well mistakes are told\n\n\
         `cargo bench --bench mutation` takes every scene of this repository that compiles, and those in\n\
         `tests/mutation/scenes`, puts 1 to 8 faults into each copy, and looks at what the compiler says. The seed is {},\n\
         so the same faults come every time; `cargo bench --bench mutation -- 17` shows mutant 17 and its report.\n\n\
         {}\n\n{}\n{DEFINITIONS}\n{}\n{LIMITS}",
        mutation::SEED,
        table.summary(),
        table.markdown(),
        table.missed(),
    )
}

const DEFINITIONS: &str = "\
## What is counted

A typo swaps two letters, drops one, doubles one or hits a key beside, and never makes another word that the language
or the scene knows. Signs are dropped or doubled where that is a mistake: no comma at the end of a line, no bracket in a
comment. Faults of one scene are apart: on other lines, and a broken brace has its item to itself. What a word is for
comes from the syntax tree of the sound scene; nothing asks the compiler which report would be right.

- *reported*: some label of some report touches the fault, or what it breaks: the brackets' contents, the item of a
  misspelt keyword. Promised: 95 %.
- *in its place*: the first label of such a report touches the misspelt word, the wrong value, or, for a sign, the tokens
  on both sides of the gap. Promised: 90 %.
- *cured*: the first thing that the help of such a report proposes is what was there; of a doubled sign it says to take
  one away. Kinds that nothing restores, such as a wrong type, have no such score. Promised: 85 %.
- *echoes*: reports beyond the first that touch what the fault breaks.
- *belong to no fault*: reports, warnings too, of which no label touches any fault; what the sound scene is told anyway
  does not count. Promised: at most 0.1 a fault.
- *accepted*: mutants that would be rendered. There shall be none.

## What is still missed
";

const LIMITS: &str = "\
Three causes stand behind most of these. A parenthesis that is lost inside a sum could stand in several places, and only
the types tell which. A fault inside a block that another fault hides, such as a mesh whose file is missing in an object
whose transform is broken, comes to light once the other is mended. Branches of an `if` that are not taken are read but
not evaluated; the corpus puts only faults of syntax there.
";
