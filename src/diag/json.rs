//! A problem for programs.

use super::Problem;
use super::report::labels;
use crate::source::{SourceMap, Span};
use serde_json::{Value, json};

/// One problem: severity, code, message, help, labels, and the steps that led there.
pub(super) fn object(problem: &Problem, sources: &SourceMap) -> Value {
    let place = |(index, (span, text)): (usize, (Span, String))| {
        let mut place = place(span, &text, sources);
        place["primary"] = (index == 0).into();
        place
    };
    let trail = problem.trail.iter().map(|step| (step.span, step.text.clone()));
    let trail = trail.chain(super::human::inclusions(problem, sources));
    json!({
        "severity": problem.severity().name(),
        "code": problem.code(),
        "message": problem.error.to_string(),
        "help": problem.error.help().map(|help| help.to_string()),
        "labels": labels(problem).enumerate().map(place).collect::<Vec<_>>(),
        "trail": trail.map(|(span, text)| self::place(span, &text, sources)).collect::<Vec<_>>(),
    })
}

/// A span as a file, line and column (from 1, in characters), and bytes from the start of the file.
fn place(span: Span, text: &str, sources: &SourceMap) -> Value {
    let Some(file) = sources.find(span.start).map(|id| sources.file(id)) else {
        return json!({ "text": text });
    };
    let location = sources.location(span);
    json!({
        "text": text,
        "file": file.name,
        "line": location.as_ref().map(|location| location.line),
        "column": location.as_ref().map(|location| location.column),
        "start": span.start - file.base,
        "end": span.end - file.base,
    })
}
