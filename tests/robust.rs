//! Whatever is fed to the compiler ends in a report: no panic, no hang, and every label inside its file.

use snell::diag::Problems;
use snell::source::{Memory, SourceMap};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Small scenes that together use most of the language.
const SEEDS: [&str; 5] = [
    "snell 1\nparam n: int = 3 in 1..=9\nfor i in 0..n { sphere { center: (i * 1m, 0m, 0m), radius: 4cm } }\n",
    "snell 1\ninclude \"room.snell\"\nimport \"lib.snell\" as lib\nplace sphere { radius: 1m, material: lib.gold } at (1, 2, 3)\n",
    "snell 1\ncamera front { position: (0m, 1m, 4m), look_at: (0m, 0m, 0m)\n lens: thin { focal_length: 50mm, aperture: f/2.8, focus: 3m }\n film: { size: 64 x 48, filter: tent(1px), exposure: auto } }\nrender { method: pt, stop: passes(4) or time(5min) }\n",
    "snell 1\nlet c = if 1 < 2 { rgb(0.1, 0.2, 0.3) } else { #ff8800 }\nlet xs = [i * 2cm for i in 0..4 if i > 1]\nrevolve { profile: bezier [(0, 0), (1, 0), (2, 1), (0, 3)], material: glass { ior: 1.5, absorption: c per 10cm }, transform: scale(2) then rotate_y(30deg) then translate(0m, xs[0], 0m) }\n",
    "snell 1\nunits { length: cm }\nfn ring(n: int, r: length = 5) -> object { group { for i in 0..n { sphere { center: (r, i, 0), radius: 1 } } } }\nplace ring(4, r: 7mm) // a comment\nlight sphere { center: (0, 9, 0), radius: 1, power: 40W, color: 3200K } /* and another */\nenvironment { radiance: white, scale: 0.1 }\n",
];

/// Pieces that mutations insert: what the grammar is made of.
const PIECES: [&str; 40] = [
    "{", "}", "(", ")", "[", "]", ",", ":", ";", "=", "..", "..=", "\"", "#", "f/", "-", "+", "*", "/", "^",
    "%", "then", "per", "on", "not", "let x =", "fn f(", "for i in", "if", "else", "param", "import",
    "include", "1e999", "9cm", "\u{e9}", "\0", "//", "/*", "data [",
];

#[test]
fn a_hundred_thousand_mutated_scenes_end_in_a_report() {
    let files = Memory::default()
        .with("room.snell", "snell 1\nplane { y: 0m }\n")
        .with("lib.snell", "snell 1\nlet gold = metal { kind: gold }\n");
    let halves = [0..50_000_u64, 50_000..100_000];
    std::thread::scope(|scope| {
        for seeds in halves {
            let files = &files;
            scope.spawn(move || seeds.for_each(|seed| compiles_or_reports(&mutated(seed), files)));
        }
    });
}

/// A hard case of `hard_cases/h_film.rs`.
pub fn hostile_texts_end_in_a_report_soon() {
    let files = Memory::default();
    let hostile = [
        String::new(),
        "\u{feff}snell 1\r\n".to_owned(),
        format!("snell 1\nlet a = {}1{}", "(".repeat(100_000), ")".repeat(100_000)),
        format!("snell 1\n{}", "group {".repeat(100_000)),
        format!("snell 1\nlet a = {}", "1 + ".repeat(300_000)),
        format!("snell 1\nlet a = [{}]", "1,".repeat(300_000)),
        format!("snell 1 {}", "x".repeat(5_000_000)),
        "\u{0}".repeat(1_000_000),
        "}".repeat(100_000),
        "snell 1\nfor i in 0..1000000000000 { sphere { radius: 1m } }".to_owned(),
        "snell 1\nfn f(n: int) -> int { f(n) }\nlet a = f(1)".to_owned(),
        "snell 1\nlet a = b\nlet b = a\nsphere { radius: a }".to_owned(),
        "snell 1\ninclude \"main.snell\"".to_owned(),
    ];
    for text in hostile {
        let start = Instant::now();
        compiles_or_reports(&text, &files);
        let shown: String = text.chars().take(40).collect();
        // Not a speed to reach: ten times what a slow machine needs, far below what would feel like a hang.
        assert!(start.elapsed() < Duration::from_secs(60), "{shown:?} takes {:?}", start.elapsed());
    }
}

/// Compiles a text; panics if a label points outside its file.
fn compiles_or_reports(text: &str, files: &Memory) {
    let mut sources = SourceMap::default();
    let main = sources.add("main.snell".into(), PathBuf::from("main.snell"), text.into()).unwrap();
    let mut problems = Problems::default();
    let scene = snell::compile(&mut sources, files, main, &[], &mut problems);
    assert!(
        scene.is_some() || problems.has_errors(),
        "nothing came out, and nothing is said to be wrong: {text:?}"
    );
    for problem in problems.list() {
        for label in problem.error.labels().into_iter().flatten() {
            let file = sources.find(label.offset() as u32).map(|id| sources.file(id).span());
            let inside = file.is_some_and(|span| label.offset() + label.len() <= span.end as usize);
            assert!(inside, "{} points outside its file: {text:?}", problem.code());
        }
    }
}

/// One of the seeds with one to eight mutations.
fn mutated(seed: u64) -> String {
    let mut random = Random(seed);
    let mut text = SEEDS[random.below(SEEDS.len())].to_owned();
    for _ in 0..=random.below(8) {
        let at = char_boundary(&text, random.below(text.len() + 1));
        let end = char_boundary(&text, (at + 1 + random.below(12)).min(text.len()));
        match random.below(5) {
            0 => drop(text.drain(at..end)),
            1 => text.insert_str(at, PIECES[random.below(PIECES.len())]),
            2 => {
                let copy = text[at..end].to_owned();
                let to = char_boundary(&text, random.below(text.len() + 1));
                text.insert_str(to, &copy);
            }
            3 => text.replace_range(at..end, PIECES[random.below(PIECES.len())]),
            _ => text.truncate(char_boundary(&text, at.max(8))),
        }
    }
    text
}

fn char_boundary(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % limit as u64) as usize
    }
}
