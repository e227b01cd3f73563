//! From the main file to all that it includes and imports.

use super::ast::{Entry, Expr, File, FileIndex, Item, Program};
use super::error::SyntaxError;
use super::foreign::recognise;
use super::grammar::{Parts, Rule, Snell};
use super::lower::{Lower, Request};
use super::repair::repair;
use crate::diag::Problems;
use crate::source::{FileId, Files, Missing, SourceMap, Span};
use pest::Parser;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// How deep files may include one another.
const MAX_INCLUDE_DEPTH: usize = 64;
/// The largest scene text in bytes; the parser needs about 25 times as much.
const MAX_TEXT: usize = 16 << 20;

/// Reads files and collects what they hold.
pub(super) struct Loader<'a> {
    sources: &'a mut SourceMap,
    files: &'a dyn Files,
    problems: &'a mut Problems,
    program: Program,
    /// Which files have been spliced in.
    included: Vec<FileIndex>,
    /// The files being read, from the main one inwards, each with the place that names it.
    open: Vec<(FileId, Span)>,
}

impl<'a> Loader<'a> {
    pub(super) fn new(sources: &'a mut SourceMap, files: &'a dyn Files, problems: &'a mut Problems) -> Self {
        Self { sources, files, problems, program: Program::default(), included: Vec::new(), open: Vec::new() }
    }

    /// The main file and all that it names.
    pub(super) fn program(mut self, main: FileId) -> Program {
        let file = self.sources.file(main);
        let (size, start) = (file.text.len(), Span::new(file.base, file.base));
        let index = self.add(main);
        self.included.push(index);
        if size > MAX_TEXT {
            let path = file_name(&self.sources.file(main).path);
            self.problems.push(SyntaxError::FileTooLarge { path, size, limit: MAX_TEXT, at: start });
        } else {
            self.fill(index, start);
        }
        self.program
    }

    /// A place for a file among those of the program.
    fn add(&mut self, source: FileId) -> FileIndex {
        self.program.files.push(File { source, items: Vec::new() });
        FileIndex(self.program.files.len() as u32 - 1)
    }

    /// Reads the text of a file into its place.
    fn fill(&mut self, index: FileIndex, named_at: Span) {
        let source = self.program.files[index.0 as usize].source;
        self.open.push((source, named_at));
        let items = self.items(source);
        self.open.pop();
        self.program.files[index.0 as usize].items = items;
    }

    /// The items of a file.
    fn items(&mut self, source: FileId) -> Vec<Item> {
        let file = self.sources.file(source);
        let (text, base): (Arc<str>, u32) = (file.text.clone(), file.base);
        let repaired = match repair(&text, base) {
            Ok(repaired) => repaired,
            Err(error) => return self.refuse(error).unwrap_or_default(),
        };
        if let Some(error) = recognise(&repaired.text, base) {
            return self.refuse(error).unwrap_or_default();
        }
        let mut load = |request: &Request| self.load(source, request);
        let mut lower = Lower::new(repaired.as_text(&text, base), &mut load);
        let items = lower.file();
        let errors = lower.finish(repaired.errors.clone(), &repaired.guesses);
        errors.into_iter().for_each(|error| self.problems.push(error));
        items
    }

    /// The file that an item names: read now, or known already. `None` when there is nothing to put in its place.
    fn load(&mut self, from: FileId, request: &Request) -> Option<FileIndex> {
        let at = request.path.span;
        let path = match self.files.locate(&self.sources.file(from).path, &request.path) {
            Ok(path) => path,
            Err(missing) => return self.refuse(missing_error(missing, &request.path, at)),
        };
        if let Some(id) = self.sources.by_path(&path) {
            if self.open.iter().any(|&(open, _)| open == id) {
                return self.refuse(self.cycle(id, at));
            }
            if let Some(index) = self.program.files.iter().position(|file| file.source == id) {
                return self.again(FileIndex(index as u32), request);
            }
        }
        if self.open.len() > MAX_INCLUDE_DEPTH {
            return self.refuse(SyntaxError::IncludeDepth { limit: MAX_INCLUDE_DEPTH, at });
        }
        let id = match self.read(&path, at) {
            Ok(id) => id,
            Err(error) => return self.refuse(error),
        };
        self.sources.set_included_from(id, at);
        let index = self.add(id);
        if !request.is_import {
            self.included.push(index);
        }
        self.fill(index, at);
        Some(index)
    }

    fn refuse<T>(&mut self, error: SyntaxError) -> Option<T> {
        self.problems.push(error);
        None
    }

    /// A file that was read before: an import names it again, an inclusion splices it in once.
    fn again(&mut self, index: FileIndex, request: &Request) -> Option<FileIndex> {
        if request.is_import {
            return Some(index);
        }
        let first = !self.included.contains(&index);
        self.included.push(index);
        first.then_some(index)
    }

