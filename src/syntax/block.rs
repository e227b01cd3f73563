//! Sequences: the entries of files and blocks, the elements between parentheses and brackets, and what separates them.

use super::ast::{Allow, Block, Entry, Expr, ExprKind, Field, Item, ItemKind, Name, Place};
use super::error::SyntaxError;
use super::foreign::glued_unit;
use super::grammar::{Parts, Rule};
use super::lower::{Lower, is_reserved, item, poison};
use crate::diag::did_you_mean;
use pest::iterators::Pair;

/// How the functions begin that move things.
const MOVES: [&str; 6] = ["translate", "scale", "rotate", "look_at", "matrix", "moving"];

/// What has been read of a sequence of entries.
#[derive(Default)]
struct Sequence {
    entries: Vec<Entry>,
    poisoned: bool,
    /// The `allow`s that wait for their item, and where the first begins.
    allows: Vec<Allow>,
    allows_start: Option<usize>,
    /// What the last separator or entry was, as far as the next entry asks.
    last: Last,
}

/// What stands before an entry.
#[derive(Clone, Copy, PartialEq, Eq, Default)]
enum Last {
    /// Nothing, a comma, or an entry after which anything may follow.
    #[default]
    Separated,
    /// An entry that ends with its block: an item may follow it on its line, a field may not.
    Block,
    /// An entry that wants a comma or a line end after it.
    Open,
    /// A name that stands alone: a field without its colon, or a word that begins no item.
    Word,
    /// A mistake: what follows on its line is likely part of it.
    Mistake,
    /// A comment in the sign of another language: what follows on its line belongs to it.
    Comment,
}

