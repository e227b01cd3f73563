//! How odd a run of tokens reads: what tells which of two repairs of a bracket people would choose.
//!
//! A low sum is a text that reads like a scene: brackets pair, blocks are indented by their structure, values stand
//! where values belong. The weights only rank repairs against each other. That indentation and layout say which
//! bracket is missing is an old observation (de Jonge, Nilsson-Nyman, Kats, Visser 2009, "Natural and flexible error
//! recovery for generated parsers").

use super::token::{Kind, Token, closer};

/// A bracket without partner outweighs everything else.
pub(super) const UNPAIRED: u32 = 100;
/// What no scene does.
const WRONG: u32 = 5;
/// What a scene hardly does.
const ODD: u32 = 3;
/// What is a little unusual.
const RARE: u32 = 1;

/// How odd `tokens` of `text` read. The run is one item, or a few; `functions` are the names that the text gives some.
pub(super) fn oddity(text: &[u8], tokens: &[Token], functions: &[&[u8]]) -> u32 {
    let mut reader = Reader { text, tokens, functions, open: Vec::new(), sum: 0 };
    for at in 0..tokens.len() {
        reader.layout(at);
        reader.token(at);
    }
    reader.sum + UNPAIRED * reader.open.len() as u32
}

/// A bracket that is open.
#[derive(Clone, Copy)]
struct Open {
    /// Its index among the tokens.
    at: usize,
    bracket: u8,
    /// Whether it is glued to the name of what is called.
    is_call: bool,
    /// Whether it holds `name: type`, or arguments that may have names.
    takes_names: bool,
    /// The indentation of the first line inside.
    inner: Option<usize>,
    /// Whether the value of a field is being read.
    in_field: bool,
}

struct Reader<'a> {
    text: &'a [u8],
    tokens: &'a [Token],
    functions: &'a [&'a [u8]],
    open: Vec<Open>,
    sum: u32,
}

