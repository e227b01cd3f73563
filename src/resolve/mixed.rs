//! Numbers without a unit beside numbers with one: `(40cm, 40cm, 40)` is 40 cm, 40 cm and 40 m.
//!
//! Where a file says what its bare numbers are, as in `units { length: cm }`, there is nothing to doubt.

use super::dimension::{Dimension, Quantity};
use super::error::Error;
use super::{Resolver, Value};
use crate::schema;
use crate::source::{Span, Spanned};

/// What a bare length is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BareUnit {
    /// In metres.
    pub metres: f64,
    /// Whether the file says so.
    pub is_said: bool,
}

impl BareUnit {
    /// Of a file that says nothing.
    pub const METRE: Self = Self { metres: 1.0, is_said: false };
}

/// One of several lengths that belong together.
pub struct Part {
    /// What it is; a plain number if it has no unit.
    pub quantity: Quantity,
    /// Where it is used.
    pub span: Span,
    /// Whether it is written there.
    pub is_written: bool,
}

impl Part {
    fn is_bare(&self) -> bool {
        self.quantity.dimension == Dimension::NONE
    }
}

impl<'a> Resolver<'a> {
    /// Warns of bare numbers among values that were written one by one and shall be lengths.
    pub(super) fn doubt_written<'v>(&mut self, parts: impl Iterator<Item = &'v Spanned<Value<'a>>>)
    where
        'a: 'v,
    {
        let part = |part: &Spanned<Value>| match part.value {
            Value::Number(quantity) => Some(Part { quantity, span: part.span, is_written: true }),
            _ => None,
        };
        self.doubt_bare(&parts.filter_map(part).collect::<Vec<_>>());
    }

    /// Warns of bare numbers in a tuple that was made elsewhere and is used as a point at `span`.
    pub(super) fn doubt_tuple(&mut self, parts: &[Value<'a>], span: Span) {
        let part = |part: &Value| match part {
            Value::Number(quantity) => Some(Part { quantity: *quantity, span, is_written: false }),
            _ => None,
        };
        self.doubt_bare(&parts.iter().filter_map(part).collect::<Vec<_>>());
    }

    /// Warns of the numbers without a unit, if others have one. Zero is zero in any unit.
    pub(super) fn doubt_bare(&mut self, parts: &[Part]) {
        let Some(measured) = parts.iter().find(|part| !part.is_bare()) else { return };
        if self.unit.is_said {
            return;
        }
        for part in parts.iter().filter(|part| part.is_bare() && part.quantity.value != 0.0) {
            let text = self.text_of(part);
            let unit = parts.iter().find_map(|part| unit_of(&self.text_of(part))).unwrap_or("m");
            let help = match text.parse::<f64>() {
                Ok(_) if unit == "m" => format!("write `{text}m`"),
                Ok(_) => format!("did you mean `{text}{unit}`? for metres write `{text}m`"),
                Err(_) => format!("give it a unit: multiply it by `1{unit}`"),
            };
            let (used, beside) = (part.span, Some(measured.span).filter(|_| measured.is_written));
            self.report(Error::MixedUnits { text, used, beside, help });
        }
    }

    fn text_of(&self, part: &Part) -> String {
        if part.is_written { self.text(part.span) } else { part.quantity.write() }
    }
}

/// The unit of a numeral as it is written, as `cm` of `-2.5cm`.
pub fn unit_of(text: &str) -> Option<&'static str> {
    let number = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    number.parse::<f64>().ok()?;
    schema::unit(&text[number.len()..]).map(|unit| unit.name)
}
