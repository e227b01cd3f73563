//! From a value to the type that is wanted, or a report that says what was written and what to write.

use super::builtin;
use super::dimension::{Dimension, Quantity};
use super::error::Error;
use super::fields::EMPTY;
use super::meant::Wanted;
use super::mixed::{Part, unit_of};
use super::{Env, Resolver, Value, color};
use crate::diag::did_you_mean;
use crate::ir;
use crate::math::Rgb;
use crate::schema::{self, Type};
use crate::source::Span;
use crate::syntax::ast::{Expr, ExprKind};
use crate::syntax::spelled_out;

/// Below this a black body does not glow; above the upper end its colour stays the same.
const GLOWING: std::ops::RangeInclusive<f64> = 100.0..=1e9;

impl<'a> Resolver<'a> {
    /// The value of an expression of which a type is expected: poisoned, or of that type.
    pub(super) fn eval_as(&mut self, expr: &'a Expr, ty: Type, env: &Env<'a>) -> Value<'a> {
        match (ty, &expr.kind) {
            (_, ExprKind::Name(name)) if env.find(name).is_none() => self.word_as(name, expr.span, ty, env),
            (_, ExprKind::Name(name)) if ty.words().is_some_and(|words| words.contains(&name.as_str())) => {
                ty.words().and_then(|words| find_word(words, name)).map_or(Value::Poison, Value::Word)
            }
            (Type::Exposure, ExprKind::Object(object)) if object.kind.value == "photo" => {
                self.photo(object, env)
            }
            (Type::Method, ExprKind::Object(object)) if object.kind.value == "classic" => {
                let block = schema::block("classic").expect("declared in the registry");
                Value::Block(std::rc::Rc::new(self.read(block, object.kind.span, &object.body, env)))
            }
            // A text that lost its quotes, as in `file: teapot.obj`.
            (Type::Text, ExprKind::Access { base, .. }) if self.is_unknown(base, env) => {
                let text = self.text(expr.span);
                let help = format!("put it in quotes: `\"{text}\"`");
                self.wrong_type("a text in quotes", "no text", expr.span, &help)
            }
            (Type::Block(kind), ExprKind::Object(object)) if object.kind.value == kind => {
                let block = schema::block(kind).expect("types name declared blocks");
                Value::Block(std::rc::Rc::new(self.read(block, object.kind.span, &object.body, env)))
            }
            (_, ExprKind::Number { value, unit: Some(unit), .. }) => {
                let value = self.numeral(*value, Some(unit), Some(ty));
                self.coerce(value, ty, expr.span)
            }
            (Type::Block(kind), ExprKind::Block(body)) => {
                let block = schema::block(kind).expect("types name declared blocks");
                Value::Block(std::rc::Rc::new(self.read(block, body.span, body, env)))
            }
            (Type::Point | Type::Offset, ExprKind::Tuple(parts)) if parts.len() == 3 => {
                self.tuple_as(parts, Type::Length, env)
            }
            _ => {
                let value = self.eval(expr, env);
                self.coerce(value, ty, expr.span)
            }
        }
    }

    /// Whether an expression is a name that nothing defines.
    pub(super) fn is_unknown(&self, expr: &Expr, env: &Env<'a>) -> bool {
        matches!(&expr.kind, ExprKind::Name(name) if env.find(name).is_none())
    }

    /// Each part as `ty`, so that a report points at the part.
    pub(super) fn tuple_as(&mut self, parts: &'a [Expr], ty: Type, env: &Env<'a>) -> Value<'a> {
        let (mut values, mut lengths) = (Vec::with_capacity(parts.len()), Vec::new());
        for part in parts {
            self.bare = None;
            let value = self.eval_as(part, ty, env);
            if let Value::Number(quantity) = value {
                // What it was before it became a length.
                let is_bare = self.bare == Some(part.span);
                let quantity = if is_bare { Quantity::plain(quantity.value) } else { quantity };
                lengths.push(Part { quantity, span: part.span, is_written: true });
            }
            values.push(value);
        }
        self.doubt_bare(&lengths);
        if values.iter().any(Value::is_poison) { Value::Poison } else { Value::Tuple(values.into()) }
    }

    /// A word that the scene does not define: what it means depends on the type.
    fn word_as(&mut self, name: &str, used: Span, ty: Type, env: &Env<'a>) -> Value<'a> {
        let lens = |this: &mut Self, kind: &str| {
            let block = schema::block(kind).expect("declared in the registry");
            this.block(block, used, &EMPTY, env)
        };
        if let Some(words) = ty.words() {
            return match find_word(words, name) {
                Some(word) => Value::Word(word),
                None => self.poison(unknown_word(name, words, used)),
            };
        }
        match (ty, name) {
            (Type::Exposure, "auto") => Value::Word("auto"),
            (Type::Projection, "uv") => Value::Projection(ir::Projection::Uv),
            (Type::Lens, kind) if is_lens(kind) => lens(self, kind),
            (Type::Material, _) => match color::named(name) {
                Some(color) => self.coerce(Value::Color(color), ty, used),
                None => self.unknown_material(name, used, env),
            },
            (Type::Bool, "yes" | "no" | "off") => {
                let help = format!("write `{}`", name == "yes");
                self.poison(Error::UnknownWord { word: name.to_owned(), wanted: ty.noun(), used, help })
            }
            (Type::Filter | Type::Projection | Type::Lens | Type::Exposure, _)
                if builtin::find(name).is_none() =>
            {
                let help = did_you_mean(name, WORDS.iter().copied().filter(|word| is_word_of(ty, word)))
                    .unwrap_or_else(|| format!("write for example `{}`", ty.example()));
                self.poison(Error::UnknownWord { word: name.to_owned(), wanted: ty.noun(), used, help })
            }
            _ => {
                let value = self.name(name, used, Wanted::Value(ty), env);
                self.coerce(value, ty, used)
            }
        }
    }

    /// `value` as `ty`: poisoned, or of that type. Bare numbers become lengths in the units of the file.
    pub(super) fn coerce(&mut self, value: Value<'a>, ty: Type, span: Span) -> Value<'a> {
        if value.is_poison() {
            return value;
        }
        if let Some(dimension) = Dimension::of(ty) {
            return self.quantity_as(value, ty, dimension, span);
        }
        match (ty, value) {
            (Type::Bool, value @ Value::Bool(_))
            | (Type::Text, value @ Value::Text(_))
            | (Type::Material, value @ Value::Material(_))
            | (Type::Texture, value @ Value::Texture(_))
            | (Type::Object, value @ Value::Object(_))
            | (Type::Transform, value @ Value::Transform(_))
            | (Type::Lens, value @ Value::Lens(_))
            | (Type::Focus, value @ Value::Focus(_))
            | (Type::Size, value @ Value::Size(..))
            | (Type::Filter, value @ Value::Filter(_))
            | (Type::Stop, value @ Value::Stop(_))
            | (Type::Projection, value @ Value::Projection(_))
            | (Type::Curve | Type::Outline, value @ Value::Curve(_))
            | (Type::Path, value @ Value::Path(_))
            | (Type::Heights, value @ (Value::Texture(_) | Value::List(_) | Value::Function(_)))
            | (Type::Absorption, value @ Value::Absorption(..))
            | (Type::List | Type::Outlines, value @ Value::List(_))
            | (Type::Block(_), value @ Value::Block(_))
            | (
                Type::ColorInput | Type::RadianceInput | Type::NumberInput | Type::SkyInput,
                value @ Value::Texture(_),
            ) => value,
            (_, Value::Word(word)) if ty.words().is_some_and(|words| words.contains(&word)) => {
                Value::Word(word)
            }
            (Type::Falloff, value @ Value::Tuple(_)) => self.plain_triple(value, ty, span),
            (Type::Outlines, value @ Value::Curve(_)) => Value::List([value].into()),
            // A curve of the plane lies where z is 0.
            (Type::Path, Value::Curve(curve)) => {
                let points = curve.points.iter().map(|p| p.extend(0.0)).collect();
                Value::Path(ir::Path { kind: curve.kind, points, span: curve.span }.into())
            }
            (Type::Point | Type::Offset, value @ Value::Tuple(_)) => {
                self.triple_as(value, Type::Length, ty, span)
            }
            (Type::Vector, value @ Value::Tuple(_)) => self.direction(value, span),
            (Type::Pair | Type::Cells, value @ Value::Tuple(_)) => self.pair(value, ty, span),
            (Type::Cells, value @ Value::Number(Quantity { dimension: Dimension::NONE, .. })) => {
                Value::Tuple([value.clone(), value].into())
            }
            (Type::Focus, value @ Value::Number(_)) => {
                match self.quantity_as(value, Type::Length, Dimension::LENGTH, span) {
                    Value::Number(distance) => Value::Focus(ir::Focus::Distance(distance.value).into()),
                    _ => Value::Poison,
                }
            }
            (Type::Focus, value @ Value::Tuple(_)) => {
                let point = self.triple_as(value, Type::Length, Type::Point, span);
                point.triple().map_or(Value::Poison, |p| Value::Focus(ir::Focus::Point(p).into()))
            }
            (Type::LightColor | Type::SkyInput, Value::Number(q))
                if q.dimension == Dimension::TEMPERATURE =>
            {
                self.glow(q, span)
            }
            (ty, value) => match as_color(&value, ty) {
                Some(color) => Value::Color(color),
                None => self.refuse(&value, ty, span),
            },
        }
    }

    fn quantity_as(&mut self, value: Value<'a>, ty: Type, dimension: Dimension, span: Span) -> Value<'a> {
        let Value::Number(quantity) = value else {
            let is_auto = ty == Type::Exposure && matches!(value, Value::Word(_));
            return if is_auto { value } else { self.refuse(&value, ty, span) };
        };
        let bare = quantity.dimension == Dimension::NONE;
        match ty {
            Type::Int if bare && quantity.value.fract() != 0.0 => {
                self.wrong_type("a whole number", "a number with a fraction", span, "round it: `round(x)`")
            }
            Type::Length if bare => {
                self.bare = Some(span);
                Value::Number(Quantity::new(quantity.value * self.unit.metres, dimension))
            }
            Type::FNumber | Type::Pixels if bare => Value::Number(Quantity::new(quantity.value, dimension)),
            _ if quantity.dimension == dimension => Value::Number(quantity),
            _ if bare => {
                let (wanted, text) = (ty.noun(), self.text(span));
                let help = unit_help(&text, quantity.value, ty);
                self.poison(Error::MissingUnit { wanted, text, used: span, help })
            }
            _ => self.refuse(&Value::Number(quantity), ty, span),
        }
    }

    fn triple_as(&mut self, value: Value<'a>, part: Type, whole: Type, span: Span) -> Value<'a> {
        let Value::Tuple(parts) = value else { return Value::Poison };
        if parts.len() != 3 {
            return self.refuse(&Value::Tuple(parts), whole, span);
        }
        self.doubt_tuple(&parts, span);
        let values: Vec<Value> = parts.iter().map(|value| self.coerce(value.clone(), part, span)).collect();
        if values.iter().any(Value::is_poison) { Value::Poison } else { Value::Tuple(values.into()) }
    }

    /// Three plain numbers, or three lengths: the difference of two points is a direction too.
    fn direction(&mut self, value: Value<'a>, span: Span) -> Value<'a> {
        let is = |value: &Value, dimension| matches!(value, Value::Number(q) if q.dimension == dimension);
        let Value::Tuple(parts) = &value else { return Value::Poison };
        let plain = parts.iter().all(|part| is(part, Dimension::NONE));
        let lengths = parts.iter().all(|part| is(part, Dimension::LENGTH));
        if parts.len() == 3 && (plain || lengths) { value } else { self.refuse(&value, Type::Vector, span) }
    }

    fn plain_triple(&mut self, value: Value<'a>, ty: Type, span: Span) -> Value<'a> {
        let Value::Tuple(parts) = &value else { return Value::Poison };
        let plain = |part: &Value| matches!(part, Value::Number(q) if q.dimension == Dimension::NONE);
        if parts.len() == 3 && parts.iter().all(plain) { value } else { self.refuse(&value, ty, span) }
    }

    fn pair(&mut self, value: Value<'a>, ty: Type, span: Span) -> Value<'a> {
        let Value::Tuple(parts) = &value else { return Value::Poison };
        let plain = |part: &Value| matches!(part, Value::Number(q) if q.dimension == Dimension::NONE);
        if parts.len() == 2 && parts.iter().all(plain) { value } else { self.refuse(&value, ty, span) }
    }

    /// The colour of a black body.
    fn glow(&mut self, temperature: Quantity, used: Span) -> Value<'a> {
        if GLOWING.contains(&temperature.value) {
            return Value::Color(color::black_body(temperature.value));
        }
        let range = "from 100K to 1000000000K".to_owned();
        let (field, found) = ("color".to_owned(), format!("`{}`", self.text(used)));
        let help = "daylight is `6500K`, a light bulb `2700K`".to_owned();
        self.poison(Error::OutOfRange { field, range, found, used, said: None, help })
    }

    /// A report that a value is not of the type wanted.
    pub(super) fn refuse(&mut self, value: &Value<'a>, ty: Type, used: Span) -> Value<'a> {
        let (wanted, text, found) = (ty.noun(), self.text(used), value.noun());
        let help = match (ty, value) {
            (_, Value::Text(words)) if is_written_bare(words, ty) => {
                format!("write it without quotes: `{words}`")
            }
            (Type::Material, Value::Color(_)) if metals().contains(&text.as_str()) => {
                format!(
                    "for the metal write `metal {{ kind: {text} }}`, for the colour `diffuse {{ color: {text} }}`"
                )
            }
            (Type::Material, Value::Color(_)) => format!("make it a material: `diffuse {{ color: {text} }}`"),
            (Type::Material, Value::Texture(_)) => {
                "put it into a material: `diffuse { color: .. }`".to_owned()
            }
            (Type::Color | Type::ColorInput | Type::RadianceInput | Type::LightColor, Value::Tuple(_)) => {
                format!("write `rgb{text}`")
            }
            (
                Type::Texture | Type::ColorInput | Type::RadianceInput | Type::NumberInput | Type::SkyInput,
                Value::Text(_),
            ) => {
                format!("a picture is `image({text})`")
            }
            (Type::Stop, Value::Number(count)) if count.dimension == Dimension::NONE => {
                format!("write `samples({text})`")
            }
            (Type::Bool, Value::Number(_)) => format!("compare it, as in `{text} == 0`"),
            (_, Value::Function(_)) => format!("call it: `{text}(..)`"),
            (_, Value::Builtin(builtin)) => format!("call it, as in `{}`", builtin.function.example),
            (Type::Point | Type::Offset | Type::Vector, Value::List(_)) => {
                format!("points stand in parentheses: `({})`", text.trim_matches(['[', ']']))
            }
            (Type::Size, Value::Tuple(parts)) if let [Value::Number(w), Value::Number(h)] = parts[..] => {
                format!("write `{} x {}`", w.value, h.value)
            }
            (Type::Path, Value::List(_)) => format!("say how to join the points: `polyline {text}`"),
            (Type::Curve, Value::Path(_)) => "points of a profile are (radius, height)".to_owned(),
            (Type::Outline, Value::Path(_)) => "points of an outline are (x, y)".to_owned(),
            (Type::Curve, Value::List(_)) => format!("say how to join the points: `polyline {text}`"),
            (Type::Outline, Value::List(_)) => format!("say how to join the points: `polygon {text}`"),
            _ => format!("write {}, such as `{}`", ty.noun(), ty.example()),
        };
        match value {
            Value::Number(_) if Dimension::of(ty).is_some() => {
                self.poison(Error::WrongDimension { wanted, text, found, used, help })
            }
            _ => self.poison(Error::WrongType { wanted, text, found, used, help }),
        }
    }

    /// A report that something else is wanted, in words of its own.
    pub(super) fn wrong_type(&mut self, wanted: &str, found: &str, used: Span, help: &str) -> Value<'a> {
        let (wanted, found, help) = (wanted.to_owned(), found.to_owned(), help.to_owned());
        let text = self.text(used);
        self.poison(Error::WrongType { wanted, text, found, used, help })
    }
}

/// Whether a text would be a value of this type if it stood without its quotes.
fn is_written_bare(words: &str, ty: Type) -> bool {
    let is_number = Dimension::of(ty).is_some() && (words.parse::<f64>().is_ok() || unit_of(words).is_some());
    let takes_color = ty.takes_color() || ty == Type::Absorption;
    is_number || takes_color && color::named(words).is_some() || is_word_of(ty, words)
}

/// The report of a word that is none of those that may stand there.
pub fn unknown_word(word: &str, words: &'static [&'static str], used: Span) -> Error {
    let wanted = Type::Choice(words).noun();
    let ours = Type::foreign_word(word, words)
        .or_else(|| spelled_out(word).and_then(|unit| words.iter().copied().find(|word| *word == unit)));
    let help = ours
        .map(|ours| format!("it is called `{ours}` here"))
        .or_else(|| did_you_mean(word, words.iter().copied()))
        .unwrap_or_else(|| format!("write for example `{}`", words[0]));
    Error::UnknownWord { word: word.to_owned(), wanted, used, help }
}

/// Words that mean something where some type or other is wanted.
const WORDS: [&str; 8] =
    ["auto", "uv", "pinhole", "thin", "orthographic", "panorama", "fisheye", "prescription"];

fn is_lens(word: &str) -> bool {
    schema::block(word).is_some_and(|block| Type::Lens.takes(block))
}

/// Whether a word means something where this type is wanted, whatever the scene defines.
pub fn is_word_of(ty: Type, word: &str) -> bool {
    match ty {
        _ if ty.words().is_some_and(|words| words.contains(&word)) => true,
        Type::Exposure => word == "auto",
        Type::Projection => word == "uv",
        Type::Lens => is_lens(word),
        _ => false,
    }
}

/// Metals that have names.
fn metals() -> &'static [&'static str] {
    let kind = schema::block("metal").and_then(|metal| metal.field("kind"));
    kind.and_then(|kind| kind.ty.words()).unwrap_or_default()
}

fn find_word(words: &'static [&'static str], name: &str) -> Option<&'static str> {
    words.iter().copied().find(|word| *word == name)
}

/// A colour, or a plain number as grey, where the type takes them.
fn as_color(value: &Value, ty: Type) -> Option<Rgb> {
    let grey_only = ty == Type::NumberInput;
    let takes_color = ty.takes_color() || grey_only;
    match value {
        Value::Color(color) if takes_color && !grey_only => Some(*color),
        Value::Number(q) if takes_color && q.dimension == Dimension::NONE => Some(Rgb::gray(q.value as f32)),
        _ => None,
    }
}

/// What to write instead of a bare number: `30deg`.
fn unit_help(text: &str, value: f64, ty: Type) -> String {
    let unit = match ty {
        Type::Angle => "deg",
        Type::Time => "s",
        Type::Power => "W",
        Type::Temperature => "K",
        _ => "EV",
    };
    let is_numeral = text.parse::<f64>().is_ok_and(|written| written == value);
    if is_numeral {
        format!("write `{text}{unit}`")
    } else {
        format!("give it a unit: multiply it by `1{unit}`")
    }
}
