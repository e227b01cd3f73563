//! Laws of evaluation that are easier said in code than in a scene.

use super::{Error, Limits, resolve_within};
use crate::diag::Problems;
use crate::ir::{Scene, ShapeKind};
use crate::source::{Memory, SourceMap};
use crate::syntax;
use std::path::PathBuf;

/// What a scene means, and the codes of what is wrong with it.
fn meaning(text: &str) -> (Scene, Vec<String>) {
    let (scene, problems) = meaning_within(text, &Limits::default());
    (scene, problems.into_sorted().iter().map(|p| p.code().replace("snell::resolve::", "")).collect())
}

fn meaning_within(text: &str, limits: &Limits) -> (Scene, Problems) {
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let text = format!("snell 1\n{text}");
    let main = sources.add("main.snell".to_owned(), PathBuf::from("main.snell"), text.into());
    let main = main.expect("the text is small");
    let program = syntax::parse(&mut sources, &Memory::default(), main, &mut problems);
    let scene = resolve_within(&program, &sources, &[], limits, &mut problems);
    (scene, problems)
}

/// The radius of the only sphere.
fn radius(text: &str) -> f64 {
    let (scene, codes) = meaning(text);
    assert_eq!(codes, [""; 0], "{text}");
    let kinds: Vec<&ShapeKind> = scene.shapes.iter().map(|shape| &shape.kind).collect();
    match kinds[..] {
        [ShapeKind::Sphere { radius, .. }] => radius.value,
        _ => panic!("not one sphere: {text}"),
    }
}

#[test]
fn units_convert_and_cancel() {
    assert_eq!(radius("sphere { radius: 30cm }"), 0.3);
    assert_eq!(radius("sphere { radius: 2m / 4s * 2s }"), 1.0);
    assert_eq!(radius("units { length: mm }\nsphere { radius: 5 }"), 0.005);
    assert_eq!(radius("sphere { radius: 6m * 2m / 3m }"), 4.0);
}

#[test]
fn what_follows_from_a_mistake_is_silent() {
    let (_, codes) =
        meaning("let a = nothing\nlet b = a + 1m\nsphere { radius: b * 30deg, center: (b, a, 0m) }");
    assert_eq!(codes, ["unknown_name"]);
    let (_, codes) = meaning("fn ball(x: length) -> object { sphere { radius: x } }\nplace ball(1m + 1deg)");
    assert_eq!(codes, ["incompatible"]);
    let (_, codes) = meaning("for i in 0..none { sphere { radious: i * 1m } }");
    assert_eq!(codes, ["unknown_name", "unknown_field"]);
}

#[test]
fn what_nothing_calls_is_looked_at_all_the_same() {
    let (_, codes) = meaning("fn _f(x: length) -> object { sphere { radius: x, colour: red } }");
    assert_eq!(codes, ["unknown_field"]);
    let (_, codes) = meaning("let _unused = glass { iro: 1.5 }");
    assert_eq!(codes, ["unknown_field"]);
}

#[test]
fn deep_definitions_end_in_a_report() {
    let chain: String = (0..2_000).map(|i| format!("let x{i} = x{} + 1m\n", i + 1)).collect();
    let (_, codes) = meaning(&format!("{chain}let x2000 = 1m\nsphere {{ radius: x0 }}"));
    assert_eq!(codes, ["budget"]);
    // In the natural order none of them needs much depth.
    let chain: String = (1..2_000).map(|i| format!("let x{i} = x{} + 1m\n", i - 1)).collect();
    assert_eq!(radius(&format!("let x0 = 1m\n{chain}sphere {{ radius: x1999 }}")), 2_000.0);
}

#[test]
fn deep_groups_end_in_a_report() {
    let groups = |n: usize| format!("{}sphere {{ radius: 1m }}{}", "group { ".repeat(n), " }".repeat(n));
    assert_eq!(radius(&groups(150)), 1.0);
    let (_, codes) = meaning(&groups(300));
    assert!(!codes.is_empty(), "too deep, and nothing said");
    let nested: String = (1..300).map(|i| format!("let g{i} = group {{ place g{} }}\n", i - 1)).collect();
    let (_, codes) = meaning(&format!("let g0 = sphere {{ radius: 1m }}\n{nested}place g299"));
    assert_eq!(codes, ["budget"]);
}