impl Lower<'_> {
    /// `block = { "{" ~ entry* ~ "}" }`
    pub(super) fn block(&mut self, pair: Pair<'_, Rule>) -> Block {
        let span = self.text.span_of(&pair);
        let sequence = self.nested(1, span, |lower| lower.entries(Parts::of(pair), true));
        match sequence {
            Some((entries, poisoned)) => Block { entries, span, poisoned },
            None => Block { entries: Vec::new(), span, poisoned: true },
        }
    }

    /// The entries of a file or block, and whether some could not be read.
    pub(super) fn entries(&mut self, parts: Parts<'_>, in_block: bool) -> (Vec<Entry>, bool) {
        let mut sequence = Sequence::default();
        for part in parts.rest() {
            match part.as_rule() {
                Rule::comma => self.entry_comma(&part, &mut sequence),
                Rule::allow => self.allow(part, &mut sequence),
                Rule::closer | Rule::broken => sequence.poisoned = true,
                _ => self.entry(part, in_block, &mut sequence),
            }
        }
        if let Some(allow) = sequence.allows.first() {
            self.note(SyntaxError::BadAllow { at: allow.code.span, problem: "no item follows" });
        }
        (sequence.entries, sequence.poisoned)
    }

    /// `,` or `;` between entries.
    fn entry_comma(&mut self, pair: &Pair<'_, Rule>, sequence: &mut Sequence) {
        let at = self.text.span_of(pair);
        if sequence.last == Last::Comment && !self.text.begins_line(pair.as_span().start()) {
            return;
        }
        if self.begins_comment(pair.as_span().start()) {
            self.foreign_comment(pair.as_span().start(), sequence);
            return;
        }
        if pair.as_str() == ";" {
            self.semicolons.push(at);
        } else if sequence.last == Last::Separated {
            self.note(SyntaxError::ExtraComma { at });
        }
        sequence.last = Last::Separated;
    }

    /// One entry, the comma before it, and what a mistake in it means for the next.
    fn entry(&mut self, pair: Pair<'_, Rule>, in_block: bool, sequence: &mut Sequence) {
        let (start, rule) = (pair.as_span().start(), pair.as_rule());
        let follows_on_line = !self.text.begins_line(start);
        if !follows_on_line {
            sequence.last = Last::Separated;
        }
        if follows_on_line && self.is_part_of_mistake(rule, sequence) {
            return;
        }
        if self.begins_comment(start) {
            return self.foreign_comment(start, sequence);
        }
        if follows_on_line && self.misses_place(&pair, sequence) {
            return;
        }
        if follows_on_line && rule == Rule::expr && self.continues_value(&pair, sequence) {
            return;
        }
        if follows_on_line && sequence.last == Last::Open && matches!(rule, Rule::expr | Rule::stray) {
            sequence.spoil_last();
        }
        if follows_on_line && self.may_begin_entry(rule, start) {
            self.check_separation(&pair, in_block, sequence);
        }
        let is_in_mistake = follows_on_line && sequence.last == Last::Mistake;
        let before = self.errors.len();
        match rule {
            Rule::field | Rule::bare_field => self.field_entry(pair, in_block, sequence),
            _ => {
                let mut item = self.item(pair);
                let start = sequence.allows_start.take().unwrap_or(start);
                item.doc = self.text.doc_above(start);
                item.span = self.text.span(start, start).to(item.span);
                let silenced = sequence.allows.iter().map(|allow| (allow.code.clone(), item.span));
                self.allows.extend(silenced);
                sequence.push(item);
            }
        }
        if is_in_mistake || self.errors.len() > before {
            sequence.last = Last::Mistake;
        }
    }

    /// Whether what stands at `start` is an entry of its own, and not the rest of the one before.
    fn may_begin_entry(&self, rule: Rule, start: usize) -> bool {
        let begins = |c: char| c.is_ascii_alphanumeric() || "_\"#([{".contains(c);
        rule != Rule::stray && self.text.text[start..].starts_with(begins)
    }

    /// What cannot be read after a mistake on its line is part of it.
    fn is_part_of_mistake(&self, rule: Rule, sequence: &mut Sequence) -> bool {
        let part = sequence.last == Last::Comment
            || sequence.last == Last::Mistake && matches!(rule, Rule::stray | Rule::expr);
        sequence.poisoned |= part;
        part
    }

    /// Whether a comment as other languages write it begins here: `# ..` and `-- ..` anywhere, `; ..` on a line of its own.
    fn begins_comment(&self, start: usize) -> bool {
        let rest = &self.text.text[start..];
        let goes_on = |sign: &str| {
            rest.strip_prefix(sign).is_some_and(|rest| !rest.trim_start_matches(' ').starts_with('\n'))
        };
        goes_on("# ") || goes_on("-- ") || goes_on("; ") && self.text.begins_line(start)
    }

    fn foreign_comment(&mut self, start: usize, sequence: &mut Sequence) {
        let sign = match self.text.text.as_bytes()[start] {
            b'#' => "#",
            b';' => ";",
            _ => "--",
        };
        self.foreign_comments.push((sign, self.text.span(start, start + sign.len())));
        sequence.last = Last::Comment;
    }

    /// Reports what stands after the value of a field or definition on its line and is part of it: the second half of
    /// `1,5m`, or another value with nothing between.
    fn continues_value(&mut self, next: &Pair<'_, Rule>, sequence: &mut Sequence) -> bool {
        let last = sequence.last;
        let Some(value) = sequence.last_value() else { return false };
        let (start, written) = (next.as_span().start(), next.as_str());
        let before = &self.text.text[..start];
        let is_number = matches!(value.kind, ExprKind::Number { unit: None, integer: true, .. });
        if is_number && before.ends_with(',') && written.starts_with(|c: char| c.is_ascii_digit()) {
            let numeral = before[..start - 1].rsplit(|c: char| !c.is_ascii_digit() && c != '_').next();
            let second = written.lines().next().unwrap_or_default().trim_end();
            let hint = format!("the decimal sign is a point: `{}.{second}`", numeral.unwrap_or_default());
            let at = self.text.span(start - 1, start);
            self.note(SyntaxError::WrongSign { written: ",".to_owned(), wanted: ".", hint, at });
        } else if let Some(glued) = glued_unit(value, before, written) {
            let at = self
                .text
                .span(start, start + written.find(|c: char| !c.is_alphanumeric()).unwrap_or(written.len()));
            self.note(SyntaxError::ApartUnit { glued, at });
        } else if last == Last::Open && self.may_begin_entry(Rule::expr, start) {
            let is_moved = matches!(value.kind, ExprKind::Call { .. } | ExprKind::Binary { .. });
            let at = self.text.after_token(start);
            if is_moved && MOVES.iter().any(|word| written.starts_with(word)) {
                let hint = "write `then` between them: the left one is applied first".to_owned();
                let place = "between two transforms".to_owned();
                self.note(SyntaxError::MissingSign { sign: "then", place, hint, at });
            } else {
                let shown: String =
                    written.lines().next().unwrap_or_default().trim_end().chars().take(20).collect();
                let hint = "write an operator before it, or a comma and the name of a field".to_owned();
                let at = self.text.first_line_of(next);
                self.note(SyntaxError::Unreadable { what: format!("`{shown}` after a value"), hint, at });
            }
        } else {
            return false;
        }
        sequence.spoil_last();
        sequence.last = Last::Mistake;
        true
    }

    /// Reports what follows a thing on its line as only the block of a `place` may: `ring(5) { .. }`, where a block after
    /// a call is no block of it, and `place ring(5) rotate_y(3deg)`.
    fn misses_place(&mut self, next: &Pair<'_, Rule>, sequence: &mut Sequence) -> bool {
        let Some(Entry::Item(Item { kind, .. })) = sequence.entries.last() else { return false };
        let (start, written) = (next.as_span().start(), next.as_str());
        let is_move = next.as_rule() == Rule::expr && MOVES.iter().any(|word| written.starts_with(word));
        let (what, hint) = match kind {
            ItemKind::Value(Expr { kind: ExprKind::Call { callee, .. }, .. })
                if next.as_rule() == Rule::block =>
            {
                let ExprKind::Name(name) = &callee.kind else { return false };
                ("a block after a call", format!("write `place {name}(..) {{ .. }}`"))
            }
            ItemKind::Place(Place { body: None, .. }) if is_move => {
                ("a transform after a thing", "write `place .. { transform: .. }`".to_owned())
            }
            _ => return false,
        };
        let at = self.text.first_char(start);
        self.note(SyntaxError::Unreadable { what: what.to_owned(), hint, at });
        sequence.last = Last::Mistake;
        true
    }

    /// Reports a missing comma before an entry that shares its line with the one before.
    fn check_separation(&mut self, next: &Pair<'_, Rule>, in_block: bool, sequence: &mut Sequence) {
        let start = next.as_span().start();
        let is_field = matches!(next.as_rule(), Rule::field | Rule::bare_field);
        match sequence.last {
            Last::Word => self.after_word(next, in_block, sequence),
            Last::Open | Last::Block if sequence.last == Last::Open || is_field => {
                let what = if is_field { "fields" } else { "items" };
                let hint = "write `,` between them, or put each on a line of its own";
                let at = self.text.after_token(start);
                self.note(SyntaxError::MissingComma { what, hint, at, next: self.text.first_char(start) });
            }
            _ => {}
        }
    }

    /// A name alone with something after it on its line: a field without its colon, or a word that begins no item.
    fn after_word(&mut self, next: &Pair<'_, Rule>, in_block: bool, sequence: &mut Sequence) {
        let Some(Entry::Item(Item { kind, span: at, .. })) = sequence.entries.last_mut() else { return };
        let ItemKind::Value(value) = kind else { return };
        let ExprKind::Name(word) = &value.kind else { return };
        let (word, at) = (word.clone(), *at);
        *kind = ItemKind::Poison;
        sequence.poisoned = true;
        sequence.last = Last::Mistake;
        let hint = name_given(&word, next.as_str())
            .or_else(|| foreign_definition(&word))
            .or_else(|| did_you_mean(&word, ITEM_WORDS));
        let example =
            "an item is a definition, as in `let a = 1m`, or a block with its name, as in `sphere { .. }`";
        let is_value = matches!(next.as_rule(), Rule::expr | Rule::object | Rule::choice);
        if in_block && is_value && hint.is_none() {
            let sign = ":";
            let (place, hint) = (format!("after `{word}`"), format!("write `{word}: ..`"));
            self.note(SyntaxError::MissingSign { sign, place, hint, at: at.after() });
        } else {
            self.note(SyntaxError::UnknownItem {
                word,
                at,
                hint: hint.unwrap_or_else(|| example.to_owned()),
            });
        }
    }

    /// `field = { ident ~ (":" | wrong_equals) ~ given }`, `bare_field = { bare_name ~ missing_colon ~ value }`
    fn field_entry(&mut self, pair: Pair<'_, Rule>, in_block: bool, sequence: &mut Sequence) {
        let (start, written) = (pair.as_span().start(), pair.as_str());
        let mut parts = Parts::of(pair);
        let Some(name) = parts.next().map(|name| self.word(&name)) else { return };
        if is_reserved(&name) {
            return self.reserved_field(name, sequence);
        }
        // `sphere ( radius: 1m )`
        let paren = name.value.len() + written[name.value.len()..].find(|c| c != ' ').unwrap_or(0);
        if written[paren..].starts_with('(') && written[paren..].contains(':') {
            let hint = format!("a block stands between braces: `{} {{ .. }}`", name.value);
            let at = self.text.first_char(start + paren);
            self.note(SyntaxError::WrongSign { written: "(".to_owned(), wanted: "{", hint, at });
            sequence.push(item(ItemKind::Poison, name.span));
            return;
        }
        // What stands outside every block is no field, so its sign is not worth a word.
        if !in_block {
            if sequence.last != Last::Mistake {
                self.note(SyntaxError::StrayField { name: name.value.clone(), at: name.span });
            }
            let value = poison(name.span);
            sequence.push(item(ItemKind::Let { value, name: name.clone() }, name.span));
            return;
        }
        let example = || format!("write `{}: ..`", name.value);
        if let Some(sign) = parts.take(Rule::wrong_equals) {
            let (written, wanted) = ("=".to_owned(), ":");
            self.note(SyntaxError::WrongSign {
                written,
                wanted,
                hint: example(),
                at: self.text.span_of(&sign),
            });
        } else if parts.skip(Rule::missing_colon) {
            let (sign, place) = (":", format!("after `{}`", name.value));
            self.note(SyntaxError::MissingSign { sign, place, hint: example(), at: name.span.after() });
        }
        let what = || format!("the value of `{}`", name.value);
        let missing = |at| SyntaxError::MissingValue { what: what(), hint: example(), at };
        let value = self.given(&mut parts, missing).unwrap_or_else(|| poison(name.span));
        self.refuse_allows(sequence);
        sequence.entries.push(Entry::Field(Field { name, value }));
        sequence.last = Last::Open;
    }

    /// `let = 3`, `param: int = 3`: a definition without its name looks like a field.
    fn reserved_field(&mut self, name: Name, sequence: &mut Sequence) {
        sequence.push(item(ItemKind::Poison, name.span));
        let at = name.span.after();
        self.note(match name.value.as_str() {
            "let" | "param" | "fn" => {
                SyntaxError::MissingName { what: "this definition", example: "goblet", at }
            }
            _ => SyntaxError::ReservedWord { word: name.value, at: name.span },
        });
    }

    /// `allow` is for items.
    fn refuse_allows(&mut self, sequence: &mut Sequence) {
        sequence.allows_start = None;
        if let Some(allow) = sequence.allows.drain(..).next() {
            self.note(SyntaxError::BadAllow { at: allow.code.span, problem: "a field follows, not an item" });
        }
    }

    /// `allow = { kw_allow ~ "(" ~ (code | string | comma | junk)* ~ ")" }`
    fn allow(&mut self, pair: Pair<'_, Rule>, sequence: &mut Sequence) {
        let (start, at) = (pair.as_span().start(), self.text.span_of(&pair));
        let mut parts = Parts::of(pair);
        let code = parts.take(Rule::code).map(|code| self.word(&code));
        parts.skip(Rule::comma);
        let reason = parts.take(Rule::string).map(|reason| self.string(&reason));
        parts.skip(Rule::comma);
        match (code, reason, parts.next()) {
            (Some(_), Some(reason), None) if reason.value.trim().is_empty() => {
                self.note(SyntaxError::BadAllow { at: reason.span, problem: "no word in it" });
            }
            (Some(code), Some(reason), None) => sequence.allows.push(Allow { code, reason }),
            (None, ..) => self.note(SyntaxError::BadAllow { at, problem: "no code" }),
            (_, None, None) => self.note(SyntaxError::BadAllow { at, problem: "no reason" }),
            _ => self.note(SyntaxError::BadAllow { at, problem: "more than these two" }),
        }
        sequence.allows_start.get_or_insert(start);
    }

    /// What stands between parentheses or brackets, with a comma between each two.
    pub(super) fn elements<T>(
        &mut self,
        pair: Pair<'_, Rule>,
        what: &'static str,
        mut lower: impl FnMut(&mut Self, Pair<'_, Rule>) -> Option<T>,
    ) -> Vec<T> {
        let mut elements = Vec::new();
        let mut last = Last::Separated;
        for part in Parts::of(pair).rest() {
            let (start, before) = (part.as_span().start(), self.errors.len());
            if part.as_rule() == Rule::comma {
                last = self.element_comma(&part, last);
                continue;
            }
            if last == Last::Open
                && self.may_begin_entry(part.as_rule(), start)
                && part.as_rule() != Rule::broken
            {
                let (at, next) = (self.text.after_token(start), self.text.first_char(start));
                let hint = "write `,` between them";
                self.note(SyntaxError::MissingComma { what, hint, at, next });
            }
            match part.as_rule() {
                Rule::junk => self.unreadable(&part),
                Rule::broken | Rule::closer => {}
                _ => elements.extend(lower(self, part)),
            }
            // Up to the next comma all belongs to the first mistake.
            if last == Last::Mistake {
                self.errors.truncate(before);
            } else if self.errors.len() > before {
                last = Last::Mistake;
            } else {
                last = Last::Open;
            }
        }
        elements
    }

    /// `,` or `;` between elements.
    fn element_comma(&mut self, pair: &Pair<'_, Rule>, last: Last) -> Last {
        let at = self.text.span_of(pair);
        if pair.as_str() == ";" {
            let (written, hint) = (";".to_owned(), "elements are separated by commas".to_owned());
            self.note(SyntaxError::WrongSign { written, wanted: ",", hint, at });
        } else if last == Last::Separated {
            self.note(SyntaxError::ExtraComma { at });
        }
        Last::Separated
    }
}

