//! Limits that make every evaluation end, and end soon.

use super::error::Error;
use super::{Resolver, Value};
use crate::source::Span;

/// Objects in the picture.
pub const OBJECTS: u64 = 10_000_000;
/// Turns of all loops together.
const TURNS: u64 = 50_000_000;
/// Elements of all lists together.
const ELEMENTS: u64 = 20_000_000;
/// Values inside values, definitions that need definitions, calls inside calls.
const DEPTH: u32 = 400;
/// Groups inside groups.
pub const GROUPS: u32 = 200;

/// What has been used up.
#[derive(Default)]
pub struct Budget {
    objects: u64,
    turns: u64,
    elements: u64,
    depth: u32,
    /// A loop of loops is reported once, and everything ends.
    exhausted: bool,
}

impl<'a> Resolver<'a> {
    /// Notes that `count` more objects come into the picture. `false`: too many.
    pub(super) fn spend_object(&mut self, used: Span) -> bool {
        self.budget.objects += 1;
        let error =
            Error::Budget { what: "objects in the picture", limit: OBJECTS, used, help: "place fewer" };
        self.within(self.budget.objects <= OBJECTS, error)
    }

    /// Notes that a loop will take so many turns. `false`: too many, and then it takes none.
    pub(super) fn spend_turns(&mut self, turns: u64, used: Span) -> bool {
        self.budget.turns = self.budget.turns.saturating_add(turns);
        let help = "make the range shorter";
        let error = Error::Budget { what: "turns of loops", limit: TURNS, used, help };
        self.within(self.budget.turns <= TURNS, error)
    }

    /// Notes that a list grows. `false`: too many.
    pub(super) fn spend_elements(&mut self, count: usize, used: Span) -> bool {
        self.budget.elements += count as u64;
        let help = "make the lists shorter";
        let error = Error::Budget { what: "elements of lists", limit: ELEMENTS, used, help };
        self.within(self.budget.elements <= ELEMENTS, error)
    }

    /// Whether a limit was passed: then there is no point in going on.
    pub(super) fn exhausted(&self) -> bool {
        self.budget.exhausted
    }

    fn within(&mut self, fits: bool, error: Error) -> bool {
        if !fits && !self.budget.exhausted {
            self.budget.exhausted = true;
            self.report(error);
        }
        fits
    }

    /// Does `work` one level deeper, or gives poison when that is too deep.
    pub(super) fn deeper(&mut self, used: Span, work: impl FnOnce(&mut Self) -> Value<'a>) -> Value<'a> {
        if self.budget.depth >= DEPTH {
            let help = "name parts of it with `let`, above where they are used";
            let limit = u64::from(DEPTH);
            return self.poison(Error::Budget { what: "values inside values", limit, used, help });
        }
        self.budget.depth += 1;
        let value = work(self);
        self.budget.depth -= 1;
        value
    }
}
