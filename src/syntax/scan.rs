//! The first look at a text: comments blanked, brackets and line starts noted, open quotes closed.
//!
//! The grammar reads what this leaves: the same bytes at the same places, but for a quote or bracket put in where one
//! was missing, with a blank for each byte that means nothing. Without comments in its way it needs half the time.

use super::error::SyntaxError;
use std::ops::Range;

/// What the first look found.
pub(super) struct Scan {
    /// The text with blanks for comments, tabs and carriage returns. Line ends stay.
    pub text: Vec<u8>,
    /// Brackets and the first words of lines, in order.
    pub marks: Vec<Mark>,
    /// The comments.
    pub comments: Vec<Range<usize>>,
    /// Where quotes are missing, with the texts that want them.
    pub open_quotes: Vec<OpenQuote>,
    /// Blanks other than the plain one: they are read as one.
    pub odd_blanks: Vec<Range<usize>>,
    /// Where a comment begins that does not end.
    pub open_comment: Option<usize>,
    /// Where a comment ends that did not begin.
    pub stray_ends: Vec<usize>,
}

/// A bracket, or the first word of a line.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Mark {
    /// Where it is.
    pub offset: usize,
    /// The bracket, or `None` for a word.
    pub bracket: Option<u8>,
    /// How many blanks its line begins with.
    pub indent: usize,
    /// Which line it is on, from 0.
    pub line: usize,
    /// Whether it is the first thing on its line.
    pub is_first: bool,
}

/// A text that its line does not close.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct OpenQuote {
    /// Where the text begins.
    pub open: usize,
    /// Where its closing quote belongs.
    pub close: usize,
}

/// Looks through `text` once.
pub(super) fn scan(text: &str) -> Scan {
    let mut scanner = Scanner {
        text,
        bytes: text.as_bytes(),
        at: 0,
        line: 0,
        line_start: 0,
        indent: None,
        scan: Scan {
            text: text.as_bytes().to_vec(),
            marks: Vec::new(),
            comments: Vec::new(),
            open_quotes: Vec::new(),
            odd_blanks: Vec::new(),
            open_comment: None,
            stray_ends: Vec::new(),
        },
    };
    if text.starts_with('\u{FEFF}') {
        scanner.blank(0..3);
        scanner.at = 3;
    }
    while let Some(&byte) = scanner.bytes.get(scanner.at) {
        scanner.step(byte);
    }
    scanner.scan
}

struct Scanner<'a> {
    text: &'a str,
    bytes: &'a [u8],
    at: usize,
    line: usize,
    line_start: usize,
    /// The blanks before the first thing on this line, once it was met.
    indent: Option<usize>,
    scan: Scan,
}

