//! The first look at a text: comments blanked, tokens noted, quotes mended.
//!
//! The grammar reads what this leaves: the same bytes at the same places, but for what was put in where something was
//! missing, with a blank for each byte that means nothing. Without comments in its way it needs half the time.

use super::token::{Kind, Token, word_len};
use std::ops::Range;

/// What the first look found.
pub(super) struct Scan {
    /// The text with blanks for comments, tabs and carriage returns. Line ends stay.
    pub text: Vec<u8>,
    /// Everything else, in order. Of `data [..]` only the word and the brackets.
    pub tokens: Vec<Token>,
    /// The comments.
    pub comments: Vec<Range<usize>>,
    /// What is wrong with the quotes of texts.
    pub quotes: Vec<Quote>,
    /// Blanks other than the plain one: they are read as one.
    pub odd_blanks: Vec<Range<usize>>,
    /// Where a comment begins that does not end.
    pub open_comment: Option<usize>,
    /// Where a comment ends that did not begin.
    pub stray_ends: Vec<usize>,
}

/// A mistake in the quotes of a text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Quote {
    /// The text that begins at `open` is not closed on its line: that belongs at `close`.
    Unclosed { open: usize, close: usize },
    /// What ends at `close` should begin with a quote at `open`.
    Unopened { open: usize, close: usize },
    /// A quote beside another.
    Doubled { at: usize },
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
            tokens: Vec::new(),
            comments: Vec::new(),
            quotes: Vec::new(),
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
            b'"' => self.quote(),
            b'[' if self.follows_data() => {
                self.token(Kind::Open(b'['), 1);
                let is_bulk = |byte: &u8| byte.is_ascii_digit() || b" ,.+-eE\t\r".contains(byte);
                self.at += self.bytes[self.at..].iter().take_while(|byte| is_bulk(byte)).count();
            }
            b'(' | b'[' | b'{' => self.token(Kind::Open(byte), 1),
            b')' | b']' | b'}' => self.token(Kind::Close(byte), 1),
            b'0'..=b'9' => self.token(Kind::Number, number_len(&self.bytes[self.at..])),
            b'a'..=b'z' | b'A'..=b'Z' | b'_' => self.token(Kind::Word, word_len(&self.bytes[self.at..])),
            0x80.. => match self.odd_blank() {
                Some(blank) => {
                    self.scan.odd_blanks.push(blank.clone());
                    self.blank(blank);
                }
                None => {
                    let len = self.text[self.at..].chars().next().map_or(1, char::len_utf8);
                    self.token(Kind::Sign(byte), len);
                }
            },
            _ => self.token(Kind::Sign(byte), 1),
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

    /// Whether the bracket at hand holds numbers in bulk.
    fn follows_data(&self) -> bool {
        let last = self.scan.tokens.last();
        last.is_some_and(|last| last.kind == Kind::Word && &self.bytes[last.range()] == b"data")
    }

    fn new_line(&mut self) {
        self.line += 1;
        self.line_start = self.at;
        self.indent = None;
    }

    /// Notes a token, and goes past it.
    fn token(&mut self, kind: Kind, len: usize) {
        let is_first = self.indent.is_none();
        let indent = *self.indent.get_or_insert(self.at - self.line_start);
        let (start, end) = (self.at, self.at + len);
        self.scan.tokens.push(Token { kind, start, end, indent, line: self.line, is_first });
        self.at = end;
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

    /// What begins with a quote: a text, or one with a quote too many or too few.
    fn quote(&mut self) {
        let (open, end) = (self.at, self.line_end());
        let rest = &self.bytes[open + 1..end];
        match rest.iter().position(|&byte| byte == b'"') {
            // `""room.snell"`: nothing stands between the first two, and a third closes what follows.
            Some(0) if rest.get(1).is_some_and(|&byte| is_path(byte)) => {
                self.scan.quotes.push(Quote::Doubled { at: open });
                self.blank(open..open + 1);
            }
            Some(length) => {
                self.token(Kind::Text, length + 2);
                self.closing_twin();
            }
            None => self.half_a_text(open, end),
        }
    }

    /// `"room.snell""`: the second of two quotes that close a text.
    fn closing_twin(&mut self) {
        let after = self.bytes.get(self.at + 1).copied().unwrap_or(b'\n');
        let others = self.bytes[self.at..self.line_end()].iter().filter(|&&byte| byte == b'"').count();
        if self.bytes.get(self.at) == Some(&b'"') && others % 2 == 1 && !is_path(after) {
            self.scan.quotes.push(Quote::Doubled { at: self.at });
            self.blank(self.at..self.at + 1);
        }
    }

    /// A quote without another on its line: the end of a text when it is glued to what may be one, or else the beginning.
    fn half_a_text(&mut self, quote: usize, end: usize) {
        let line = &self.bytes[self.line_start..quote];
        let before = line.iter().rev().take_while(|byte| is_path(**byte)).count();
        let glued = self.bytes[quote + 1..end].first().is_some_and(|&byte| is_path(byte));
        if before > 0 && !glued {
            return self.unopened(quote - before, quote);
        }
        let rest = &self.bytes[quote + 1..end];
        let close = quote + 1 + open_text_len(rest);
        self.scan.quotes.push(Quote::Unclosed { open: quote, close });
        self.token(Kind::Text, close.max(quote + 1) - quote);
    }

    /// What stands before a lone quote becomes a text.
    fn unopened(&mut self, open: usize, close: usize) {
        self.scan.quotes.push(Quote::Unopened { open, close });
        let tokens = &mut self.scan.tokens;
        let first = tokens.partition_point(|token| token.end <= open);
        if let Some(token) = tokens.get_mut(first) {
            *token = Token { kind: Kind::Text, start: open, end: close + 1, ..*token };
            tokens.truncate(first + 1);
        }
        self.at = close + 1;
    }
}

