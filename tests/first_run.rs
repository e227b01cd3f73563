//! What is missing is told beside other mistakes, not in the run after they are mended, as long as the text leaves no
//! doubt that it is missing.

use snell::diag::Problems;
use snell::source::{Memory, SourceMap};
use std::collections::BTreeSet;

const CAMERA: &str = "camera { position: (0m, 1m, 4m), look_at: (0m, 0m, 0m) }\n";
const LIGHT: &str = "light point { position: (0m, 3m, 0m), power: 60W }\n";

/// The codes of all that is said about a scene, files and all.
fn codes(lines: &[&str]) -> BTreeSet<String> {
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let text = format!("snell 1\n{}\n", lines.join("\n"));
    let main = sources.add("main.snell".to_owned(), "main.snell".into(), text.into());
    let main = main.expect("the scene is small");
    let files = Memory::default();
    if let Some(checked) = snell::compile(&mut sources, &files, main, &[], &mut problems) {
        snell::load::load(&checked, &sources, &files, &mut problems);
    }
    problems.list().iter().map(|problem| problem.code().trim_start_matches("snell::").to_owned()).collect()
}

fn set(codes: &[&str]) -> BTreeSet<String> {
    codes.iter().map(|&code| code.to_owned()).collect()
}

#[test]
fn what_nothing_uses_is_told_beside_a_mistake_of_form() {
    let unused = "let chalk = diffuse { color: white }";
    let broken = "sphere { radius: 1m material: mirror {} }";
    assert_eq!(codes(&[CAMERA, LIGHT, unused, broken]), set(&["resolve::unused", "syntax::missing_comma"]));
}

#[test]
fn what_a_line_with_a_mistake_may_use_is_not_called_unused() {
    let chalk = "let chalk = diffuse { color: white }";
    for broken in ["sphere { radius: 1m material: chalk }", "sphere { radius: 1m material: chlak } }"] {
        assert!(!codes(&[CAMERA, LIGHT, chalk, broken]).contains("resolve::unused"), "{broken}");
    }
    // The silence that could not be read may have been for it.
    let silenced = codes(&[CAMERA, LIGHT, "allow(unused)", chalk]);
    assert_eq!(silenced, set(&["syntax::bad_allow"]));
}

#[test]
fn a_scene_without_light_is_told_so_beside_other_mistakes() {
    let misspelt = "sphere { radius: 1m, material: papre }";
    let expected = set(&["check::no_light", "resolve::unknown_material"]);
    assert_eq!(codes(&[CAMERA, misspelt]), expected);
    let camera = "camera { position: (0m, 1m, 4m), lookat: (0m, 0m, 0m) }";
    assert!(codes(&[camera, "sphere { radius: 1m }"]).contains("check::no_light"));
    assert!(codes(&[CAMERA, "sphere { radius: -1m }"]).contains("check::no_light"));
}

#[test]
fn light_that_is_written_badly_may_be_light() {
    let bad_lights = [
        "ligth point { position: (0m, 3m, 0m), power: 60W }",
        "light point { position: (0m, 3m, 0m), power: sixty }",
        "sphere { radius: 1m, material: emisive { power: 60W } }",
        "enviroment { radiance: 1 }",
    ];
    for bad in bad_lights {
        assert!(!codes(&[CAMERA, bad]).contains("check::no_light"), "{bad}");
    }
}

#[test]
fn a_call_with_a_mistake_does_not_hide_one_in_the_function() {
    let ball = "fn ball(r: length) -> object { sphere { radius: rr } }";
    let expected = set(&["resolve::argument_count", "resolve::unknown_name"]);
    assert_eq!(codes(&[CAMERA, LIGHT, ball, "place ball(1m, 2m)"]), expected);
}

#[test]
fn a_misspelt_name_does_not_hide_that_what_it_means_lacks_its_file() {
    let paper = "let paper = diffuse { color: image(\"weave.png\") }";
    let misspelt = "sphere { radius: 1m, material: papre }";
    let expected = set(&["load::missing_file", "resolve::unknown_material"]);
    assert_eq!(codes(&[CAMERA, LIGHT, paper, misspelt]), expected);
    // What nothing means is not even opened.
    let other = "sphere { radius: 1m, material: velvet }";
    assert!(!codes(&[CAMERA, LIGHT, paper, other]).contains("load::missing_file"));
}
