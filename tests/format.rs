//! Formatting changes no tree, loses no comment, and done twice is done once.

use crate::robust_syntax::{SplitMix, mangle, texts};
use snell::diag::Problems;
use snell::format::format;
use snell::source::{FileId, SourceMap};
use snell::syntax::{self, ast::Program};

/// How many mangled texts are formatted; most of them have mistakes, and are left alone.
const RUNS: usize = 20_000;

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

/// Asserts what formatting promises; `false` when the text has mistakes.
fn check(text: &str) -> bool {
    let (Some(once), tree) = canonical_and_tree(text) else { return false };
    let (twice, tree_of_canonical) = canonical_and_tree(&once);
    assert_eq!(twice.as_deref(), Some(once.as_str()), "{text:?} formatted twice");
    assert_eq!(tree, tree_of_canonical, "{text:?} formatted as {once:?}");
    let letters =
        |text: &str| text.chars().filter(|c| !c.is_whitespace() && *c != '\u{FEFF}').collect::<String>();
    assert_eq!(letters(text), letters(&once), "something was lost");
    true
}

#[test]
fn scenes_keep_their_trees_and_comments() {
    let sound = texts().iter().filter(|text| check(text)).count();
    assert!(sound >= 5, "only {sound} texts are without mistakes");
}

#[test]
fn mangled_scenes_keep_their_trees_and_comments() {
    let (texts, mut random) = (texts(), SplitMix(2));
    let sound = (0..RUNS).filter(|_| check(&mangle(&texts, &mut random))).count();
    assert!(sound >= RUNS / 1000, "only {sound} texts are without mistakes");
}
