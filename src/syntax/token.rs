//! The tokens of a text that may be wrong: what the repairs before the grammar look at.

use std::ops::Range;

/// A token.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Token {
    /// What it is.
    pub kind: Kind,
    /// Its first byte.
    pub start: usize,
    /// One past its last byte.
    pub end: usize,
    /// How many blanks its line begins with.
    pub indent: usize,
    /// Which line it is on, from 0.
    pub line: usize,
    /// Whether it is the first thing on its line.
    pub is_first: bool,
}

/// The kinds of tokens.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    /// A name or a word of the language.
    Word,
    /// A numeral, with the unit glued to it.
    Number,
    /// A text with its quotes.
    Text,
    /// An opening bracket.
    Open(u8),
    /// A closing bracket.
    Close(u8),
    /// Any other character, by its first byte.
    Sign(u8),
}

impl Token {
    /// Its bytes.
    pub fn range(&self) -> Range<usize> {
        self.start..self.end
    }

    /// Whether this is that sign.
    pub fn is(&self, sign: u8) -> bool {
        self.kind == Kind::Sign(sign)
    }

    /// Whether a value may end with it.
    pub fn ends_value(&self) -> bool {
        matches!(self.kind, Kind::Word | Kind::Number | Kind::Text | Kind::Close(_))
    }

    /// Whether a value may begin with it.
    pub fn begins_value(&self) -> bool {
        matches!(self.kind, Kind::Word | Kind::Number | Kind::Text | Kind::Open(_) | Kind::Sign(b'#'))
    }
}

/// How many bytes the word has that a text begins with.
pub(super) fn word_len(text: &[u8]) -> usize {
    text.iter().take_while(|byte| byte.is_ascii_alphanumeric() || **byte == b'_').count()
}

/// The bracket that closes an opening one.
pub(super) const fn closer(open: u8) -> u8 {
    match open {
        b'(' => b')',
        b'[' => b']',
        _ => b'}',
    }
}
