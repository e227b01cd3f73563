//! Whole texts: a file with its version, an expression alone.

use super::ast::{Entry, Expr, Item};
use super::error::SyntaxError;
use super::grammar::{Parts, Rule, Snell};
use super::lower::{Lower, MAX_DEPTH};
use crate::diag::nearest;
use pest::Parser;
use pest::error::InputLocation;
use pest::iterators::Pair;
use std::ops::Range;

impl<'a> Lower<'a> {
    /// The text as the grammar reads it.
    fn parse(&mut self, rule: Rule) -> Option<Pair<'a, Rule>> {
        match Snell::parse(rule, self.text.text) {
            Ok(mut pairs) => pairs.next(),
            Err(error) => {
                self.unparsed(&error);
                None
            }
        }
    }

    /// `file = { SOI ~ entry* ~ EOI }`
    pub(super) fn file(&mut self) -> Vec<Item> {
        let Some(file) = self.parse(Rule::file) else { return Vec::new() };
        let mut parts = Parts::of(file);
        self.version(&mut parts);
        let (entries, _) = self.entries(parts, false);
        let as_item = |entry| match entry {
            Entry::Item(item) => Some(item),
            Entry::Field(_) => None,
        };
        entries.into_iter().filter_map(as_item).collect()
    }

    /// `alone = { SOI ~ value ~ EOI }`, as in `--set NAME=VALUE`
    pub(super) fn alone(&mut self) -> Option<Expr> {
        let alone = self.parse(Rule::alone)?;
        let what = "one value, and no more,".to_owned();
        let at = self.text.span(0, self.text.text.len());
        let mut values = self.elements(alone, "values", |lower, value| Some(lower.value(value)));
        match (values.pop(), values.is_empty()) {
            (Some(value), true) => Some(value),
            _ if self.errors.is_empty() => {
                let hint = "write for example `8`, `3cm` or `true`".to_owned();
                self.note(SyntaxError::MissingValue { what, hint, at });
                None
            }
            _ => None,
        }
    }

    /// The mistakes of the whole text: those of its brackets and quotes, and those that do not follow from them.
    pub(super) fn finish(mut self, mut errors: Vec<SyntaxError>, guesses: &[Range<u32>]) -> Vec<SyntaxError> {
        if let &[at, ref rest @ ..] = self.semicolons.as_slice() {
            self.note(SyntaxError::Semicolon { others: others(rest.len()), at });
        }
        if let &[(sign, at), ref rest @ ..] = self.foreign_comments.as_slice() {
            self.note(SyntaxError::ForeignComment { sign, others: others(rest.len()), at });
        }
        // At most one open quote stands on a line, so the lines are in order and apart.
        let follows = |error: &SyntaxError| {
            let line = guesses.partition_point(|line| line.end < error.at());
            guesses.get(line).is_some_and(|line| line.start <= error.at())
        };
        let is_use = |error: &SyntaxError| match error {
            SyntaxError::ReservedWord { word, at } => {
                let mut binders = self.bound_words.iter().filter(|bound| bound.value == *word).peekable();
                binders.peek().is_some() && binders.all(|bound| bound.span != *at)
            }
            _ => false,
        };
        errors.extend(self.errors.iter().filter(|error| !follows(error) && !is_use(error)).cloned());
        errors
    }

    /// `version = { kw_snell ~ number }`, the first thing in a file.
    fn version(&mut self, parts: &mut Parts<'_>) {
        let Some(version) = parts.take(Rule::version) else {
            let misspelt = parts.peek().filter(|first| first.as_rule() == Rule::bare_field);
            let name = misspelt.and_then(|first| first.into_inner().next()).map(|name| self.word(&name));
            let (at, hint) = match name.filter(|name| !nearest(name, ["snell"]).is_empty()) {
                Some(name) => {
                    parts.next();
                    (name.span, "did you mean `snell 1`?")
                }
                None => (self.text.span(0, 0), "put `snell 1` before everything else"),
            };
            self.note(SyntaxError::MissingVersion { at, hint });
            return;
        };
        let number = Parts::of(version).next();
        let Some(number) = number.filter(|number| number.as_str() != "1") else { return };
        let (written, at) = (number.as_str().to_owned(), self.text.span_of(&number));
        self.note(SyntaxError::UnsupportedVersion { written, at });
    }

    /// A text that the parser gave up: brackets that lie too deep for it.
    fn unparsed(&mut self, error: &pest::error::Error<Rule>) {
        let offset = match error.location {
            InputLocation::Pos(offset) | InputLocation::Span((offset, _)) => offset,
        };
        self.note(SyntaxError::TooDeep { limit: MAX_DEPTH, at: self.text.first_char(offset) });
    }
}

/// What to say of a habit that was reported where it is met first.
fn others(count: usize) -> String {
    match count {
        0 => String::new(),
        1 => " (nor does the other one in this file)".to_owned(),
        _ => format!(" (nor do the {count} others in this file)"),
    }
}
