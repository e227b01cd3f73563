//! The parser that pest derives from `grammar/snell.pest`, and the walk over what it found.

use pest::iterators::{Pair, Pairs};

/// The parser.
#[derive(pest_derive::Parser)]
#[grammar = "../grammar/snell.pest"]
pub(super) struct Snell;

/// The parts of a node, without keywords, taken from left to right.
pub(super) struct Parts<'i> {
    pairs: Pairs<'i, Rule>,
}

impl<'i> Parts<'i> {
    /// The parts of `pair`.
    pub(super) fn of(pair: Pair<'i, Rule>) -> Self {
        Self { pairs: pair.into_inner() }
    }

    /// The next part, left in place.
    pub(super) fn peek(&mut self) -> Option<Pair<'i, Rule>> {
        while let Some(pair) = self.pairs.peek() {
            if !is_silent(pair.as_rule()) {
                return Some(pair);
            }
            self.pairs.next();
        }
        None
    }

    /// The kind of the next part.
    pub(super) fn peek_rule(&mut self) -> Option<Rule> {
        self.peek().map(|pair| pair.as_rule())
    }

    /// The next part if it is of this kind.
    pub(super) fn take(&mut self, rule: Rule) -> Option<Pair<'i, Rule>> {
        self.peek().filter(|pair| pair.as_rule() == rule)?;
        self.pairs.next()
    }

    /// The next part.
    pub(super) fn next(&mut self) -> Option<Pair<'i, Rule>> {
        self.pairs.find(|pair| !is_silent(pair.as_rule()))
    }

    /// How many of the parts that are left are of a kind that `is_meant` says.
    pub(super) fn count(&self, is_meant: impl Fn(Rule) -> bool) -> usize {
        self.pairs.clone().filter(|pair| is_meant(pair.as_rule())).count()
    }

    /// All parts that are left.
    pub(super) fn rest(self) -> impl Iterator<Item = Pair<'i, Rule>> {
        self.pairs.filter(|pair| !is_silent(pair.as_rule()))
    }

    /// Whether the next part is of this kind; if so it is taken.
    pub(super) fn skip(&mut self, rule: Rule) -> bool {
        self.take(rule).is_some()
    }
}

/// The end of the text, and the keywords that tell lowering nothing.
fn is_silent(rule: Rule) -> bool {
    use Rule::*;
    matches!(
        rule,
        EOI | kw_snell
            | kw_allow
            | kw_include
            | kw_import
            | kw_units
            | kw_param
            | kw_let
            | kw_fn
            | kw_for
            | kw_while
            | kw_place
            | kw_if
            | kw_else
            | kw_on
    )
}
