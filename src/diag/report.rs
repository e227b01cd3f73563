//! All mistakes of a run, in source order, for people and for programs.

use super::human::{self, Style};
use super::json;
use super::{Problem, Problems, Severity};
use crate::source::{SourceMap, Span};
use std::fmt::Write;

/// How many problems are shown; what comes after them is counted.
const MAX_SHOWN: usize = 100;

/// The mistakes of a run with the texts they are in.
pub struct Report {
    /// The mistakes in source order.
    pub problems: Vec<Problem>,
    sources: SourceMap,
}

impl Report {
    /// The report of `problems` in `sources`.
    pub fn new(problems: Problems, sources: &SourceMap) -> Self {
        Self { problems: problems.into_sorted(), sources: sources.clone() }
    }

    /// Whether anything is wrong, not merely suspicious.
    pub fn has_errors(&self) -> bool {
        self.error_count() > 0
    }

    /// How many mistakes forbid to render.
    pub fn error_count(&self) -> usize {
        self.count(Severity::Error)
    }

    /// How many places are merely suspicious.
    pub fn warning_count(&self) -> usize {
        self.count(Severity::Warning)
    }

    fn count(&self, severity: Severity) -> usize {
        self.problems.iter().filter(|problem| problem.severity() == severity).count()
    }

    /// Each problem with the lines it is about, then how many there are. Empty when there is none.
    pub fn render_human(&self, style: &Style) -> String {
        let mut out = String::new();
        for problem in self.problems.iter().take(MAX_SHOWN) {
            human::render(problem, &self.sources, style, &mut out);
        }
        out.push_str(&self.closing_lines());
        out
    }

    /// A line for each problem: `scene.snell:3:7: error: there is no .. [snell::..]`.
    pub fn render_short(&self) -> String {
        let mut out = String::new();
        for problem in self.problems.iter().take(MAX_SHOWN) {
            let place = primary_span(problem).and_then(|span| self.sources.location(span));
            if let Some(place) = place {
                let _ = write!(out, "{place}: ");
            }
            let _ = writeln!(out, "{}: {} [{}]", problem.severity().name(), problem.error, problem.code());
        }
        out.push_str(&self.closing_lines());
        out
    }

    /// An object for each problem, one a line; nothing is left out.
    pub fn render_json(&self) -> String {
        self.problems.iter().map(|problem| format!("{}\n", json::object(problem, &self.sources))).collect()
    }

    /// `and 20 more`, `2 errors, 1 warning`.
    fn closing_lines(&self) -> String {
        let mut out = String::new();
        if let Some(more) = self.problems.len().checked_sub(MAX_SHOWN).filter(|&more| more > 0) {
            let _ = writeln!(out, "and {more} more");
        }
        let counts = [(self.error_count(), "error"), (self.warning_count(), "warning")];
        let counts = counts.iter().filter(|(count, _)| *count > 0);
        let words: Vec<String> = counts
            .map(|&(count, noun)| format!("{count} {noun}{}", if count == 1 { "" } else { "s" }))
            .collect();
        if !words.is_empty() {
            let _ = writeln!(out, "{}", words.join(", "));
        }
        out
    }
}

/// The place of a problem's first label.
pub(super) fn primary_span(problem: &Problem) -> Option<Span> {
    labels(problem).next().map(|(span, _)| span)
}

/// The labels of a problem, the primary one first.
pub(super) fn labels(problem: &Problem) -> impl Iterator<Item = (Span, String)> {
    let labels = problem.error.labels().into_iter().flatten();
    labels.map(|label| {
        let start = label.offset() as u32;
        (Span::new(start, start + label.len() as u32), label.label().unwrap_or_default().to_owned())
    })
}

impl Severity {
    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}
