//! The well-formed scenes that are made wrong.

use super::roles::{Roles, defined_names, roles};
use super::tokens::{Token, tokens};
use snell::diag::{Problem, Problems, Style};
use snell::source::{Memory, SourceMap};
use snell::syntax::{self, ast::File};
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Where scenes are taken from; those that have mistakes of their own are left out.
const FOLDERS: [&str; 4] = ["scenes", "tests/ir", "tests/syntax", "tests/mutation/scenes"];

/// A scene with the files that it includes and imports, the main one first.
pub struct Scene {
    /// Its files.
    pub files: Vec<SceneFile>,
    /// Every word that means something in it, or could.
    pub known: BTreeSet<String>,
    /// Everything that a scene of the corpus may name.
    disk: Memory,
    /// The warnings that it has as it is: code, file and place.
    pub warnings: Vec<Label>,
}

/// A file of a scene.
pub struct SceneFile {
    /// Its path.
    pub path: PathBuf,
    /// What it says.
    pub text: String,
    /// Its tokens.
    pub tokens: Vec<Token>,
    /// What its words are for.
    pub roles: Roles,
}

/// A place that a report points at.
#[derive(Clone, PartialEq, Debug)]
pub struct Label {
    /// The code of the report.
    pub code: String,
    /// The index of the file in its scene; `usize::MAX` for a file that is no scene.
    pub file: usize,
    /// The bytes.
    pub range: Range<usize>,
}

/// What is said of a scene.
pub struct Said {
    /// The reports.
    pub reports: Vec<Report>,
    /// Whether the scene is refused.
    pub refused: bool,
}

/// One report.
pub struct Report {
    /// The places, the primary one first.
    pub labels: Vec<Label>,
    /// What to do.
    pub help: String,
}

/// All well-formed scenes.
pub fn scenes() -> Vec<Scene> {
    let paths = FOLDERS.iter().flat_map(|folder| files_in(Path::new(folder), "snell", false));
    let disk = disk();
    let words = words_of_the_language();
    paths.filter_map(|path| Scene::read(&path, &disk, &words)).collect()
}

fn files_in(folder: &Path, extension: &str, deep: bool) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the folder is there");
    let mut paths = Vec::new();
    for path in entries.map(|entry| entry.expect("a folder can be listed").path()) {
        if path.is_dir() && deep {
            paths.extend(files_in(&path, extension, deep));
        } else if path.extension().is_some_and(|found| found == extension) {
            paths.push(path);
        }
    }
    paths.sort();
    paths
}

/// All scenes of the corpus, and small stand-ins for the meshes and pictures that they name.
fn disk() -> Memory {
    let mut disk = Memory::default();
    for folder in FOLDERS {
        for path in files_in(Path::new(folder), "snell", true) {
            let text = std::fs::read(&path).expect("a scene can be read");
            for name in asset_names(&String::from_utf8_lossy(&text)) {
                let path = path.parent().expect("a file has a folder").join(&name);
                disk.0.insert(path, stand_in(&name));
            }
            disk.0.insert(path, text);
        }
    }
    disk
}

/// The texts of a scene that end as the name of a mesh or a picture does.
fn asset_names(text: &str) -> Vec<String> {
    let is_asset = |text: &&str| {
        !text.contains('\n') && [".obj", ".png", ".jpg", ".hdr"].iter().any(|end| text.ends_with(end))
    };
    text.split('"').filter(is_asset).map(str::to_owned).collect()
}

/// A triangle, or a picture of one pixel.
fn stand_in(name: &str) -> Vec<u8> {
    if name.ends_with(".obj") {
        return b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec();
    }
    let format = image::ImageFormat::from_path(name).expect("the corpus names pictures of known kinds");
    let mut bytes = std::io::Cursor::new(Vec::new());
    let pixel = image::DynamicImage::new_rgb32f(1, 1);
    let pixel = if name.ends_with(".hdr") { pixel } else { pixel.to_rgb8().into() };
    pixel.write_to(&mut bytes, format).expect("memory takes what is written");
    bytes.into_inner()
}

