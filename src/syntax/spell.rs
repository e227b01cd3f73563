//! Words of the language that are misspelt, and colons that stand twice.
//!
//! Two values never stand side by side on a line, so a word between them, or before one, can only be a word of the
//! language; what begins a line before a name can only begin an item. Where such a word is one slip from one that may
//! stand there, it is read as that one, and nothing after it goes wrong.

use super::error::SyntaxError;
use super::token::{Kind, Token};
use crate::diag::{is_slip_of, nearest};
use crate::source::Span;

/// How many tokens of a line are looked at before a word.
const LONGEST_LOOK: usize = 64;

/// A word or sign to be read as another.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Slip {
    /// The bytes from `start` to `end` mean `word`, which begins an item or joins something.
    Word { start: usize, end: usize, word: &'static str, begins_item: bool },
    /// A second colon.
    Colon { at: usize },
}

/// The slips in a text that `tokens` make up.
pub(super) fn slips(text: &[u8], tokens: &[Token]) -> Vec<Slip> {
    let words = Words { text, tokens };
    (0..tokens.len()).filter_map(|at| words.slip(at)).collect()
}

struct Words<'a> {
    text: &'a [u8],
    tokens: &'a [Token],
}

impl Words<'_> {
    fn slip(&self, at: usize) -> Option<Slip> {
        let token = self.tokens[at];
        if token.is(b':') {
            let is_second = self.before(at).is_some_and(|before| before.is(b':'));
            // `allow(snell::resolve::unused, ..)` has paths.
            return (is_second && !self.is_path(at)).then_some(Slip::Colon { at: token.start });
        }
        if token.kind != Kind::Word || is_word_of_the_language(self.word(at)) {
            return None;
        }
        if self.is_prose(at) {
            return None;
        }
        let item = nearest(self.word(at), self.item_words(at).iter().copied()).into_iter().next();
        let word = item.or_else(|| {
            let joining = self.joining_words(at).iter().copied();
            nearest(self.word(at), joining.filter(|word| is_slip_of(word, self.word(at)))).into_iter().next()
        })?;
        Some(Slip::Word { start: token.start, end: token.end, word, begins_item: item.is_some() })
    }

    fn word(&self, at: usize) -> &str {
        let word = self.tokens.get(at).filter(|token| token.kind == Kind::Word);
        word.and_then(|token| std::str::from_utf8(&self.text[token.range()]).ok()).unwrap_or_default()
    }

    fn sign(&self, at: usize, sign: u8) -> bool {
        self.tokens.get(at).is_some_and(|token| token.is(sign))
    }

    fn kind(&self, at: usize) -> Option<Kind> {
        self.tokens.get(at).map(|token| token.kind)
    }

    /// The token before one, on its line.
    fn before(&self, at: usize) -> Option<Token> {
        let before = self.tokens[at.checked_sub(1)?];
        (before.line == self.tokens[at].line).then_some(before)
    }

    /// The token after one, on its line and apart from it.
    fn after(&self, at: usize) -> Option<Token> {
        let (token, after) = (self.tokens[at], *self.tokens.get(at + 1)?);
        (after.line == token.line && after.start > token.end).then_some(after)
    }

    /// The tokens before one on its line, the nearest first.
    fn line_before(&self, at: usize) -> impl Iterator<Item = (usize, &Token)> {
        let line = self.tokens[at].line;
        let before = self.tokens[..at].iter().enumerate().rev().take(LONGEST_LOOK);
        before.take_while(move |(_, token)| token.line == line)
    }

    /// Whether a colon is part of the code of a warning.
    fn is_path(&self, colon: usize) -> bool {
        self.line_before(colon).any(|(at, _)| self.word(at) == "allow")
    }

    /// Whether words follow each other around this one, as they do in a sentence, or its line begins with `#`.
    fn is_prose(&self, at: usize) -> bool {
        let is_plain = |at: Option<usize>| {
            at.is_some_and(|at| !self.word(at).is_empty() && !is_word_of_the_language(self.word(at)))
        };
        let line = self.tokens[at].line;
        let on_line =
            |at: Option<usize>| at.filter(|&at| self.tokens.get(at).is_some_and(|token| token.line == line));
        let (before, after) = (on_line(at.checked_sub(1)), on_line(Some(at + 1)));
        let (second_before, second_after) = (on_line(at.checked_sub(2)), on_line(Some(at + 2)));
        let is_directive = self.line_before(at).any(|(_, token)| token.is_first && token.is(b'#'));
        is_directive
            || is_plain(before) && (is_plain(second_before) || is_plain(after) && is_plain(second_after))
            || is_plain(after) && is_plain(second_after) && is_plain(on_line(Some(at + 3)))
    }

    /// The words that begin an item which goes on as what follows the first word of an entry does.
    fn item_words(&self, at: usize) -> &'static [&'static str] {
        let begins = match self.before(at) {
            None => true,
            Some(before) => matches!(before.kind, Kind::Open(b'{') | Kind::Close(b'}')),
        };
        let Some(after) = self.after(at).filter(|_| begins) else { return &[] };
        let follows = self.tokens.get(at + 2).map(|token| token.kind);
        match after.kind {
            Kind::Text => &["import", "include"],
            Kind::Word if follows == Some(Kind::Sign(b'=')) => &["let"],
            Kind::Word if follows == Some(Kind::Sign(b':')) => &["param"],
            Kind::Word if self.word(at + 2) == "in" => &["for"],
            Kind::Word if follows == Some(Kind::Open(b'(')) && self.has_arrow(at) => &["fn"],
            // `light sphere {` and `camera front {` are whole.
            Kind::Word if !matches!(self.word(at), "light" | "camera") => &["place", "if", "for"],
            Kind::Number | Kind::Open(b'(') => &["if", "place"],
            Kind::Open(b'{') if is_slip_of("units", self.word(at)) => &["units"],
            _ => &[],
        }
    }

    /// Whether `->` stands on the line.
    fn has_arrow(&self, at: usize) -> bool {
        let line = self.tokens[at].line;
        let mut rest = self.tokens[at..].iter().take_while(|token| token.line == line);
        rest.any(|token| token.is(b'-') && self.text.get(token.end) == Some(&b'>'))
    }

    /// The words that join what stands before and after a word, or that stand before a value.
    fn joining_words(&self, at: usize) -> &'static [&'static str] {
        let after = self.after(at);
        let is_apart = self.before(at).is_some_and(|before| before.end < self.tokens[at].start);
        let after_value = is_apart && self.before(at).is_some_and(|before| before.ends_value());
        let after_value = after_value && !is_word_of_the_language(self.word(at - 1));
        let after_block = at > 0 && self.kind(at - 1) == Some(Kind::Close(b'}'));
        let next = self.word(at + 1);
        match after.map(|after| after.kind) {
            Some(Kind::Open(b'{')) if after_block => &["else"],
            None if after_block && self.kind(at + 1) == Some(Kind::Open(b'{')) => &["else"],
            Some(Kind::Word) if after_block && next == "if" => &["else"],
            // A transform goes on in the next line.
            Some(Kind::Word) if self.tokens[at].is_first && self.closes_call(at) => &["then"],
            Some(Kind::Word | Kind::Open(b'(')) if after_block && !self.sign(at + 2, b':') => &["as", "at"],
            Some(_) if after_value && !after_block && self.begins_value_after(at) => self.infix_words(at),
            Some(Kind::Word | Kind::Number | Kind::Open(b'(')) if self.wants_value(at) && !joins(next) => {
                &["on", "not", "if"]
            }
            _ => &[],
        }
    }

    /// Whether the line before ends as a call does, and one follows.
    fn closes_call(&self, at: usize) -> bool {
        at > 0 && self.kind(at - 1) == Some(Kind::Close(b')')) && self.kind(at + 2) == Some(Kind::Open(b'('))
    }

    /// Whether a value begins after a word, and no colon makes the word a field.
    fn begins_value_after(&self, at: usize) -> bool {
        self.after(at).is_some_and(|after| after.begins_value() || after.is(b'-'))
            && self.kind(at + 1) != Some(Kind::Open(b'{'))
            && !self.sign(at + 2, b':')
    }

    /// Whether a value is wanted where a word stands: after a sign or a word that joins.
    fn wants_value(&self, at: usize) -> bool {
        let Some(before) = self.before(at) else { return false };
        match before.kind {
            Kind::Sign(_) | Kind::Open(b'(' | b'[') => true,
            Kind::Word => matches!(self.word(at - 1), "in" | "and" | "or" | "not" | "then" | "if"),
            _ => false,
        }
    }

    /// The words that may stand between two values, in the item that a word is part of.
    fn infix_words(&self, at: usize) -> &'static [&'static str] {
        if at > 0 && self.kind(at - 1) == Some(Kind::Text) {
            return &["as"];
        }
        for (index, token) in self.line_before(at) {
            match (token.kind, self.word(index)) {
                (Kind::Open(b'['), _) => return &["for", "if", "in", "then", "per", "or", "and"],
                (Kind::Word, "for") => return &["in", "if", "and", "or"],
                (Kind::Word, "param") => return &["in", "then", "per", "or", "and"],
                (Kind::Word, "place") => return &["as", "at", "then"],
                _ => {}
            }
        }
        &["then", "per", "or", "and"]
    }
}

