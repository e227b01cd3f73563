//! The canonical form of a scene text.
//!
//! Lines end where their author ended them; indentation, blanks and blank lines are set by rule: four blanks a level, one
//! between words, none inside parentheses, at most one blank line. Every comment stays where it was. Formatting twice gives
//! the same as formatting once.

mod token;

use crate::diag::Problems;
use crate::source::{FileId, SourceMap};
use crate::syntax;
use token::{Kind, Token, tokens};

/// The blanks of one level.
const INDENT: usize = 4;

/// The canonical form of a file; `None`, and reports, when it has syntax errors.
pub fn format(sources: &SourceMap, id: FileId, problems: &mut Problems) -> Option<String> {
    let mut own = Problems::default();
    syntax::parse_file(sources, id, &mut own);
    let is_sound = !own.has_errors();
    problems.append(own);
    is_sound.then(|| layout(&tokens(&sources.file(id).text)))
}

/// The tokens as canonical text.
fn layout(tokens: &[Token<'_>]) -> String {
    let mut out = String::new();
    let mut levels = Levels::default();
    for (index, token) in tokens.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| &tokens[before]);
        match before {
            Some(before) if starts_line(before, token) => {
                let is_inner = before.kind != Kind::Open && token.kind != Kind::Close;
                out.push_str(if token.line_ends > 1 && is_inner { "\n\n" } else { "\n" });
                let level = levels.start_line(&tokens[..index], &tokens[index..]);
                out.extend(std::iter::repeat_n(' ', INDENT * level));
            }
            Some(before) if is_spaced(&tokens[..index], before, token) => out.push(' '),
            _ => {}
        }
        out.push_str(token.text);
        levels.pass(token);
    }
    if !out.is_empty() {
        out.push('\n');
    }
    out.replace("\r\n", "\n")
}

/// Whether a token begins a line, as it did in what was written.
fn starts_line(before: &Token<'_>, token: &Token<'_>) -> bool {
    let is_empty_block = before.text == "{" && token.text == "}";
    before.kind == Kind::LineComment || token.line_ends > 0 && !is_empty_block
}

/// How deep lines are indented.
#[derive(Default)]
struct Levels {
    open: Vec<Bracket>,
    /// Whether a bracket opened on this line is still open and counts.
    has_counted: bool,
    /// Whether this line goes on with the expression of the line before.
    goes_on: bool,
}

/// An open bracket.
#[derive(Clone, Copy)]
struct Bracket {
    /// Whether its line is one level less deep than what it holds: of the brackets of a line one counts.
    counts: bool,
    /// Whether its line goes on with another, and so is one level deeper itself.
    goes_on: bool,
}

impl Levels {
    /// The level of the line that begins with the first of `after`.
    fn start_line(&mut self, before: &[Token<'_>], after: &[Token<'_>]) -> usize {
        self.has_counted = false;
        // Closing brackets at the start of a line stand where the line of the outermost partner does.
        let closing = after
            .iter()
            .enumerate()
            .take_while(|(index, token)| token.kind == Kind::Close && (*index == 0 || token.line_ends == 0));
        let (open, closed) = self.open.split_at(self.open.len().saturating_sub(closing.count()));
        self.goes_on = match closed.first() {
            Some(partner) => partner.counts && partner.goes_on,
            None => continues(before, &after[0]),
        };
        let counted = open.iter().filter(|bracket| bracket.counts);
        counted.map(|bracket| 1 + usize::from(bracket.goes_on)).sum::<usize>() + usize::from(self.goes_on)
    }

    /// Goes past a token.
    fn pass(&mut self, token: &Token<'_>) {
        match token.kind {
            Kind::Open => {
                self.open.push(Bracket { counts: !self.has_counted, goes_on: self.goes_on });
                self.has_counted = true;
            }
            Kind::Close => {
                let counted = self.open.pop().is_some_and(|bracket| bracket.counts);
                self.has_counted &= !counted;
            }
            _ => {}
        }
    }
}

