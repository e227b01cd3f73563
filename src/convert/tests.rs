//! Tests of the whole conversion: expected files, the places of mistakes, and texts nobody would write.

use super::parse::{Block, Node, Span};
use super::*;
use crate::source::{Memory, SourceMap};
use std::path::{Path, PathBuf};

/// Files that a test's scenes name: every picture has 8 x 4 pixels, and what is called `lost` is missing.
struct Shelf;

impl AssetFinder for Shelf {
    fn find(&self, path: &str) -> Search {
        match path {
            lost if lost.contains("lost") => {
                Search::Missing { tried: vec![path.into(), format!("../{path}")] }
            }
            _ => Search::Found { root: "..".into(), head: b"P6\n8 4\n255\n".to_vec() },
        }
    }
}

fn convert_plainly(text: &str) -> Conversion {
    convert(text, "scene.txt", &Options::default(), Some(&Shelf))
}

/// The codes of all problems, without their common beginning; errors have a `!`.
fn codes(conversion: &Conversion) -> Vec<String> {
    use miette::Diagnostic;
    let code = |problem: &ConvertError| {
        let code = problem.code().map(|code| code.to_string()).unwrap_or_default();
        let mark = if problem.is_error() { "!" } else { "" };
        format!("{mark}{}", code.trim_start_matches("snell::convert::"))
    };
    conversion.problems.iter().map(code).collect()
}

/// The problems as a person sees them, then the report.
fn account(conversion: &Conversion, name: &str, text: &str) -> String {
    let handler = miette::GraphicalReportHandler::new_themed(miette::GraphicalTheme::none()).with_width(80);
    let mut out = String::new();
    for problem in &conversion.problems {
        let source = miette::NamedSource::new(name, text.to_string());
        let report = miette::Report::new(problem.clone()).with_source_code(source);
        handler.render_report(&mut out, report.as_ref()).expect("writing to a string");
        out.push('\n');
    }
    out + &report::render(text, &conversion.report)
}

/// Every word and number lies in exactly one fate, and fates do not overlap. Nothing of a scene that was written is said
/// to be lost.
fn assert_accounted(text: &str, conversion: &Conversion, name: &str) {
    let fates = &conversion.report;
    let lost = fates.iter().find(|fate| fate.outcome.parts().1 == fields::READ);
    if let (Some(_), Some(fate)) = (&conversion.snell, lost) {
        panic!("{name}: nothing was made of {:?}", &text[fate.span.clone()]);
    }
    for pair in fates.windows(2) {
        let [a, b] = pair else { continue };
        let (first, second) = (&text[a.span.clone()], &text[b.span.clone()]);
        assert!(a.span.end <= b.span.start, "{name}: {first:?} and {second:?} overlap");
    }
    let tree = parse::parse(text, &mut Notebook::default());
    let mut tokens = Vec::new();
    collect_tokens(&tree, &mut tokens);
    for token in tokens {
        let at = fates.partition_point(|fate| fate.span.end <= token.start);
        let is_covered =
            fates.get(at).is_some_and(|fate| fate.span.start <= token.start && token.end <= fate.span.end);
        assert!(is_covered, "{name}: nothing is said of {:?} at {token:?}", &text[token.clone()]);
    }
}

fn collect_tokens(block: &Block<'_>, tokens: &mut Vec<Span>) {
    tokens.extend(block.name.iter().map(|name| name.span.clone()));
    for node in &block.body {
        match node {
            Node::Block(inner) => collect_tokens(inner, tokens),
            Node::List(list) => tokens.extend(list.items.iter().map(Node::span)),
            node => tokens.push(node.span()),
        }
    }
}

/// What is written is a scene: the compiler may doubt it, but finds nothing wrong.
fn assert_compiles(snell: &str, name: &str) {
    let mut sources = SourceMap::default();
    let main = sources.add("scene.snell".into(), "scene.snell".into(), snell.into()).expect("a short text");
    let mut problems = crate::diag::Problems::default();
    crate::compile(&mut sources, &Memory::default(), main, &[], &mut problems);
    let faults: Vec<String> = problems
        .list()
        .iter()
        .filter(|problem| problem.severity() == crate::diag::Severity::Error)
        .map(|problem| format!("{}: {}", problem.code(), problem.error))
        .collect();
    assert!(faults.is_empty(), "{name}\n{snell}\n{}", faults.join("\n"));
}

fn project(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// Every `.txt` file below a folder, in the order of their names.
fn scenes_below(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "txt") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// Compares with an expected file, or writes it when `UPDATE` is set.
fn assert_expected(path: &Path, actual: &str) {
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(path, actual).expect("the folder of expected files can be written");
        return;
    }
    let expected = std::fs::read_to_string(path).unwrap_or_default().replace("\r\n", "\n");
    assert_eq!(actual, expected, "{} differs; UPDATE=1 writes it", path.display());
}

