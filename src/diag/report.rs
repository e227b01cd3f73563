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

    /// The texts that the places lie in.
    pub(super) fn sources(&self) -> &SourceMap {
        &self.sources
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::samples::{Odd, Wrong};

    fn sources(text: &str) -> SourceMap {
        let mut sources = SourceMap::default();
        sources.add("main.snell".to_owned(), "main.snell".into(), text.into()).expect("the text is small");
        sources
    }

    #[test]
    fn a_place_far_to_the_right_is_drawn_with_what_surrounds_it() {
        let text = format!("first\n{}@{}\nlast", "é".repeat(100_000), "x".repeat(100_000));
        let at = text.find('@').expect("it was put there") as u32;
        let mut problems = Problems::default();
        problems.push(Wrong { at: Span::new(at, at + 1) });
        let report = problems.into_report(&sources(&text));
        let human = report.render_human(&Style::default());
        assert!(human.contains("[main.snell:2:100001]"), "{human}");
        assert!(human.contains("é@x") && human.contains("here") && human.len() < 1000, "{human}");
        assert!(
            report
                .render_short()
                .starts_with("main.snell:2:100001: error: something is wrong [snell::test::wrong]")
        );
    }

    #[test]
    fn a_hundred_are_shown_and_the_others_counted() {
        let mut problems = Problems::default();
        (0..130).for_each(|_| problems.push(Wrong { at: Span::new(0, 1) }));
        let short = problems.into_report(&sources("x")).render_short();
        assert_eq!(short.lines().count(), 102);
        assert!(short.ends_with("and 30 more\n130 errors\n"), "{short}");
    }

    #[test]
    fn warnings_are_counted_apart() {
        let mut problems = Problems::default();
        problems.push(Odd { at: Span::new(2, 3) });
        problems.push(Wrong { at: Span::new(2, 3) });
        let report = problems.into_report(&sources("0123456789"));
        assert_eq!((report.error_count(), report.warning_count()), (1, 1));
        assert!(report.render_short().ends_with("1 error, 1 warning\n"));
    }
}