/// How long a text is that its line does not close: up to the sign that likely follows it, or a word that belongs to what
/// names a file.
fn open_text_len(rest: &[u8]) -> usize {
    let signs = rest.iter().position(|byte| b",;()[]{}".contains(byte)).unwrap_or(rest.len());
    let words = [&b" as "[..], b" at "].into_iter();
    let word =
        words.filter_map(|word| rest[..signs].windows(word.len()).position(|found| found == word)).min();
    rest[..word.unwrap_or(signs)].trim_ascii_end().len()
}

/// Whether a byte may stand in the name of a file.
fn is_path(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || b"_./-".contains(&byte)
}

/// How many bytes a numeral has, with the unit glued to it.
fn number_len(text: &[u8]) -> usize {
    let is_part = |at: usize| text.get(at).is_some_and(|byte| byte.is_ascii_alphanumeric() || *byte == b'_');
    let mut len = 1;
    loop {
        let is_point = text.get(len) == Some(&b'.') && text.get(len + 1).is_some_and(u8::is_ascii_digit);
        let is_sign = matches!(text[len - 1], b'e' | b'E')
            && matches!(text.get(len), Some(b'+' | b'-'))
            && text.get(len + 1).is_some_and(u8::is_ascii_digit);
        if !(is_part(len) || is_point || is_sign) {
            break;
        }
        len += 1;
    }
    len + usize::from(text.get(len) == Some(&b'%'))
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
        assert_eq!(scan("image(\"wood.png), x").quotes, [Quote::Unclosed { open: 6, close: 15 }]);
        assert_eq!(scan("import \"a.snell as b").quotes, [Quote::Unclosed { open: 7, close: 15 }]);
    }

    #[test]
    fn a_quote_behind_a_name_closes_it() {
        assert_eq!(scan("image(wood.png\")").quotes, [Quote::Unopened { open: 6, close: 14 }]);
    }

    #[test]
    fn a_doubled_quote_is_no_empty_text() {
        assert_eq!(scan("image(\"\"wood.png\")").quotes, [Quote::Doubled { at: 6 }]);
        assert_eq!(scan("image(\"wood.png\"\")").quotes, [Quote::Doubled { at: 16 }]);
        assert_eq!(scan("[\"\", \"\"]").quotes, []);
    }

    #[test]
    fn a_comment_without_end_is_noted() {
        assert_eq!(scan("a /* b /* c */").open_comment, Some(2));
    }
}