impl Scanner<'_> {
    /// Goes past the byte at hand and what belongs to it.
    fn step(&mut self, byte: u8) {
        match byte {
            b'\n' => {
                self.at += 1;
                self.new_line();
            }
            b' ' => self.at += 1,
            b'\t' | b'\r' => self.blank(self.at..self.at + 1),
            b'/' if self.next_is(b'/') => self.line_comment(),
            b'/' if self.next_is(b'*') => self.block_comment(),
            // `*//` is an operator before a comment.
            b'*' if self.next_is(b'/') && !matches!(self.bytes.get(self.at + 2), Some(b'/' | b'*')) => {
                self.scan.stray_ends.push(self.at);
                self.blank(self.at..self.at + 2);
            }
            b'"' => self.text(),
            b'(' | b')' | b'[' | b']' | b'{' | b'}' => self.mark(Some(byte)),
            0x80.. if let Some(blank) = self.odd_blank() => {
                self.scan.odd_blanks.push(blank.clone());
                self.blank(blank);
            }
            _ if self.indent.is_none() => self.mark(None),
            _ => self.at += 1,
        }
    }

    /// A no-break space or the like, as they come with what is pasted from a page.
    fn odd_blank(&self) -> Option<Range<usize>> {
        let rest = self.text.get(self.at..)?;
        let blank = rest.chars().next().filter(|c| c.is_whitespace())?;
        Some(self.at..self.at + blank.len_utf8())
    }

    fn next_is(&self, byte: u8) -> bool {
        self.bytes.get(self.at + 1) == Some(&byte)
    }

    fn new_line(&mut self) {
        self.line += 1;
        self.line_start = self.at;
        self.indent = None;
    }

    /// Notes a bracket, or the first word of a line.
    fn mark(&mut self, bracket: Option<u8>) {
        let is_first = self.indent.is_none();
        let indent = *self.indent.get_or_insert(self.at - self.line_start);
        self.scan.marks.push(Mark { offset: self.at, bracket, indent, line: self.line, is_first });
        self.at += 1;
    }

    /// Writes blanks over all but line ends, and goes past them.
    fn blank(&mut self, range: Range<usize>) {
        self.at = range.end;
        for byte in &mut self.scan.text[range] {
            if *byte != b'\n' {
                *byte = b' ';
            }
        }
    }

    /// `// ..`, up to the end of the line.
    fn line_comment(&mut self) {
        let end = self.line_end();
        self.scan.comments.push(self.at..end);
        self.blank(self.at..end);
    }

    fn line_end(&self) -> usize {
        let rest = &self.bytes[self.at..];
        self.at + rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len())
    }

    /// `/* .. */`, with the comments it holds.
    fn block_comment(&mut self) {
        let start = self.at;
        let (mut depth, mut at) = (0_usize, start);
        let end = loop {
            match self.bytes.get(at..at + 2) {
                Some(b"/*") => (depth, at) = (depth + 1, at + 2),
                Some(b"*/") if depth == 1 => break at + 2,
                Some(b"*/") => (depth, at) = (depth - 1, at + 2),
                Some(_) => at += 1,
                None => {
                    self.scan.open_comment = Some(start);
                    break self.bytes.len();
                }
            }
        };
        self.scan.comments.push(start..end);
        self.blank(start..end);
        let lines = self.bytes[start..end].iter().filter(|&&byte| byte == b'\n').count();
        if lines > 0 {
            self.line += lines;
            self.indent = None;
            let line_end = self.bytes[start..end].iter().rposition(|&byte| byte == b'\n');
            self.line_start = start + line_end.map_or(0, |offset| offset + 1);
        }
    }

    /// A text between quotes; an open one is taken to end before the sign that likely follows it.
    fn text(&mut self) {
        let open = self.at;
        if self.indent.is_none() {
            self.mark(None);
        }
        let end = self.line_end();
        let rest = &self.bytes[open + 1..end];
        if let Some(length) = rest.iter().position(|&byte| byte == b'"') {
            self.at = open + length + 2;
            return;
        }
        let length = rest.iter().position(|byte| b",;()[]{}".contains(byte)).unwrap_or(rest.len());
        let close = open + 1 + rest[..length].trim_ascii_end().len();
        self.scan.open_quotes.push(OpenQuote { open, close });
        self.at = close.max(open + 1);
    }
}

impl OpenQuote {
    /// The report, places given by `span`.
    pub(super) fn report(self, span: impl Fn(usize, usize) -> crate::source::Span) -> SyntaxError {
        SyntaxError::UnclosedQuote {
            at: span(self.close, self.close),
            opened: span(self.open, self.open + 1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blanked(text: &str) -> String {
        String::from_utf8(scan(text).text).expect("blanks keep a text valid")
    }

    #[test]
    fn comments_become_blanks_of_their_length() {
        assert_eq!(blanked("a // b\nc"), "a     \nc");
        assert_eq!(blanked("a /* x /* y */\n */ b"), "a             \n    b");
        assert_eq!(blanked("\"// text\" /* é */"), "\"// text\"         ");
    }

    #[test]
    fn an_open_quote_ends_before_what_likely_follows() {
        let scan = scan("image(\"wood.png), x");
        assert_eq!(scan.open_quotes, [OpenQuote { open: 6, close: 15 }]);
    }

    #[test]
    fn a_comment_without_end_is_noted() {
        assert_eq!(scan("a /* b /* c */").open_comment, Some(2));
    }
}
