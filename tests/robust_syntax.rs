//! Mangled scenes end in a report, never in a panic, and every label of it lies inside its file.

use snell::diag::{Problems, Style};
use snell::source::{Memory, SourceMap, Span};
use snell::syntax;
use std::path::Path;

/// How many mangled texts are read.
const RUNS: usize = 100_000;
/// The longest text in bytes, so that all of them take seconds.
const MAX_LEN: usize = 240;
/// One text in so many is also rendered.
const RENDERED: usize = 64;

/// Pieces that mean something to the grammar.
const PIECES: [&str; 60] = [
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    "\"",
    "'",
    ",",
    ";",
    ":",
    "=",
    "->",
    "=>",
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
    "#",
    "#ff0",
    "f/2.8",
    "1024 x 768",
    "5cm",
    "1e",
    "0.",
    "let ",
    "for i in ",
    "if ",
    " else ",
    "place ",
    "fn g(a: int) -> ",
    "param n: int = ",
    "allow(",
    "snell 1\n",
    "include \"a.snell\"\n",
    "import \"a.snell\" as a\n",
    "data [",
    " then ",
    " per ",
    "not ",
    "on ",
    " as ",
    " at ",
    "sphere { radius: 1m }",
    "\n",
    "\r\n",
    "\t",
    "é",
    "“",
    "\u{FEFF}",
    "\0",
    "@",
];

/// The splitmix64 generator (Steele, Lea & Flood 2014).
pub(crate) struct SplitMix(pub(crate) u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A number below `limit`, which is not 0.
    pub(crate) fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit as u64) as usize
    }

    /// One of several.
    pub(crate) fn one<'a, T>(&mut self, choices: &'a [T]) -> &'a T {
        &choices[self.below(choices.len())]
    }
}

/// A part of a text, changed in a few places.
pub(crate) fn mangle(texts: &[String], random: &mut SplitMix) -> String {
    let mut text: Vec<char> = texts[random.below(texts.len())].chars().collect();
    let start = random.below(text.len());
    text.drain(..if random.below(2) == 0 { 0 } else { start });
    text.truncate(MAX_LEN / 2 + random.below(MAX_LEN / 2));
    for _ in 0..1 + random.below(6) {
        let at = random.below(text.len() + 1);
        let end = text.len().min(at + random.below(12));
        let piece: Vec<char> = random.one(&PIECES).chars().collect();
        match random.below(3) {
            0 => drop(text.drain(at..end)),
            1 => drop(text.splice(at..at, piece)),
            _ => drop(text.splice(at..end, piece)),
        }
    }
    text.into_iter().collect()
}

pub(crate) fn texts() -> Vec<String> {
    let folders = ["tests/syntax", "tests/diagnostics/syntax"];
    let entries = folders.iter().flat_map(|folder| std::fs::read_dir(folder).expect("the folder is there"));
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("a folder can be listed").path()).collect();
    paths.sort();
    let scenes = paths.iter().filter(|path| path.extension().is_some_and(|extension| extension == "snell"));
    scenes.map(|path| std::fs::read_to_string(path).expect("scenes are texts")).collect()
}

/// Reads a text and asserts that its report can be shown.
fn check(text: &str, is_rendered: bool) {
    let files = Memory::default().with("a.snell", "snell 1\nlet b = 3 *\n");
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let main =
        sources.add("main.snell".to_owned(), "main.snell".into(), text.into()).expect("the text is small");
    syntax::parse(&mut sources, &files, main, &mut problems);
    for label in problems.list().iter().flat_map(|problem| problem.error.labels().into_iter().flatten()) {
        let span = Span::new(label.offset() as u32, (label.offset() + label.len()) as u32);
        let file = sources.find(span.start).map(|id| sources.file(id).span());
        assert!(file.is_some_and(|file| span.end <= file.end), "{label:?} leaves its file in {text:?}");
        assert!(
            span.is_empty() || !sources.text(span).is_empty(),
            "{label:?} splits a character in {text:?}"
        );
    }
    if is_rendered {
        let report = problems.into_report(&sources);
        let human = report.render_human(&Style::default());
        assert!(!human.contains("Failed to read"), "{human}");
        report.render_json().lines().for_each(|line| assert!(line.starts_with('{') && line.ends_with('}')));
    }
}

#[test]
fn mangled_scenes_end_in_a_report() {
    let (texts, mut random) = (texts(), SplitMix(1));
    for run in 0..RUNS {
        check(&mangle(&texts, &mut random), run % RENDERED == 0);
    }
}

#[test]
fn extreme_texts_end_in_a_report() {
    let many = 100_000;
    let repeated = [
        "(",
        "[",
        "{",
        "sphere {",
        ")",
        "}",
        "-",
        "not ",
        "a.",
        "a()",
        "/*",
        "\"\n",
        ";",
        ",",
        "'",
        "@",
        "if a {} else ",
        "while a ",
        "-- a ",
        "<1, ",
    ];
    for piece in repeated {
        check(&format!("snell 1\nlet a = {}", piece.repeat(many / 10)), true);
    }
    check(&format!("snell 1\nlet a = {}", "(".repeat(many)), true);
    check(&format!("snell 1\nlet a = 1{}", " + 1".repeat(many)), true);
    check(&format!("snell 1\nlet a = {}1{}", "(".repeat(250), ")".repeat(250)), true);
    check(&format!("snell 1\n{}{}", "group { ".repeat(250), "}".repeat(250)), true);
    // A mistake far to the right, beyond every column that can be drawn.
    check(&format!("snell 1\nlet a = [{}@, \"é\"]", "1, ".repeat(many)), true);
    check(&format!("snell 1\n{}", "é".repeat(many)), true);
    check("", true);
    check("\u{FEFF}", true);
    assert!(!Path::new("a.snell").exists(), "files come from memory");
}
