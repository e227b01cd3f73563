//! What a field of a block is declared with.

use super::{Range, Type};

/// A field of a block.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// The word before the colon.
    pub name: &'static str,
    /// What may stand after it.
    pub ty: Type,
    /// What happens without it.
    pub need: Need,
    /// Which values make sense, in SI units.
    pub range: Option<Range>,
    /// A field that it means nothing without.
    pub beside: Option<&'static str>,
    /// What it is, in one sentence.
    pub doc: &'static str,
    /// A value that could stand there, where the type's own example would mislead.
    sample: Option<&'static str>,
}

/// What happens when a field is left out.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Need {
    /// That is a mistake.
    Required,
    /// Nothing stands in for it, or the block's documentation says what does.
    Optional,
    /// This stands in for it.
    Default(Literal),
}

/// A default, in SI units.
#[derive(Clone, Copy, PartialEq, Debug)]
#[expect(missing_docs, reason = "each is its type")]
pub enum Literal {
    Number(f64),
    Word(&'static str),
    Bool(bool),
    Triple([f64; 3]),
    Pair([f64; 2]),
    Size([u32; 2]),
}

/// A field that may be left out, with nothing in its place.
pub(super) const fn field(name: &'static str, ty: Type, doc: &'static str) -> Field {
    Field { name, ty, need: Need::Optional, range: None, beside: None, doc, sample: None }
}

impl Field {
    pub(super) const fn required(self) -> Self {
        Self { need: Need::Required, ..self }
    }

    /// A default number, in SI units.
    pub(super) const fn or(self, value: f64) -> Self {
        Self { need: Need::Default(Literal::Number(value)), ..self }
    }

    pub(super) const fn or_word(self, word: &'static str) -> Self {
        Self { need: Need::Default(Literal::Word(word)), ..self }
    }

    pub(super) const fn or_bool(self, value: bool) -> Self {
        Self { need: Need::Default(Literal::Bool(value)), ..self }
    }

    pub(super) const fn or_triple(self, x: f64, y: f64, z: f64) -> Self {
        Self { need: Need::Default(Literal::Triple([x, y, z])), ..self }
    }

    pub(super) const fn or_pair(self, x: f64, y: f64) -> Self {
        Self { need: Need::Default(Literal::Pair([x, y])), ..self }
    }

    pub(super) const fn or_size(self, width: u32, height: u32) -> Self {
        Self { need: Need::Default(Literal::Size([width, height])), ..self }
    }

    pub(super) const fn within(self, range: Range) -> Self {
        Self { range: Some(range), ..self }
    }

    /// Means nothing unless that field is given too.
    pub(super) const fn beside(self, name: &'static str) -> Self {
        Self { beside: Some(name), ..self }
    }

    pub(super) const fn like(self, sample: &'static str) -> Self {
        Self { sample: Some(sample), ..self }
    }

    /// A value that could stand there: `30cm`.
    pub fn example(&self) -> &'static str {
        self.sample.unwrap_or_else(|| self.ty.example())
    }

    /// The default as it would be written.
    pub fn default_text(&self) -> Option<String> {
        let Need::Default(literal) = self.need else { return None };
        let write = |value| self.ty.write(value);
        Some(match literal {
            Literal::Number(value) => write(value),
            Literal::Word(word) => word.to_owned(),
            Literal::Bool(value) => value.to_string(),
            Literal::Triple([x, y, z]) => format!("({}, {}, {})", write(x), write(y), write(z)),
            Literal::Pair([x, y]) => format!("({}, {})", write(x), write(y)),
            Literal::Size([width, height]) => format!("{width} x {height}"),
        })
    }
}
