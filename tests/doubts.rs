//! Doubts about scenes are to the point: every planted one is found, and nothing else is said.
//!
//! A scene of `tests/doubts` is named after the one code that it gives, or `fine-..` when it gives none. Its first line may
//! say what the command asks for: `// --method pt`.

use snell::diag::{Problems, Report, Style};
use snell::ir::Method;
use snell::plan::Wish;
use snell::source::{Disk, SourceMap};
use snell::{load, plan};
use std::path::{Path, PathBuf};

/// Everything that is said of a scene before a ray is shot, files and method included.
pub fn look(path: &Path) -> Report {
    let text = std::fs::read_to_string(path).expect("a scene of a test can be read");
    let wish = text.lines().next().and_then(|line| line.strip_prefix("// --method ")).map_or(
        Wish::Scene,
        |method| match method {
            "pt" => Wish::Method(Method::Pt),
            "ppm" => Wish::Method(Method::Ppm),
            "hybrid" => Wish::Method(Method::Hybrid),
            "auto" => Wish::Auto,
            other => panic!("no test asks for the method {other}"),
        },
    );
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let main = sources.add(path.display().to_string(), path.to_path_buf(), text.into());
    let (files, main) = (Disk::new(path, Vec::new(), false), main.expect("a scene of a test is small"));
    if let Some(checked) = snell::compile(&mut sources, &files, main, &[], &mut problems) {
        let loaded = load::load(&checked, &sources, &files, &mut problems);
        if let Some(loaded) = loaded.filter(|_| !problems.has_errors()) {
            let plan = plan::plan(&loaded, checked.cameras.first(), wish);
            plan::warn(&plan, &loaded, &mut problems);
        }
    }
    problems.into_report(&sources)
}

/// The scenes in a folder, in order.
pub fn scenes(folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the folder of scenes is there");
    let paths = entries.map(|entry| entry.expect("a folder can be listed").path());
    let mut scenes: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|e| e == "snell")).collect();
    scenes.sort();
    scenes
}

fn codes(report: &Report) -> Vec<String> {
    let code =
        |problem: &snell::diag::Problem| problem.code().rsplit("::").next().unwrap_or_default().to_owned();
    report.problems.iter().map(code).collect()
}

#[test]
fn every_planted_doubt_is_found_and_no_other() {
    let scenes = scenes("tests/doubts");
    assert!(scenes.len() >= 40, "only {} scenes", scenes.len());
    let mut wrong = String::new();
    for path in &scenes {
        let report = look(path);
        let name = path.file_stem().and_then(|stem| stem.to_str()).expect("a scene has a name");
        let planted: Vec<&str> = name.split('-').take(1).filter(|code| *code != "fine").collect();
        if codes(&report) != planted {
            wrong += &format!("── {name}\n{}", report.render_human(&Style::default()));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn scenes_worth_looking_at_raise_no_doubt() {
    for path in scenes("scenes").iter().chain(&scenes("tests/ir")) {
        let report = look(path);
        let doubts: Vec<_> =
            report.problems.iter().filter(|p| p.code().starts_with("snell::check")).collect();
        assert!(doubts.is_empty(), "{}: {}", path.display(), report.render_short());
    }
}