/// Every word between quotes in the tables of the compiler: more than the words of the language, and never fewer.
fn words_of_the_language() -> BTreeSet<String> {
    let files =
        ["src/resolve", "src/schema"].into_iter().flat_map(|folder| files_in(Path::new(folder), "rs", true));
    let mut words: BTreeSet<String> = BTreeSet::new();
    for path in files {
        let text = std::fs::read_to_string(&path).expect("the source can be read");
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        words.extend(text.split('"').flat_map(|part| part.split(|c| !is_word(c))).map(str::to_owned));
    }
    words.extend("snell let param for in fn place import include as at units if else then per on and or not allow data f true false".split(' ').map(str::to_owned));
    words
}

impl Scene {
    /// The scene at `path`, unless it has mistakes of its own.
    fn read(path: &Path, disk: &Memory, words: &BTreeSet<String>) -> Option<Self> {
        let text = disk.0.get(path).map(|bytes| String::from_utf8_lossy(bytes).into_owned())?;
        let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
        let main = sources.add(path.display().to_string(), path.to_owned(), text.into())?;
        let program = syntax::parse(&mut sources, disk, main, &mut problems);
        if problems.has_errors() {
            return None;
        }
        let names: BTreeSet<String> =
            program.files.iter().flat_map(|file| defined_names(file, &sources)).collect();
        let read_file = |file: &File| {
            let source = sources.file(file.source);
            let (path, text) = (source.path.clone(), source.text.to_string());
            SceneFile { path, tokens: tokens(&text), roles: roles(file, &sources, &names), text }
        };
        let files: Vec<SceneFile> = program.files.iter().map(read_file).collect();
        let known = words.union(&names).cloned().collect();
        let mut scene = Self { files, known, disk: Memory(disk.0.clone()), warnings: Vec::new() };
        let said = scene.say(&scene.texts());
        if said.refused {
            return None;
        }
        scene.warnings =
            said.reports.into_iter().filter_map(|report| report.labels.into_iter().next()).collect();
        Some(scene)
    }

    /// The texts of its files as they are.
    pub fn texts(&self) -> Vec<String> {
        self.files.iter().map(|file| file.text.clone()).collect()
    }

    /// What the compiler says when its files hold these texts.
    pub fn say(&self, texts: &[String]) -> Said {
        let (sources, problems) = self.check(texts);
        let refused = problems.has_errors();
        let reports = problems.into_sorted();
        Said { reports: reports.iter().map(|problem| self.said(problem, &sources)).collect(), refused }
    }

    /// The same, for people.
    pub fn report(&self, texts: &[String]) -> String {
        let (sources, problems) = self.check(texts);
        problems.into_report(&sources).render_human(&Style::default())
    }

    /// What `snell check` does.
    fn check(&self, texts: &[String]) -> (SourceMap, Problems) {
        let mut disk = Memory(self.disk.0.clone());
        for (file, text) in self.files.iter().zip(texts) {
            disk.0.insert(file.path.clone(), text.clone().into_bytes());
        }
        let (mut sources, mut problems) = (SourceMap::default(), Problems::default());
        let path = &self.files[0].path;
        let main = sources.add(path.display().to_string(), path.clone(), texts[0].as_str().into());
        let main = main.expect("scenes of the corpus are small");
        if let Some(checked) = snell::compile(&mut sources, &disk, main, &[], &mut problems) {
            let loaded = snell::load::load(&checked, &sources, &disk, &mut problems);
            if let Some(loaded) = loaded.filter(|_| !problems.has_errors()) {
                let plan = snell::plan::plan(&loaded, checked.cameras.first(), None);
                snell::plan::warn(&plan, &loaded, &mut problems);
            }
        }
        (sources, problems)
    }

    fn said(&self, problem: &Problem, sources: &SourceMap) -> Report {
        let labels = problem.error.labels().into_iter().flatten();
        let label = |label: miette::LabeledSpan| {
            let file = sources.find(label.offset() as u32).map(|id| sources.file(id));
            let index = file.and_then(|file| self.files.iter().position(|own| own.path == file.path));
            let start = label.offset() - file.map_or(0, |file| file.base as usize);
            let file = index.unwrap_or(usize::MAX);
            Label { code: problem.code(), file, range: start..start + label.len() }
        };
        Report {
            labels: labels.map(label).collect(),
            help: problem.error.help().map(|help| help.to_string()).unwrap_or_default(),
        }
    }
}
