//! Limits that make every evaluation end, and end soon.

use super::error::Error;
use super::{Resolver, Value};
use crate::source::Span;

/// Values inside values, definitions that need definitions, calls inside calls: what the stack can bear.
const DEPTH: u32 = 400;
/// Groups, places and names inside each other.
pub const GROUPS: u32 = 400;

/// How much a scene may ask for. Each of these can be raised, for those who mean it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Limits([u64; 5]);

/// What is limited: an index into [`Limits`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Limit {
    /// Objects in the picture.
    Objects,
    /// Turns of all loops together.
    Turns,
    /// Elements of all lists and factors of all transforms together.
    Elements,
    /// Values that are worked out.
    Steps,
    /// Mistakes that are reported.
    Problems,
}

impl Default for Limits {
    fn default() -> Self {
        Self([10_000_000, 50_000_000, 20_000_000, 200_000_000, 10_000])
    }
}

impl Limits {
    /// The names of what is limited.
    pub const NAMES: [&'static str; 5] = ["objects", "turns", "elements", "steps", "problems"];

    /// Changes the limit of this name. `false`: there is none.
    pub fn set(&mut self, name: &str, value: u64) -> bool {
        let index = Self::NAMES.iter().position(|known| *known == name);
        index.map(|index| self.0[index] = value).is_some()
    }

    const fn get(&self, limit: Limit) -> u64 {
        self.0[limit as usize]
    }
}

impl Limit {
    /// What is counted, and what to do about too much of it.
    const fn told(self) -> (&'static str, &'static str) {
        match self {
            Self::Objects => ("objects in the picture", "place fewer"),
            Self::Turns => ("turns of loops", "make the range shorter"),
            Self::Elements => ("elements of lists", "make the lists shorter"),
            Self::Steps => ("steps of evaluation", "let functions call each other less often"),
            Self::Problems => ("mistakes", "mend those before"),
        }
    }
}

/// What has been used up.
#[derive(Default)]
pub struct Budget {
    limits: Limits,
    used: [u64; 5],
    depth: u32,
    /// The limits that were passed; each is reported once.
    passed: Vec<&'static str>,
}

impl Budget {
    /// Nothing used up of these limits.
    pub fn new(limits: &Limits) -> Self {
        Self { limits: limits.clone(), ..Self::default() }
    }

    /// Uses some more of what is limited. `false`: that is too much.
    pub fn spend(&mut self, limit: Limit, count: u64) -> bool {
        let used = &mut self.used[limit as usize];
        *used = used.saturating_add(count);
        *used <= self.limits.get(limit)
    }

    const fn is_spent(&self, limit: Limit) -> bool {
        self.used[limit as usize] > self.limits.get(limit)
    }
}

impl<'a> Resolver<'a> {
    /// Uses some more of what is limited. `false`: that is too much, which is reported, and must not be done.
    pub(super) fn spend(&mut self, limit: Limit, count: u64, used: Span) -> bool {
        self.budget.spend(limit, count) || self.pass(limit, used)
    }

    /// Reports that a limit was passed. Always `false`.
    fn pass(&mut self, limit: Limit, used: Span) -> bool {
        let (what, cure) = limit.told();
        let most = self.budget.limits.get(limit);
        let name = Limits::NAMES[limit as usize];
        let help = format!("{cure}; or allow more: `--limit {name}={}`", most.saturating_mul(10));
        self.over(what, most, used, help)
    }

    /// Whether the picture is full, or time is up: then there is no point in going on.
    pub(super) fn is_full(&self) -> bool {
        self.budget.is_spent(Limit::Objects) || self.budget.is_spent(Limit::Steps)
    }

    /// Does `work` one level deeper, or gives poison when that is too deep or too much.
    pub(super) fn deeper(&mut self, used: Span, work: impl FnOnce(&mut Self) -> Value<'a>) -> Value<'a> {
        if !self.spend(Limit::Steps, 1, used) {
            return Value::Poison;
        }
        if self.budget.depth >= DEPTH {
            let help = "name parts of it with `let`, above where they are used".to_owned();
            self.over("values inside values", DEPTH.into(), used, help);
            return Value::Poison;
        }
        self.budget.depth += 1;
        let value = work(self);
        self.budget.depth -= 1;
        value
    }

    /// Reports, the first time, that a limit was passed. Always `false`: what asked for more does not get it.
    pub(super) fn over(&mut self, what: &'static str, limit: u64, used: Span, help: String) -> bool {
        if !self.budget.passed.contains(&what) {
            self.budget.passed.push(what);
            self.report_all_the_same(Error::Budget { what, limit, used, help });
        }
        false
    }
}