impl Sequence {
    /// The value of the last field or definition.
    fn last_value(&mut self) -> Option<&mut Expr> {
        match self.entries.last_mut()? {
            Entry::Field(field) => Some(&mut field.value),
            Entry::Item(item) => match &mut item.kind {
                ItemKind::Let { value, .. } | ItemKind::Param { value, .. } => Some(value),
                _ => None,
            },
        }
    }

    /// Forgets the last value: what cannot be read after it on its line was part of it.
    fn spoil_last(&mut self) {
        self.poisoned = true;
        if let Some(value) = self.last_value() {
            value.kind = ExprKind::Poison;
        }
    }

    /// Adds an item with the `allow`s that wait for it.
    fn push(&mut self, mut item: Item) {
        item.allows = std::mem::take(&mut self.allows);
        self.poisoned |= matches!(item.kind, ItemKind::Poison);
        self.last = match &item.kind {
            ItemKind::Value(value) => match value.kind {
                ExprKind::Name(_) => Last::Word,
                ExprKind::Block(_) => Last::Block,
                _ => Last::Open,
            },
            ItemKind::Object(_)
            | ItemKind::For { .. }
            | ItemKind::If { .. }
            | ItemKind::Fn(_)
            | ItemKind::Units(_) => Last::Block,
            ItemKind::Poison => Last::Mistake,
            _ => Last::Open,
        };
        self.entries.push(Entry::Item(item));
    }
}

