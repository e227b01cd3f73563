//! Places in a text: from what the grammar read back to what was written.

use super::grammar::Rule;
use crate::source::Span;
use pest::iterators::Pair;

/// A text as the grammar reads it, and where it lies among the sources.
pub(super) struct Text<'a> {
    /// What the grammar reads.
    pub text: &'a str,
    /// What was written.
    pub original: &'a str,
    /// The offsets into `text` of bytes that were not written, in order.
    pub inserted: &'a [usize],
    /// The offset of the text's first byte among the sources.
    pub base: u32,
}

impl Text<'_> {
    /// The place of a range of bytes.
    pub(super) fn span(&self, start: usize, end: usize) -> Span {
        Span::new(self.base + self.written(start) as u32, self.base + self.written(end) as u32)
    }

    /// Where what stands at `offset` was written.
    fn written(&self, offset: usize) -> usize {
        offset - self.inserted.partition_point(|&inserted| inserted < offset)
    }

    /// The place of a node; exact for tokens, and for others with the blanks after them.
    pub(super) fn span_of(&self, pair: &Pair<'_, Rule>) -> Span {
        let span = pair.as_span();
        self.span(span.start(), span.end())
    }

    /// The place just after the last token before `offset`.
    pub(super) fn after_token(&self, offset: usize) -> Span {
        let end = self.token_end(offset);
        self.span(end, end)
    }

    /// Where the last token before `offset` ends.
    fn token_end(&self, offset: usize) -> usize {
        self.text[..offset].trim_end().len()
    }

    /// The place of a node without the blanks after it.
    pub(super) fn trimmed_span_of(&self, pair: &Pair<'_, Rule>) -> Span {
        let span = pair.as_span();
        self.span(span.start(), self.token_end(span.end()).max(span.start()))
    }

    /// The place of the first line of a node.
    pub(super) fn first_line_of(&self, pair: &Pair<'_, Rule>) -> Span {
        let start = pair.as_span().start();
        let line = pair.as_str().lines().next().unwrap_or_default().trim_end();
        self.span(start, start + line.len())
    }

    /// The place of the character at `offset`.
    pub(super) fn first_char(&self, offset: usize) -> Span {
        let len = self.text[offset..].chars().next().map_or(0, char::len_utf8);
        self.span(offset, offset + len)
    }

    /// Whether `offset` is the first thing on its line.
    pub(super) fn begins_line(&self, offset: usize) -> bool {
        let before = &self.text[..offset];
        let blanks = &before[before.trim_end().len()..];
        blanks.len() == before.len() || blanks.contains('\n')
    }

    /// Whether a sign begins its line and is glued to what follows, as in `-x`.
    pub(super) fn is_glued_line_start(&self, offset: usize) -> bool {
        self.begins_line(offset) && !self.text[offset + 1..].starts_with([' ', '\t', '\r', '\n'])
    }

    /// The operator before `offset`.
    pub(super) fn operator_before(&self, offset: usize) -> String {
        let before = self.text[..offset].trim_end();
        let is_word = before.ends_with(|c: char| c.is_ascii_alphabetic());
        let begin = before.trim_end_matches(|c: char| {
            if is_word { c.is_ascii_alphabetic() } else { "+-*/%^=!<>&|.".contains(c) }
        });
        before[begin.len()..].to_owned()
    }

    /// The `///` lines just above `offset`, joined, without their slashes.
    pub(super) fn doc_above(&self, offset: usize) -> Option<String> {
        let (above, line) = self.original[..self.written(offset)].rsplit_once('\n')?;
        if !line.trim().is_empty() {
            return None;
        }
        let mut lines: Vec<&str> =
            above.rsplit('\n').map_while(|line| line.trim().strip_prefix("///")).collect();
        lines.reverse();
        let lines: Vec<&str> = lines.iter().map(|line| line.strip_prefix(' ').unwrap_or(line)).collect();
        (!lines.is_empty()).then(|| lines.join("\n"))
    }
}
