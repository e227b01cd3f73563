//! Changes of single brackets, from which the search for a repair chooses.

use super::balance::{Repair, closes};
use super::token::{Kind, Token, closer};

/// What every change costs, so that few are preferred to many.
const EACH: u32 = 3;

/// A change of one bracket.
#[derive(Clone, Copy)]
pub(super) enum Edit {
    /// This bracket comes before the token of this index; within a word, such as `rgb0`, at an offset.
    Insert { before: usize, bracket: Token, within: bool },
    /// The token of this index goes.
    Remove(usize),
    /// The token of this index becomes this closing bracket.
    Replace(usize, u8),
}

/// The changes that could mend what counting finds.
pub(super) fn edits(text: &[u8], tokens: &[Token], counted: &[Repair]) -> Vec<Edit> {
    let byte = |at: usize| text.get(at).copied().unwrap_or_default();
    let (mut unclosed, mut unopened) = (Vec::new(), Vec::new());
    for repair in counted {
        match *repair {
            Repair::Close { close, .. } if !unclosed.contains(&close) => unclosed.push(close),
            Repair::Remove { at } if !unopened.contains(&byte(at)) => unopened.push(byte(at)),
            _ => {}
        }
    }
    let mut edits = Vec::new();
    for &close in &unclosed {
        edits.extend(those(tokens, |token| closes(close, token)).map(Edit::Remove));
        edits.extend((1..=tokens.len()).map(|before| insert(tokens, before, Kind::Close(close))));
        for &wrong in &unopened {
            edits.extend(
                those(tokens, |token| token.kind == Kind::Close(wrong)).map(|at| Edit::Replace(at, close)),
            );
        }
    }
    for &close in &unopened {
        let open = opener(close);
        edits.extend(those(tokens, |token| token.kind == Kind::Close(close)).map(Edit::Remove));
        edits.extend((1..tokens.len()).map(|before| insert(tokens, before, Kind::Open(open))));
        edits.extend((0..tokens.len()).filter_map(|at| within(text, tokens, at, open)));
    }
    edits
}

fn those(tokens: &[Token], is_meant: impl Fn(&Token) -> bool) -> impl Iterator<Item = usize> {
    tokens.iter().enumerate().filter(move |(_, token)| is_meant(token)).map(|(index, _)| index)
}

/// A bracket before a token: braces and closing brackets stand right after what precedes them, others before what follows.
fn insert(tokens: &[Token], before: usize, kind: Kind) -> Edit {
    let last = tokens[before - 1];
    let leans_on = match kind {
        Kind::Open(b'(' | b'[') => tokens[before],
        _ => last,
    };
    let at = if matches!(kind, Kind::Open(b'(' | b'[')) { leans_on.start } else { last.end };
    let bracket = Token { kind, start: at, end: at, is_first: false, ..leans_on };
    Edit::Insert { before, bracket, within: false }
}

/// A bracket inside `rgb0`, which is a name and a number grown together.
fn within(text: &[u8], tokens: &[Token], at: usize, open: u8) -> Option<Edit> {
    let token = tokens[at];
    let digits = text[token.range()].iter().position(u8::is_ascii_digit);
    let at_digit =
        token.start + digits.filter(|&offset| token.kind == Kind::Word && offset > 0 && open != b'{')?;
    let bracket = Token { kind: Kind::Open(open), start: at_digit, end: at_digit, is_first: false, ..token };
    Some(Edit::Insert { before: at, bracket, within: true })
}

impl Edit {
    /// The tokens with this change.
    pub(super) fn apply(self, tokens: &[Token]) -> Vec<Token> {
        let mut edited = tokens.to_vec();
        match self {
            Self::Insert { before, bracket, within: false } => edited.insert(before, bracket),
            Self::Insert { before, bracket, within: true } => {
                let word = &mut edited[before];
                let number = Token { kind: Kind::Number, start: bracket.start, is_first: false, ..*word };
                word.end = bracket.start;
                edited.splice(before + 1..before + 1, [bracket, number]);
            }
            Self::Remove(at) => drop(edited.remove(at)),
            Self::Replace(at, close) => edited[at].kind = Kind::Close(close),
        }
        edited
    }

    /// Whether what is put in finds a partner.
    pub(super) fn pairs(self, tokens: &[Token]) -> bool {
        match self {
            Self::Insert { before, within, .. } => {
                partner(&self.apply(tokens), before + usize::from(within)).is_some()
            }
            Self::Replace(at, _) => partner(&self.apply(tokens), at).is_some(),
            Self::Remove(_) => true,
        }
    }

    /// How unlikely the slip is that this mends: a key that was hit twice, or not at all behind a name, comes first.
    pub(super) fn cost(self, tokens: &[Token]) -> u32 {
        let is_glued = |first: usize, second: usize| match (tokens.get(first), tokens.get(second)) {
            (Some(first), Some(second)) => first.end == second.start,
            _ => false,
        };
        let is_twin = |a: usize, b: usize| is_glued(a.min(b), a.max(b)) && tokens[a].kind == tokens[b].kind;
        let more = match self {
            Self::Insert { within: true, .. } => 0,
            Self::Insert { before, bracket, .. } => {
                let after_name = tokens[before - 1].kind == Kind::Word && is_glued(before - 1, before);
                u32::from(!(after_name && bracket.kind == Kind::Open(b'(')))
            }
            Self::Remove(at) => match is_twin(at, at + 1) || at > 0 && is_twin(at - 1, at) {
                true => 0,
                false => 2,
            },
            Self::Replace(..) => 1,
        };
        EACH + more
    }

    /// What this mends.
    pub(super) fn repair(self, tokens: &[Token], edited: &[Token]) -> Repair {
        match self {
            Self::Insert { before, bracket, within } => {
                let own = before + usize::from(within);
                let partner = partner(edited, own).map_or(bracket.start, |partner| edited[partner].start);
                match bracket.kind {
                    Kind::Open(open) => Repair::Open { at: bracket.start, open, close: partner },
                    Kind::Close(close) => Repair::Close { at: bracket.start, open: partner, close },
                    _ => unreachable!("only brackets are put in"),
                }
            }
            Self::Remove(at) => match tokens[at].kind {
                Kind::Open(_) => Repair::Doubled { at: tokens[at].start },
                _ => Repair::Remove { at: tokens[at].start },
            },
            Self::Replace(at, close) => {
                let open = partner(edited, at).map_or(tokens[at].start, |partner| edited[partner].start);
                Repair::Replace { at: tokens[at].start, open, close }
            }
        }
    }
}

/// The index of the bracket that pairs with the one at `own`.
fn partner(tokens: &[Token], own: usize) -> Option<usize> {
    let step = |token: &Token| match token.kind {
        Kind::Open(_) => 1,
        Kind::Close(_) => -1,
        _ => 0,
    };
    let mut depth = 0;
    let mut is_level = |at: &usize| {
        depth += step(&tokens[*at]);
        depth == 0
    };
    let found = match tokens[own].kind {
        Kind::Open(_) => (own..tokens.len()).find(|at| is_level(at)),
        _ => (0..=own).rev().find(|at| is_level(at)),
    };
    found.filter(|&found| match (tokens[own.min(found)].kind, tokens[own.max(found)].kind) {
        (Kind::Open(open), Kind::Close(close)) => closer(open) == close,
        _ => false,
    })
}

/// The bracket that opens what a closing one closes.
const fn opener(close: u8) -> u8 {
    match close {
        b')' => b'(',
        b']' => b'[',
        _ => b'{',
    }
}
