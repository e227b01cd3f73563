//! A scene text as tokens with the gaps between them, comments included.

/// What a token is, as far as its spacing goes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    /// A name, a word of the language, a path of names with `::`.
    Word,
    /// A number, colour or text.
    Literal,
    /// `(`, `[` or `{`.
    Open,
    /// `)`, `]` or `}`.
    Close,
    /// `,` and `:`.
    Mark,
    /// Every other sign.
    Operator,
    /// `// ..`, to the end of the line.
    LineComment,
    /// `/* .. */`
    BlockComment,
    /// The numbers of a `data`, brackets included: kept as they are.
    Raw,
}

/// A token and what stood before it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Token<'a> {
    /// What it is.
    pub kind: Kind,
    /// Its text.
    pub text: &'a str,
    /// How many line ends stood before it.
    pub line_ends: usize,
    /// Whether anything stood before it.
    pub is_apart: bool,
}

/// The tokens of a text without syntax errors.
pub(super) fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut rest = text.trim_start_matches('\u{FEFF}');
    let mut tokens: Vec<Token<'_>> = Vec::new();
    loop {
        let trimmed = rest.trim_start();
        let gap = &rest[..rest.len() - trimmed.len()];
        let (line_ends, is_apart) = (gap.matches('\n').count(), !gap.is_empty());
        let is_comment = |token: &&Token<'_>| matches!(token.kind, Kind::LineComment | Kind::BlockComment);
        let before = tokens.iter().rev().find(|token| !is_comment(token)).map(|token| token.text);
        let Some((kind, len)) = token(trimmed, before) else { return tokens };
        let text = trimmed[..len].trim_end();
        tokens.push(Token { kind, text, line_ends, is_apart });
        rest = &trimmed[len..];
    }
}

/// The kind and length of the token that a text begins with; `before` is the token before it, comments left out.
fn token(text: &str, before: Option<&str>) -> Option<(Kind, usize)> {
    let first = text.chars().next()?;
    let signs = [("..=", 3), ("->", 2), ("..", 2), ("==", 2), ("!=", 2), ("<=", 2), (">=", 2)];
    Some(match first {
        _ if text.starts_with("//") => (Kind::LineComment, text.find('\n').unwrap_or(text.len())),
        _ if text.starts_with("/*") => (Kind::BlockComment, block_comment(text)),
        '[' if before == Some("data") => (Kind::Raw, raw(text)),
        '(' | '[' | '{' => (Kind::Open, 1),
        ')' | ']' | '}' => (Kind::Close, 1),
        ',' | ':' => (Kind::Mark, 1),
        '"' => (Kind::Literal, text[1..].find('"').map_or(text.len(), |end| end + 2)),
        '#' => (Kind::Literal, 1 + run(&text[1..], |c| c.is_ascii_alphanumeric())),
        'f' if text.starts_with("f/") => (Kind::Literal, 2 + numeral(&text[2..])),
        '.' if text[1..].starts_with(|c: char| c.is_ascii_digit()) => (Kind::Literal, number(text)),
        c if c.is_ascii_digit() => (Kind::Literal, number(text)),
        // `x` between two numerals: `1024x768`.
        'x' if before.is_some_and(is_number) && text[1..].starts_with(|c: char| c.is_ascii_digit()) => {
            (Kind::Word, 1)
        }
        c if c.is_ascii_alphabetic() || c == '_' => (Kind::Word, word(text)),
        c => {
            let sign = signs.iter().find(|(sign, _)| text.starts_with(sign));
            (Kind::Operator, sign.map_or(c.len_utf8(), |&(_, len)| len))
        }
    })
}

/// Whether a token is a number.
pub(super) fn is_number(token: &str) -> bool {
    token.trim_start_matches('.').starts_with(|c: char| c.is_ascii_digit())
}

/// The bytes at the start of a text whose characters are so.
fn run(text: &str, is_so: impl Fn(char) -> bool) -> usize {
    text.find(|c: char| !is_so(c)).unwrap_or(text.len())
}

/// A word, or the code of a warning with its `::`.
fn word(text: &str) -> usize {
    let len = run(text, |c| c.is_ascii_alphanumeric() || c == '_');
    match text[len..].strip_prefix("::") {
        Some(rest) if rest.starts_with(|c: char| c.is_ascii_alphabetic()) => len + 2 + word(rest),
        _ => len,
    }
}

/// Digits and a fraction.
fn numeral(text: &str) -> usize {
    let is_digit = |c: char| c.is_ascii_digit() || c == '_';
    let whole = run(text, is_digit);
    match text[whole..].strip_prefix('.') {
        Some(rest) if rest.starts_with(|c: char| c.is_ascii_digit()) => whole + 1 + run(rest, is_digit),
        _ => whole,
    }
}

/// A numeral, its exponent, and the unit glued to it.
fn number(text: &str) -> usize {
    let mut len = numeral(text);
    let exponent = text[len..]
        .strip_prefix(['e', 'E'])
        .map(|rest| (rest, rest.strip_prefix(['+', '-']).unwrap_or(rest)));
    if let Some((rest, digits)) =
        exponent.filter(|(_, digits)| digits.starts_with(|c: char| c.is_ascii_digit()))
    {
        len += 1 + (rest.len() - digits.len()) + run(digits, |c| c.is_ascii_digit());
    }
    let unit = &text[len..];
    let is_size = unit.strip_prefix('x').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    len + match unit.chars().next() {
        Some('%') => 1,
        Some(c) if !is_size && (c.is_ascii_alphabetic() || "µμ°".contains(c)) => {
            run(unit, |c| c.is_ascii_alphanumeric() || "_µμ°".contains(c))
        }
        _ => 0,
    }
}

/// The numbers of a `data`, up to the bracket that closes them; one in a comment closes nothing.
fn raw(text: &str) -> usize {
    let mut at = 0;
    while let Some(found) = text[at..].find([']', '/']) {
        at += found;
        at += match &text[at..] {
            rest if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            rest if rest.starts_with("/*") => block_comment(rest),
            rest if rest.starts_with(']') => return at + 1,
            _ => 1,
        };
    }
    text.len()
}

/// A comment with those that it holds.
fn block_comment(text: &str) -> usize {
    let (mut depth, mut at) = (0_usize, 0);
    while let Some(pair) = text.as_bytes().get(at..at + 2) {
        match pair {
            b"/*" => (depth, at) = (depth + 1, at + 2),
            b"*/" if depth == 1 => return at + 2,
            b"*/" => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bracket_in_a_comment_ends_no_data() {
        let text = "data /* [ */ [1 -2 // ]\n 3 /* ] */] + 1";
        let kinds: Vec<Kind> = tokens(text).iter().map(|token| token.kind).collect();
        assert_eq!(kinds, [Kind::Word, Kind::BlockComment, Kind::Raw, Kind::Operator, Kind::Literal]);
    }
}
