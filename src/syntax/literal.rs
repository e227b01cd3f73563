//! Numbers, colours, texts and bulk data.

use super::ast::{Expr, ExprKind};
use super::error::SyntaxError;
use super::grammar::Rule;
use super::lower::Lower;
use crate::source::{Span, Spanned};
use pest::iterators::Pair;

impl Lower<'_> {
    /// The operands that are one token.
    pub(super) fn literal(&mut self, pair: Pair<'_, Rule>) -> Expr {
        let span = self.text.span_of(&pair);
        let kind = match pair.as_rule() {
            Rule::number => self.number(&pair),
            Rule::f_number => {
                self.finite(&pair.as_str()[2..], span).map_or(ExprKind::Poison, ExprKind::FNumber)
            }
            Rule::string if self.is_guessed(&pair) => ExprKind::Poison,
            Rule::string => ExprKind::Text(self.string(&pair).value),
            Rule::colour => self.colour(&pair),
            Rule::data => self.data(pair),
            Rule::quoted => self.quoted(&pair),
            Rule::angled => self.angled(&pair),
            _ => self.unknown(&pair),
        };
        Expr { kind, span }
    }

    /// `number = @{ digits ~ ("." ~ digits)* ~ exponent? ~ (unit | sp+ ~ apart_unit)? }`
    fn number(&mut self, pair: &Pair<'_, Rule>) -> ExprKind {
        let written = pair.as_str();
        let split = numeral_len(written);
        let (numeral, unit) = written.split_at(split);
        let start = pair.as_span().start();
        if unit.starts_with('.') {
            let (what, hint) = (format!("`{written}`"), "a number has one decimal point".to_owned());
            self.note(SyntaxError::Unreadable { what, hint, at: self.text.span_of(pair) });
            return ExprKind::Poison;
        }
        if unit.starts_with(' ') {
            let (glued, at) = (format!("{numeral}{}", unit.trim_start()), self.text.span_of(pair));
            self.note(SyntaxError::ApartUnit { glued, at });
            return ExprKind::Poison;
        }
        let integer = numeral.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_');
        let Some(value) = self.finite(numeral, self.text.span(start, start + split)) else {
            return ExprKind::Poison;
        };
        let unit = (!unit.is_empty())
            .then(|| Spanned::new(unit.to_owned(), self.text.span(start + split, start + written.len())));
        ExprKind::Number { value, unit, integer }
    }

    /// The value of a numeral, `None` and a report when it is beyond every finite number.
    fn finite(&mut self, numeral: &str, at: Span) -> Option<f64> {
        let plain = if numeral.contains('_') { &numeral.replace('_', "") } else { numeral };
        let value = plain.parse::<f64>().ok().filter(|value| value.is_finite());
        if value.is_none() {
            self.note(SyntaxError::HugeNumber { at });
        }
        value
    }

    /// Whether the closing quote of a text was put in: then nobody knows what it was to be.
    pub(super) fn is_guessed(&self, pair: &Pair<'_, Rule>) -> bool {
        let last = pair.as_span().end() - 1;
        pair.as_str().len() > 1 && self.text.inserted.binary_search(&last).is_ok()
    }

    /// `string = @{ "\"" ~ .. ~ "\"" }`: what stands between the quotes.
    pub(super) fn string(&self, pair: &Pair<'_, Rule>) -> Spanned<String> {
        let inner = pair.as_str().strip_prefix('"').unwrap_or_default();
        let inner = inner.strip_suffix('"').unwrap_or(inner);
        Spanned::new(inner.to_owned(), self.text.span_of(pair))
    }

    /// `colour = @{ "#" ~ cont* }`
    fn colour(&mut self, pair: &Pair<'_, Rule>) -> ExprKind {
        let digits = &pair.as_str()[1..];
        if let Some(color) = hex_color(digits) {
            return ExprKind::Color(color);
        }
        let problem = match digits.chars().find(|c| !c.is_ascii_hexdigit()) {
            Some(c) => format!("`{c}` is no hexadecimal digit"),
            None => format!("{} digits", digits.len()),
        };
        self.note(SyntaxError::BadColor { at: self.text.span_of(pair), problem });
        ExprKind::Poison
    }

    /// `data = ${ "data" ~ sp* ~ raw }`
    fn data(&mut self, pair: Pair<'_, Rule>) -> ExprKind {
        let Some(raw) = pair.into_inner().next() else { return ExprKind::Poison };
        let (start, text) = (raw.as_span().start() + 1, raw.as_str());
        let text = &text[1..text.len() - 1];
        let mut numbers = Vec::new();
        for token in
            text.split(|c: char| c.is_ascii_whitespace() || c == ',').filter(|token| !token.is_empty())
        {
            match token.parse::<f64>().ok().filter(|value| value.is_finite()) {
                Some(value) => numbers.push(value),
                None => {
                    let offset = start + (token.as_ptr() as usize - text.as_ptr() as usize);
                    self.note(SyntaxError::BadData { at: self.text.span(offset, offset + token.len()) });
                    return ExprKind::Poison;
                }
            }
        }
        ExprKind::Data(numbers)
    }

    /// A text in quotes of another kind.
    /// `<0, 1, 2>`
    fn angled(&mut self, pair: &Pair<'_, Rule>) -> ExprKind {
        let hint = format!("points stand in parentheses: `({})`", pair.as_str().trim_matches(['<', '>']));
        let (what, at) = ("a point between `<` and `>`".to_owned(), self.text.span_of(pair));
        self.note(SyntaxError::Unreadable { what, hint, at });
        ExprKind::Poison
    }

    fn quoted(&mut self, pair: &Pair<'_, Rule>) -> ExprKind {
        let text = pair.as_str().trim_matches(|c: char| !c.is_ascii_alphanumeric() && !"./_-".contains(c));
        self.note(SyntaxError::WrongQuotes { text: text.to_owned(), at: self.text.span_of(pair) });
        ExprKind::Poison
    }

    /// Characters that begin nothing.
    fn unknown(&mut self, pair: &Pair<'_, Rule>) -> ExprKind {
        self.unknown_at(pair.as_span().start());
        ExprKind::Poison
    }

    /// Reports the character at `offset`, which begins nothing.
    fn unknown_at(&mut self, offset: usize) {
        let Some(c) = self.text.text[offset..].chars().next() else { return };
        let (shown, hint) = describe(c);
        self.note(SyntaxError::UnknownCharacter { shown, hint, at: self.text.first_char(offset) });
    }

    /// Reports a character that begins nothing where a name or sign belongs.
    pub(super) fn strange_character_at(&mut self, offset: usize) -> bool {
        let is_strange = |c: char| c != '\n' && c.is_control() || !c.is_ascii() && !"“”„«‘’".contains(c);
        let found = self.text.text[offset..].starts_with(is_strange);
        if found {
            self.unknown_at(offset);
        }
        found
    }
}

