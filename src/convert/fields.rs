//! Fields by their roles: what a block holds, and how readers take it out.

use super::log::{Log, READ};
use super::mistake::Mistake;
use super::parse::{Block, List, Number, Span, Word};
use super::words::{Args, Vocabulary};
use crate::math::DVec3;

/// A key and its values.
#[derive(Debug)]
pub struct Field<'t> {
    /// The key as written.
    pub key: &'t str,
    /// What it means; empty if that is not known.
    pub role: &'static str,
    pub numbers: Vec<Number<'t>>,
    pub word: Option<Word<'t>>,
    pub lists: Vec<List<'t>>,
    /// From the key to its last value.
    pub span: Span,
    /// Whether the role follows from the look of the key only.
    pub guessed: bool,
    /// Whether it has the values it should have; if not, that is noted already.
    pub sound: bool,
}

impl Field<'_> {
    /// The `i`-th number, or 0.
    pub fn number(&self, i: usize) -> f64 {
        self.numbers.get(i).map_or(0.0, |number| number.value)
    }

    /// The first three numbers; a single one is a grey.
    pub fn vector(&self) -> DVec3 {
        match self.numbers[..] {
            [ref grey] => DVec3::splat(grey.value),
            _ => DVec3::new(self.number(0), self.number(1), self.number(2)),
        }
    }

    /// Whether it is one number, or a pair of them: a share rather than a colour.
    pub fn is_share(&self) -> bool {
        (1..3).contains(&self.numbers.len()) && self.word.is_none()
    }

    /// Whether nothing follows the key but, perhaps, a word for yes.
    pub fn is_flag(&self) -> bool {
        self.numbers.is_empty()
    }

    /// Whether it holds three numbers or more.
    pub fn is_vector(&self) -> bool {
        self.numbers.len() >= 3
    }

    /// The word among its values, empty if there is none.
    pub fn text(&self) -> &str {
        self.word.as_ref().map_or("", |word| word.text)
    }
}

/// What a block holds, in the order of the file.
#[derive(Debug)]
pub enum Part<'t> {
    Field(Field<'t>),
    Block(Block<'t>),
}

/// What a block holds, when the order does not matter.
#[derive(Debug)]
pub struct Fields<'t> {
    pub block: String,
    /// The block's name and brace.
    pub head: Span,
    pub span: Span,
    list: Vec<Field<'t>>,
    blocks: Vec<Block<'t>>,
    vocabulary: &'static Vocabulary,
}

impl<'t> Fields<'t> {
    /// Whether a field of this role is there, sound or not.
    pub fn has(&self, role: &str) -> bool {
        self.list.iter().any(|field| field.role == role)
    }

    /// The fields that nobody took yet.
    pub fn rest(&self) -> &[Field<'t>] {
        &self.list
    }

    /// The first field of a role, without taking it.
    pub fn peek(&self, role: &str) -> Option<&Field<'t>> {
        self.list.iter().find(|field| field.role == role)
    }

    /// The first field of a role that `fits`, without taking it.
    pub fn peek_where(&self, role: &str, fits: impl Fn(&Field<'t>) -> bool) -> Option<&Field<'t>> {
        self.list.iter().find(|field| field.role == role && fits(field))
    }

    /// Takes away a key that its reader has told of.
    pub fn forget(&mut self, key: &str) {
        if let Some(at) = self.list.iter().position(|field| field.key == key) {
            self.list.remove(at);
        }
    }

    /// Takes the first inner block that `fits`.
    pub fn take_block(&mut self, fits: impl Fn(&str) -> bool) -> Option<Block<'t>> {
        let at = self.blocks.iter().position(|block| fits(block.name()))?;
        Some(self.blocks.remove(at))
    }
}

impl Log {
    /// Sorts a block's content into fields and blocks by role, for blocks in which the order does not matter.
    pub fn fields<'t>(&mut self, block: Block<'t>, vocabulary: &'static Vocabulary) -> Fields<'t> {
        let (name, head, span) = (block.name().to_string(), block.head.clone(), block.span.clone());
        let (mut list, mut blocks) = (Vec::new(), Vec::new());
        for part in self.parts(block.body, vocabulary) {
            match part {
                Part::Field(field) => list.push(field),
                Part::Block(block) => blocks.push(block),
            }
        }
        Fields { block: name, head, span, list, blocks, vocabulary }
    }

