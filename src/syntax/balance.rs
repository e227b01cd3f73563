//! Which bracket closes which, and where one is missing or one too many.
//!
//! A text whose brackets pair is left alone. Otherwise each item is mended by itself, with the change after which it
//! reads best (`plausible.rs`): items begin where a word begins a line without indentation. A text that is not
//! written so, or too long to try everything, is mended by plain counting.

use super::edit::{Edit, edits};
use super::plausible::{UNPAIRED, oddity};
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
/// How many ways to mend an item are followed at once.
const BEAM: usize = 4;
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

/// Whether a bracket closes the one that a token is.
pub(super) fn closes(close: u8, open: &Token) -> bool {
    matches!(open.kind, Kind::Open(bracket) if closer(bracket) == close)
}

/// An item with some of its brackets mended.
struct State {
    tokens: Vec<Token>,
    repairs: Vec<Repair>,
    /// What the changes cost, without how odd the item reads now.
    cost: u32,
}

/// The search for the changes after which an item reads best.
struct Search<'a> {
    text: &'a [u8],
    functions: Vec<&'a [u8]>,
    looks: usize,
}

impl Search<'_> {
    /// The repairs of an item: a beam search, since one mistake may make the right cure of another look odd.
    fn mend(&mut self, item: &[Token]) -> Vec<Repair> {
        let mut beam = vec![State { tokens: item.to_vec(), repairs: Vec::new(), cost: 0 }];
        for _ in 0..MOST_REPAIRS {
            let is_done = |state: &State| count(self.text, &state.tokens).is_empty();
            if beam.iter().all(is_done) || !self.may_look(&beam) {
                break;
            }
            beam = self.step(beam);
        }
        let best = beam.swap_remove(0);
        let rest = count(self.text, &best.tokens);
        best.repairs.into_iter().chain(rest).collect()
    }

    /// Whether another step is not too much: a bracket may be put in at every place, and each is looked at as a whole.
    fn may_look(&mut self, beam: &[State]) -> bool {
        self.looks += beam.iter().map(|state| state.tokens.len().saturating_pow(2)).sum::<usize>();
        self.looks <= MOST_LOOKS
    }

    /// The states that read best after one more change of each, the best first.
    fn step(&mut self, beam: Vec<State>) -> Vec<State> {
        let mut next: Vec<(u32, usize, Option<Edit>)> = Vec::new();
        for (index, state) in beam.iter().enumerate() {
            let edits = edits(self.text, &state.tokens, &count(self.text, &state.tokens));
            if edits.is_empty() {
                next.push((state.cost + oddity(self.text, &state.tokens, &self.functions), index, None));
            }
            let total = |edit: Edit| {
                let edited = edit.apply(&state.tokens);
                state.cost + edit.cost(&state.tokens) + oddity(self.text, &edited, &self.functions)
            };
            // Of equals the last: what is missing is missed late.
            let edits = edits.into_iter().rev().filter(|edit| edit.pairs(&state.tokens));
            next.extend(edits.map(|edit| (total(edit), index, Some(edit))));
        }
        if next.is_empty() {
            return beam;
        }
        next.sort_by_key(|&(total, ..)| total);
        // A bracket that is replaced mends two mistakes at once: the states that are not whole yet are not to be judged
        // against such a one.
        let unfinished = next.partition_point(|&(total, ..)| total < UNPAIRED);
        let (whole, rest) = next.split_at(unfinished);
        let best = whole.iter().take(BEAM).chain(rest.iter().take(BEAM)).copied();
        best.map(|(_, index, edit)| beam[index].after(edit)).collect()
    }
}

impl State {
    /// This state with one more change.
    fn after(&self, edit: Option<Edit>) -> Self {
        let Some(edit) = edit else {
            return Self { tokens: self.tokens.clone(), repairs: self.repairs.clone(), cost: self.cost };
        };
        let tokens = edit.apply(&self.tokens);
        let repair = edit.repair(&self.tokens, &tokens);
        let repairs = self.repairs.iter().copied().chain([repair]).collect();
        Self { repairs, cost: self.cost + edit.cost(&self.tokens), tokens }
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
