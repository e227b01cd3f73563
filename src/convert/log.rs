//! Mistakes and fates: what every reading function writes to.

use super::mistake::Mistake;
use super::notebook::{MOST_OF_A_KIND, Notebook};
use super::parse::{Block, Span};
use super::report::{Fate, Outcome};
use crate::diag::did_you_mean;
use std::collections::{BTreeMap, BTreeSet};

/// What is said of a field that was taken, until its reader says what it becomes.
pub const READ: &str = "read, and lost with what it belongs to";

/// Notes and fates.
#[derive(Debug)]
pub struct Log {
    pub notes: Notebook,
    /// By their beginnings; what is said last of a stretch counts.
    pub fates: BTreeMap<usize, Fate>,
    /// Where the fields begin whose meaning was guessed.
    guessed: BTreeSet<usize>,
    /// How often a word was looked for that may be meant by another.
    proposals: usize,
}

impl Log {
    pub fn new(notes: Notebook) -> Self {
        Self { notes, fates: BTreeMap::new(), guessed: BTreeSet::new(), proposals: 0 }
    }

    pub fn mapped(&mut self, span: &Span, to: impl Into<String>) {
        let to = to.into();
        let outcome = if self.guessed.contains(&span.start) {
            Outcome::Approximated(format!("{to}, by the look of its name"))
        } else {
            Outcome::Mapped(to)
        };
        self.tell(span, outcome);
    }

    pub fn approximated(&mut self, span: &Span, how: impl Into<String>) {
        self.tell(span, Outcome::Approximated(how.into()));
    }

    pub fn ignored(&mut self, span: &Span, why: impl Into<String>) {
        self.tell(span, Outcome::Ignored(why.into()));
    }

    pub fn dropped(&mut self, span: &Span, why: impl Into<String>) {
        self.tell(span, Outcome::Dropped(why.into()));
    }

    /// Tells of a comment, unless it stands in the middle of something that is told of.
    pub fn comment(&mut self, span: &Span) {
        let before = self.fates.range(..=span.start).next_back();
        if before.is_none_or(|(_, fate)| fate.span.end <= span.start) {
            self.ignored(span, "a comment, which the format does not have");
        }
    }

    fn tell(&mut self, span: &Span, outcome: Outcome) {
        self.fates.insert(span.start, Fate { span: span.clone(), outcome });
    }

    /// Notes that a field was given a meaning by the look of its name.
    pub fn guess(&mut self, key: &str, role: &str, span: &Span) {
        if self.guessed.insert(span.start) {
            let at = span.clone().into();
            self.notes.note(Mistake::Guessed { key: key.into(), meant: role.into(), at });
        }
    }

    /// The fates in the order of the file. What was taken without a word was lost on the way.
    pub fn into_fates(self) -> (Vec<Fate>, Notebook) {
        let mut fates: Vec<Fate> = self.fates.into_values().collect();
        for fate in &mut fates {
            if fate.outcome.parts().1 == READ {
                fate.outcome = Outcome::Dropped("lost with what it belongs to".into());
            }
        }
        (fates, self.notes)
    }

    /// Drops a whole block, whatever was said of its parts.
    pub fn drop_all(&mut self, span: &Span, why: &str) {
        let inside: Vec<usize> = self.fates.range(span.clone()).map(|(start, _)| *start).collect();
        for start in inside {
            self.fates.remove(&start);
        }
        self.dropped(span, why);
    }

    /// Takes back what was said to be in the result, for what it belongs to is not.
    pub fn lose(&mut self, span: &Span, why: &str) {
        for (_, fate) in self.fates.range_mut(span.clone()) {
            if matches!(fate.outcome, Outcome::Mapped(_) | Outcome::Approximated(_)) {
                fate.outcome = Outcome::Dropped(why.into());
            }
        }
    }

    /// Notes that only the last of several counts.
    pub fn repeated(&mut self, name: &str, earlier: &Span, last: &Span) {
        self.drop_all(earlier, "repeated further down; the last one counts");
        let (at, last) = (earlier.clone().into(), last.clone().into());
        self.notes.note(Mistake::Repeated { name: name.into(), at, last });
    }

    /// Drops a whole block with a warning.
    pub fn unknown_block(&mut self, block: &Block<'_>, place: String, names: &[&'static str]) {
        self.drop_all(&block.span, "not known to the converter");
        let help = self.proposal(block.name(), names.iter().copied());
        let (name, at) = (block.name().into(), block.head.clone().into());
        self.notes.note(Mistake::UnknownBlock { name, place, at, help });
    }

    /// What may be meant by an unknown word. Looking takes its time, so it ends with the list of mistakes.
    pub fn proposal(&mut self, word: &str, known: impl Iterator<Item = &'static str>) -> Option<String> {
        self.proposals += 1;
        (self.proposals <= 2 * MOST_OF_A_KIND).then(|| did_you_mean(word, known)).flatten()
    }

    /// Notes a value that the converted scene could not have.
    pub fn bad_value(&mut self, what: impl Into<String>, at: &Span, help: &'static str) {
        self.notes.note(Mistake::BadValue { what: what.into(), at: at.clone().into(), help });
    }

    /// Notes a difference from the original that a person should know.
    pub fn differs(&mut self, what: impl Into<String>, at: &Span, help: &'static str) {
        self.notes.note(Mistake::Differs { what: what.into(), at: at.clone().into(), help });
    }

    /// Drops something that is understood and has no counterpart.
    pub fn not_convertible(&mut self, what: impl Into<String>, at: &Span, why: &'static str) {
        self.notes.note(Mistake::NotConvertible { what: what.into(), why, at: at.clone().into() });
    }
}
