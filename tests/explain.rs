//! Every code has a page, and the examples of every page do what it says.
//!
//! A page has one block ` ```snell broken ` and one ` ```snell mended `, of `text` for the scenes that are converted. After these words may stand
//! - `also=CODE`: the mistake has another one in its train,
//! - `set=NAME=VALUE`, `camera=NAME`: what is said on the command line,
//! - `render`: only `snell render` finds it, which wants a camera and places everything,
//! - `untestable: REASON`.
//!
//! Further blocks are files: ` ```text file=tri.obj `, for one of the two scenes when `broken` or `mended` follows. A file
//! may be `locked`, `latin1`, or `padded=BYTES`.

use snell::diag::{Problems, Style};
use snell::explain::{Level, Page, Part, pages};
use snell::source::{Files, Memory, Missing, SourceMap};
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};

/// Examples that no test can run: what they need cannot be written in Markdown.
const UNTESTABLE: [&str; 7] = [
    "snell::convert::asset_elsewhere",
    "snell::convert::missing_asset",
    "snell::convert::more",
    "snell::convert::too_deep",
    "snell::convert::too_large",
    "snell::syntax::include_depth",
    "snell::syntax::too_deep",
];

/// Codes that are made for the tests of reports.
const WITHOUT_PAGE: [&str; 1] = ["snell::test::"];

#[test]
fn every_code_has_a_page_and_every_page_a_code() {
    let mut codes = BTreeSet::new();
    collect_codes(Path::new("src"), &mut codes);
    let paged: BTreeSet<String> = pages().iter().map(|page| page.code.to_owned()).collect();
    assert!(codes.len() > 100, "the codes were not found");
    assert_eq!(codes.difference(&paged).collect::<Vec<_>>(), [""; 0], "codes without a page");
    assert_eq!(paged.difference(&codes).collect::<Vec<_>>(), [""; 0], "pages without a code");
}

