//! Which bracket closes which, and where one is missing or one too many.
//!
//! A text whose brackets pair is left alone. Otherwise each item is mended by itself, with the change after which it
//! reads best (`plausible.rs`): items begin where a word begins a line without indentation. A text that is not
//! written so, or too long to try everything, is mended by plain counting.

use super::plausible::oddity;
use super::token::{Kind, Token, closer};

/// A change that makes the brackets pair, and what was wrong.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Repair {
    /// The bracket at `open` is not closed: `close` belongs at `at`.
    Close { at: usize, open: usize, close: u8 },
    /// The bracket at `close` closes nothing: `open` belongs at `at`.
    Open { at: usize, open: u8, close: usize },
    /// The bracket at `at` closes nothing.
    Remove { at: usize },
    /// The opening bracket at `at` stands there twice.
    Doubled { at: usize },
    /// The bracket at `at` should be `close`, to match the one at `open`.
    Replace { at: usize, open: usize, close: u8 },
}

/// How many brackets of an item may be mended before it counts as hopeless.
const MOST_REPAIRS: usize = 4;
/// How many tokens may be looked at in all: mending stays quick however many items are broken.
const MOST_LOOKS: usize = 20_000_000;

/// The changes that make the brackets among `tokens` pair; `text` has blanks for comments.
pub(super) fn balance(text: &[u8], tokens: &[Token]) -> Vec<Repair> {
    let counted = count(text, tokens);
    if counted.is_empty() {
        return counted;
    }
    let mut search = Search { text, functions: functions(text, tokens), looks: 0 };
    let mut repairs = Vec::new();
    for item in items(text, tokens) {
        repairs.extend(search.mend(item));
    }
    // More mistakes than counting finds: the text is not indented by its structure.
    if repairs.len() <= counted.len() { repairs } else { counted }
}

/// The first bracket that lies more than `limit` deep.
pub(super) fn too_deep(tokens: &[Token], limit: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for token in tokens {
        match token.kind {
            Kind::Open(_) => depth += 1,
            Kind::Close(_) => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > limit {
            return Some(token.start);
        }
    }
    None
}

/// The tokens of each item, as its first line's lack of indentation shows.
fn items<'a>(text: &'a [u8], tokens: &'a [Token]) -> impl Iterator<Item = &'a [Token]> {
    tokens.chunk_by(move |_, token| {
        let joins =
            || matches!(&text[token.range()], b"else" | b"then" | b"or" | b"and" | b"per" | b"as" | b"at");
        !(token.is_first && token.indent == 0 && token.kind == Kind::Word && !joins())
    })
}

/// The names of the functions that a text defines.
fn functions<'a>(text: &'a [u8], tokens: &[Token]) -> Vec<&'a [u8]> {
    let words =
        tokens.windows(2).filter(|pair| &text[pair[0].range()] == b"fn" && pair[1].kind == Kind::Word);
    words.map(|pair| &text[pair[1].range()]).collect()
}

/// The repairs that plain counting finds: an open bracket is closed at the end of what it is in.
fn count(text: &[u8], tokens: &[Token]) -> Vec<Repair> {
    let (mut open, mut repairs): (Vec<Token>, Vec<Repair>) = (Vec::new(), Vec::new());
    let close_before = |open: Token, offset: usize| {
        let Kind::Open(bracket) = open.kind else { unreachable!("only opening brackets are kept") };
        let at = text[..offset].trim_ascii_end().len();
        Repair::Close { at, open: open.start, close: closer(bracket) }
    };
    for &token in tokens {
        match token.kind {
            Kind::Open(_) => open.push(token),
            Kind::Close(close) => {
                let partner = open.iter().rposition(|open| closes(close, open));
                let Some(partner) = partner else {
                    repairs.push(Repair::Remove { at: token.start });
                    continue;
                };
                let unclosed = open.split_off(partner + 1);
                repairs.extend(unclosed.into_iter().rev().map(|open| close_before(open, token.start)));
                open.pop();
            }
            _ => {}
        }
    }
    repairs.extend(open.into_iter().rev().map(|open| close_before(open, text.len())));
    repairs
}

fn closes(close: u8, open: &Token) -> bool {
    matches!(open.kind, Kind::Open(bracket) if closer(bracket) == close)
}

/// A change of one bracket.
#[derive(Clone, Copy)]
enum Edit {
    /// This bracket comes before the token of this index; within a word, such as `rgb0`, at an offset.
    Insert { before: usize, bracket: Token, within: bool },
    /// The token of this index goes.
    Remove(usize),
    /// The token of this index becomes this closing bracket.
    Replace(usize, u8),
}

/// The search for the changes after which an item reads best.
struct Search<'a> {
    text: &'a [u8],
    functions: Vec<&'a [u8]>,
    looks: usize,
}

impl Search<'_> {
    /// The repairs of an item.
    fn mend(&mut self, item: &[Token]) -> Vec<Repair> {
        let (mut repairs, mut tokens) = (Vec::new(), item.to_vec());
        loop {
            let counted = count(self.text, &tokens);
            let best = if repairs.len() < MOST_REPAIRS { self.best(&tokens, &counted) } else { None };
            let Some(best) = best else {
                repairs.extend(counted);
                return repairs;
            };
            let edited = best.apply(&tokens);
            repairs.push(best.repair(&tokens, &edited));
            tokens = edited;
        }
    }

    /// The change after which the tokens read best; `None` when nothing is wrong, or too much to look at.
    fn best(&mut self, tokens: &[Token], counted: &[Repair]) -> Option<Edit> {
        let edits = edits(self.text, tokens, counted);
        self.looks += edits.len() * tokens.len();
        if self.looks > MOST_LOOKS {
            return None;
        }
        let sum = |edit: &Edit| edit.cost(tokens) + oddity(self.text, &edit.apply(tokens), &self.functions);
        // Of equals the last: what is missing is missed late.
        edits.into_iter().rev().filter(|edit| edit.pairs(tokens)).min_by_key(sum)
    }
}

