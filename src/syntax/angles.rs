//! Vectors as POV-Ray writes them, `<0, 2, -3>`: read as `(0, 2, -3)`, and told once for a text.
//!
//! No comparison looks like that: three values between `<` and `>`, with a comma between each two.

use super::error::SyntaxError;
use super::scan::Scan;
use super::token::{Kind, Token};
use crate::source::Span;

/// Mends all of them in what the grammar will read. The report of the first, if there is one.
pub(super) fn mend_vectors(
    scan: &mut Scan,
    text: &str,
    span: impl Fn(usize, usize) -> Span,
) -> Option<SyntaxError> {
    let (mut first, mut count, mut index) = (None, 0, 0);
    while index < scan.tokens.len() {
        let Some(close) = vector_at(&scan.tokens, index) else {
            index += 1;
            continue;
        };
        let (open, end) = (scan.tokens[index].start, scan.tokens[close].start);
        (scan.text[open], scan.text[end]) = (b'(', b')');
        (scan.tokens[index].kind, scan.tokens[close].kind) = (Kind::Open(b'('), Kind::Close(b')'));
        first.get_or_insert((open, end));
        (count, index) = (count + 1, close + 1);
    }
    let (open, end) = first?;
    let parts: Vec<String> = text[open + 1..end].split(',').map(with_unit).collect();
    let others = match count {
        1 => String::new(),
        2 => ", and the other one likewise".to_owned(),
        _ => format!(", and {} others likewise", count - 1),
    };
    let hint = format!("write `({})`{others}", parts.join(", "));
    Some(SyntaxError::WrongSign { written: "<".to_owned(), wanted: "(", hint, at: span(open, open + 1) })
}

/// The index of the `>` that ends the vector beginning at `open`, if one does.
fn vector_at(tokens: &[Token], open: usize) -> Option<usize> {
    if !tokens[open].is(b'<') {
        return None;
    }
    let mut at = open + 1;
    for end in [b',', b',', b'>'] {
        while tokens.get(at)?.is(b'-') || tokens.get(at)?.is(b'+') {
            at += 1;
        }
        let is_value = matches!(tokens.get(at)?.kind, Kind::Number | Kind::Word);
        if !is_value || !tokens.get(at + 1)?.is(end) {
            return None;
        }
        at += 2;
    }
    Some(at - 1)
}

/// A part of a vector as a length: in metres, if it has no unit.
fn with_unit(part: &str) -> String {
    let part = part.trim();
    if part.parse::<f64>().is_ok() { format!("{part}m") } else { part.to_owned() }
}
