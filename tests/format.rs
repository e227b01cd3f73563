//! Formatting changes no tree, loses no comment, and done twice is done once.

use crate::generate;
use crate::robust_syntax::{SplitMix, mangle, texts};
use snell::diag::Problems;
use snell::format::format;
use snell::source::{FileId, Memory, SourceMap};
use snell::syntax::{self, ast::Program};
use std::ops::Range;

/// How many mangled texts are formatted; most of them have mistakes, and are left alone.
const RUNS: usize = 20_000;
/// How many generated scenes are formatted in every run of the tests, and in the long one.
const SCENES: u64 = 400;
const MANY_SCENES: u64 = 100_000;
/// One generated scene in so many is compiled before and after: slow, and the tree tells nearly all.
const COMPILED: u64 = 8;

fn source(text: &str) -> (SourceMap, FileId) {
    let mut sources = SourceMap::default();
    let id =
        sources.add("main.snell".to_owned(), "main.snell".into(), text.into()).expect("the text is small");
    (sources, id)
}

/// The canonical form of a text without mistakes, and the tree of a text.
fn canonical_and_tree(text: &str) -> (Option<String>, String) {
    let (sources, id) = source(text);
    let file = syntax::parse_file(&sources, id, &mut Problems::default());
    let canonical = format(&sources, id, &mut Problems::default());
    (canonical, syntax::dump::dump(&Program { files: vec![file], lacks_files: false }))
}

/// Asserts what formatting promises; the canonical form, `None` when the text has mistakes.
fn check(text: &str) -> Option<String> {
    let (once, tree) = canonical_and_tree(text);
    let once = once?;
    let (twice, tree_of_canonical) = canonical_and_tree(&once);
    assert_eq!(twice.as_deref(), Some(once.as_str()), "{text:?} formatted twice");
    assert_eq!(tree, tree_of_canonical, "{text:?} formatted as {once:?}");
    let letters =
        |text: &str| text.chars().filter(|c| !c.is_whitespace() && *c != '\u{FEFF}').collect::<String>();
    assert_eq!(letters(text), letters(&once), "something was lost");
    Some(once)
}

/// What a scene means, and what is said about it, without the places.
fn meaning(text: &str) -> (Vec<String>, Option<String>) {
    let files = generate::FILES.iter().fold(Memory::default(), |files, (name, text)| files.with(name, *text));
    let (mut sources, main) = source(text);
    let mut problems = Problems::default();
    let checked = snell::compile(&mut sources, &files, main, &[], &mut problems);
    let said = problems.list().iter().map(|problem| problem.code()).collect();
    (said, checked.map(|checked| snell::ir::dump::dump(&checked)))
}

/// The first mistake of form of a text.
fn first_mistake(text: &str) -> String {
    let (sources, id) = source(text);
    let mut problems = Problems::default();
    syntax::parse_file(&sources, id, &mut problems);
    problems.into_report(&sources).render_short().lines().next().unwrap_or_default().to_owned()
}

/// Asserts over generated scenes what formatting promises, and that none of them has a mistake of form.
fn check_generated(numbers: Range<u64>) {
    let (mut compiled, mut unsound) = (0, Vec::new());
    for number in numbers.clone() {
        let text = generate::scene(number);
        let Some(canonical) = check(&text) else {
            unsound.push(format!("scene {number}: {}", first_mistake(&text)));
            continue;
        };
        if number % COMPILED == 0 {
            let (before, after) = (meaning(&text), meaning(&canonical));
            assert_eq!(before, after, "scene {number}\n{text}");
            compiled += u64::from(before.1.is_some());
        }
    }
    assert!(unsound.is_empty(), "{} scenes are not well formed:\n{}", unsound.len(), unsound.join("\n"));
    assert!(compiled * COMPILED * 4 > numbers.end - numbers.start, "only {compiled} scenes mean something");
}

#[test]
fn scenes_keep_their_trees_and_comments() {
    let sound = texts().iter().filter(|text| check(text).is_some()).count();
    assert!(sound >= 5, "only {sound} texts are without mistakes");
}

#[test]
fn mangled_scenes_keep_their_trees_and_comments() {
    let (texts, mut random) = (texts(), SplitMix(2));
    let sound = (0..RUNS).filter(|_| check(&mangle(&texts, &mut random)).is_some()).count();
    assert!(sound >= RUNS / 1000, "only {sound} texts are without mistakes");
}

#[test]
fn generated_scenes_keep_their_trees_and_comments() {
    check_generated(0..SCENES);
}

#[test]
#[ignore = "minutes; run it after a change to the formatter or the grammar"]
fn a_great_many_generated_scenes_keep_their_trees_and_comments() {
    check_generated(0..MANY_SCENES);
}
