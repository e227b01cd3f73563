//! What miette reads when it draws the lines around a label.
//!
//! All files of a report lie one after the other in an offset space of its own, the file of its primary label first,
//! because snippets are drawn in that order. A span never leaves its file, so that labels in two files become two
//! snippets. Lines beyond [`LONG_LINE`] are cut to the surroundings of the label: columns beyond 65,535 are more than
//! miette can draw.

use crate::source::{FileId, SourceFile, SourceMap, Span};
use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};
use std::ops::Range;

/// The longest line in bytes that is shown whole.
const LONG_LINE: usize = 4096;
/// How many bytes of a long line are shown on each side of a label.
const AROUND: usize = 60;
/// The longest part of a line in bytes that is underlined.
const LONGEST_LABEL: usize = 200;

/// The files that one report shows.
pub(super) struct View<'a> {
    sources: &'a SourceMap,
    /// The files and where they begin, in the order of being shown.
    shown: Vec<(FileId, usize)>,
}

impl<'a> View<'a> {
    /// A view of no file yet.
    pub(super) const fn new(sources: &'a SourceMap) -> Self {
        Self { sources, shown: Vec::new() }
    }

    /// Where a span is drawn: its file is added to the view, and it is cut to its first line and a drawable length.
    pub(super) fn place(&mut self, span: Span) -> Option<SourceSpan> {
        let id = self.sources.find(span.start)?;
        let base = match self.shown.iter().find(|(shown, _)| *shown == id) {
            Some(&(_, base)) => base,
            None => self.show(id),
        };
        let file = self.sources.file(id);
        let start = (span.start - file.base) as usize;
        let line = file.line_range(file.line_of(start));
        let line_end = start.max(line.start + file.text[line.clone()].trim_end().len());
        let end = ((span.end - file.base) as usize).min(line_end).max(start);
        let end = if line.len() > LONG_LINE { end.min(start + LONGEST_LABEL) } else { end };
        Some(SourceSpan::new((base + start).into(), round_up(&file.text, end) - start))
    }

    fn show(&mut self, id: FileId) -> usize {
        // A gap of one byte keeps the end of a file out of the next.
        let last = self.shown.last().map(|&(last, base)| base + self.sources.file(last).text.len() + 1);
        let base = last.unwrap_or(0);
        self.shown.push((id, base));
        base
    }

    /// The file that holds an offset, and where it begins.
    fn find(&self, offset: usize) -> Option<(&'a SourceFile, usize)> {
        let &(id, base) = self.shown.iter().rfind(|(_, base)| *base <= offset)?;
        let file = self.sources.file(id);
        (offset - base <= file.text.len()).then_some((file, base))
    }
}

impl SourceCode for View<'_> {
    fn read_span<'b>(
        &'b self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'b> + 'b>, MietteError> {
        let (file, base) = self.find(span.offset()).ok_or(MietteError::OutOfBounds)?;
        let local = span.offset() - base..span.offset() - base + span.len();
        if local.end > file.text.len() {
            return Err(MietteError::OutOfBounds);
        }
        let shown = match (lines_before, lines_after) {
            (0, 0) => local,
            _ => with_lines(file, local, lines_before, lines_after).ok_or(MietteError::OutOfBounds)?,
        };
        let line = file.line_of(shown.start);
        let column = file.text[file.line_range(line).start..shown.start].chars().count();
        let data = &file.text.as_bytes()[shown.clone()];
        let line_count = data.iter().filter(|&&byte| byte == b'\n').count() + 1;
        let place = SourceSpan::new((base + shown.start).into(), shown.len());
        Ok(Box::new(MietteSpanContents::new_named(file.name.clone(), data, place, line, column, line_count)))
    }
}

/// The lines of `local` and some around it. `None` when `local` joins two places of a line too long to be drawn.
fn with_lines(file: &SourceFile, local: Range<usize>, before: usize, after: usize) -> Option<Range<usize>> {
    let (first, last) = (file.line_of(local.start), file.line_of(local.end));
    let is_long = |line: usize| file.line_range(line).len() > LONG_LINE;
    if (first..=last).any(is_long) {
        return cut(file, local);
    }
    let first = (first.saturating_sub(before)..first)
        .rev()
        .take_while(|&line| !is_long(line))
        .last()
        .unwrap_or(first);
    let end = file.line_count().min(last + 1 + after);
    let last = (last + 1..end).take_while(|&line| !is_long(line)).last().unwrap_or(last);
    let shown = file.line_range(first).start..file.line_range(last).end;
    // The last line feed would begin one more line.
    let shown_end = if file.text[shown.clone()].ends_with('\n') { shown.end - 1 } else { shown.end };
    Some(shown.start..shown_end.max(local.end))
}

/// The surroundings of a label on a long line.
fn cut(file: &SourceFile, local: Range<usize>) -> Option<Range<usize>> {
    if local.len() > LONGEST_LABEL + 4 {
        return None;
    }
    let line = file.line_range(file.line_of(local.start));
    let start = round_up(&file.text, local.start.saturating_sub(AROUND).max(line.start));
    let line_end = line.start + file.text[line].trim_end_matches(['\n', '\r']).len();
    let end = round_up(&file.text, (local.end + AROUND).min(line_end.max(local.end)));
    Some(start.min(local.start)..end)
}

/// The first offset from `offset` on that begins a character.
fn round_up(text: &str, offset: usize) -> usize {
    (offset..text.len()).find(|&at| text.is_char_boundary(at)).unwrap_or(text.len())
}
