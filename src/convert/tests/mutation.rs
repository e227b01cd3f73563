//! Texts nobody would write.

use super::*;

/// A sequence of numbers that is the same on every machine (Steele, Lea and Flood 2014, splitmix64).
struct Splitmix(u64);

impl Splitmix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit.max(1) as u64) as usize
    }
}

/// Pieces that hurt: braces where none belong, numbers at the edge of what a number can be, other dialects' words.
const SHARDS: &[&str] = &[
    "{",
    "}",
    "[",
    "]",
    "{}",
    "//",
    "#",
    "\n",
    "\r\n",
    "\0",
    "\u{e9}",
    "\u{1F4A1}",
    "\"",
    "\\",
    "1e308",
    "1e999",
    "-0",
    "1e-320",
    ".",
    "-",
    "+5",
    "99999999999999999999",
    "nan",
    "0",
    "-1",
    "Group {",
    "Transform {",
    "RevSurface { profile BezierCurve { controls [ 1 1 0 ]",
    "Material {",
    "Sphere {",
    "MaterialIndex",
    "MaterialIndex 2",
    "obj_file",
    "texture a.ppm x-axis",
    "type",
    "type DIFF",
    "type 0 0 0",
    "Color",
    "reflection 2",
    "emissionColor 12 12 12",
    "shininess 1e9",
    "Scale 0 0 0",
    "Matrix {",
    "Y_inverse",
    "focalLength 3 aperture 1",
    "numObjects 3",
];

/// A text with some of its words removed, doubled, swapped or replaced.
fn mutated(words: &[&str], random: &mut Splitmix) -> String {
    let mut words: Vec<&str> = words.to_vec();
    for _ in 0..1 + random.below(6) {
        let at = random.below(words.len());
        let shard = SHARDS[random.below(SHARDS.len())];
        match random.below(6) {
            0 if words.len() > 1 => {
                words.remove(at);
            }
            1 => words.insert(at, shard),
            2 => words[at] = shard,
            3 => {
                let other = random.below(words.len());
                words.swap(at, other);
            }
            4 => words.truncate(at + 1),
            _ => words.insert(at, words[random.below(words.len())]),
        }
    }
    let glue = if random.below(8) == 0 { "" } else { " " };
    words.join(glue)
}

/// Every dialect's constructs, mangled a hundred thousand times (a fifth of that in debug builds): each text ends in a scene or a report, every word of it
/// is accounted for, and what is written holds no number that cannot be read.
#[test]
fn mangled_scenes_end_in_a_report() {
    let seeds: Vec<String> = scenes_below(&project("tests/convert"))
        .iter()
        .map(|path| std::fs::read_to_string(path).expect("a scene"))
        .collect();
    let texts: Vec<Vec<&str>> = seeds.iter().map(|text| text.split_whitespace().collect()).collect();
    let mut random = Splitmix(6837);
    for round in 0..if cfg!(debug_assertions) { 20_000 } else { 100_000 } {
        let whole = &texts[random.below(texts.len())];
        let start = random.below(whole.len());
        let piece = if round % 10 == 0 { &whole[..] } else { &whole[start..(start + 60).min(whole.len())] };
        let text = mutated(piece, &mut random);
        let conversion = convert(&text, "mangled", &Options::default(), Some(&Shelf));
        if conversion.problems.iter().any(|problem| matches!(problem.mistake, Mistake::TooDeep { .. })) {
            continue;
        }
        assert_accounted(&text, &conversion, &text);
        for Converted { snell, .. } in conversion.scenes {
            assert!(
                !snell.contains("NaN") && !snell.contains("inf,") && !snell.contains("inf)"),
                "{text}\n{snell}"
            );
            assert_compiles(&snell, &text);
        }
    }
}
