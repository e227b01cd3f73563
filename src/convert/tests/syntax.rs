//! Words, numbers, braces, and what is made of texts that break the rules.

use super::*;

#[test]
fn numbers_end_where_numbers_end() {
    let (tree, _) = parse::parse("a 20} b 3.png 1. -.5 +2e-3 1..2 ]", &mut Notebook::default());
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
    assert_eq!(conversion.scenes.len(), 0);
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