/// The changes that could mend what counting finds.
fn edits(text: &[u8], tokens: &[Token], counted: &[Repair]) -> Vec<Edit> {
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
    fn apply(self, tokens: &[Token]) -> Vec<Token> {
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
    fn pairs(self, tokens: &[Token]) -> bool {
        match self {
            Self::Insert { before, within, .. } => {
                partner(&self.apply(tokens), before + usize::from(within)).is_some()
            }
            Self::Replace(at, _) => partner(&self.apply(tokens), at).is_some(),
            Self::Remove(_) => true,
        }
    }

    /// How unlikely the slip is that this mends: a key that was hit twice, or not at all behind a name, comes first.
    fn cost(self, tokens: &[Token]) -> u32 {
        let is_glued = |first: usize, second: usize| match (tokens.get(first), tokens.get(second)) {
            (Some(first), Some(second)) => first.end == second.start,
            _ => false,
        };
        let is_twin = |a: usize, b: usize| is_glued(a.min(b), a.max(b)) && tokens[a].kind == tokens[b].kind;
        match self {
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
        }
    }

    /// What this mends.
    fn repair(self, tokens: &[Token], edited: &[Token]) -> Repair {
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

#[cfg(test)]
mod tests {
    use super::super::scan::scan;
    use super::*;

    fn repairs(text: &str) -> Vec<Repair> {
        let scan = scan(text);
        balance(&scan.text, &scan.tokens)
    }

    #[test]
    fn pairs_are_left_alone_however_they_are_indented() {
        assert_eq!(repairs("group {\nsphere {\n}\n  }\n(\n)"), []);
    }

    #[test]
    fn a_missing_brace_belongs_where_the_indentation_ends() {
        let text = "group {\n    sphere {\n        radius: 1m\n    plane { y: 0m }\n}\n";
        let at = text.find("\n    plane").unwrap();
        assert_eq!(repairs(text), [Repair::Close { at, open: 19, close: b'}' }]);
    }

    #[test]
    fn a_missing_opening_brace_belongs_after_the_words_that_head_the_block() {
        let text = "group {\n    light sphere\n        radius: 1m\n    }\n    plane { y: 0m }\n}\n";
        let (at, close) = (text.find("\n        radius").unwrap(), text.find("}\n    plane").unwrap());
        assert_eq!(repairs(text), [Repair::Open { at, open: b'{', close }]);
        assert_eq!(repairs("plane y: 0m }"), [Repair::Open { at: 5, open: b'{', close: 12 }]);
    }

    #[test]
    fn a_missing_parenthesis_belongs_on_its_line() {
        let text = "camera {\n    position: (0m, 1m, 2m\n    look_at: (0m, 0m, 0m)\n}\n";
        let at = text.find("\n    look").unwrap();
        assert_eq!(repairs(text), [Repair::Close { at, open: 23, close: b')' }]);
    }

    #[test]
    fn a_missing_parenthesis_belongs_before_the_next_field() {
        let text = "sphere { center: (0m, 1m, 2m, radius: 1m }";
        let at = text.find(", radius").unwrap();
        assert_eq!(repairs(text), [Repair::Close { at, open: 17, close: b')' }]);
        let call = "fn ring(n: int) -> object { a }\nplace ring(1, radius: 1m";
        let open = call.rfind('(').unwrap();
        assert_eq!(repairs(call), [Repair::Close { at: call.len(), open, close: b')' }]);
    }

    #[test]
    fn a_missing_opening_parenthesis_belongs_before_the_value_or_behind_the_function() {
        let point = "sphere { center: 0m, 1m, 2m), radius: 1m }";
        assert_eq!(repairs(point), [Repair::Open { at: 17, open: b'(', close: 27 }]);
        let call = "metal { color: rgb0.9, 0.7, 0.3), roughness: 0.2 }";
        assert_eq!(repairs(call), [Repair::Open { at: 18, open: b'(', close: 31 }]);
    }

    #[test]
    fn a_bracket_of_the_wrong_kind_is_replaced() {
        assert_eq!(repairs("a: (1, 2]"), [Repair::Replace { at: 8, open: 3, close: b')' }]);
    }

    #[test]
    fn a_brace_too_many_is_the_one_that_stands_too_far_right() {
        let text = "group {\n    sphere {\n    }\n    }\n}\n";
        assert_eq!(repairs(text), [Repair::Remove { at: 31 }]);
    }

    #[test]
    fn a_doubled_bracket_is_one_too_many() {
        assert_eq!(repairs("plane {{ y: 0m }"), [Repair::Doubled { at: 7 }]);
        assert_eq!(repairs("a: rotate_y((28deg) then scale(2)"), [Repair::Doubled { at: 12 }]);
        assert_eq!(repairs("mix { a: mirror {}}, amount: 0.25 }"), [Repair::Remove { at: 18 }]);
    }
}