#[test]
fn scenes_convert_to_what_is_expected() {
    let scenes = scenes_below(&project("tests/convert"));
    assert!(!scenes.is_empty());
    for path in scenes {
        let text = std::fs::read_to_string(&path).expect("a scene");
        let name = path.file_name().and_then(|name| name.to_str()).expect("a plain name");
        let conversion = convert(&text, name, &Options::default(), Some(&Shelf));
        assert_accounted(&text, &conversion, name);
        if let Some(snell) = &conversion.snell {
            assert_compiles(snell, name);
            assert_expected(&path.with_extension("snell"), snell);
        }
        assert_expected(&path.with_extension("report"), &account(&conversion, name, &text));
    }
}

/// Real files of many programs, where they are at hand.
#[test]
fn nothing_in_the_corpus_passes_without_a_word() {
    let scenes = scenes_below(&project("../shared/corpus"));
    if scenes.is_empty() {
        println!("skipped: no corpus beside the project");
    }
    for path in scenes {
        let text = std::fs::read_to_string(&path).expect("a scene");
        let conversion =
            convert(&text, "corpus.txt", &Options::default(), Some(&DiskFinder::new(&path, Vec::new())));
        assert_accounted(&text, &conversion, &path.display().to_string());
        if let Some(folder) = std::env::var_os("CONVERTED") {
            let stem = path.file_stem().expect("a file").to_string_lossy().into_owned();
            let name = path.file_name().expect("a file").to_string_lossy().into_owned();
            let account = account(&conversion, &name, &text);
            std::fs::write(Path::new(&folder).join(format!("{stem}.report")), account).expect("a folder");
            if let Some(snell) = conversion.snell {
                std::fs::write(Path::new(&folder).join(format!("{stem}.snell")), snell).expect("a folder");
            }
        }
    }
}

#[test]
fn numbers_end_where_numbers_end() {
    let tree = parse::parse("a 20} b 3.png 1. -.5 +2e-3 1..2 ]", &mut Notebook::default());
    let kinds: Vec<String> = tree
        .body
        .iter()
        .map(|node| match node {
            Node::Number(number) => format!("number {}", number.value),
            Node::Word(word) => format!("word {}", word.text),
            _ => "other".into(),
        })
        .collect();
    let expected = [
        "word a",
        "number 20",
        "word b",
        "word 3.png",
        "number 1",
        "number -0.5",
        "number 0.002",
        "word 1..2",
    ];
    assert_eq!(kinds, expected);
}

#[test]
fn a_number_may_touch_a_closing_brace() {
    let conversion = convert_plainly("Materials{numMaterials 1 Material{diffuseColor 1 0 0 shininess 20}}");
    assert_eq!(codes(&conversion), ["no_camera"]);
}

#[test]
fn strict_mode_refuses_what_lenient_mode_leaves_out() {
    let text = "Background { color 0 0 0 glow 3 } Mist { density 1 }";
    assert_eq!(codes(&convert_plainly(text)), ["unknown_field", "unknown_block", "no_camera"]);
    let strict = Options { strict: true, ..Options::default() };
    let conversion = convert(text, "scene.txt", &strict, None);
    assert_eq!(codes(&conversion), ["!unknown_field", "!unknown_block", "no_camera"]);
    assert_eq!(conversion.snell, None);
}

#[test]
fn a_flood_of_warnings_is_cut_off() {
    let conversion = convert_plainly(&"Mist {} ".repeat(1000));
    let codes = codes(&conversion);
    assert_eq!(codes.iter().filter(|code| *code == "unknown_block").count(), 100);
    assert!(conversion.problems.iter().any(|problem| problem.mistake == Mistake::More { count: 900 }));
}

#[test]
fn deep_nesting_ends_in_a_report() {
    for (depth, expected) in [(250, &["no_camera"][..]), (300, &["!too_deep"]), (200_000, &["!too_deep"])] {
        let text = format!("{}{}", "Group { ".repeat(depth), "} ".repeat(depth));
        let codes = codes(&convert_plainly(&text));
        let relevant: Vec<&str> = codes.iter().map(String::as_str).filter(|code| *code != "empty").collect();
        assert!(relevant.starts_with(expected), "{depth} deep: {relevant:?}");
    }
}