/// How many bytes of a number are its numeral; the rest is its unit.
fn numeral_len(number: &str) -> usize {
    let bytes = number.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit() || **b == b'_').count();
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end += 1 + digits(end + 1);
    }
    // An exponent needs its digits: `2e` is a number of a unit `e`.
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if bytes.get(end + 1 + sign).is_some_and(u8::is_ascii_digit) {
            let from = end + 1 + sign;
            end = from + bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
        }
    }
    end
}

/// The channels of three or six hexadecimal digits.
fn hex_color(digits: &str) -> Option<[u8; 3]> {
    let nibbles: Vec<u8> = digits.chars().map(|c| c.to_digit(16).map(|d| d as u8)).collect::<Option<_>>()?;
    match *nibbles.as_slice() {
        [r, g, b] => Some([r * 17, g * 17, b * 17]),
        [r0, r1, g0, g1, b0, b1] => Some([r0 * 16 + r1, g0 * 16 + g1, b0 * 16 + b1]),
        _ => None,
    }
}

/// A character for people, and what they may have meant by it.
fn describe(c: char) -> (String, String) {
    let shown = if c.is_control() || c.is_whitespace() || !c.is_ascii() && !c.is_alphanumeric() {
        let code = u32::from(c);
        if c.is_control() || c.is_whitespace() {
            format!("U+{code:04X}")
        } else {
            format!("`{c}` (U+{code:04X})")
        }
    } else {
        format!("`{c}`")
    };
    let hint = match c {
        '\0' => "remove it; a text holds no NUL: is this a scene, or a binary file?".to_owned(),
        '\u{A0}' => "this is a no-break space: write a plain one".to_owned(),
        '−' | '–' | '—' => "write `-`".to_owned(),
        '×' | '·' | '⋅' => "write `*`, and `x` in a size: `1024 x 768`".to_owned(),
        '÷' => "write `/`".to_owned(),
        '≤' => "write `<=`".to_owned(),
        '≥' => "write `>=`".to_owned(),
        '≠' => "write `!=`".to_owned(),
        '→' => "write `->`".to_owned(),
        '…' => "write `..`".to_owned(),
        '\'' => "write `\"` around a text".to_owned(),
        '?' => "a choice is written `if a { 1m } else { 2m }`".to_owned(),
        '$' | '@' => "write the name alone".to_owned(),
        c if c.is_alphabetic() => "names are made of `a` to `z`, `A` to `Z`, digits and `_`".to_owned(),
        _ => "remove it".to_owned(),
    };
    (shown, hint)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_begins_where_the_numeral_ends() {
        for (number, numeral) in
            [("5cm", "5"), ("1e-3m", "1e-3"), ("2.5%", "2.5"), ("1e", "1"), ("1_000", "1_000"), (".5m", ".5")]
        {
            assert_eq!(&number[..numeral_len(number)], numeral, "{number}");
        }
    }

    #[test]
    fn colours_have_three_or_six_digits() {
        assert_eq!(hex_color("f80"), Some([255, 136, 0]));
        assert_eq!(hex_color("ff8800"), Some([255, 136, 0]));
        assert_eq!(hex_color("ff88"), None);
        assert_eq!(hex_color("ggg"), None);
    }
}