/// How a definition that other languages begin with `word` is written.
/// What to say of a word before `name = value`, as in `material red = diffuse { .. }`.
fn name_given(word: &str, next: &str) -> Option<String> {
    let name = &next[..next.bytes().take_while(|byte| byte.is_ascii_alphanumeric() || *byte == b'_').count()];
    let sign = next[name.len()..].trim_start_matches(' ').strip_prefix('=')?;
    let is_slip = did_you_mean(word, ["let", "param"]).is_some();
    let is_name = !name.is_empty() && !sign.starts_with('=') && !is_slip;
    is_name.then(|| format!("names are given by `let`: write `let {name} = ..`"))
}

fn foreign_definition(word: &str) -> Option<String> {
    let hint = match word {
        "var" | "const" | "val" | "auto" | "set" | "define" | "int" | "float" => "write `let a = 1m`",
        "def" | "func" | "function" | "macro" => "write `fn ring(n: int) -> object { .. }`",
        "use" | "using" | "require" => "write `import \"materials.snell\" as mat`",
        _ => return None,
    };
    Some(hint.to_owned())
}

/// The words that begin items, for those who nearly wrote one.
const ITEM_WORDS: [&str; 15] = [
    "allow",
    "camera",
    "environment",
    "fn",
    "for",
    "group",
    "if",
    "import",
    "include",
    "let",
    "light",
    "param",
    "place",
    "render",
    "units",
];
