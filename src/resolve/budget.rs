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
/// Groups, places and names inside each other.
pub const GROUPS: u32 = 400;

/// What has been used up.
#[derive(Default)]
pub struct Budget {
    objects: u64,
    turns: u64,
    elements: u64,
    depth: u32,
    /// The limits that were passed; each is reported once.
    passed: Vec<&'static str>,
}

impl<'a> Resolver<'a> {
    /// Notes that so many more objects come into the picture. `false`: too many, and then none does.
    pub(super) fn spend_objects(&mut self, count: u64, used: Span) -> bool {
        self.budget.objects = self.budget.objects.saturating_add(count);
        self.budget.objects <= OBJECTS || self.over("objects in the picture", OBJECTS, used, "place fewer")
    }

    /// Notes that a loop will take so many turns. `false`: too many, and then it takes none.
    pub(super) fn spend_turns(&mut self, turns: u64, used: Span) -> bool {
        self.budget.turns = self.budget.turns.saturating_add(turns);
        self.budget.turns <= TURNS || self.over("turns of loops", TURNS, used, "make the range shorter")
    }

    /// Notes that a list grows. `false`: too many.
    pub(super) fn spend_elements(&mut self, count: usize, used: Span) -> bool {
        self.budget.elements += count as u64;
        self.budget.elements <= ELEMENTS
            || self.over("elements of lists", ELEMENTS, used, "make the lists shorter")
    }

    /// Whether the picture is full: then there is no point in going on.
    pub(super) fn is_full(&self) -> bool {
        self.budget.objects > OBJECTS
    }

    /// Does `work` one level deeper, or gives poison when that is too deep.
    pub(super) fn deeper(&mut self, used: Span, work: impl FnOnce(&mut Self) -> Value<'a>) -> Value<'a> {
        if self.budget.depth >= DEPTH {
            let help = "name parts of it with `let`, above where they are used";
            self.over("values inside values", DEPTH.into(), used, help);
            return Value::Poison;
        }
        self.budget.depth += 1;
        let value = work(self);
        self.budget.depth -= 1;
        value
    }

    /// Reports, the first time, that a limit was passed. Always `false`: what asked for more does not get it.
    pub(super) fn over(&mut self, what: &'static str, limit: u64, used: Span, help: &'static str) -> bool {
        if !self.budget.passed.contains(&what) {
            self.budget.passed.push(what);
            self.report(Error::Budget { what, limit, used, help });
        }
        false
    }
}
