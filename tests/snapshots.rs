//! What the program says of the scenes in `tests/`, compared with what it said before.
//!
//! To add a case, add a scene, and run once with `UPDATE=1`.

use snell::diag::{Problems, Report, Style};
use snell::source::{Disk, Files, Memory, Missing, SourceMap};
use snell::syntax::{self, ast::Program};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::io;
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

/// The tree of a scene, and what is wrong with it.
fn parse(files: &dyn Files, path: &Path) -> (Program, Report) {
    let bytes = files.read(path).expect("a scene of a test can be read");
    let text = String::from_utf8(bytes).expect("a scene of a test is a text");
    let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
    let main = sources.add(path.display().to_string(), path.to_path_buf(), text.into());
    let main = main.expect("a scene of a test is small");
    let program = syntax::parse(&mut sources, files, main, &mut problems);
    (program, problems.into_report(&sources))
}

fn parse_file(path: &Path) -> (Program, Report) {
    parse(&Disk::new(path, Vec::new(), false), path)
}

/// Compares `said` with the file at `path`, or writes it there; what differs is added to `differences`.
fn compare(path: &Path, said: &str, differences: &mut String) {
    let expected = std::fs::read_to_string(path).unwrap_or_default();
    if expected == said {
        return;
    }
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(path, said).expect("an expectation can be written");
    } else {
        let _ = writeln!(differences, "── {}\nexpected:\n{expected}\nsaid:\n{said}", path.display());
    }
}

#[test]
fn scenes_are_read_as_these_trees() {
    let mut differences = String::new();
    for scene in scenes("tests/syntax") {
        let (program, report) = parse_file(&scene);
        assert_eq!(report.render_human(&Style::default()), "", "{}", scene.display());
        compare(&scene.with_extension("ast"), &syntax::dump::dump(&program), &mut differences);
    }
    assert!(differences.is_empty(), "{differences}");
}

#[test]
fn mistakes_of_syntax_are_reported_so() {
    let mut differences = String::new();
    for scene in scenes("tests/diagnostics/syntax") {
        let (_, report) = parse_file(&scene);
        compare(&scene.with_extension("txt"), &report.render_human(&Style::default()), &mut differences);
    }
    for (name, files) in files_that_cannot_be_on_disk() {
        let (_, report) = parse(&*files, Path::new("main.snell"));
        let path = Path::new("tests/diagnostics/syntax").join(name).with_extension("txt");
        compare(&path, &report.render_human(&Style::default()), &mut differences);
    }
    assert!(differences.is_empty(), "{differences}");
}

#[test]
fn every_code_of_syntax_has_its_report() {
    let source = std::fs::read_to_string("src/syntax/error.rs").expect("the source is there");
    let after = source.split("code(").skip(1);
    let codes: BTreeSet<&str> = after.filter_map(|rest| rest.split(')').next()).collect();
    for code in codes {
        let name = code.rsplit("::").next().expect("a split has a part");
        let report =
            std::fs::read_to_string(format!("tests/diagnostics/syntax/{name}.txt")).unwrap_or_default();
        assert!(report.contains(code), "no report of {code}");
    }
}

#[test]
fn the_lines_for_programs_name_the_same_places() {
    let (_, report) = parse_file(Path::new("tests/diagnostics/syntax/included_from.snell"));
    let short = report.render_short();
    let place = "tests/diagnostics/syntax/parts/broken.snell:3:12";
    let expected =
        format!("{place}: error: `+` has nothing on its right [snell::syntax::missing_operand]\n1 error\n");
    assert_eq!(short, expected);
    let json: serde_json::Value =
        serde_json::from_str(report.render_json().trim()).expect("each line is an object");
    assert_eq!((&json["labels"][0]["line"], &json["labels"][0]["column"]), (&3.into(), &12.into()));
    assert_eq!(json["labels"][0]["start"], 20);
    assert_eq!(json["trail"][0]["file"], "tests/diagnostics/syntax/included_from.snell");
}

/// Scenes that would be too large, too many or not readable as files of this repository.
fn files_that_cannot_be_on_disk() -> [(&'static str, Box<dyn Files>); 3] {
    let include = "snell 1\n\ninclude \"big.snell\"\n";
    let large = Memory::default().with("main.snell", include).with("big.snell", vec![b' '; (16 << 20) + 1]);
    let deep = (0..70).fold(Memory::default(), |files, n| {
        let name = if n == 0 { "main.snell".to_owned() } else { format!("{n}.snell") };
        files.with(&name, format!("snell 1\ninclude \"{}.snell\"\n", n + 1))
    });
    [
        ("file_too_large", Box::new(large)),
        ("include_depth", Box::new(deep)),
        ("file_unreadable", Box::new(Locked)),
    ]
}

/// A disk on which everything but the main file is locked.
struct Locked;

impl Files for Locked {
    fn locate(&self, _from: &Path, name: &str) -> Result<PathBuf, Missing> {
        Ok(PathBuf::from(name))
    }

    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        match path.to_str() {
            Some("main.snell") => Ok(b"snell 1\n\ninclude \"locked.snell\"\n".to_vec()),
            _ => Err(io::Error::new(io::ErrorKind::PermissionDenied, "permission denied")),
        }
    }
}
