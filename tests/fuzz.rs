//! The texts that fuzzing starts from and the texts that it once found: what must hold of every text holds of them.
//!
//! `fuzz/README.md` says how to look for more.

#[path = "../fuzz/src/lib.rs"]
mod laws;

use snell::schema;
use std::collections::BTreeSet;
use std::path::PathBuf;

/// A law that holds of every text.
type Law = fn(&str);

const LAWS: [(&str, Law); 4] =
    [("parse", laws::parse), ("compile", laws::compile), ("fmt", laws::fmt), ("convert", laws::convert)];

fn files(folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut files: Vec<PathBuf> =
        entries.map(|entry| entry.expect("a folder can be listed").path()).collect();
    files.sort();
    files
}

#[test]
fn what_must_hold_of_every_text_holds_of_those_at_hand() {
    for (name, law) in LAWS {
        let (corpus, found) = (files(&format!("fuzz/corpus/{name}")), files(&format!("fuzz/found/{name}")));
        assert!(!corpus.is_empty(), "nothing to start `{name}` from");
        for path in corpus.iter().chain(&found) {
            let bytes = std::fs::read(path).expect("a text of a test can be read");
            // The fuzzer takes texts only, too.
            if let Ok(text) = std::str::from_utf8(&bytes) {
                println!("{name} {}", path.display());
                law(text);
            }
        }
    }
}

/// The traps among mesh files are where the fuzzer of meshes starts from.
#[test]
fn what_must_hold_of_every_mesh_holds_of_those_at_hand() {
    let folders = ["tests/assets/obj", "tests/assets/gltf", "fuzz/found/mesh"];
    for path in folders.iter().flat_map(|folder| files(folder)) {
        println!("mesh {}", path.display());
        laws::mesh(&std::fs::read(&path).expect("a file of a test can be read"));
    }
}

/// What the grammar is made of beside its words.
const SIGNS: [&str; 30] = [
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    ",",
    ":",
    "=",
    "->",
    "..",
    "..=",
    "+",
    "-",
    "*",
    "/",
    "%",
    "^",
    "//",
    "/*",
    "*/",
    "///",
    "#ff8800",
    "f/2.8",
    "1024 x 768",
    "5cm",
    "1e30",
    "then",
    "per",
    "snell 1\n",
];

/// The words that the fuzzer tries: every keyword, block and field. `UPDATE=1` writes them anew.
#[test]
fn the_fuzzer_knows_every_word_of_the_language() {
    let grammar = std::fs::read_to_string("grammar/snell.pest").expect("the grammar is there");
    let keywords =
        grammar.lines().filter(|line| line.starts_with("kw_")).filter_map(|line| line.split('"').nth(1));
    let mut words: BTreeSet<String> = keywords.chain(SIGNS).map(str::to_owned).collect();
    for block in schema::blocks() {
        words.insert(format!("{} {{", block.kind));
        words.extend(block.fields().map(|field| format!("{}: {}", field.name, field.example())));
    }
    let quoted = |word: &String| word.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\x0A");
    let said: String = words.iter().map(|word| format!("\"{}\"\n", quoted(word))).collect();
    let path = "fuzz/snell.dict";
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(path, &said).expect("the words can be written");
    }
    let written = std::fs::read_to_string(path).unwrap_or_default();
    assert!(written == said, "{path} lacks a word, or has one too many: run once with UPDATE=1");
}
