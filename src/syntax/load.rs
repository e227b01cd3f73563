//! From the main file to all that it includes and imports.

use super::ast::{File, FileIndex, Item, Program};
use super::error::SyntaxError;
use super::foreign::recognise;
use super::lower::{Load, Lower, Request};
use super::repair::repair;
use crate::diag::{Problems, where_it_was_sought};
use crate::source::{FileId, Files, Missing, SourceMap, Span};
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
        // What is wrong in a file that this one names is noted first; reports are sorted by place in the end.
        let mut own = Problems::default();
        let items = items(&text, base, &mut |request| self.load(source, request), &mut own);
        self.problems.append(own);
        items
    }

    /// The file that an item names: read now, or known already. `None` when there is nothing to put in its place.
    fn load(&mut self, from: FileId, request: &Request) -> Option<FileIndex> {
        let at = request.path.span;
        let path = match self.files.locate(&self.sources.file(from).path, &request.path) {
            Ok(path) => path,
            Err(missing) => return self.lack(request, missing_error(missing, &request.path, at)),
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
            Err(error) => return self.lack(request, error),
        };
        self.sources.set_included_from(id, at);
        let index = self.add(id);
        if !request.is_import {
            self.included.push(index);
        }
        self.fill(index, at);
        Some(index)
    }

    /// Goes on without a file.
    fn lack<T>(&mut self, request: &Request, error: SyntaxError) -> Option<T> {
        self.program.lacks_files |= !request.is_import;
        if request.is_guessed { None } else { self.refuse(error) }
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

/// The items of a text; `load` reads what they name.
pub(super) fn items(text: &str, base: u32, load: &mut Load<'_>, problems: &mut Problems) -> Vec<Item> {
    let repaired = match repair(text, base) {
        Ok(repaired) => repaired,
        Err(error) => {
            problems.push(error);
            return Vec::new();
        }
    };
    let place = repaired.as_text(text, base);
    if let Some(error) = recognise(&place) {
        problems.push(error);
        return Vec::new();
    }
    let mut lower = Lower::new(place, load);
    let items = lower.file();
    std::mem::take(&mut lower.allows).into_iter().for_each(|(code, item)| problems.allow(code, item));
    let errors = lower.finish(repaired.errors.clone(), &repaired.guesses);
    errors.into_iter().for_each(|error| problems.push(error));
    items
}

/// What to say of a file that cannot be found.
fn missing_error(missing: Missing, name: &str, at: Span) -> SyntaxError {
    let path = name.to_owned();
    match missing {
        Missing::NotFound { near, tried } => {
            SyntaxError::FileNotFound { path, at, hint: where_it_was_sought(name, &tried, &near) }
        }
        Missing::Outside { .. } => SyntaxError::FileOutside { path, at },
    }
}

/// A path for people.
fn file_name(path: &Path) -> String {
    path.display().to_string()
}