/// Whether a line that begins with `token` goes on with the expression of the line before.
fn continues(before: &[Token<'_>], token: &Token<'_>) -> bool {
    let is_comment = |token: &&Token<'_>| matches!(token.kind, Kind::LineComment | Kind::BlockComment);
    let joins = |token: &Token<'_>| token.kind == Kind::Operator || is_joining_word(token.text);
    match before.iter().rev().find(|token| !is_comment(token)) {
        Some(last) if last.kind == Kind::Open || last.text == "," => false,
        Some(last) => joins(token) || joins(last) || last.text == ":",
        None => false,
    }
}

/// The words that join two values.
fn is_joining_word(word: &str) -> bool {
    matches!(word, "then" | "per" | "or" | "and" | "not" | "in" | "as")
}

/// Whether a blank stands between two tokens of one line; `tokens` are those up to `before`.
fn is_spaced(tokens: &[Token<'_>], before: &Token<'_>, token: &Token<'_>) -> bool {
    let is_tight = |text: &str| matches!(text, ".." | "..=" | "^" | ".");
    match (before.text, token.text) {
        _ if token.kind == Kind::LineComment || token.kind == Kind::BlockComment => true,
        _ if before.kind == Kind::BlockComment => token.text != ",",
        ("{", "}") => false,
        ("{", _) | (_, "}") => true,
        ("(" | "[", _) | (_, ")" | "]" | "," | ":" | ";") => false,
        (tight, _) | (_, tight) if is_tight(tight) => false,
        // A bracket glued to a name calls or indexes it, one apart from it begins a value: that tells, so it stays.
        (_, "(" | "[") if matches!(before.kind, Kind::Word | Kind::Close) => token.is_apart,
        _ => !is_sign(tokens),
    }
}

/// Whether the last of these tokens is a sign before its operand, as in `-x`.
fn is_sign(tokens: &[Token<'_>]) -> bool {
    let Some((last, before)) = tokens.split_last() else { return false };
    if last.text != "-" && last.text != "+" {
        return false;
    }
    // Without a value on its left it cannot join two.
    before.last().is_none_or(|before| match before.kind {
        Kind::Word => is_joining_word(before.text),
        Kind::Literal | Kind::Close | Kind::Raw => false,
        Kind::Open | Kind::Mark | Kind::Operator => true,
        Kind::LineComment | Kind::BlockComment => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn formatted(text: &str) -> String {
        layout(&tokens(text))
    }

    #[test]
    fn blanks_are_set_by_rule() {
        let wild = "snell 1\r\n\r\n\r\n\r\nlet a=3*( 2+ -x )^2\nsphere{radius:5cm,center:( 0m,1m , 2m )}\nfor i in 0 .. n{}\n";
        let tame = "snell 1\n\nlet a = 3 * (2 + -x)^2\nsphere { radius: 5cm, center: (0m, 1m, 2m) }\nfor i in 0..n {}\n";
        assert_eq!(formatted(wild), tame);
    }

    #[test]
    fn what_glues_and_what_does_not_stays_so() {
        let text = "let a = bezier [(0m, 1m)]\nlet b = xs[0].y + ring(2)\nlet c = data [1 -2 3]\nlet d = 1024 x 768\nlet e = n % 2 + 50%\n";
        assert_eq!(formatted(text), text);
        assert_eq!(formatted("let d = 1024x768"), "let d = 1024 x 768\n");
    }

    #[test]
    fn lines_are_indented_by_their_brackets() {
        let text = "group {\nplace ring(2, sphere {\n// here\nradius: 5cm /* there */\n})\nlet k = 1 +\n2\nlet b =\nsphere {\nradius: 1m\n}\n}\n";
        let expected = "group {\n    place ring(2, sphere {\n        // here\n        radius: 5cm /* there */\n    })\n    let k = 1 +\n        2\n    let b =\n        sphere {\n            radius: 1m\n        }\n}\n";
        assert_eq!(formatted(text), expected);
    }
}
