//! What scenes mean, and what is said of those that make no sense, compared with what was said before.
//!
//! To add a case, add a scene, and run once with `UPDATE=1`.

use crate::doubts::look;
use snell::diag::{Problems, Report, Style};
use snell::ir::{Scene, dump::dump};
use snell::source::{Disk, SourceMap, Spanned};
use snell::{check, resolve, syntax};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The scenes in a folder, in order.
fn scenes(folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the folder of scenes is there");
    let paths = entries.map(|entry| entry.expect("a folder can be listed").path());
    let mut scenes: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|e| e == "snell")).collect();
    scenes.sort();
    assert!(!scenes.is_empty(), "{folder} holds no scene");
    scenes
}

/// What a scene means, and everything that is wrong with it.
fn compile(path: &Path, sets: &[(&str, &str)]) -> (Scene, Report) {
    let text = std::fs::read_to_string(path).expect("a scene of a test can be read");
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let main = sources.add(path.display().to_string(), path.to_path_buf(), text.into());
    let files = Disk::new(path, Vec::new(), false);
    let main = main.expect("a scene of a test is small");
    let program = syntax::parse(&mut sources, &files, main, &mut problems);
    let setting = |&(name, value): &(&str, &str)| {
        let value = syntax::parse_expression(&mut sources, value, "--set", &mut problems)?;
        Some(resolve::Setting { name: Spanned::new(name.to_owned(), value.span), value })
    };
    let settings: Vec<_> = sets.iter().filter_map(setting).collect();
    let scene = resolve::resolve(&program, &sources, &settings, &mut problems);
    let copy = resolve::resolve(&program, &sources, &settings, &mut Problems::default());
    check::check(scene, &mut problems);
    (copy, Report::new(problems, &sources))
}

/// The phases whose mistakes have scenes here.
const PHASES: [&str; 4] = ["resolve", "check", "load", "plan"];

/// What is said of a scene: of its words alone, or with files and method.
fn report(phase: &str, path: &Path) -> Report {
    if phase == "resolve" { compile(path, &[]).1 } else { look(path) }
}

/// Compares `said` with the file at `path`, or writes it there; what differs is added to `differences`.
pub fn compare(path: &Path, said: &str, differences: &mut String) {
    if std::env::var_os("UPDATE").is_some() {
        return std::fs::write(path, said).expect("an expectation can be written");
    }
    let expected = std::fs::read_to_string(path).unwrap_or_default();
    if expected != said {
        let _ = writeln!(differences, "── {}\nexpected:\n{expected}\nsaid:\n{said}", path.display());
    }
}

fn code_of(problem: &snell::diag::Problem) -> String {
    problem.code().rsplit("::").next().unwrap_or_default().to_owned()
}

#[test]
fn scenes_mean_this() {
    let mut differences = String::new();
    for path in scenes("tests/ir") {
        let (scene, report) = compile(&path, &[]);
        assert!(!report.has_errors(), "{}", report.render_human(&Style::default()));
        compare(&path.with_extension("ir"), &dump(&scene), &mut differences);
    }
    assert!(differences.is_empty(), "{differences}");
}

#[test]
fn mistakes_of_meaning_are_reported_so() {
    let mut differences = String::new();
    for phase in PHASES {
        for path in scenes(&format!("tests/diagnostics/{phase}")) {
            let report = report(phase, &path);
            compare(&path.with_extension("txt"), &report.render_human(&Style::default()), &mut differences);
        }
    }
    assert!(differences.is_empty(), "{differences}");
}

/// Scenes with many mistakes, all of which are told in one run; and one with none, though it looks like it.
#[test]
fn many_mistakes_are_reported_together() {
    let mut differences = String::new();
    for path in scenes("tests/diagnostics/many") {
        let report = report("resolve", &path);
        compare(&path.with_extension("txt"), &report.render_human(&Style::default()), &mut differences);
    }
    assert!(differences.is_empty(), "{differences}");
}

