//! The README shows what is so: its scene is a scene of ours, and its reports are what the compiler says today.

use snell::diag::{Problems, Style};
use snell::source::{Memory, SourceMap};
use std::fs;
use std::path::PathBuf;

#[test]
fn the_scene_of_the_readme_is_the_one_that_is_rendered() {
    assert!(readme().contains(&fs::read_to_string("scenes/beads.snell").unwrap()));
}

#[test]
fn the_reports_of_the_readme_are_what_the_compiler_says() {
    let broken = fs::read_to_string("tests/diagnostics/readme/beads.snell").unwrap();
    let files =
        Memory::default().with("lib/materials.snell", fs::read("scenes/lib/materials.snell").unwrap());
    let mut sources = SourceMap::default();
    let main = sources.add("beads.snell".into(), PathBuf::from("beads.snell"), broken.into()).unwrap();
    let mut problems = Problems::default();
    let _ = snell::compile(&mut sources, &files, main, &[], &mut problems);
    let said =
        problems.into_report(&sources).render_human(&Style { color: false, unicode: true, width: 100 });
    assert!(readme().contains(said.trim_end()), "the README should show:\n{said}");
}

fn readme() -> String {
    fs::read_to_string("README.md").unwrap()
}
