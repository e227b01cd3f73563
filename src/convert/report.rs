//! What became of every word and number of a file.

use super::parse::Span;
use std::fmt::Write;

/// What became of a stretch of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It says the same in the result; the text names where.
    Mapped(String),
    /// It is in the result, but not exactly; the text says how.
    Approximated(String),
    /// The original program reads it and does nothing with it.
    Ignored(String),
    /// It is not in the result; the text says why.
    Dropped(String),
}

impl Outcome {
    /// The outcome's name and what is said of it.
    pub fn parts(&self) -> (&'static str, &str) {
        match self {
            Self::Mapped(to) => ("mapped", to),
            Self::Approximated(how) => ("approximated", how),
            Self::Ignored(why) => ("ignored", why),
            Self::Dropped(why) => ("dropped", why),
        }
    }
}

/// A stretch of the file and what became of it. The fates of a file do not overlap, and every word and number
/// lies in one of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fate {
    /// The bytes in question.
    pub span: Span,
    /// What became of them.
    pub outcome: Outcome,
}

/// Renders fates as a table: line, the words, what became of them.
///
/// The report opens with the count of each outcome. Long stretches are shown by their beginning.
pub fn render(text: &str, fates: &[Fate]) -> String {
    let mut out = summary(fates);
    out.push_str("\n\n line  in the file                           what became of it\n");
    let mut line = 1;
    let mut seen = 0;
    for fate in fates {
        line += text[seen..fate.span.start].bytes().filter(|&byte| byte == b'\n').count();
        seen = fate.span.start;
        let (name, detail) = fate.outcome.parts();
        let _ = writeln!(out, "{line:>5}  {:<36}  {name}: {detail}", excerpt(&text[fate.span.clone()]));
    }
    out
}

/// The count of each outcome: "12 mapped, 3 approximated, 0 ignored, 1 dropped".
pub fn summary(fates: &[Fate]) -> String {
    let count = |name| fates.iter().filter(|fate| fate.outcome.parts().0 == name).count();
    let counts =
        ["mapped", "approximated", "ignored", "dropped"].map(|name| format!("{} {name}", count(name)));
    counts.join(", ")
}

/// The fates of every token: those of the report, and between them the braces that end blocks and the separators.
pub fn complete(text: &str, fates: &[Fate]) -> Vec<Fate> {
    let mut all = Vec::new();
    let mut seen = 0;
    for fate in fates {
        all.extend(punctuation(text, seen..fate.span.start));
        all.push(fate.clone());
        seen = fate.span.end;
    }
    all.extend(punctuation(text, seen..text.len()));
    all
}

/// What stands between the words of a file and is no white space.
fn punctuation(text: &str, gap: Span) -> impl Iterator<Item = Fate> + '_ {
    let start = gap.start;
    tokens(&text[gap]).map(move |token| {
        let span = start + token.start..start + token.end;
        let outcome = match &text[span.clone()] {
            "}" | "]" => Outcome::Mapped("ends a block".into()),
            "{" | "[" => Outcome::Mapped("begins a block".into()),
            separator if separator.chars().all(|c| ",;".contains(c)) => {
                Outcome::Ignored("means nothing between values".into())
            }
            _ => Outcome::Dropped("lost with what it belongs to".into()),
        };
        Fate { span, outcome }
    })
}

/// The tokens of a stretch: braces and brackets, and runs of other characters that are no white space.
pub fn tokens(text: &str) -> impl Iterator<Item = Span> + '_ {
    let mut rest = 0;
    std::iter::from_fn(move || {
        let is_space = |c: char| c.is_ascii_whitespace() || matches!(c, '\u{0B}' | '\u{FEFF}');
        let is_brace = |c: char| "{}[]".contains(c);
        let start = rest + text[rest..].find(|c| !is_space(c))?;
        let first = text[start..].chars().next()?;
        let end = match is_brace(first) {
            true => start + first.len_utf8(),
            false => {
                let length = text[start..].find(|c| is_space(c) || is_brace(c));
                let run = &text[start..length.map_or(text.len(), |length| start + length)];
                start + number_before_comment(run).unwrap_or(run.len())
            }
        };
        rest = end;
        Some(start..end)
    })
}

/// How long a number is that a comment touches, as in `20//twenty`.
fn number_before_comment(run: &str) -> Option<usize> {
    let at = run.find("//")?;
    let is_number =
        run[..at].ends_with(|c: char| c.is_ascii_digit() || c == '.') && run[..at].parse::<f64>().is_ok();
    is_number.then_some(at)
}

/// The words of a stretch on one line, at most 36 characters.
fn excerpt(text: &str) -> String {
    const WIDTH: usize = 36;
    let mut line = String::new();
    for word in text.split_whitespace() {
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
        if line.chars().count() > WIDTH {
            return line.chars().take(WIDTH - 2).chain("..".chars()).collect();
        }
    }
    line
}
