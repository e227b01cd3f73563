//! Tests of the whole conversion: expected files, the places of mistakes, and texts nobody would write.

use super::parse::{Block, Node, Span};
use super::*;
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

/// Every word and number lies in exactly one fate, and fates do not overlap.
fn assert_accounted(text: &str, fates: &[Fate], name: &str) {
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
        assert_accounted(&text, &conversion.report, name);
        if let Some(snell) = &conversion.snell {
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
        assert_accounted(&text, &conversion.report, &path.display().to_string());
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