impl Reader<'_> {
    fn add(&mut self, weight: u32, is_so: bool) {
        self.sum += if is_so { weight } else { 0 };
    }

    fn word(&self, at: usize) -> &[u8] {
        self.tokens
            .get(at)
            .filter(|token| token.kind == Kind::Word)
            .map_or(b"", |token| &self.text[token.range()])
    }

    /// The token before one, on its line.
    fn before(&self, at: usize) -> Option<Token> {
        let before = self.tokens[at.checked_sub(1)?];
        (before.line == self.tokens[at].line).then_some(before)
    }

    fn is_keyword(&self, at: usize) -> bool {
        let in_size =
            || self.word(at) == b"x" && self.before(at).is_some_and(|before| before.kind == Kind::Number);
        is_keyword(self.word(at)) || in_size()
    }

    /// Whether a value ends just before a token, on its line.
    fn follows_value(&self, at: usize) -> bool {
        self.before(at).is_some_and(|before| before.ends_value()) && !self.is_keyword(at - 1)
    }

    /// The bracket of the innermost open one, `{` for the file itself.
    fn inside(&self) -> u8 {
        self.open.last().map_or(b'{', |open| open.bracket)
    }

    fn in_block(&self) -> bool {
        self.inside() == b'{'
    }

    /// Lines stand further right than the one that opens what they are in, and beside each other.
    fn layout(&mut self, at: usize) {
        let token = self.tokens[at];
        if !token.is_first || matches!(token.kind, Kind::Close(_) | Kind::Open(b'{')) || self.continues(at) {
            return;
        }
        let Some(open) = self.open.last_mut() else {
            self.sum += if token.indent > self.tokens[0].indent { ODD } else { 0 };
            return;
        };
        let outer = self.tokens[open.at].indent;
        let is_beside = open.bracket != b'{' || *open.inner.get_or_insert(token.indent) == token.indent;
        open.in_field = false;
        self.add(ODD, token.indent <= outer);
        self.add(ODD, !is_beside);
    }

    /// Whether a line continues the one before.
    fn continues(&self, at: usize) -> bool {
        let joins = matches!(self.word(at), b"then" | b"or" | b"and" | b"per" | b"as" | b"at" | b"else");
        let Some(before) = at.checked_sub(1) else { return false };
        joins || matches!(self.tokens[before].kind, Kind::Sign(sign) if sign != b',')
    }

    fn token(&mut self, at: usize) {
        match self.tokens[at].kind {
            Kind::Open(bracket) => self.opening(at, bracket),
            Kind::Close(bracket) => self.closing(at, bracket),
            Kind::Word if self.is_keyword(at) => self.keyword(at),
            Kind::Word => self.name(at),
            Kind::Number => self.add(ODD, self.follows_value(at)),
            Kind::Text => {
                let after_word =
                    at.checked_sub(1).is_some_and(|before| self.tokens[before].kind == Kind::Word);
                self.add(ODD, self.follows_value(at) && !after_word);
            }
            Kind::Sign(b',') => self.comma(at),
            Kind::Sign(b':') => {
                let after_name =
                    at.checked_sub(1).is_some_and(|before| self.tokens[before].kind == Kind::Word);
                self.add(WRONG, !after_name);
            }
            // `->` stands behind parameters.
            Kind::Sign(b'-') if self.text.get(self.tokens[at].end) == Some(&b'>') => {
                self.add(WRONG, !self.in_block());
            }
            Kind::Sign(_) => {}
        }
    }

    fn opening(&mut self, at: usize, bracket: u8) {
        let before = at.checked_sub(1).map(|before| self.tokens[before]);
        let glued = before.filter(|before| before.end == self.tokens[at].start);
        let after_name = |token: Option<Token>| {
            token.is_some_and(|token| token.kind == Kind::Word) && !self.is_keyword(at - 1)
        };
        let (is_call, is_apart) = (after_name(glued), glued.is_none() && after_name(self.before(at)));
        let weight = match (bracket, before.map(|before| before.kind)) {
            (b'{', None | Some(Kind::Text)) => ODD,
            (b'{', Some(Kind::Open(_))) => WRONG,
            (b'{', Some(Kind::Word)) if is_head_less(self.word(at - 1)) => ODD,
            (b'{', Some(Kind::Number | Kind::Close(_))) if !self.in_block() => ODD,
            (b'{', Some(Kind::Close(b'}'))) => ODD,
            (b'{', Some(Kind::Sign(sign))) if sign != b':' && sign != b'=' => ODD,
            (b'(', _) if is_apart => ODD - RARE,
            (b'(' | b'[', Some(Kind::Number | Kind::Text)) if self.before(at).is_some() => ODD,
            (b'(' | b'[', Some(Kind::Close(_))) if glued.is_none() && self.before(at).is_some() => ODD,
            (b'(' | b'[', Some(Kind::Open(b'{'))) => RARE,
            _ => 0,
        };
        self.sum += weight;
        let takes_names = is_call && (self.word(at.wrapping_sub(2)) == b"fn" || self.is_defined(at - 1));
        self.open.push(Open { at, bracket, is_call, takes_names, inner: None, in_field: false });
    }

    /// Whether the text defines the function that is called, so that its arguments may have names.
    fn is_defined(&self, callee: usize) -> bool {
        let is_member = callee.checked_sub(1).is_some_and(|dot| self.tokens[dot].is(b'.'));
        is_member || self.word(callee) == b"bezier" || self.functions.contains(&self.word(callee))
    }

    fn closing(&mut self, at: usize, bracket: u8) {
        let Some(partner) = self.open.iter().rposition(|open| closer(open.bracket) == bracket) else {
            self.sum += UNPAIRED;
            return;
        };
        self.sum += UNPAIRED * (self.open.len() - partner - 1) as u32;
        self.open.truncate(partner + 1);
        let Some(open) = self.open.pop() else { return };
        self.pair(open, at);
        let before = self.tokens[at - 1];
        self.add(ODD, matches!(before.kind, Kind::Sign(sign) if sign != b',' && sign != b'%'));
        let (from, to) = (self.tokens[open.at], self.tokens[at]);
        if from.line != to.line {
            self.add(ODD, to.is_first && to.indent != from.indent);
            self.add(RARE, !to.is_first);
        }
    }

    /// What stands between a pair of brackets.
    fn pair(&mut self, open: Open, close: usize) {
        let within = &self.tokens[open.at + 1..close];
        let round = open.bracket == b'(';
        let weight = match within {
            [] if round && open.is_call => RARE,
            [] if round => WRONG,
            [one] if round && !open.is_call && !matches!(one.kind, Kind::Open(_)) => ODD - RARE,
            [first, .., last] if round && is_pair(within, first, last) => {
                if open.is_call {
                    RARE
                } else {
                    ODD
                }
            }
            _ => 0,
        };
        self.sum += weight;
    }

    fn keyword(&mut self, at: usize) {
        let (word, before) = (self.word(at), self.before(at));
        let number_before = before.is_some_and(|before| matches!(before.kind, Kind::Number | Kind::Text));
        let in_call = self.open.last().is_some_and(|open| open.is_call);
        let in_field = self.open.last().is_some_and(|open| open.in_field);
        let begins_entry = before.is_none_or(|before| {
            matches!(before.kind, Kind::Open(b'{') | Kind::Close(b'}')) || before.is(b',')
        });
        let weight = match word {
            b"else" if !self.follows_choice(at) => WRONG,
            b"as" | b"at" if !self.in_block() => ODD,
            b"as" | b"at" if in_field => ODD,
            b"then" if number_before => ODD,
            b"then" | b"or" if in_call => RARE,
            b"let" | b"param" | b"place" | b"fn" | b"import" | b"include" => {
                match (self.in_block(), begins_entry) {
                    (false, _) => WRONG,
                    (true, begins) => {
                        if begins {
                            0
                        } else {
                            ODD
                        }
                    }
                }
            }
            b"for" => match self.inside() {
                b'[' => 0,
                b'{' => {
                    if begins_entry {
                        0
                    } else {
                        ODD
                    }
                }
                _ => WRONG,
            },
            _ => 0,
        };
        self.sum += weight;
    }

    /// Whether a block ends before an `else`: on its line, or as the only thing on a line.
    fn follows_choice(&self, at: usize) -> bool {
        let before = at.checked_sub(1).map(|before| self.tokens[before]);
        before.is_some_and(|before| {
            // What is put in stands on a line of its own, too.
            let is_alone = before.is_first || before.start == before.end;
            before.kind == Kind::Close(b'}') && (!self.tokens[at].is_first || is_alone)
        })
    }

    fn name(&mut self, at: usize) {
        let next = self.tokens.get(at + 1).copied();
        let is_field = next.is_some_and(|next| next.is(b':'))
            && at.checked_sub(1).is_none_or(|before| self.word(before) != b"param");
        if is_field {
            return self.field(at);
        }
        if !self.follows_value(at) {
            return;
        }
        let weight = match self.before(at).map(|before| before.kind) {
            Some(Kind::Close(b'}')) if self.in_block() => 0,
            // Two words head a block: `light sphere {`.
            Some(Kind::Word) if next.is_some_and(|next| next.kind == Kind::Open(b'{')) => 0,
            _ => ODD,
        };
        self.sum += weight;
    }

    /// `name:`, which begins a field, a parameter or an argument.
    fn field(&mut self, at: usize) {
        let before = self.before(at);
        let begins = before.is_none_or(|before| matches!(before.kind, Kind::Open(_)) || before.is(b','));
        self.add(ODD, !begins);
        let is_top = self.open.is_empty();
        let takes_names = self.open.last().is_some_and(|open| open.takes_names);
        let weight = match self.open.last_mut() {
            None => WRONG,
            Some(open) if open.bracket == b'{' => {
                open.in_field = true;
                0
            }
            Some(open) if open.takes_names => 0,
            Some(open) => {
                if open.is_call {
                    ODD - RARE
                } else {
                    WRONG
                }
            }
        };
        self.sum += weight;
        self.add(RARE, is_top);
        // No list of values goes on with a field in a line of its own.
        self.add(2 * WRONG, !self.in_block() && self.tokens[at].is_first && !takes_names);
    }

    fn comma(&mut self, at: usize) {
        let before = at.checked_sub(1).map(|before| self.tokens[before]);
        self.add(WRONG, before.is_none_or(|before| matches!(before.kind, Kind::Open(_)) || before.is(b',')));
        self.add(ODD, self.open.is_empty());
        if let Some(open) = self.open.last_mut().filter(|open| open.bracket == b'{') {
            open.in_field = false;
            let next = self.tokens.get(at + 1).filter(|next| !next.is_first);
            self.add(ODD, next.is_some_and(|next| !matches!(next.kind, Kind::Word | Kind::Close(_))));
        }
    }
}

/// Whether no block follows a word of the language.
fn is_head_less(word: &[u8]) -> bool {
    is_keyword(word) && word != b"else"
}

/// Whether `first` and `last` of a run are partners.
fn is_pair(within: &[Token], first: &Token, last: &Token) -> bool {
    let (Kind::Open(_), Kind::Close(_)) = (first.kind, last.kind) else { return false };
    let mut depth = 0_i32;
    within[..within.len() - 1].iter().all(|token| {
        depth += match token.kind {
            Kind::Open(_) => 1,
            Kind::Close(_) => -1,
            _ => 0,
        };
        depth > 0
    })
}

/// The words that begin or join items and values.
fn is_keyword(word: &[u8]) -> bool {
    matches!(
        word,
        b"and"
            | b"as"
            | b"at"
            | b"else"
            | b"fn"
            | b"for"
            | b"if"
            | b"import"
            | b"in"
            | b"include"
            | b"let"
            | b"not"
            | b"on"
            | b"or"
            | b"param"
            | b"per"
            | b"place"
            | b"then"
    )
}
