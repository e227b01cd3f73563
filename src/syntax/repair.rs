//! The text as the grammar reads it: comments blanked, brackets and quotes in pairs.

use super::angles::mend_vectors;
use super::balance::{Repair, balance, too_deep};
use super::error::SyntaxError;
use super::lower::MAX_DEPTH;
use super::scan::{Quote, Scan, scan};
use super::spell::{Slip, slips};
use super::text::Text;
use crate::source::Span;
use std::ops::Range;

/// A text made readable, and what was wrong with it.
pub(super) struct Repaired {
    /// What the grammar reads.
    pub text: String,
    /// Where bytes were put in, in order, as offsets into `text`.
    pub inserted: Vec<usize>,
    /// What was wrong.
    pub errors: Vec<SyntaxError>,
    /// The lines that were mended by guessing: what the grammar finds there follows from the mistake.
    pub guesses: Vec<Range<u32>>,
}

/// Makes a text readable; `base` is its offset among the sources. `Err` when it is nested too deeply to be read at all.
pub(super) fn repair(text: &str, base: u32) -> Result<Repaired, SyntaxError> {
    let mut scan = scan(text);
    let span = |start: usize, end: usize| Span::new(base + start as u32, base + end as u32);
    if let Some(offset) = too_deep(&scan.tokens, MAX_DEPTH) {
        return Err(SyntaxError::TooDeep { limit: MAX_DEPTH, at: span(offset, offset + 1) });
    }
    let vectors = mend_vectors(&mut scan, text, span);
    let repairs = balance(&scan.text, &scan.tokens);
    let mut errors: Vec<SyntaxError> = scan.quotes.iter().map(|quote| quote.report(text, span)).collect();
    errors.extend(scan.stray_ends.iter().map(|&at| SyntaxError::StrayCommentEnd { at: span(at, at + 2) }));
    if let Some(first) = scan.odd_blanks.first() {
        errors.push(unknown_blank(text, first, scan.odd_blanks.len(), span(first.start, first.end)));
    }
    match scan.open_comment {
        // What the comment swallows is not missing.
        Some(start) => errors.push(SyntaxError::UnclosedComment { at: span(start, start + 2) }),
        None => errors.extend(repairs.iter().map(|repair| repair.report(text, span))),
    }
    let slips = slips(&scan.text, &scan.tokens);
    errors.extend(vectors);
    errors.extend(slips.iter().map(|slip| slip.report(text, span)));
    let line_around = |offset: usize| {
        let start = text[..offset].rfind('\n').map_or(0, |end| end + 1);
        let end = text[offset..].find('\n').map_or(text.len(), |length| offset + length);
        base + start as u32..base + end as u32
    };
    let guesses = scan.quotes.iter().map(|quote| line_around(quote.open())).collect();
    let (text, inserted) = apply(scan, &repairs, &slips);
    Ok(Repaired { text, inserted, errors, guesses })
}

/// The report of blanks that are read as plain ones: once for the whole text, since they come in crowds.
fn unknown_blank(text: &str, first: &Range<usize>, count: usize, at: Span) -> SyntaxError {
    let code = text[first.clone()].chars().next().map_or(0, u32::from);
    let others = match count {
        1 => String::new(),
        2 => ", as in one other place".to_owned(),
        _ => format!(", as in {} other places", count - 1),
    };
    let hint = format!("this looks like a space and is none: write a plain one{others}");
    SyntaxError::UnknownCharacter { shown: format!("U+{code:04X}"), hint, at }
}

impl Quote {
    /// Where the text begins.
    const fn open(self) -> usize {
        match self {
            Self::Unclosed { open, .. } | Self::Unopened { open, .. } | Self::Doubled { at: open } => open,
        }
    }

    /// The report.
    fn report(self, text: &str, span: impl Fn(usize, usize) -> Span) -> SyntaxError {
        match self {
            Self::Unclosed { open, close } => {
                SyntaxError::UnclosedQuote { at: span(close, close), opened: span(open, open + 1) }
            }
            Self::Unopened { open, close } => SyntaxError::MissingSign {
                sign: "\"",
                place: format!("before `{}`", &text[open..close]),
                hint: "write `\"` where the text begins, too".to_owned(),
                at: span(open, open),
            },
            Self::Doubled { at } => SyntaxError::DoubledSign { sign: "\"".to_owned(), at: span(at, at + 1) },
        }
    }
}