#[test]
fn every_dialect_is_told_by_what_sets_it_apart() {
    let thu = "PerspectiveCamera { width 4 height 4 } ";
    let material = |fields: &str| format!("{thu} Materials {{ Material {{ color 1 1 1 }} {fields} }}");
    let cases = [
        (material("Material { reflection 2 }"), Dialect::Arsenal),
        (material("Material { emissionColor 12 12 12 }"), Dialect::Arsenal),
        (format!("{thu} Group {{ TriangleMesh {{ Y_inverse }} }}"), Dialect::Arsenal),
        (material("PhongMaterial { diffuseColor 1 0 0 shininess 20}"), Dialect::Pa1),
        (thu.to_string(), Dialect::Pa1),
        (material("Material { type 1 0 0 }"), Dialect::Weights),
        (material("Material { type 0 1 0 0 refr 1.5 }"), Dialect::Weights),
        (material("Material { type SPEC }"), Dialect::Enum),
        (material("Material { type 2 refr 1.5 }"), Dialect::Enum),
        (material("Material { SPEC }"), Dialect::Flags),
        (material("Material { prop Glass }"), Dialect::Flags),
        (material("ReflectiveMaterial { }"), Dialect::Typed),
        (material("Material { diff 1.0 refl 0 refr 0 }"), Dialect::Factors),
        (material("Material { reflection 0.5 refraction_rate 1.5 }"), Dialect::Factors),
        ("Group { Material { diffuseColor 1 0 0 } }".into(), Dialect::Mit2003),
        ("OrthographicCamera { size 5 }".into(), Dialect::Mit2004),
        ("PerspectiveCamera { } Materials { Marble { } }".into(), Dialect::Mit2004),
        ("PerspectiveCamera { } Lights { PointLight { attenuation 0 0 1 } }".into(), Dialect::Mit2004),
        ("PerspectiveCamera { } Materials { Material { refractionIndex 2 } }".into(), Dialect::Mit2010),
        ("PerspectiveCamera { } Group { TriangleMesh { obj_file models/a.obj } }".into(), Dialect::Mit2016),
    ];
    for (text, expected) in cases {
        assert_eq!(convert_plainly(&text).detection.dialect, expected, "{text}");
    }
    for dialect in Dialect::ALL {
        assert_eq!(Dialect::from_id(dialect.id()), Some(dialect));
        let forced = Options { dialect: Some(dialect), ..Options::default() };
        assert_eq!(convert(thu, "scene.txt", &forced, None).detection.dialect, dialect);
    }
}

/// The value after a name in the result, up to the end of its line.
fn value_of<'t>(snell: &'t str, name: &str) -> &'t str {
    let start = snell.find(name).unwrap_or_else(|| panic!("no `{name}` in\n{snell}")) + name.len();
    snell[start..].lines().next().unwrap_or_default().trim()
}

/// All numbers in a stretch of text.
fn numbers_in(text: &str) -> Vec<f64> {
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '-' | '.');
    text.split(|c| !is_part(c)).filter_map(|number| number.parse().ok()).collect()
}

const CAMERA: &str = "PerspectiveCamera { center 0 0 9 direction 0 0 -1 up 0 1 0 angle 45 width 8 height 8 }";

#[test]
fn transforms_act_in_the_order_of_the_original() {
    let text = format!(
        "{CAMERA} Materials {{ Material {{ diffuseColor 1 1 1 }} }} Group {{ MaterialIndex 0 Transform {{ \
         Scale 8 8 8 Translate 0.5 0 0 Transform {{ ZRotate 90 Sphere {{ center 1 0 0 radius 1 }} }} }} }}"
    );
    let snell = convert_plainly(&text).snell.expect("a scene");
    let chain = value_of(&snell, "transform: ");
    assert!(chain.starts_with("rotate_z(90deg) then translate(0.5, 0, 0) then scale(8)"), "{chain}");
}

#[test]
fn matrices_multiply_from_the_left_and_lie_as_they_are_named() {
    let text = |name: &str, numbers: &str| {
        format!(
            "{CAMERA} Materials {{ Material {{ diffuseColor 1 1 1 }} }} Group {{ MaterialIndex 0 Transform {{ \
             XRotate 5 {name} {{ {numbers} }} YRotate 6 Sphere {{ center 0 0 0 radius 1 }} }} }}"
        )
    };
    let rows = convert_plainly(&text("Matrix", "1 2 3 4 5 6 7 8 9 10 11 12 0 0 0 1")).snell.expect("a scene");
    assert!(rows.contains("rotate_y(6deg)") && rows.contains("rotate_x(5deg)"));
    let order = ["rotate_y", "rotate_x", "matrix"].map(|name| rows.find(name).expect("a step"));
    assert!(order.is_sorted(), "{rows}");
    assert!(rows.contains("matrix([1, 2, 3, 4, 5"), "{rows}");
    let columns =
        convert_plainly(&text("Matrix4f", "1 5 9 0 2 6 10 0 3 7 11 0 4 8 12 1")).snell.expect("a scene");
    assert!(columns.contains("matrix([1, 2, 3, 4, 5"), "{columns}");
}

