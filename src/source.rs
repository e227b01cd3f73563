//! Source texts and places in them.
//!
//! All files of a run share one offset space: a [`Span`] is a pair of offsets into it, and the [`SourceMap`] says
//! which file, line and column that is. So one diagnostic can point into several files.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

mod files;
pub use files::{Disk, Files, Memory, Missing};

/// A half-open range of bytes in the offset space of a [`SourceMap`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Span {
    /// The first byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The bytes from `start` to before `end`.
    pub const fn new(start: u32, end: u32) -> Self {
        Self { start, end }
    }

    /// The smallest span that holds both.
    pub fn to(self, other: Self) -> Self {
        Self::new(self.start.min(other.start), self.end.max(other.end))
    }

    /// The place just after this span: where a missing token belongs.
    pub const fn after(self) -> Self {
        Self::new(self.end, self.end)
    }

    /// The number of bytes.
    pub const fn len(self) -> usize {
        (self.end - self.start) as usize
    }

    /// Whether the span holds no byte.
    pub const fn is_empty(self) -> bool {
        self.start == self.end
    }
}

impl fmt::Debug for Span {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}..{}", self.start, self.end)
    }
}

impl From<Span> for miette::SourceSpan {
    fn from(span: Span) -> Self {
        Self::new((span.start as usize).into(), span.len())
    }
}

/// A value with the place where it was written.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Where it was written.
    pub span: Span,
}

impl<T> Spanned<T> {
    /// `value`, written at `span`.
    pub const fn new(value: T, span: Span) -> Self {
        Self { value, span }
    }

    /// The same place with another value.
    pub fn map<U>(self, f: impl FnOnce(T) -> U) -> Spanned<U> {
        Spanned::new(f(self.value), self.span)
    }
}

impl<T> std::ops::Deref for Spanned<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.value
    }
}

/// Index of a file in its [`SourceMap`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct FileId(pub u32);

/// A text that was read, with what is needed to find a line in it.
#[derive(Clone)]
pub struct SourceFile {
    /// The name shown to people, as they would type it.
    pub name: String,
    /// Where the file is; includes and assets are looked for beside it.
    pub path: PathBuf,
    /// The text, valid UTF-8.
    pub text: Arc<str>,
    /// The offset of the text's first byte.
    pub base: u32,
    /// The place that names this file, `None` for the main one.
    pub included_from: Option<Span>,
    line_starts: Arc<[u32]>,
}

impl SourceFile {
    /// The span of the whole text.
    pub fn span(&self) -> Span {
        Span::new(self.base, self.base + self.text.len() as u32)
    }

    /// The number of lines: one more than the number of line feeds.
    pub fn line_count(&self) -> usize {
        self.line_starts.len()
    }

    /// The line (from 0) that holds the byte at `local`, an offset into this text.
    pub fn line_of(&self, local: usize) -> usize {
        self.line_starts.partition_point(|&start| start as usize <= local) - 1
    }

    /// The bytes of a line (from 0), its line feed included.
    pub fn line_range(&self, line: usize) -> std::ops::Range<usize> {
        let start = self.line_starts[line] as usize;
        let end = self.line_starts.get(line + 1).map_or(self.text.len(), |&next| next as usize);
        start..end
    }
}

/// A place as people count: lines and columns from 1, columns in characters.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Location {
    /// The name of the file.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1, in characters.
    pub column: usize,
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)
    }
}

/// Every text of a run, in the order in which they were read.
#[derive(Clone, Default)]
pub struct SourceMap {
    files: Vec<SourceFile>,
}

impl SourceMap {
    /// Adds a text. `None` when the texts of the run would exceed the 4 GiB that a [`Span`] can address.
    pub fn add(&mut self, name: String, path: PathBuf, text: Arc<str>) -> Option<FileId> {
        // A gap of one byte between files keeps an empty span at the end of one out of the next.
        let base = self.files.last().map_or(Some(0), |last| last.span().end.checked_add(1))?;
        u32::try_from(text.len()).ok()?.checked_add(base)?.checked_add(1)?;
        let ends = text.bytes().enumerate().filter(|&(_, byte)| byte == b'\n').map(|(i, _)| i as u32 + 1);
        let line_starts = std::iter::once(0).chain(ends).collect();
        self.files.push(SourceFile { name, path, text, base, included_from: None, line_starts });
        Some(FileId(self.files.len() as u32 - 1))
    }

    /// Says which place named a file.
    pub fn set_included_from(&mut self, id: FileId, place: Span) {
        self.files[id.0 as usize].included_from = Some(place);
    }

    /// The file with this index.
    pub fn file(&self, id: FileId) -> &SourceFile {
        &self.files[id.0 as usize]
    }

    /// Every file, in the order in which they were read.
    pub fn files(&self) -> &[SourceFile] {
        &self.files
    }

    /// The file that was read from `path`, if one was.
    pub fn by_path(&self, path: &Path) -> Option<FileId> {
        self.files.iter().position(|file| file.path == path).map(|index| FileId(index as u32))
    }

    /// The file that holds the byte at `offset`.
    pub fn find(&self, offset: u32) -> Option<FileId> {
        let index = self.files.partition_point(|file| file.base <= offset).checked_sub(1)?;
        (offset <= self.files[index].span().end).then_some(FileId(index as u32))
    }

    /// The text of a span that lies in one file.
    pub fn text(&self, span: Span) -> &str {
        let Some(id) = self.find(span.start) else { return "" };
        let file = self.file(id);
        let local = (span.start - file.base) as usize..(span.end - file.base) as usize;
        file.text.get(local).unwrap_or("")
    }

    /// Where a span begins, for people.
    pub fn location(&self, span: Span) -> Option<Location> {
        let file = self.file(self.find(span.start)?);
        let local = (span.start - file.base) as usize;
        let line = file.line_of(local);
        let before = file.text.get(file.line_range(line).start..local).unwrap_or("");
        Some(Location { file: file.name.clone(), line: line + 1, column: before.chars().count() + 1 })
    }
}
