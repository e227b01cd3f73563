//! What every command on a scene does first: read it, compile it, and say what is wrong.

use super::args::{Color, Deny, MessageArgs, SceneArgs};
use super::messages::Messages;
use crate::check::Checked;
use crate::diag::{Problems, Report, Style};
use crate::ir::Camera;
use crate::load::MeshImport;
use crate::resolve::{Limits, Offer};
use crate::source::{Disk, Files, Missing, SourceMap, Span};
use std::io::{IsTerminal, Read};
use std::path::{Path, PathBuf};
use terminal_size::{Height, Width, terminal_size_of};

/// A scene on its way from text to picture, with all that was noted about it.
pub struct Session {
    /// The texts.
    pub sources: SourceMap,
    /// The scene's view of the file system.
    pub files: Disk,
    /// What was noted so far.
    pub problems: Problems,
    /// The scene as the user named it.
    pub name: String,
    main: crate::source::FileId,
    sets: Vec<(String, String)>,
    limits: Limits,
    deny: Option<Deny>,
}

/// A hash that is the same on every machine and in every version.
pub struct Fingerprint(u64);

impl Default for Fingerprint {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fingerprint {
    /// Takes in a piece; where pieces end makes a difference.
    pub fn add(&mut self, bytes: &[u8]) {
        let length = (bytes.len() as u64).to_le_bytes();
        for &byte in bytes.iter().chain(&length) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

impl std::fmt::Display for Fingerprint {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{:016x}", self.0)
    }
}

/// The largest scene text that is read.
const MAX_TEXT: u64 = 1 << 30;

impl Session {
    /// Reads the text of a scene; `-` is standard input, seen from the current folder.
    ///
    /// # Errors
    /// Why it cannot be read, in a sentence.
    pub fn open(scene: &Path, args: &SceneArgs) -> Result<Self, String> {
        let text = read_text(scene)?;
        let (name, path) = match scene.to_str() {
            Some("-") => (STDIN.to_owned(), PathBuf::from("stdin.snell")),
            _ => (scene.display().to_string(), scene.to_owned()),
        };
        let mut sources = SourceMap::default();
        let main = sources.add(name.clone(), path.clone(), text.into()).ok_or("the scene is too large")?;
        let files = Disk::new(&path, args.asset_dirs.clone(), args.allow_outside);
        let (sets, deny) = (args.sets.clone(), args.deny);
        let mut limits = Limits::default();
        args.limits.iter().for_each(|(limit, value)| {
            limits.set(limit, *value);
        });
        Ok(Self { sources, files, problems: Problems::default(), name, main, sets, limits, deny })
    }

    /// Compiles the text. `None` when so much is wrong that nothing is left to check.
    pub fn compile(&mut self) -> Option<Checked> {
        let (sources, problems) = (&mut self.sources, &mut self.problems);
        crate::compile_within(sources, &self.files, self.main, &self.sets, &self.limits, problems)
    }

    /// What the scene defines.
    pub fn survey(&mut self) -> Vec<Offer> {
        let program = crate::syntax::parse(&mut self.sources, &self.files, self.main, &mut self.problems);
        crate::resolve::survey(&program, &self.sources, &mut self.problems)
    }

    /// Compiles the text and loads what it names, for all that is wrong with it; what was read of mesh files.
    pub fn inspect(&mut self) -> Vec<MeshImport> {
        let Some(checked) = self.compile() else { return Vec::new() };
        let loaded = crate::load::load(&checked, &self.sources, &self.files, &mut self.problems);
        let imports = loaded.iter().flat_map(|loaded| loaded.imports().cloned()).collect();
        if let Some(loaded) = loaded.filter(|_| !self.problems.has_errors()) {
            let plan = crate::plan::plan(&loaded, checked.cameras.first(), None);
            crate::plan::warn(&plan, &loaded, &mut self.problems);
            // What a file of definitions silences is given where they are placed.
            if !checked.is_empty() {
                crate::allow::doubt_idle(&self.sources, &mut self.problems);
            }
        }
        imports
    }

    /// The same scene with one parameter more, as if it was opened anew.
    pub fn with_set(&self, name: &str, value: &str) -> Self {
        let main = self.sources.file(self.main);
        let mut sources = SourceMap::default();
        let main = sources.add(main.name.clone(), main.path.clone(), main.text.clone());
        let main = main.expect("the text had its place before");
        let mut sets = self.sets.clone();
        sets.push((name.to_owned(), value.to_owned()));
        let (files, name) = (self.files.clone(), self.name.clone());
        let (limits, deny) = (self.limits.clone(), self.deny);
        Self { sources, files, problems: Problems::default(), name, main, sets, limits, deny }
    }

    /// The scene's texts and parameters as 16 hexadecimal digits: other texts, other digits (FNV-1a, Fowler, Noll, Vo 1991).
    pub fn fingerprint(&self) -> String {
        let mut hash = Fingerprint::default();
        self.sources.files().iter().for_each(|file| hash.add(file.text.as_bytes()));
        self.sets.iter().for_each(|(name, value)| hash.add(format!("{name}={value}").as_bytes()));
        hash.to_string()
    }