/// Each scene has one mistake, which gives one report, whose code names the scene: `CODE.snell`, `CODE-CASE.snell`.
#[test]
fn one_mistake_gives_one_report() {
    /// Scenes about how mistakes are told rather than about one code.
    const OTHERS: [&str; 1] = ["trail"];
    for phase in PHASES {
        for path in scenes(&format!("tests/diagnostics/{phase}")) {
            let report = report(phase, &path);
            let codes: Vec<String> = report.problems.iter().map(code_of).collect();
            let name = path.file_stem().and_then(|stem| stem.to_str()).expect("a scene has a name");
            if !OTHERS.contains(&name) {
                let code = name.split('-').next().unwrap_or(name);
                assert_eq!(codes, [code], "{}", path.display());
            }
        }
    }
}

#[test]
fn every_code_of_meaning_has_its_scene() {
    /// These need a command line, or a file that may not be read.
    const ELSEWHERE: [&str; 4] = ["unknown_parameter", "no_camera", "unknown_camera", "unreadable"];
    let files = PHASES.map(|phase| (phase, format!("src/{phase}/error.rs")));
    for (phase, file) in files.into_iter().chain([("check", "src/check/space/error.rs".to_owned())]) {
        let source = std::fs::read_to_string(file).expect("the source is there");
        let prefix = format!("code(snell::{phase}::");
        let codes = source.split(&prefix).skip(1).filter_map(|rest| rest.split(')').next());
        let missing: BTreeSet<&str> = codes
            .filter(|code| !ELSEWHERE.contains(code))
            .filter(|code| !Path::new(&format!("tests/diagnostics/{phase}/{code}.snell")).exists())
            .collect();
        assert!(missing.is_empty(), "{phase} has no scene for {missing:?}");
    }
}

#[test]
fn the_command_line_sets_parameters_typed_and_checked() {
    let path = Path::new("tests/ir/scopes.snell");
    let value = |sets: &[(&str, &str)]| {
        let (scene, report) = compile(path, sets);
        let count = scene.params.iter().find(|param| param.name.value == "count").map(|p| p.value.clone());
        (count, report.problems.iter().map(code_of).collect::<Vec<_>>())
    };
    assert_eq!(value(&[("count", "4")]), (Some("4".to_owned()), vec![]));
    assert_eq!(value(&[("count", "4"), ("count", "5")]), (Some("5".to_owned()), vec![]));
    assert_eq!(value(&[("count", "6")]).1, ["out_of_range"]);
    assert_eq!(value(&[("count", "2.5")]).1, ["wrong_type"]);
    assert_eq!(value(&[("size", "30deg")]).1, ["wrong_dimension"]);
    assert_eq!(value(&[("cuont", "4")]).1, ["unknown_parameter"]);
}

#[test]
fn a_camera_is_found_by_name() {
    let path = Path::new("tests/ir/transforms.snell");
    let (scene, _) = compile(path, &[]);
    let checked = check::check(scene, &mut Problems::default()).expect("the scene holds something");
    let mut problems = Problems::default();
    let mut name = |wanted| {
        let camera = check::camera(&checked, wanted, Default::default(), &mut problems)?;
        camera.name.as_ref().map(|name| name.value.clone())
    };
    assert_eq!(name(None).as_deref(), Some("front"));
    assert_eq!(name(Some("side")).as_deref(), Some("side"));
    assert_eq!(name(Some("sdie")), None);
    assert_eq!(code_of(&problems.list()[0]), "unknown_camera");

    let (scene, _) = compile(Path::new("tests/ir/expressions.snell"), &[]);
    let (checked, mut problems) = (check::check(scene, &mut Problems::default()), Problems::default());
    let checked = checked.expect("the scene holds something");
    assert_eq!(check::camera(&checked, None, Default::default(), &mut problems), None);
    assert_eq!(code_of(&problems.list()[0]), "no_camera");
}

/// Ten mistakes in three files: ten reports in one run, each with its place and its cure.
#[test]
fn ten_mistakes_are_shown_at_once() {
    let path = Path::new("tests/diagnostics/ten/main.snell");
    let (_, report) = compile(path, &[]);
    assert_eq!(report.problems.len(), 10, "{}", report.render_human(&Style::default()));
    for problem in &report.problems {
        assert!(problem.error.help().is_some(), "`{}` has no cure", problem.error);
        assert!(problem.error.labels().is_some(), "`{}` has no place", problem.error);
    }
    let mut differences = String::new();
    compare(&path.with_extension("txt"), &report.render_human(&Style::default()), &mut differences);
    assert!(differences.is_empty(), "{differences}");
}