#[test]
fn operators_join_from_the_left() {
    assert_eq!(radius("sphere { radius: 10m - 4m - 3m }"), 3.0);
    assert_eq!(radius("sphere { radius: 12m / 3 / 2 }"), 2.0);
    assert_eq!(radius("sphere { radius: 2 ^ 3 ^ 2 * 1m }"), 512.0);
    let sum = vec!["1m"; 200].join(" + ");
    assert_eq!(radius(&format!("sphere {{ radius: {sum} }}")), 200.0);
}

#[test]
fn the_same_mistake_in_a_loop_is_told_once() {
    let (_, codes) = meaning("for i in 0..100 { sphere { radius: 1m, color: i } }");
    assert_eq!(codes, ["unknown_field"]);
}

#[test]
fn an_error_names_its_code() {
    use miette::Diagnostic;
    let error = Error::UnevenLight { light: Default::default(), transform: None };
    assert_eq!(error.code().map(|code| code.to_string()).as_deref(), Some("snell::resolve::uneven_light"));
}

#[test]
fn every_unit_that_a_blank_parts_from_its_number_is_known() {
    // `in` is also a word of `param`, and `7 % 2` is a remainder.
    for unit in crate::schema::UNITS.iter().map(|unit| unit.name).filter(|unit| !["in", "%"].contains(unit)) {
        let (_, codes) = meaning(&format!("let _a = 3 {unit}"));
        assert_eq!(codes, ["snell::syntax::apart_unit"], "{unit}");
    }
}

/// What is said of a scene that asks for more than a limit of 100, and what of one that asks for less.
fn at_a_limit(name: &str, more: &str, less: &str) {
    let mut limits = Limits::default();
    assert!(limits.set(name, 100), "there is no limit `{name}`");
    let (_, problems) = meaning_within(more, &limits);
    let helps: Vec<String> = problems
        .list()
        .iter()
        .filter(|problem| problem.code().ends_with("budget"))
        .filter_map(|problem| problem.error.help().map(|help| help.to_string()))
        .collect();
    assert_eq!(helps.len(), 1, "{name}");
    assert!(helps[0].contains(&format!("`--limit {name}=1000`")), "{}", helps[0]);
    let (_, problems) = meaning_within(less, &limits);
    assert!(!problems.list().iter().any(|problem| problem.code().ends_with("budget")), "{name}");
}

#[test]
fn every_limit_is_told_with_the_way_to_raise_it() {
    let spheres = |n: u32| format!("let b = sphere {{ radius: 1m }}\nfor i in 0..{n} {{ place b }}");
    at_a_limit("objects", &spheres(101), &spheres(100));
    at_a_limit("turns", "for i in 0..50 { for j in 0..3 { } }", "for i in 0..25 { for j in 0..3 { } }");
    at_a_limit("elements", "let _a = [i for i in 0..101]", "let _a = [i for i in 0..100]");
    at_a_limit("elements", &format!("let _a = data [ {} ]", "1 ".repeat(101)), "let _a = data [ 1 2 ]");
    at_a_limit("steps", &format!("let _a = [{}]", "1, ".repeat(101)), "let _a = [1, 2, 3]");
    at_a_limit("problems", &"sphere { radius: x }\n".repeat(101), &"sphere { radius: x }\n".repeat(90));
    assert!(!Limits::default().set("colours", 3));
}

#[test]
fn what_grows_exponentially_ends_in_a_report() {
    let doubled: String = (1..40).map(|i| format!("let t{i} = t{} then t{}\n", i - 1, i - 1)).collect();
    let (_, codes) = meaning(&format!("let t0 = scale(2)\n{doubled}sphere {{ radius: 1m, transform: t39 }}"));
    assert_eq!(codes, ["budget"]);
    let calls: String =
        (1..40).map(|i| format!("fn f{i}() -> number {{ f{}() + f{}() }}\n", i - 1, i - 1)).collect();
    let mut limits = Limits::default();
    limits.set("steps", 1_000_000);
    let text = format!("fn f0() -> number {{ 1 }}\n{calls}sphere {{ radius: f39() * 1m }}");
    let (_, problems) = meaning_within(&text, &limits);
    assert_eq!(problems.list().iter().map(|p| p.code()).collect::<Vec<_>>(), ["snell::resolve::budget"]);
}
