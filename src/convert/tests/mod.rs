//! Tests of the whole conversion.

mod files;
mod meaning;
mod mutation;
mod rows;
mod syntax;

use super::parse::{Block, Node, Span};
use super::*;
use crate::source::{Memory, SourceMap};
use std::path::{Path, PathBuf};

/// Files that a test's scenes name: every picture has 8 x 4 pixels, what is called `lost` is missing, and what is
/// called `astray` lies elsewhere.
struct Shelf;

impl AssetFinder for Shelf {
    fn find(&self, path: &str) -> Search {
        match path {
            lost if lost.contains("lost") => {
                Search::Missing { tried: vec![path.into(), format!("../{path}")] }
            }
            astray if astray.contains("astray") => {
                Search::Elsewhere { path: "../other/astray.obj".into(), head: Vec::new() }
            }
            _ => Search::Found { root: "..".into(), head: b"P6\n8 4\n255\n".to_vec() },
        }
    }
}

fn convert_plainly(text: &str) -> Conversion {
    convert(text, "scene.txt", &Options::default(), Some(&Shelf))
}

impl Conversion {
    /// The one scene there should be.
    fn only(self) -> String {
        assert_eq!(self.scenes.len(), 1, "{:?}", self.problems);
        self.scenes.into_iter().next().expect("counted").snell
    }
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

/// Every word and number lies in exactly one fate, and fates do not overlap.
fn assert_accounted(text: &str, conversion: &Conversion, name: &str) {
    let fates = &conversion.report;
    for pair in fates.windows(2) {
        let [a, b] = pair else { continue };
        let (first, second) = (&text[a.span.clone()], &text[b.span.clone()]);
        assert!(a.span.end <= b.span.start, "{name}: {first:?} and {second:?} overlap");
    }
    let (tree, _) = parse::parse(text, &mut Notebook::default());
    let mut tokens = Vec::new();
    collect_tokens(&tree, &mut tokens);
    for token in tokens {
        let at = fates.partition_point(|fate| fate.span.end <= token.start);
        let is_covered =
            fates.get(at).is_some_and(|fate| fate.span.start <= token.start && token.end <= fate.span.end);
        assert!(is_covered, "{name}: nothing is said of {:?} at {token:?}", &text[token.clone()]);
    }
    let accounted: usize = report::complete(text, fates)
        .iter()
        .map(|fate| report::tokens(&text[fate.span.clone()]).count())
        .sum();
    assert!(accounted >= report::tokens(text).count(), "{name}: {accounted} tokens accounted for");
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

/// What is written is a scene: the compiler finds nothing wrong. What it doubts comes back.
fn assert_compiles(snell: &str, name: &str) -> Vec<String> {
    let mut sources = SourceMap::default();
    let main = sources.add("scene.snell".into(), "scene.snell".into(), snell.into()).expect("a short text");
    let mut problems = crate::diag::Problems::default();
    crate::compile(&mut sources, &Memory::default(), main, &[], &mut problems);
    let say = |problem: &crate::diag::Problem| format!("{}: {}", problem.code(), problem.error);
    let of = |severity| {
        let list = problems.list().iter();
        list.filter(|problem| problem.severity() == severity).map(say).collect::<Vec<_>>()
    };
    let faults = of(crate::diag::Severity::Error);
    assert!(faults.is_empty(), "{name}\n{snell}\n{}", faults.join("\n"));
    of(crate::diag::Severity::Warning)
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