    /// The text at `path`, added to the sources.
    fn read(&mut self, path: &Path, at: Span) -> Result<FileId, SyntaxError> {
        let name = file_name(path);
        let bytes = self.files.read(path).map_err(|error| SyntaxError::FileUnreadable {
            path: name.clone(),
            reason: error.to_string(),
            at,
        })?;
        let size = bytes.len();
        let too_large = |path| SyntaxError::FileTooLarge { path, size, limit: MAX_TEXT, at };
        if size > MAX_TEXT {
            return Err(too_large(name));
        }
        let text = String::from_utf8(bytes).map_err(|error| SyntaxError::NotUtf8 {
            path: name.clone(),
            offset: error.utf8_error().valid_up_to(),
            at,
        })?;
        self.sources.add(name.clone(), path.to_path_buf(), text.into()).ok_or_else(|| too_large(name))
    }

    /// The report of a circle that the item at `at` closes by naming `id`.
    fn cycle(&self, id: FileId, at: Span) -> SyntaxError {
        let from = self.open.iter().position(|&(open, _)| open == id).unwrap_or(0);
        let round = &self.open[from..];
        let names = round.iter().map(|&(file, _)| file).chain([id]);
        let names: Vec<String> = names.map(|file| format!("`{}`", self.sources.file(file).name)).collect();
        let steps = round.iter().skip(1).map(|&(_, step)| step).collect();
        SyntaxError::FileCycle { cycle: names.join(" -> "), at, steps }
    }
}

impl Lower<'_> {
    /// `file = { SOI ~ entry* ~ EOI }`
    fn file(&mut self) -> Vec<Item> {
        let file = match Snell::parse(Rule::file, self.text.text) {
            Ok(mut pairs) => pairs.next(),
            Err(error) => {
                self.unparsed(&error);
                None
            }
        };
        let Some(file) = file else { return Vec::new() };
        let mut parts = Parts::of(file);
        self.version(&mut parts);
        let (entries, _) = self.entries(parts, false);
        let as_item = |entry| match entry {
            Entry::Item(item) => Some(item),
            Entry::Field(_) => None,
        };
        entries.into_iter().filter_map(as_item).collect()
    }

    /// `alone = { SOI ~ value ~ EOI }`, as in `--set NAME=VALUE`
    pub(super) fn alone(&mut self) -> Option<Expr> {
        let parsed = Snell::parse(Rule::alone, self.text.text).map(|mut pairs| pairs.next());
        let alone = parsed.unwrap_or_else(|error| {
            self.unparsed(&error);
            None
        })?;
        let what = "one value, and no more,".to_owned();
        let at = self.text.span(0, self.text.text.len());
        let mut values = self.elements(alone, "values", |lower, value| Some(lower.value(value)));
        match (values.pop(), values.is_empty()) {
            (Some(value), true) => Some(value),
            _ if self.errors.is_empty() => {
                let hint = "write for example `8`, `3cm` or `true`".to_owned();
                self.note(SyntaxError::MissingValue { what, hint, at });
                None
            }
            _ => None,
        }
    }

    /// The mistakes of the whole text: those of its brackets and quotes, and those that do not follow from them.
    pub(super) fn finish(mut self, mut errors: Vec<SyntaxError>, guesses: &[Range<u32>]) -> Vec<SyntaxError> {
        if let [first, rest @ ..] = self.semicolons.as_slice() {
            let others = match rest.len() {
                0 => String::new(),
                1 => " (nor does the other one in this file)".to_owned(),
                count => format!(" (nor do the {count} others in this file)"),
            };
            let at = *first;
            self.note(SyntaxError::Semicolon { others, at });
        }
        // At most one open quote stands on a line, so the lines are in order and apart.
        let follows = |error: &SyntaxError| {
            let line = guesses.partition_point(|line| line.end < error.at());
            guesses.get(line).is_some_and(|line| line.start <= error.at())
        };
        errors.extend(self.errors.iter().filter(|error| !follows(error)).cloned());
        errors
    }
}

/// What to say of a file that cannot be found.
fn missing_error(missing: Missing, name: &str, at: Span) -> SyntaxError {
    let path = name.to_owned();
    match missing {
        Missing::NotFound { near, .. } => {
            let quoted: Vec<String> = near.iter().map(|name| format!("`{name}`")).collect();
            let hint = (!quoted.is_empty()).then(|| format!("did you mean {}?", quoted.join(" or ")));
            SyntaxError::FileNotFound { path, at, hint }
        }
        Missing::Outside { .. } => SyntaxError::FileOutside { path, at },
    }
}

/// A path for people.
fn file_name(path: &Path) -> String {
    path.display().to_string()
}
