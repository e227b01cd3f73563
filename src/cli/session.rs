//! What every command on a scene does first: read it, compile it, and say what is wrong.

use super::args::{Color, Deny, MessageArgs, MessageFormat, SceneArgs};
use super::{note, print};
use crate::check::Checked;
use crate::diag::{Problems, Report, Style};
use crate::ir::Camera;
use crate::source::{Disk, Files, Missing, SourceMap};
use std::io::{IsTerminal, Read};
use std::path::{Path, PathBuf};

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
    deny: Option<Deny>,
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
        Ok(Self { sources, files, problems: Problems::default(), name, main, sets, deny })
    }

    /// Compiles the text. `None` when so much is wrong that nothing is left to check.
    pub fn compile(&mut self) -> Option<Checked> {
        crate::compile(&mut self.sources, &self.files, self.main, &self.sets, &mut self.problems)
    }

    /// The camera that the scene is seen through: the one asked for, or the first.
    pub fn camera<'a>(&mut self, scene: &'a Checked, wanted: Option<&str>) -> Option<&'a Camera> {
        crate::check::camera(scene, wanted, self.sources.file(self.main).span(), &mut self.problems)
    }

    /// Whether nothing noted so far forbids going on.
    pub fn is_good(&self) -> bool {
        let denied = self.deny == Some(Deny::Warnings) && !self.problems.list().is_empty();
        !self.problems.has_errors() && !denied
    }

    /// Shows everything that was noted, in source order, and forgets it. Reports for programs are a command's result when
    /// `as_result` is set, and go to standard output then.
    pub fn report(&mut self, args: &MessageArgs, as_result: bool) {
        let good = self.is_good();
        let problems = std::mem::take(&mut self.problems);
        if !(args.quiet && good) {
            show_all(problems, &self.sources, args, as_result);
        }
    }
}

/// Shows problems in the form that was asked for; warnings alone only where something may be said.
pub fn show(problems: Problems, sources: &SourceMap, args: &MessageArgs) {
    if !args.quiet || problems.has_errors() {
        show_all(problems, sources, args, false);
    }
}

fn show_all(problems: Problems, sources: &SourceMap, args: &MessageArgs, as_result: bool) {
    let report = Report::new(problems, sources);
    match args.message_format {
        MessageFormat::Human => note(report.render_human(&style(args.color))),
        MessageFormat::Short => note(report.render_short()),
        MessageFormat::Json if as_result => print(report.render_json()),
        MessageFormat::Json => note(report.render_json()),
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
    } else {
        std::fs::File::open(scene).and_then(|file| file.take(MAX_TEXT + 1).read_to_end(&mut bytes))
    };
    match read {
        Ok(_) if bytes.len() as u64 > MAX_TEXT => Err("it is larger than 1 GiB".to_owned()),
        Ok(_) => Ok(bytes),
        Err(error) => Err(error.to_string()),
    }
}

fn style(color: Color) -> Style {
    let terminal = std::io::stderr().is_terminal();
    let color = match color {
        Color::Always => true,
        Color::Never => false,
        Color::Auto => {
            let plain = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty())
                || std::env::var_os("TERM").is_some_and(|term| term == "dumb");
            terminal && !plain
        }
    };
    let width = if terminal { terminal_width() } else { 100 };
    Style { color, unicode: speaks_unicode(), width }
}

/// The terminal's width, between 60 and 120 columns.
fn terminal_width() -> usize {
    let columns = terminal_size::terminal_size_of(std::io::stderr()).map(|(width, _)| usize::from(width.0));
    columns.unwrap_or(100).clamp(60, 120)
}

/// Whether the locale is one of UTF-8; where nothing is said, plain characters are safe.
fn speaks_unicode() -> bool {
    let said = ["LC_ALL", "LC_CTYPE", "LANG"]
        .into_iter()
        .find_map(|name| std::env::var(name).ok().filter(|v| !v.is_empty()));
    said.is_some_and(|locale| locale.to_lowercase().replace('-', "").contains("utf8"))
}
