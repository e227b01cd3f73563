//! The reports of a run for code scanners and editors: one document in SARIF 2.1.0 (OASIS 2020).

use super::report::labels;
use super::{Problem, Report, Severity, human};
use crate::source::{SourceFile, SourceMap, Span};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// What is known of a code, for those who read a report without the program at hand.
#[derive(Clone, Debug)]
pub struct Rule {
    /// The code: `snell::resolve::unknown_name`.
    pub code: String,
    /// Whether what it reports forbids to render.
    pub level: Severity,
    /// What it means, in a sentence.
    pub summary: String,
    /// What it means, in a paragraph.
    pub description: String,
    /// Its page as plain text.
    pub text: String,
    /// Its page in Markdown.
    pub markdown: String,
}

/// The document of `reports`, which may share files. `rules` are looked up by code; `troubles` say what kept the program
/// from looking at something.
pub fn sarif(reports: &[Report], rules: &[Rule], troubles: &[String]) -> String {
    let codes: BTreeSet<String> =
        reports.iter().flat_map(|report| &report.problems).map(Problem::code).collect();
    let codes: Vec<&str> = codes.iter().map(String::as_str).collect();
    let mut artifacts = Artifacts::default();
    let mut results = Vec::new();
    for report in reports {
        for file in report.sources().files() {
            artifacts.index(file); // also of those in which nothing is wrong
        }
        let of_report = report.problems.iter();
        results.extend(of_report.map(|problem| result(problem, report.sources(), &codes, &mut artifacts)));
    }
    let rule = |code: &&str| match rules.iter().find(|rule| rule.code == *code) {
        Some(rule) => rule.object(),
        None => json!({ "id": code }),
    };
    let trouble = |text: &String| json!({ "level": "error", "message": message(text) });
    let document = json!({
        "$schema": "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "snell",
                "version": env!("CARGO_PKG_VERSION"),
                "semanticVersion": env!("CARGO_PKG_VERSION"),
                "rules": codes.iter().map(rule).collect::<Vec<_>>(),
            }},
            "invocations": [{
                "executionSuccessful": troubles.is_empty(),
                "toolExecutionNotifications": troubles.iter().map(trouble).collect::<Vec<_>>(),
            }],
            "columnKind": "unicodeCodePoints",
            "artifacts": artifacts.list,
            "results": results,
        }],
    });
    format!("{document:#}\n")
}

impl Rule {
    /// Braces stay single here: unlike a result's message, these texts take no arguments.
    fn object(&self) -> Value {
        json!({
            "id": self.code,
            "shortDescription": { "text": self.summary },
            "fullDescription": { "text": self.description },
            "help": { "text": self.text, "markdown": self.markdown },
            "defaultConfiguration": { "level": self.level.name() },
        })
    }
}

fn result(problem: &Problem, sources: &SourceMap, codes: &[&str], artifacts: &mut Artifacts) -> Value {
    let code = problem.code();
    let text = match problem.error.help() {
        Some(help) => format!("{}.\nhelp: {help}", problem.error),
        None => format!("{}.", problem.error),
    };
    let mut places = labels(problem);
    let trail = problem.trail.iter().map(|step| (step.span, step.text.clone()));
    let primary = places.next().and_then(|place| location(place, sources, artifacts));
    let others = places.chain(trail).chain(human::inclusions(problem, sources));
    let mut related: Vec<Value> = others.filter_map(|place| location(place, sources, artifacts)).collect();
    related.iter_mut().enumerate().for_each(|(id, location)| location["id"] = id.into());
    json!({
        "ruleId": code,
        "ruleIndex": codes.binary_search(&code.as_str()).ok(),
        "level": problem.severity().name(),
        "message": message(&text),
        "locations": primary.into_iter().collect::<Vec<_>>(),
        "relatedLocations": related,
    })
}

/// A message without arguments: in it a brace would begin one, and is doubled to mean itself (section 3.11.5).
fn message(text: &str) -> Value {
    json!({ "text": text.replace('{', "{{").replace('}', "}}") })
}

fn location((span, text): (Span, String), sources: &SourceMap, artifacts: &mut Artifacts) -> Option<Value> {
    let file = sources.file(sources.find(span.start)?);
    let (start, end) = (sources.location(span)?, sources.location(span.after())?);
    let mut location = json!({ "physicalLocation": {
        "artifactLocation": artifacts.location(file),
        "region": {
            "startLine": start.line,
            "startColumn": start.column,
            "endLine": end.line,
            "endColumn": end.column,
            "byteOffset": span.start - file.base,
            "byteLength": span.len(),
        },
    }});
    if !text.is_empty() {
        location["message"] = message(&text);
    }
    Some(location)
}

/// The texts that were looked at, each once.
#[derive(Default)]
struct Artifacts {
    list: Vec<Value>,
    by_name: BTreeMap<String, usize>,
}

impl Artifacts {
    /// The number of a text in the list; it is added when it is new.
    fn index(&mut self, file: &SourceFile) -> usize {
        if let Some(&index) = self.by_name.get(&file.name) {
            return index;
        }
        let index = self.list.len();
        let mut artifact = match is_on_disk(file) {
            true => json!({ "location": { "uri": uri(&file.name), "index": index } }),
            // What was typed is nowhere else.
            false => json!({ "description": { "text": file.name }, "contents": { "text": &*file.text } }),
        };
        artifact["length"] = file.text.len().into();
        artifact["encoding"] = "UTF-8".into();
        self.list.push(artifact);
        self.by_name.insert(file.name.clone(), index);
        index
    }

    fn location(&mut self, file: &SourceFile) -> Value {
        let index = self.index(file);
        match is_on_disk(file) {
            true => json!({ "uri": uri(&file.name), "index": index }),
            false => json!({ "index": index }),
        }
    }
}

/// Whether a text is a file, and not standard input or a value of the command line.
fn is_on_disk(file: &SourceFile) -> bool {
    file.path == Path::new(&file.name)
}

/// A path as a URI: relative as it is, absolute with the scheme `file`.
fn uri(path: &str) -> String {
    let path = if cfg!(windows) { path.replace('\\', "/") } else { path.to_owned() };
    let path = path.strip_prefix("./").unwrap_or(&path);
    let is_drive = cfg!(windows) && path.as_bytes().get(1) == Some(&b':');
    let scheme = match is_drive {
        true => "file:///",
        false if path.starts_with('/') => "file://",
        false => "",
    };
    let encoded = path.bytes().map(|byte| match byte {
        b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
            char::from(byte).to_string()
        }
        _ => format!("%{byte:02X}"),
    });
    format!("{scheme}{}", encoded.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_become_uris() {
        assert_eq!(uri("./scenes/a b.snell"), "scenes/a%20b.snell");
        assert_eq!(uri("/tmp/köln#1.snell"), "file:///tmp/k%C3%B6ln%231.snell");
        assert_eq!(uri("a:b%.snell"), "a%3Ab%25.snell");
        assert_eq!(uri("../lib/x.snell"), "../lib/x.snell");
    }

    #[test]
    fn braces_are_doubled() {
        assert_eq!(message("write `units { .. }`"), json!({ "text": "write `units {{ .. }}`" }));
    }
}