impl Repair {
    /// The report of what this mends.
    fn report(self, text: &str, span: impl Fn(usize, usize) -> Span) -> SyntaxError {
        let byte = |at: usize| char::from(text.as_bytes()[at]);
        match self {
            Self::Close { at, open, close } => SyntaxError::UnclosedBracket {
                open: byte(open),
                close: close.into(),
                at: span(at, at),
                opened: span(open, open + 1),
            },
            Self::Open { at, open, .. } => {
                let sign = match open {
                    b'(' => "(",
                    b'[' => "[",
                    _ => "{",
                };
                let before = text[..at].trim_end();
                let word =
                    before.rsplit(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default();
                let place = match word {
                    "" => "here".to_owned(),
                    word => format!("after `{word}`"),
                };
                SyntaxError::MissingSign {
                    sign,
                    place,
                    hint: format!("write `{sign}` here"),
                    at: span(at, at),
                }
            }
            Self::Doubled { at } => {
                SyntaxError::DoubledSign { sign: byte(at).to_string(), at: span(at, at + 1) }
            }
            Self::Remove { at } => {
                let close = byte(at);
                let open = match close {
                    ')' => '(',
                    ']' => '[',
                    _ => '{',
                };
                SyntaxError::StrayBracket { open, close, at: span(at, at + 1) }
            }
            Self::Replace { at, open, close } => SyntaxError::MismatchedBracket {
                open: byte(open),
                close: byte(at),
                wanted: close.into(),
                at: span(at, at + 1),
                opened: span(open, open + 1),
            },
        }
    }
}

/// The text with every repair done, and where bytes were put in.
fn apply(scan: Scan, repairs: &[Repair], slips: &[Slip]) -> (String, Vec<usize>) {
    let mut bytes = scan.text;
    let missing = |quote: &Quote| match *quote {
        Quote::Unclosed { close, .. } => Some((close, b'"')),
        Quote::Unopened { open, .. } => Some((open, b'"')),
        Quote::Doubled { .. } => None,
    };
    let mut inserts: Vec<(usize, u8)> = scan.quotes.iter().filter_map(missing).collect();
    for &repair in repairs {
        match repair {
            Repair::Close { at, close, .. } => inserts.push((at, close)),
            Repair::Open { at, open, .. } => inserts.push((at, open)),
            Repair::Remove { at } | Repair::Doubled { at } => bytes[at] = b' ',
            Repair::Replace { at, close, .. } => bytes[at] = close,
        }
    }
    for &slip in slips {
        match slip {
            Slip::Colon { at } => bytes[at] = b' ',
            Slip::Word { start, end, word, .. } => {
                // What does not fit in its place is put in behind it, and what is left of it is blank.
                let (fits, more) = word.as_bytes().split_at(word.len().min(end - start));
                bytes[start..end].fill(b' ');
                bytes[start..start + fits.len()].copy_from_slice(fits);
                inserts.extend(more.iter().map(|&byte| (end, byte)));
            }
        }
    }
    // A stable sort: brackets put in at one place stay in the order in which they close.
    inserts.sort_by_key(|&(at, _)| at);
    let (mut text, mut inserted, mut done) = (Vec::with_capacity(bytes.len() + inserts.len()), Vec::new(), 0);
    for (at, byte) in inserts {
        text.extend_from_slice(&bytes[done..at]);
        inserted.push(text.len());
        text.push(byte);
        done = at;
    }
    text.extend_from_slice(&bytes[done..]);
    (String::from_utf8(text).expect("only whole characters are blanked, only ASCII is put in"), inserted)
}

impl Repaired {
    /// The repaired text with the original beside it.
    pub(super) fn as_text<'a>(&'a self, original: &'a str, base: u32) -> Text<'a> {
        Text { text: &self.text, original, inserted: &self.inserted, base }
    }
}
