//! What has gone wrong so far.

use super::{Allow, Report};
use crate::source::{SourceMap, Span};
use miette::Diagnostic;

/// How bad a problem is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Severity {
    /// Suspicious: the scene is rendered all the same.
    Warning,
    /// Wrong: no ray is shot.
    Error,
}

/// A step on the way to a mistake: "included from here", "in this call of `ring`".
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Trail {
    /// Where the step was taken.
    pub span: Span,
    /// What the step was.
    pub text: String,
}

/// One mistake: what the phase says of it, and the way that led there.
pub struct Problem {
    /// The mistake in its phase's own words: message, code, labels, help.
    pub error: Box<dyn Diagnostic + Send + Sync + 'static>,
    /// The steps that led there, the nearest first.
    pub trail: Vec<Trail>,
}

impl Problem {
    /// Warnings say so themselves; everything else is an error.
    pub fn severity(&self) -> Severity {
        match self.error.severity() {
            Some(miette::Severity::Warning | miette::Severity::Advice) => Severity::Warning,
            _ => Severity::Error,
        }
    }

    /// The stable code, such as `snell::resolve::unknown_name`.
    pub fn code(&self) -> String {
        self.error.code().map(|code| code.to_string()).unwrap_or_default()
    }

    /// The offset of the primary label (the first one), by which reports are ordered.
    pub fn offset(&self) -> usize {
        self.error.labels().and_then(|mut labels| labels.next()).map_or(usize::MAX, |label| label.offset())
    }
}

/// The mistakes noted so far. No phase stops at one.
#[derive(Default)]
pub struct Problems {
    pub(super) list: Vec<Problem>,
    /// What the scene silences.
    pub(super) allows: Vec<Allow>,
    error_count: usize,
}

impl Problems {
    /// Notes a mistake.
    pub fn push(&mut self, error: impl Diagnostic + Send + Sync + 'static) {
        self.push_with_trail(error, Vec::new());
    }

    /// Notes a mistake and the steps that led there.
    pub fn push_with_trail(&mut self, error: impl Diagnostic + Send + Sync + 'static, trail: Vec<Trail>) {
        let problem = Problem { error: Box::new(error), trail };
        self.error_count += usize::from(problem.severity() == Severity::Error);
        self.list.push(problem);
    }

    /// Adds what was noted elsewhere.
    pub fn append(&mut self, other: Self) {
        self.error_count += other.error_count;
        self.list.extend(other.list);
        self.allows.extend(other.allows);
    }

    /// Whether anything is wrong, not merely suspicious.
    pub fn has_errors(&self) -> bool {
        self.error_count > 0
    }

    /// Keeps the problems for which `keep` says so.
    pub fn retain(&mut self, keep: impl FnMut(&Problem) -> bool) {
        self.list.retain(keep);
        self.error_count = self.list.iter().filter(|problem| problem.severity() == Severity::Error).count();
    }

    /// What was noted, in the order of noting.
    pub fn list(&self) -> &[Problem] {
        &self.list
    }

    /// The report of all that was noted.
    pub fn into_report(self, sources: &SourceMap) -> Report {
        Report::new(self, sources)
    }

    /// What was noted and is not silenced, in source order; mistakes without a place come last, equal places in the order
    /// of noting.
    pub fn into_sorted(mut self) -> Vec<Problem> {
        self.silence();
        self.list.sort_by_key(Problem::offset);
        self.list
    }
}