#[test]
fn every_broken_example_is_reported_so_and_every_mended_one_is_silent() {
    let mut faults = Vec::new();
    for page in pages() {
        for which in ["broken", "mended"] {
            let example = Example::of(page, which);
            if example.flag("untestable:") {
                continue;
            }
            let (codes, report) = example.run(page);
            let expected = match which {
                "broken" => example.values("also").chain([page.code]).map(str::to_owned).collect(),
                _ => BTreeSet::new(),
            };
            if codes != expected {
                faults.push(format!("── {}, {which}: expected {expected:?}\n{report}", page.code));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn levels_are_those_of_the_reports() {
    for page in pages().iter().filter(|page| !UNTESTABLE.contains(&page.code)) {
        let (_, report) = Example::of(page, "broken").run(page);
        let is_error = report.contains(&format!("error[{}]", page.code));
        assert_eq!(is_error, page.level == Level::Error, "{}", page.code);
    }
}

#[test]
fn few_examples_are_not_tested() {
    let untested = pages().iter().filter(|page| {
        let examples = ["broken", "mended"].map(|which| Example::of(page, which));
        examples.iter().any(|example| example.flag("untestable:"))
    });
    assert_eq!(untested.map(|page| page.code).collect::<Vec<_>>(), UNTESTABLE);
}

/// The codes in the sources of a folder.
fn collect_codes(folder: &Path, codes: &mut BTreeSet<String>) {
    for entry in std::fs::read_dir(folder).expect("the sources are there") {
        let path = entry.expect("a folder can be listed").path();
        if path.is_dir() {
            collect_codes(&path, codes);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = std::fs::read_to_string(&path).expect("a source is a text");
            let found = text.split("code(snell::").skip(1).filter_map(|rest| rest.split(')').next());
            let found = found.map(|code| format!("snell::{code}"));
            codes.extend(found.filter(|code| !WITHOUT_PAGE.iter().any(|prefix| code.starts_with(prefix))));
        }
    }
}

/// A scene of a page, with the files that it needs.
pub struct Example {
    info: &'static str,
    pub text: String,
    files: Shelf,
}

/// Files in memory, with the troubles that disks have.
#[derive(Default)]
struct Shelf {
    files: Memory,
    locked: BTreeSet<PathBuf>,
}

impl Example {
    pub fn of(page: &Page, which: &str) -> Self {
        let blocks: Vec<(&str, &str)> = page
            .parts()
            .into_iter()
            .filter_map(|part| match part {
                Part::Block { info, text } => Some((info, text)),
                Part::Paragraph(_) => None,
            })
            .collect();
        let has = |info: &str, flag: &str| info.split_whitespace().any(|word| word == flag);
        let scenes = blocks.iter().filter(|(info, _)| !info.contains("file=") && has(info, which));
        let [&(info, text)] = scenes.collect::<Vec<_>>()[..] else {
            panic!("{} should have one {which} example", page.code);
        };
        let other = if which == "broken" { "mended" } else { "broken" };
        let mut files = Shelf::default();
        for (info, text) in blocks.iter().filter(|(info, _)| !has(info, other)) {
            if let Some(name) = value(info, "file") {
                files.add(name, info, text);
            }
        }
        Self { info, text: text.to_owned(), files }
    }

    fn flag(&self, flag: &str) -> bool {
        self.info.split_whitespace().any(|word| word == flag)
    }

    fn values(&self, key: &str) -> impl Iterator<Item = &'static str> {
        let prefix = format!("{key}=");
        self.info.split_whitespace().filter_map(move |word| word.strip_prefix(prefix.as_str()))
    }

    /// The codes that are reported, and the report.
    pub fn run(&self, page: &Page) -> (BTreeSet<String>, String) {
        let (mut problems, sources) = match page.phase() {
            "convert" => self.convert(),
            _ => self.compile(),
        };
        problems.silence();
        let codes = problems.list().iter().map(|problem| problem.code()).collect();
        let level = |problem: &snell::diag::Problem| problem.severity().name();
        let list: Vec<String> =
            problems.list().iter().map(|problem| format!("{}[{}]", level(problem), problem.code())).collect();
        let report = problems.into_report(&sources).render_human(&Style::default());
        (codes, format!("{}\n{report}", list.join(" ")))
    }

    /// Where the item begins that the first report of `page` is about.
    pub fn first_item(&self, page: &Page) -> usize {
        let (problems, mut sources) = self.compile();
        let report = problems.list().iter().find(|problem| problem.code() == page.code);
        let place = report.expect("the example is broken").offset() as u32;
        let main = sources.find(0).expect("the scene was read");
        let program = snell::syntax::parse(&mut sources, &self.files, main, &mut Problems::default());
        let mut items = program.files[0].items.iter().map(|item| item.span);
        let item = items.find(|span| (span.start..span.end).contains(&place));
        item.expect("a report is about an item").start as usize
    }

    /// The way of `snell check`, or of `snell render` up to the first ray.
    fn compile(&self) -> (Problems, SourceMap) {
        let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
        let main = sources.add("scene.snell".into(), "scene.snell".into(), self.text.as_str().into());
        let main = main.expect("an example is small");
        let sets: Vec<(String, String)> = self
            .values("set")
            .filter_map(|set| set.split_once('='))
            .map(|(name, value)| (name.to_owned(), value.to_owned()))
            .collect();
        let checked = snell::compile(&mut sources, &self.files, main, &sets, &mut problems);
        let Some(checked) = checked else { return (problems, sources) };
        let wanted = self.values("camera").next();
        let camera = match self.flag("render") || wanted.is_some() {
            true => snell::check::camera(&checked, wanted, sources.file(main).span(), &mut problems).cloned(),
            false => checked.cameras.first().cloned(),
        };
        let loaded = snell::load::load(&checked, &sources, &self.files, &mut problems);
        if let Some(loaded) = loaded.filter(|_| !problems.has_errors()) {
            let plan = snell::plan::plan(&loaded, camera.as_ref(), None);
            snell::plan::warn(&plan, &loaded, &mut problems);
            snell::allow::doubt_idle(&sources, &mut problems);
            if let Some(camera) = camera.filter(|_| self.flag("render")) {
                let _ = snell::lower::lower(&loaded, &plan, &camera, &self.files, &mut problems);
            }
        }
        (problems, sources)
    }

    /// The way of `snell convert`.
    fn convert(&self) -> (Problems, SourceMap) {
        let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
        sources.add("scene.txt".into(), "scene.txt".into(), self.text.as_str().into());
        let options = snell::convert::Options::default();
        let conversion = snell::convert::convert(&self.text, "scene.txt", &options, None);
        conversion.problems.into_iter().for_each(|problem| problems.push(problem));
        (problems, sources)
    }
}

impl Shelf {
    fn add(&mut self, name: &str, info: &str, text: &str) {
        let mut bytes = match info.split_whitespace().any(|word| word == "latin1") {
            true => text.chars().map(|c| u8::try_from(c).expect("a letter of Latin-1")).collect(),
            false => text.as_bytes().to_vec(),
        };
        if let Some(padded) = value(info, "padded") {
            bytes.resize(padded.parse().expect("a number of bytes"), b' ');
        }
        if info.split_whitespace().any(|word| word == "locked") {
            self.locked.insert(PathBuf::from(name));
        }
        self.files = std::mem::take(&mut self.files).with(name, bytes);
    }
}

impl Files for Shelf {
    fn locate(&self, from: &Path, name: &str) -> Result<PathBuf, Missing> {
        match self.files.locate(from, name) {
            Ok(path) if path.starts_with("..") => Err(Missing::Outside { path }),
            found => found,
        }
    }

    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        match self.locked.contains(path) {
            true => Err(io::Error::new(io::ErrorKind::PermissionDenied, "permission denied")),
            false => self.files.read(path),
        }
    }
}

/// What stands after `KEY=` in the words after a fence.
fn value<'a>(info: &'a str, key: &str) -> Option<&'a str> {
    let words: BTreeMap<&str, &str> =
        info.split_whitespace().filter_map(|word| word.split_once('=')).collect();
    words.get(key).copied()
}