    /// Takes the field of a role. If it was written several times the last one counts, as in the original; one whose
    /// role is only guessed does not count beside one that is known.
    pub fn take<'t>(&mut self, fields: &mut Fields<'t>, role: &str) -> Option<Field<'t>> {
        self.take_where(fields, role, |_| true)
    }

    /// Takes the field of a role that `fits`, where fields of one role can be of several kinds.
    pub fn take_where<'t>(
        &mut self,
        fields: &mut Fields<'t>,
        role: &str,
        fits: impl Fn(&Field<'t>) -> bool,
    ) -> Option<Field<'t>> {
        let is_meant = |field: &Field<'t>| field.role == role && fits(field);
        let any_sure = fields.list.iter().any(|field| is_meant(field) && !field.guessed);
        let counts = |field: &Field<'t>| is_meant(field) && (!field.guessed || !any_sure);
        let last = fields.list.iter().rposition(counts)?;
        let field = fields.list.remove(last);
        let (earlier, rest) =
            std::mem::take(&mut fields.list).into_iter().partition::<Vec<_>, _>(|field| counts(field));
        fields.list = rest;
        for earlier in earlier {
            self.repeated(field.key, &earlier.span, &field.span);
        }
        if !field.sound {
            self.dropped(&field.span, "malformed");
            return None;
        }
        if field.guessed {
            self.guess(field.key, role, &field.span);
        }
        self.mapped(&field.span, READ); // until the reader says what it becomes
        Some(field)
    }

    /// Takes all fields of a role that may stand several times, in the order of the file.
    pub fn take_all<'t>(&mut self, fields: &mut Fields<'t>, role: &str) -> Vec<Field<'t>> {
        let places: Vec<usize> =
            fields.list.iter().filter(|field| field.role == role).map(|field| field.span.start).collect();
        let here = |place| move |field: &Field<'_>| field.span.start == place;
        places.into_iter().filter_map(|place| self.take_where(fields, role, here(place))).collect()
    }

    /// Takes the first role that is there.
    pub fn take_any<'t>(&mut self, fields: &mut Fields<'t>, roles: &[&str]) -> Option<Field<'t>> {
        roles.iter().find_map(|role| self.take(fields, role))
    }

    /// Takes a field of three numbers, which becomes `to`.
    pub fn vector(&mut self, fields: &mut Fields<'_>, role: &str, to: &str) -> Option<DVec3> {
        let field = self.take(fields, role)?;
        self.mapped(&field.span, to);
        Some(field.vector())
    }

    /// Takes a field of one number, which becomes `to`.
    pub fn number(&mut self, fields: &mut Fields<'_>, role: &str, to: &str) -> Option<f64> {
        let field = self.take(fields, role)?;
        self.mapped(&field.span, to);
        Some(field.number(0))
    }

    /// Takes a field that must be there.
    pub fn need<'t>(&mut self, fields: &mut Fields<'t>, role: &'static str) -> Option<Field<'t>> {
        if !fields.has(role) {
            let row = fields.vocabulary.find(role);
            let help = match row.map(|row| row.args) {
                Some(Args::Numbers(count)) => format!("add `{}`", example(role, count)),
                Some(Args::Path) => format!("add `{role} FILE`"),
                _ => format!("add `{role}`"),
            };
            let at = fields.head.clone().into();
            self.notes.note(Mistake::MissingField { block: fields.block.clone(), field: role, at, help });
        }
        self.take(fields, role)
    }

    /// Takes a field of three numbers that must be there.
    pub fn need_vector(&mut self, fields: &mut Fields<'_>, role: &'static str, to: &str) -> Option<DVec3> {
        let field = self.need(fields, role)?;
        self.mapped(&field.span, to);
        Some(field.vector())
    }

    /// Takes a field of one number that must be there.
    pub fn need_number(&mut self, fields: &mut Fields<'_>, role: &'static str, to: &str) -> Option<f64> {
        let field = self.need(fields, role)?;
        self.mapped(&field.span, to);
        Some(field.number(0))
    }

    /// Drops every field of these roles, for one stated reason.
    pub fn put_aside(&mut self, fields: &mut Fields<'_>, roles: &[&str], why: &str) {
        let (aside, rest) = std::mem::take(&mut fields.list)
            .into_iter()
            .partition::<Vec<_>, _>(|field| !field.guessed && roles.contains(&field.role));
        fields.list = rest;
        for field in aside {
            self.dropped(&field.span, why);
        }
    }

    /// What nobody took: unknown fields and blocks, with a warning for each.
    pub fn finish(&mut self, fields: Fields<'_>) {
        for field in fields.list {
            self.unknown_field(&field, &fields.block, fields.vocabulary);
        }
        for block in fields.blocks {
            self.unknown_block(&block, format!("in `{}`", fields.block), &[]);
        }
    }

    /// What nobody took of a block that is lost: one mistake is enough.
    pub fn finish_lost(&mut self, fields: Fields<'_>, why: &str) {
        for field in fields.list {
            self.dropped(&field.span, why);
        }
        for block in fields.blocks {
            self.drop_all(&block.span, why);
        }
        self.lose(&fields.span, why);
    }

    /// Drops a field with a warning. A field with a role is known to the family, but not in this place.
    pub fn unknown_field(&mut self, field: &Field<'_>, block: &str, vocabulary: &'static Vocabulary) {
        if !field.sound {
            return self.dropped(&field.span, "malformed");
        }
        let is_known = !field.role.is_empty() && !field.guessed;
        self.dropped(
            &field.span,
            if is_known { "without a meaning here" } else { "not known to the converter" },
        );
        let help = if is_known {
            Some(format!("this kind of `{block}` gives it no meaning"))
        } else {
            self.proposal(field.key, vocabulary.keys())
        };
        let at = field.span.clone().into();
        self.notes.note(Mistake::UnknownField { field: field.key.into(), block: block.into(), at, help });
    }

    /// Compares a count with what it counts. The braces win.
    pub fn check_count(&mut self, field: &Field<'_>, found: usize) {
        if !field.sound {
            return self.dropped(&field.span, "malformed");
        }
        self.mapped(&field.span, "counts what follows, which the braces tell by themselves");
        if field.number(0) != found as f64 {
            self.notes.note(Mistake::CountMismatch {
                key: field.key.into(),
                said: field.numbers.first().map_or("", |number| number.text).into(),
                found,
                at: field.span.clone().into(),
            });
        }
    }
}

/// What a field looks like, for the help of a mistake.
pub fn example(key: &str, count: usize) -> String {
    let numbers = match (key, count) {
        ("up" | "normal", _) => " 0 1 0".into(),
        ("direction", _) => " 0 0 -1".into(),
        ("angle", _) => " 45".into(),
        (_, 1) => " 1".into(),
        (_, 3) => " 0 0 0".into(),
        (_, count) => " 0".repeat(count),
    };
    format!("{key}{numbers}")
}