    /// The camera that the scene is seen through: the one asked for, or the first.
    pub fn camera<'a>(&mut self, scene: &'a Checked, wanted: Option<&str>) -> Option<&'a Camera> {
        crate::check::camera(scene, wanted, self.sources.file(self.main).span(), &mut self.problems)
    }

    /// Where a span begins, as `FILE:LINE`.
    pub fn line(&self, span: Span) -> String {
        let place = self.sources.location(span);
        place.map_or(String::new(), |place| format!("{}:{}", place.file, place.line))
    }

    /// Whether nothing noted so far forbids going on.
    pub fn is_good(&mut self) -> bool {
        self.problems.silence();
        let denied = self.deny == Some(Deny::Warnings) && !self.problems.list().is_empty();
        !self.problems.has_errors() && !denied
    }

    /// Shows everything that was noted, in source order, and forgets it.
    pub fn report(&mut self, messages: &mut Messages<'_>) {
        let problems = std::mem::take(&mut self.problems);
        messages.show(Report::new(problems, &self.sources), self.deny);
    }

    /// [`Session::report`] where the scene is the only one, and a report no result.
    pub fn report_alone(&mut self, args: &MessageArgs) {
        let mut messages = Messages::new(args, false);
        self.report(&mut messages);
        messages.finish();
    }
}

/// What standard input is called in reports.
const STDIN: &str = "standard input";

/// The text of a file, or of standard input for `-`.
///
/// # Errors
/// Why it cannot be read, in a sentence.
pub fn read_text(path: &Path) -> Result<String, String> {
    String::from_utf8(read_bytes(path)?).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = good.iter().filter(|&&byte| byte == b'\n').count() + 1;
        format!("{} is not a text in UTF-8 (line {line}): save it as UTF-8", name_of(path))
    })
}

/// The bytes of a file, or of standard input for `-`.
///
/// # Errors
/// Why it cannot be read, in a sentence.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, String> {
    read(path).map_err(|reason| {
        let near = near(path).map_or(String::new(), |near| format!("; did you mean `{}`?", near.display()));
        format!("{} cannot be read: {reason}{near}", name_of(path))
    })
}

fn name_of(path: &Path) -> String {
    if path.as_os_str() == "-" { STDIN.to_owned() } else { format!("`{}`", path.display()) }
}

/// The file beside `path` whose name is most like it, where `path` itself is missing.
fn near(path: &Path) -> Option<PathBuf> {
    let name = path.file_name()?.to_str()?;
    match Disk::new(path, Vec::new(), true).locate(path, name) {
        Err(Missing::NotFound { near, .. }) => Some(path.with_file_name(near.first()?)),
        _ => None,
    }
}

fn read(scene: &Path) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let read = if scene.as_os_str() == "-" {
        std::io::stdin().lock().take(MAX_TEXT + 1).read_to_end(&mut bytes)
    } else if scene.is_dir() {
        return Err(format!("it is a folder{}", scene_within(scene)));
    } else {
        std::fs::File::open(scene).and_then(|file| file.take(MAX_TEXT + 1).read_to_end(&mut bytes))
    };
    match read {
        Ok(_) if bytes.len() as u64 > MAX_TEXT => Err("it is larger than 1 GiB".to_owned()),
        Ok(_) => Ok(bytes),
        Err(error) => Err(error.to_string()),
    }
}

/// A scene in a folder, as something to name instead.
fn scene_within(folder: &Path) -> String {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let is_scene = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "snell");
    let first = entries.map(|entry| entry.path()).filter(is_scene).min();
    first.map_or("; name a file in it".to_owned(), |path| {
        format!("; name a file in it, such as `{}`", path.display())
    })
}

/// How reports for people look where standard error goes.
pub fn style(color: Color) -> Style {
    let terminal = std::io::stderr().is_terminal();
    let width = if terminal { text_width(terminal_size_of(std::io::stderr())) } else { 100 };
    Style { color: paints(color, terminal), unicode: speaks_unicode(), width }
}

/// Whether to use colour in a stream that is a terminal or is none.
pub fn paints(color: Color, terminal: bool) -> bool {
    match color {
        Color::Always => true,
        Color::Never => false,
        Color::Auto => {
            let plain = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty())
                || std::env::var_os("TERM").is_some_and(|term| term == "dumb");
            terminal && !plain
        }
    }
}

/// The width of text that is a command's result: that of its terminal, 80 columns elsewhere.
pub fn result_width() -> usize {
    let out = std::io::stdout();
    if out.is_terminal() { text_width(terminal_size_of(out)) } else { 80 }
}

/// The width to wrap text to on a terminal of this size: between 60 and 120 columns.
fn text_width(size: Option<(Width, Height)>) -> usize {
    size.map_or(100, |(width, _)| usize::from(width.0)).clamp(60, 120)
}

/// Whether the locale is one of UTF-8; where nothing is said, plain characters are safe.
fn speaks_unicode() -> bool {
    let said = ["LC_ALL", "LC_CTYPE", "LANG"]
        .into_iter()
        .find_map(|name| std::env::var(name).ok().filter(|v| !v.is_empty()));
    said.is_some_and(|locale| locale.to_lowercase().replace('-', "").contains("utf8"))
}
