//! The mistakes of a conversion, gathered.

use super::gravity::Gravity;
use super::mistake::Mistake;
use miette::{Diagnostic, Severity};
use rustc_hash::FxHashMap;
use std::fmt;
use std::mem::{Discriminant, discriminant};

/// A [`Mistake`] with the severity that the mode of conversion gives it.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvertError {
    /// What it is.
    pub mistake: Mistake,
    /// Errors leave the conversion without a result.
    pub severity: Severity,
}

impl ConvertError {
    /// Whether it keeps the scene from being written.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

impl fmt::Display for ConvertError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.mistake.fmt(f)
    }
}

impl std::error::Error for ConvertError {}

impl Diagnostic for ConvertError {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.mistake.code()
    }
    fn severity(&self) -> Option<Severity> {
        Some(self.severity)
    }
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.mistake.help()
    }
    fn labels(&self) -> Option<Box<dyn Iterator<Item = miette::LabeledSpan> + '_>> {
        self.mistake.labels()
    }
}

/// How many mistakes of a kind are listed; a file of noise has millions.
pub const MOST_OF_A_KIND: usize = 100;

/// Collects mistakes while a file is converted.
#[derive(Debug, Default)]
pub struct Notebook {
    strict: bool,
    list: Vec<ConvertError>,
    /// How many of each kind there were; only looked up.
    counts: FxHashMap<Discriminant<Mistake>, usize>,
    /// How many were not listed.
    unlisted: usize,
}

impl Notebook {
    /// In strict mode, whatever is wrong or not understood is an error.
    pub fn new(strict: bool) -> Self {
        Self { strict, ..Self::default() }
    }

    /// Notes a mistake.
    ///
    /// Mistakes of one kind have one severity, so what is not listed never hides an error.
    pub fn note(&mut self, mistake: Mistake) {
        let count = self.counts.entry(discriminant(&mistake)).or_default();
        *count += 1;
        if *count > MOST_OF_A_KIND {
            self.unlisted += 1;
            return;
        }
        let severity = match mistake.gravity() {
            Gravity::Fatal => Severity::Error,
            Gravity::Wrong | Gravity::Unknown if self.strict => Severity::Error,
            _ => Severity::Warning,
        };
        self.list.push(ConvertError { mistake, severity });
    }

    /// Whether anything noted keeps the scene from being written.
    pub fn has_errors(&self) -> bool {
        self.list.iter().any(ConvertError::is_error)
    }

    /// Everything noted, by the place of the first label; mistakes without a place come last.
    pub fn into_sorted(mut self) -> Vec<ConvertError> {
        if self.unlisted > 0 {
            self.note(Mistake::More { count: self.unlisted });
        }
        self.list.sort_by_key(|error| {
            let first = error.labels().and_then(|mut labels| labels.next());
            first.map_or(usize::MAX, |label| label.offset())
        });
        self.list
    }
}
