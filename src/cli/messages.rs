//! Where reports go, and in which form.

use super::args::{Deny, MessageArgs, MessageFormat};
use super::session::style;
use super::{Exit, fail, note, print};
use crate::diag::{Report, Rule, Severity, sarif};
use crate::explain::{Level, Look, Page, find, pages};
use std::io::IsTerminal;

/// The reports of a command on their way to the user.
pub struct Messages<'a> {
    args: &'a MessageArgs,
    /// Whether reports for programs are the command's result: then they go to standard output.
    as_result: bool,
    /// Reports that wait for the end, since one SARIF document holds them all, and what could not be looked at.
    waiting: Vec<Report>,
    troubles: Vec<String>,
}

impl<'a> Messages<'a> {
    /// Messages in the form that `args` ask for.
    pub fn new(args: &'a MessageArgs, as_result: bool) -> Self {
        Self { args, as_result, waiting: Vec::new(), troubles: Vec::new() }
    }

    /// The form that was asked for.
    pub fn args(&self) -> &'a MessageArgs {
        self.args
    }

    /// Shows a report; one of warnings alone only where something may be said. `deny` makes them matter.
    pub fn show(&mut self, report: Report, deny: Option<Deny>) {
        let is_denied = deny.is_some() && report.warning_count() > 0;
        if self.args.quiet && !report.has_errors() && !is_denied {
            return;
        }
        match self.args.message_format {
            MessageFormat::Human => {
                note(report.render_human(&style(self.args.color)));
                note(closing_lines(&report, is_denied));
            }
            MessageFormat::Short => note(report.render_short()),
            MessageFormat::Json => self.result(&report.render_json()),
            MessageFormat::Sarif => self.waiting.push(report),
        }
    }

    /// Says why something cannot be looked at.
    pub fn fail(&mut self, reason: String) -> Exit {
        self.troubles.push(reason.clone());
        fail(reason)
    }

    /// Shows what has to be shown in one piece.
    pub fn finish(self) {
        if self.args.message_format == MessageFormat::Sarif {
            let rules: Vec<Rule> = pages().iter().map(rule).collect();
            self.result(&sarif(&self.waiting, &rules, &self.troubles));
        }
    }

    fn result(&self, text: &str) {
        if self.as_result { print(text) } else { note(text) }
    }
}

/// What follows a report for people: why warnings end the run, and, on a terminal, where to read more.
fn closing_lines(report: &Report, is_denied: bool) -> String {
    let mut out = String::new();
    if is_denied && !report.has_errors() {
        out.push_str("warnings are denied by `--deny warnings`\n");
    }
    let first = report.problems.iter().find_map(|problem| find(&problem.code()).first().copied());
    if let Some(page) = first.filter(|_| std::io::stderr().is_terminal()) {
        out.push_str(&format!("`snell explain {}` tells more\n", page.short_name()));
    }
    out
}

/// A page, as those need it who have only the report.
fn rule(page: &Page) -> Rule {
    Rule {
        code: page.code.to_owned(),
        level: match page.level {
            Level::Error => Severity::Error,
            Level::Warning => Severity::Warning,
        },
        summary: page.summary(),
        description: page.opening(),
        text: page.render(&Look { color: false, width: 100 }),
        markdown: page.markdown.to_owned(),
    }
}