impl Slip {
    /// The report.
    pub fn report(self, text: &str, span: impl Fn(usize, usize) -> Span) -> SyntaxError {
        match self {
            Self::Colon { at } => SyntaxError::DoubledSign { sign: ":".to_owned(), at: span(at, at + 1) },
            Self::Word { start, end, word, begins_item } => {
                let (written, hint, at) =
                    (&text[start..end], format!("did you mean `{word}`?"), span(start, end));
                match begins_item {
                    true => SyntaxError::UnknownItem { word: written.to_owned(), at, hint },
                    false => SyntaxError::Unreadable { what: format!("`{written}`"), hint, at },
                }
            }
        }
    }
}

/// Whether a word stands between two values, so that it begins none.
fn joins(word: &str) -> bool {
    matches!(word, "and" | "as" | "at" | "else" | "in" | "or" | "per" | "then" | "x")
}

/// Whether a word means something by itself.
fn is_word_of_the_language(word: &str) -> bool {
    super::lower::is_reserved(word) || matches!(word, "allow" | "at" | "snell" | "x")
}

#[cfg(test)]
mod tests {
    use super::super::scan::scan;
    use super::*;

    /// The words that a line is taken to mean.
    fn meant(line: &str) -> Vec<&'static str> {
        let scan = scan(line);
        let word = |slip| match slip {
            Slip::Word { word, .. } => word,
            Slip::Colon { .. } => ":",
        };
        slips(&scan.text, &scan.tokens).into_iter().map(word).collect()
    }

    #[test]
    fn a_word_where_only_one_of_the_language_can_stand_is_read_as_that() {
        assert_eq!(meant("lte a = 1m"), ["let"]);
        assert_eq!(meant("iport \"a.snell\" az a"), ["import", "as"]);
        assert_eq!(meant("fro i im 0..3 { poace ball { radius: 1m } }"), ["for", "place"]);
        assert_eq!(meant("place sphere { radius: 1m } ar (1m, 2m, 3m)"), ["at"]);
        assert_eq!(meant("transform: scale(2) thn rotate_y(30deg)"), ["then"]);
        assert_eq!(meant("focus: onn hero, color: iff night { white } esle { black }"), ["on", "if", "else"]);
        assert_eq!(meant("transform: scale(2)\n    thn rotate_y(30deg)"), ["then"]);
        assert_eq!(meant("ubits { length: mm }"), ["units"]);
        assert_eq!(meant("radius:: 1m"), [":"]);
    }

    #[test]
    fn what_is_whole_is_left_alone() {
        for line in [
            "light sphere { radius: 1m } light point { position: p }",
            "camera front { film: { size: 1024 x 768 } }",
            "let a = bezier [(0m, 0m)]",
            "param n: int = 3 in 1..=5",
            "allow(snell::resolve::unused, \"why\")",
            "place ring(3) as circle at (0m, 1m, 0m) { transform: scale(2) }",
            "# a comment of other languages",
            "for (i in 0..3) { sphere { radius: 1m } }",
            "let t = scale(2)\nplace ring(3)",
        ] {
            assert_eq!(meant(line), [] as [&str; 0], "{line}");
        }
    }
}