/// A picture on a plane: the converted projection must name the pixel that the original names.
#[test]
fn a_picture_lies_where_the_original_puts_it() {
    let (x, y, xo, yo) = ([2.0, 0.0, 1.0], [0.5, 3.0, 0.0], -6.0, 2.5);
    let text = format!(
        "{CAMERA} Materials {{ Material {{ color 1 1 1 }} }} Group {{ MaterialIndex 0 Plane {{ normal 0 0 1 offset -3 \
         texture wall.ppm x-axis 2 0 1 y-axis 0.5 3 0 x-offset {xo} y-offset {yo} }} }}"
    );
    let snell = convert_plainly(&text).snell.expect("a scene");
    let start = snell.find("planar {").expect("a projection");
    let frame = numbers_in(snell[start..].split('}').next().unwrap_or_default());
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (origin, u, v) = (&frame[0..3], &frame[3..6], &frame[6..9]);
    for p in [[0.0, 0.0, -3.0], [1.5, -2.0, -3.0], [-4.0, 7.0, 0.25]] {
        let from_origin = [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]];
        let pixel = |axis: &[f64], side: f64| side * dot(&from_origin, axis) / dot(axis, axis);
        assert!((pixel(u, 8.0) - (dot(&x, &p) - xo)).abs() < 1e-5, "{snell}");
        assert!((pixel(v, 4.0) - (dot(&y, &p) - yo)).abs() < 1e-5, "{snell}");
    }
}

/// With the basis of 2020, a point at the picture's upper edge has `s tan(angle / 2)` for the tangent of its height.
#[test]
fn a_leaning_up_changes_the_angle_in_the_dialect_of_arsenal_only() {
    let camera = "PerspectiveCamera { center 0 0 0 direction 0 -3 -4 up 0 1 0 angle 60 width 8 height 8 }";
    let fov = |basis| {
        let options = Options { basis, ..Options::default() };
        let snell = convert(camera, "scene.txt", &options, None).snell.expect("a scene");
        numbers_in(value_of(&snell, "fov: "))[0]
    };
    assert_eq!(fov(None), 60.0);
    assert_eq!(fov(Some(Basis::Orthonormal)), 60.0);
    let tangent = crate::math::float::tan64((fov(Some(Basis::Raw)) / 2.0).to_radians());
    let expected = 0.8 / 3.0_f64.sqrt(); // s = |(0, -0.6, -0.8) x (0, 1, 0)| = 0.8
    assert!((tangent - expected).abs() < 1e-6, "{tangent} instead of {expected}");
}

/// The course shows `c diffuse cos` and a highlight of `c specular`; a converted surface must shine as brightly.
#[test]
fn the_course_s_brightness_is_kept_at_the_middle_of_the_scene() {
    let text = format!(
        "{CAMERA} Lights {{ PointLight {{ position 0 0 5 color 0.5 0.5 0.5 }} }} Materials {{ Material {{ \
         diffuseColor 0.3 0.3 0.3 specularColor 0.8 0.8 0.8 shininess 14 }} }} \
         Group {{ MaterialIndex 0 Sphere {{ center 0 0 2 radius 1 }} }}"
    );
    let snell = convert_plainly(&text).snell.expect("a scene");
    let after = |name| numbers_in(value_of(&snell, name))[0];
    let irradiance = after("intensity: ") / (3.0 * 3.0);
    let pi = std::f64::consts::PI;
    assert!((irradiance * after("diffuse: ") / pi - 0.5 * 0.3).abs() < 1e-4, "{snell}");
    // The lobe at its middle: specular (n + 2) / (2 pi).
    let highlight = irradiance * after("specular: ") * (14.0 + 2.0) / (2.0 * pi);
    assert!((highlight - 0.5 * 0.8).abs() < 1e-4, "{snell}");
}

#[test]
fn lights_are_kept_where_programs_use_them() {
    let lights = "Lights { PointLight { position 0 1 0 color 1 1 1 } }";
    let lamp = "Materials { Material { color 0 0 0 emission 9 9 9 type 1 0 0 } }";
    let has_light = |text: &str, lights| {
        let options = Options { lights, ..Options::default() };
        convert(text, "scene.txt", &options, None).snell.is_some_and(|snell| snell.contains("light point"))
    };
    let course = format!("{CAMERA} {lights}");
    let weights = format!("{CAMERA} {lights} {lamp}");
    assert!(has_light(&course, Lights::Auto) && !has_light(&course, Lights::Drop));
    assert!(!has_light(&weights, Lights::Auto) && has_light(&weights, Lights::Keep));
}

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
        if let Some(snell) = conversion.snell {
            assert!(
                !snell.contains("NaN") && !snell.contains("inf,") && !snell.contains("inf)"),
                "{text}\n{snell}"
            );
            assert_compiles(&snell, &text);
        }
    }
}
