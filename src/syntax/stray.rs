//! What should not be there: operators of other languages, lines that cannot be read.

use super::error::SyntaxError;
use super::foreign;
use super::grammar::Rule;
use super::lower::{Lower, is_reserved};
use pest::iterators::Pair;

impl Lower<'_> {
    /// An item that is none.
    pub(super) fn stray(&mut self, pair: &Pair<'_, Rule>) {
        match pair.as_rule() {
            Rule::version => self.note(SyntaxError::MisplacedVersion { at: self.text.trimmed_span_of(pair) }),
            Rule::directive => {
                self.foreign("POV-Ray's language", foreign::directive_hint(pair.as_str()), pair)
            }
            Rule::command => self.foreign("pbrt's language", foreign::command_hint(pair.as_str()), pair),
            _ if foreign::is_tag(pair.as_str()) => {
                let hint = foreign::tag_hint(pair.as_str()).to_owned();
                self.foreign("XML, as Mitsuba reads it", hint, pair);
            }
            _ => self.unreadable(pair),
        }
    }

    fn foreign(&mut self, language: &'static str, hint: String, pair: &Pair<'_, Rule>) {
        let at = self.text.first_line_of(pair);
        // What is said the same way is told once.
        let is_told =
            |error: &SyntaxError| matches!(error, SyntaxError::Foreign { hint: told, .. } if *told == hint);
        if self.errors.iter().any(is_told) {
            return;
        }
        self.note(SyntaxError::Foreign { language, hint, at });
    }

    /// Text that no rule reads.
    pub(super) fn unreadable(&mut self, pair: &Pair<'_, Rule>) {
        let (at, written) = (self.text.first_line_of(pair), pair.as_str().trim());
        let shown: String = written.chars().take(20).collect();
        let dots = if shown.len() < written.len() { ".." } else { "" };
        let hint = match written.split(|c: char| !c.is_ascii_alphanumeric()).next() {
            Some("else") => "`else` follows the block of an `if`",
            Some("in") => "`in` follows the name of a loop or the default of a `param`",
            Some("as") => "`as` follows `import \"file.snell\"` or `place thing`",
            Some("then" | "per" | "or" | "and") => "an operator stands between two values",
            _ if written.starts_with('<') => "write a point or vector between parentheses: `(0m, 1m, 0m)`",
            _ if written.starts_with(':') => "a colon follows the name of a field, parameter or argument",
            _ if written.starts_with(['*', '/', '+', '-']) && self.follows_block(pair) => {
                "what stands in braces is no operand: put it in parentheses, `(noise { .. }) * 3`"
            }
            _ => "remove it, or finish what stands before it",
        };
        self.note(SyntaxError::Unreadable { what: format!("`{shown}{dots}`"), hint: hint.to_owned(), at });
    }

    /// Whether it stands after a block, on its line.
    fn follows_block(&self, pair: &Pair<'_, Rule>) -> bool {
        let before = &self.text.text[..pair.as_span().start()];
        before.trim_end_matches([' ', '\t']).ends_with('}')
    }

    /// Tells those who wrote an operator of another language which one it is here, and refuses `-x` at a line's start.
    pub(super) fn check_infix(&mut self, pair: &Pair<'_, Rule>) {
        let written = pair.as_str();
        match written {
            "&&" => self.wrong_operator(pair, "and"),
            "||" => self.wrong_operator(pair, "or"),
            "**" => self.wrong_operator(pair, "^"),
            "=" => self.wrong_operator(pair, "=="),
            "+" | "-" if self.text.is_glued_line_start(pair.as_span().start()) => {
                let (sign, at) = (written.to_owned(), self.text.span_of(pair));
                self.note(SyntaxError::SignAtLineStart { sign, at });
            }
            _ => {}
        }
    }

    /// An operator of another language.
    pub(super) fn wrong_operator(&mut self, pair: &Pair<'_, Rule>, wanted: &'static str) {
        let (written, at) = (pair.as_str().to_owned(), self.text.span_of(pair));
        let hint = format!("`{wanted}` is the operator of this language");
        self.note(SyntaxError::WrongSign { written, wanted, hint, at });
    }

    /// An operator with nothing on its right, or with a word that is no value.
    pub(super) fn missing_operand(&mut self, pair: &Pair<'_, Rule>) {
        let offset = pair.as_span().start();
        if self.reserved_word_at(offset) {
            return;
        }
        let (operator, at) = (self.text.operator_before(offset), self.text.after_token(offset));
        if operator == "++" || operator == "--" {
            let (what, sign) = (format!("`{operator}`"), &operator[1..]);
            let hint = format!("values do not change: give the new one a name, as in `let b = a {sign} 1`");
            return self.note(SyntaxError::Unreadable { what, hint, at });
        }
        self.note(SyntaxError::MissingOperand { operator, at });
    }

    /// Reports a word of the language that stands, on the line at hand, where a value belongs.
    pub(super) fn reserved_word_at(&mut self, offset: usize) -> bool {
        let rest = &self.text.text[offset..];
        let word =
            &rest[..rest.bytes().take_while(|byte| byte.is_ascii_alphanumeric() || *byte == b'_').count()];
        let joins = matches!(word, "and" | "as" | "else" | "in" | "or" | "per" | "then");
        let found = is_reserved(word) && !joins && !self.text.begins_line(offset);
        if found {
            let at = self.text.span(offset, offset + word.len());
            self.note(SyntaxError::ReservedWord { word: word.to_owned(), at });
        }
        found
    }
}
