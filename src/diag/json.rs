//! A problem for programs.

use super::Problem;
use super::report::{labels, primary_span};
use crate::source::{SourceMap, Span};
use serde_json::{Value, json};

/// One problem: severity, code, message, help, where it is (as its first label says), labels, and the steps that led there.
pub(super) fn object(problem: &Problem, sources: &SourceMap) -> Value {
    let place = |(index, (span, text)): (usize, (Span, String))| {
        let mut place = place(span, &text, sources);
        place["primary"] = (index == 0).into();
        place
    };
    let trail = problem.trail.iter().map(|step| (step.span, step.text.clone()));
    let trail = trail.chain(super::human::inclusions(problem, sources));
    let first = primary_span(problem).and_then(|span| sources.location(span));
    json!({
        "severity": problem.severity().name(),
        "code": problem.code(),
        "message": problem.error.to_string(),
        "help": problem.error.help().map(|help| help.to_string()),
        "file": first.as_ref().map(|place| place.file.as_str()),
        "line": first.as_ref().map(|place| place.line),
        "column": first.as_ref().map(|place| place.column),
        "labels": labels(problem).enumerate().map(place).collect::<Vec<_>>(),
        "trail": trail.map(|(span, text)| self::place(span, &text, sources)).collect::<Vec<_>>(),
    })
}

/// A span as a file, lines and columns (from 1, in characters; the end is left out), and bytes from the start of the file.
fn place(span: Span, text: &str, sources: &SourceMap) -> Value {
    let Some(file) = sources.find(span.start).map(|id| sources.file(id)) else {
        return json!({ "text": text });
    };
    let (first, last) = (sources.location(span), sources.location(span.after()));
    json!({
        "text": text,
        "file": file.name,
        "line": first.as_ref().map(|place| place.line),
        "column": first.as_ref().map(|place| place.column),
        "end_line": last.as_ref().map(|place| place.line),
        "end_column": last.as_ref().map(|place| place.column),
        "start": span.start - file.base,
        "end": span.end - file.base,
    })
}
