//! The tokens of a scene, read without the compiler: what stands beside a sign, and which brackets are partners.

use std::ops::Range;

/// A token of a well-formed text.
#[derive(Clone, Debug)]
pub struct Token {
    /// What it is.
    pub kind: Kind,
    /// Its bytes.
    pub range: Range<usize>,
    /// The index of the bracket that it pairs with.
    pub partner: Option<usize>,
    /// The index of the innermost bracket around it.
    pub inside: Option<usize>,
}

/// The kinds of tokens.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// A name or word of the language.
    Word,
    /// A numeral with its unit, or a colour.
    Number,
    /// A text with its quotes.
    Text,
    /// A bracket that opens.
    Open,
    /// A bracket that closes.
    Close,
    /// Any other character.
    Sign,
}

/// The tokens of `text`, whose brackets and quotes pair; comments are none.
pub fn tokens(text: &str) -> Vec<Token> {
    let bytes = text.as_bytes();
    let (mut tokens, mut open, mut at): (Vec<Token>, Vec<usize>, usize) = (Vec::new(), Vec::new(), 0);
    while let Some(&byte) = bytes.get(at) {
        let rest = &text[at..];
        let while_ = |is: fn(char) -> bool| rest.find(|c| !is(c)).unwrap_or(rest.len());
        let (kind, len) = match byte {
            b' ' | b'\t' | b'\r' | b'\n' | 0x80.. => (None, rest.chars().next().map_or(1, char::len_utf8)),
            b'/' if rest.starts_with("//") => (None, while_(|c| c != '\n')),
            b'/' if rest.starts_with("/*") => (None, rest.find("*/").map_or(rest.len(), |end| end + 2)),
            b'"' => (Some(Kind::Text), 1 + rest[1..].find('"').expect("quotes pair") + 1),
            b'(' | b'[' | b'{' => (Some(Kind::Open), 1),
            b')' | b']' | b'}' => (Some(Kind::Close), 1),
            b'0'..=b'9' => (Some(Kind::Number), numeral(rest)),
            b'#' => (Some(Kind::Number), 1 + rest[1..].find(|c: char| !c.is_ascii_hexdigit()).unwrap_or(0)),
            b'a'..=b'z' | b'A'..=b'Z' | b'_' => {
                (Some(Kind::Word), while_(|c| c.is_ascii_alphanumeric() || c == '_'))
            }
            _ => (Some(Kind::Sign), 1),
        };
        if let Some(kind) = kind {
            let index = tokens.len();
            let partner = if kind == Kind::Close { open.pop() } else { None };
            if let Some(partner) = partner {
                tokens[partner].partner = Some(index);
            }
            tokens.push(Token { kind, range: at..at + len, partner, inside: open.last().copied() });
            if kind == Kind::Open {
                open.push(index);
            }
        }
        at += len;
    }
    tokens
}

/// How many bytes a numeral and its unit have; `0..4` is three tokens.
fn numeral(rest: &str) -> usize {
    let bytes = rest.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit() || **b == b'_').count();
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') && bytes.get(end + 1).is_some_and(u8::is_ascii_digit) {
        end += 1 + digits(end + 1);
    }
    end + bytes[end..].iter().take_while(|b| b.is_ascii_alphanumeric() || **b == b'%').count()
}
