//! A problem for people: the lines it is about, drawn by miette.

use super::report::{labels, primary_span};
use super::view::View;
use super::{Problem, Severity};
use crate::source::{SourceMap, Span};
use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode, ThemeCharacters, ThemeStyles,
};
use std::fmt;

/// How many steps of the way to a mistake are shown.
const MAX_TRAIL: usize = 8;

/// How reports look.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// Whether to use ANSI colours.
    pub color: bool,
    /// Whether to draw lines with characters beyond ASCII.
    pub unicode: bool,
    /// The width in columns that text is wrapped to.
    pub width: usize,
}

impl Default for Style {
    /// What every terminal and file shows: no colour, 80 columns.
    fn default() -> Self {
        Self { color: false, unicode: true, width: 80 }
    }
}

/// Draws one problem.
pub(super) fn render(problem: &Problem, sources: &SourceMap, style: &Style, out: &mut String) {
    let theme = GraphicalTheme {
        characters: if style.unicode { ThemeCharacters::unicode() } else { ThemeCharacters::ascii() },
        styles: if style.color { ThemeStyles::ansi() } else { ThemeStyles::none() },
    };
    let handler = GraphicalReportHandler::new_themed(theme);
    let handler = handler.with_links(false).with_width(style.width).with_context_lines(1);
    let shown = Shown::new(problem, sources);
    handler.render_report(out, &shown).expect("writing to a string does not fail");
    out.push('\n');
}

/// The steps by which the file of a problem was reached, from it to the main file.
pub(super) fn inclusions(problem: &Problem, sources: &SourceMap) -> Vec<(Span, String)> {
    let mut steps = Vec::new();
    let mut place = primary_span(problem);
    while let Some(at) =
        place.and_then(|span| sources.find(span.start)).and_then(|id| sources.file(id).included_from)
    {
        steps.push((at, "named from here".to_owned()));
        place = Some(at);
    }
    steps
}

/// A problem with its labels placed in a view of the files they are in.
struct Shown<'a> {
    problem: &'a Problem,
    view: View<'a>,
    labels: Vec<LabeledSpan>,
}

impl<'a> Shown<'a> {
    fn new(problem: &'a Problem, sources: &'a SourceMap) -> Self {
        let mut view = View::new(sources);
        let own: Vec<(Span, String)> = labels(problem).collect();
        // A file that a label names already needs no step that leads there.
        let trail = problem.trail.iter().map(|step| (step.span, step.text.clone()));
        let trail = trail.chain(inclusions(problem, sources)).take(MAX_TRAIL);
        let steps: Vec<(Span, String)> =
            trail.filter(|(span, _)| own.iter().all(|(label, _)| label != span)).collect();
        let mut labels = Vec::new();
        for (index, (span, text)) in own.into_iter().chain(steps).enumerate() {
            let Some(place) = view.place(span) else { continue };
            let text = (!text.is_empty()).then_some(text);
            labels.push(match index {
                0 => LabeledSpan::new_primary_with_span(text, place),
                _ => LabeledSpan::new_with_span(text, place),
            });
        }
        Self { problem, view, labels }
    }
}

impl Diagnostic for Shown<'_> {
    fn code<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        self.problem.error.code()
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.problem.severity() {
            Severity::Error => miette::Severity::Error,
            Severity::Warning => miette::Severity::Warning,
        })
    }

    fn help<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        self.problem.error.help()
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        (!self.labels.is_empty()).then_some(&self.view)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.labels.iter().cloned()))
    }
}

impl std::error::Error for Shown<'_> {}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.problem.error)
    }
}

impl fmt::Debug for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.problem.error)
    }
}
