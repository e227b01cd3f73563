//! The functions of the language: what each does with its arguments. What they are called with, the registry says.

use super::arguments::Given;
use super::dimension::{Dimension, Quantity};
use super::error::Error;
use super::noise;
use super::{Resolver, Value, color};
use crate::math::{DVec3, Rgb};
use crate::schema::{self, Function, Type};
use crate::source::{Span, Spanned};
use rustc_hash::FxHashMap;
use std::sync::LazyLock;

/// A function of the language.
pub struct Builtin {
    /// What the registry declares of it.
    pub function: &'static Function,
    rule: Rule,
}

/// What a function does with its arguments.
#[derive(Clone, Copy)]
enum Rule {
    /// A plain number from plain numbers.
    Plain(fn(&[f64]) -> f64),
    /// A plain number from an angle.
    OfAngle(fn(f64) -> f64),
    /// An angle from plain numbers.
    ToAngle(fn(f64) -> f64),
    /// One of several numbers of one dimension, or something between them.
    Same(fn(&[f64]) -> f64),
    /// As its name says; see `by_name`.
    Numeric,
    /// A colour from three numbers.
    Color(fn([f64; 3]) -> Rgb),
    /// A transform, filter, rule to stop by or texture; see `constructor`.
    Constructor,
    /// A curve, whose points are read as they are written; see `constructor`.
    Curve,
}

const RULES: &[(&str, Rule)] = &[
    ("sin", Rule::OfAngle(libm::sin)),
    ("cos", Rule::OfAngle(libm::cos)),
    ("tan", Rule::OfAngle(tan)),
    ("asin", Rule::ToAngle(libm::asin)),
    ("acos", Rule::ToAngle(libm::acos)),
    ("atan", Rule::ToAngle(libm::atan)),
    ("atan2", Rule::Numeric),
    ("sqrt", Rule::Numeric),
    ("pow", Rule::Numeric),
    ("exp", Rule::Plain(|x| libm::exp(x[0]))),
    ("log", Rule::Plain(|x| libm::log(x[0]))),
    ("floor", Rule::Plain(|x| x[0].floor())),
    ("ceil", Rule::Plain(|x| x[0].ceil())),
    ("round", Rule::Plain(|x| x[0].round())),
    ("random", Rule::Plain(|x| noise::random(x[0], x[1]))),
    ("abs", Rule::Same(|x| x[0].abs())),
    ("min", Rule::Same(|x| x.iter().copied().fold(f64::INFINITY, f64::min))),
    ("max", Rule::Same(|x| x.iter().copied().fold(f64::NEG_INFINITY, f64::max))),
    ("clamp", Rule::Same(|x| if x[1] <= x[2] { x[0].clamp(x[1], x[2]) } else { f64::NAN })),
    ("lerp", Rule::Numeric),
    ("dot", Rule::Numeric),
    ("cross", Rule::Numeric),
    ("length", Rule::Numeric),
    ("normalize", Rule::Numeric),
    ("len", Rule::Numeric),
    ("noise", Rule::Numeric),
    ("rgb", Rule::Color(|[r, g, b]| Rgb::new(r as f32, g as f32, b as f32))),
    ("srgb", Rule::Color(|[r, g, b]| Rgb::from_srgb(r as f32, g as f32, b as f32))),
    ("hsv", Rule::Color(|[h, s, v]| color::from_hsv(h, s, v))),
    ("translate", Rule::Constructor),
    ("scale", Rule::Constructor),
    ("rotate_x", Rule::Constructor),
    ("rotate_y", Rule::Constructor),
    ("rotate_z", Rule::Constructor),
    ("rotate", Rule::Constructor),
    ("look_at", Rule::Constructor),
    ("matrix", Rule::Constructor),
    ("moving", Rule::Constructor),
    ("samples", Rule::Constructor),
    ("passes", Rule::Constructor),
    ("time", Rule::Constructor),
    ("error", Rule::Constructor),
    ("box", Rule::Constructor),
    ("tent", Rule::Constructor),
    ("gaussian", Rule::Constructor),
    ("mitchell", Rule::Constructor),
    ("blackman_harris", Rule::Constructor),
    ("image", Rule::Constructor),
    ("bezier", Rule::Curve),
    ("bspline", Rule::Curve),
    ("polyline", Rule::Curve),
    ("polygon", Rule::Curve),
];

/// Every declared function with its rule.
static BUILTINS: LazyLock<FxHashMap<&str, Builtin>> = LazyLock::new(|| {
    let rule = |name: &str| RULES.iter().find(|(known, _)| *known == name).map(|(_, rule)| *rule);
    let of =
        |function: &'static Function| Some((function.name, Builtin { function, rule: rule(function.name)? }));
    schema::functions().filter_map(of).collect()
});

/// The function of this name.
pub fn find(name: &str) -> Option<&'static Builtin> {
    BUILTINS.get(name)
}

/// The names of all functions.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    schema::functions().map(|function| function.name)
}

impl Builtin {
    /// The function's name.
    pub fn name(&self) -> &'static str {
        self.function.name
    }

    /// What an argument is, where that is known before its value is.
    pub fn type_of_argument(&self, index: usize) -> Option<Type> {
        let args = self.function.forms.iter().filter_map(|form| form.get(index));
        args.into_iter().find_map(|arg| match arg.takes {
            schema::Takes::Of(ty) => Some(ty),
            _ => None,
        })
    }
}

impl<'a> Resolver<'a> {
    /// Calls a function of the language.
    pub(super) fn call_builtin(
        &mut self,
        builtin: &'static Builtin,
        args: Vec<Given<'a, '_>>,
        used: Span,
    ) -> Value<'a> {
        if args.iter().any(|(_, value)| value.is_poison()) {
            return Value::Poison;
        }
        let Some(args) = self.fit(builtin.function, args, used) else { return Value::Poison };
        let numbers = |args: &[Spanned<Value>]| -> Vec<f64> {
            args.iter().filter_map(|arg| number(&arg.value)).map(|quantity| quantity.value).collect()
        };
        match builtin.rule {
            Rule::Plain(f) => self.result(builtin, &args, f(&numbers(&args)), Dimension::NONE, used),
            Rule::OfAngle(f) => self.result(builtin, &args, f(numbers(&args)[0]), Dimension::NONE, used),
            Rule::ToAngle(f) => self.result(builtin, &args, f(numbers(&args)[0]), Dimension::ANGLE, used),
            Rule::Same(f) => match self.same_dimension(builtin, &args) {
                Some(dimension) => self.result(builtin, &args, f(&numbers(&args)), dimension, used),
                None => Value::Poison,
            },
            Rule::Color(f) => match numbers(&args)[..] {
                [a, b, c] => Value::Color(f([a, b, c])),
                _ => Value::Poison,
            },
            Rule::Numeric => self.by_name(builtin, &args, used),
            Rule::Constructor => self.construct(builtin.name(), &args, used),
            // A curve that got here came through a value, as in `(bezier)([..])`.
            Rule::Curve => self.refuse(&args[0].value, Type::Curve, used),
        }
    }

    /// A computed number, unless it is none.
    fn result(
        &mut self,
        builtin: &Builtin,
        args: &[Spanned<Value<'a>>],
        value: f64,
        dimension: Dimension,
        used: Span,
    ) -> Value<'a> {
        if value.is_finite() {
            return Value::Number(Quantity::new(value, dimension));
        }
        let written = |arg: &Spanned<Value<'a>>| match &arg.value {
            Value::Number(quantity) => quantity.write(),
            _ => self.text(arg.span),
        };
        let call: Vec<String> = args.iter().map(written).collect();
        let name = builtin.name();
        let what = match (builtin.function.domain, value.is_nan()) {
            (None, false) => "too large",
            _ => "not defined",
        };
        let why = format!("`{name}({})` is {what}", call.join(", "));
        let help = match builtin.function.domain {
            Some(domain) => format!("`{name}` is for {domain}"),
            None => "see what the numbers in it may be".to_owned(),
        };
        self.poison(Error::NotFinite { why, used, help })
    }

    /// The dimension that all arguments share.
    fn same_dimension(&mut self, builtin: &Builtin, args: &[Spanned<Value<'a>>]) -> Option<Dimension> {
        let mut shared: Option<(Dimension, Span)> = None;
        for arg in args {
            let Some(quantity) = number(&arg.value) else {
                self.refuse(&arg.value, Type::Number, arg.span);
                return None;
            };
            let (dimension, left) = *shared.get_or_insert((quantity.dimension, arg.span));
            if dimension != quantity.dimension {
                let (left_noun, right_noun) = (dimension.noun(), quantity.dimension.noun());
                let operator = builtin.name();
                let help = Some("give all of them the same kind of unit".to_owned());
                self.report(Error::Incompatible {
                    operator,
                    left_noun,
                    right_noun,
                    left,
                    right: arg.span,
                    help,
                });
                return None;
            }
        }
        shared.map(|(dimension, _)| dimension)
    }

    /// Functions whose result has a dimension that depends on those of the arguments.
    fn by_name(&mut self, builtin: &Builtin, args: &[Spanned<Value<'a>>], used: Span) -> Value<'a> {
        match builtin.name() {
            "sqrt" => self.raise(builtin, args, 0.5, used),
            "pow" => match number(&args[1].value).filter(|q| q.dimension == Dimension::NONE) {
                Some(exponent) => self.raise(builtin, args, exponent.value, used),
                None => self.refuse(&args[1].value, Type::Number, args[1].span),
            },
            "atan2" => {
                let (Some(_), Some(y), Some(x)) =
                    (self.same_dimension(builtin, args), number(&args[0].value), number(&args[1].value))
                else {
                    return Value::Poison;
                };
                self.result(builtin, args, libm::atan2(y.value, x.value), Dimension::ANGLE, used)
            }
            "lerp" => self.lerp(builtin, args),
            "noise" => match (&args[0].value, args[0].value.triple()) {
                (Value::Number(q), _) => Value::number(noise::noise([q.value, 0.0, 0.0])),
                (_, Some(p)) => Value::number(noise::noise(p.to_array())),
                _ => self.no_vector(builtin, &args[0]),
            },
            "len" => match &args[0].value {
                Value::List(parts) => Value::number(parts.len() as f64),
                _ => Value::Poison,
            },
            _ => self.of_vectors(builtin, args, used),
        }
    }

    fn raise(
        &mut self,
        builtin: &Builtin,
        args: &[Spanned<Value<'a>>],
        exponent: f64,
        used: Span,
    ) -> Value<'a> {
        let Some(base) = number(&args[0].value) else {
            return self.refuse(&args[0].value, Type::Number, args[0].span);
        };
        let value = if exponent == 0.5 { base.value.sqrt() } else { libm::pow(base.value, exponent) };
        match base.dimension.power(exponent) {
            Some(dimension) => self.result(builtin, args, value, dimension, used),
            None => {
                let text = self.text(args[0].span);
                let is_one = text.chars().all(|c| c.is_ascii_alphanumeric() || c == '.' || c == '_');
                let base = if is_one { text } else { format!("({text})") };
                let help = format!("take its unit away first, as in `{base} / 1m`");
                let wanted = if exponent == 0.5 { "a plain number or an area" } else { "a plain number" };
                self.wrong_type(wanted, &args[0].value.noun(), args[0].span, &help)
            }
        }
    }

    /// `a` at 0, `b` at 1; of numbers, points and colours.
    fn lerp(&mut self, builtin: &Builtin, args: &[Spanned<Value<'a>>]) -> Value<'a> {
        use crate::syntax::ast::BinaryOp::{Add, Multiply, Subtract};
        let [a, b, t] = args else { return Value::Poison };
        let (left_noun, right_noun) = (a.value.noun(), b.value.noun());
        if left_noun != right_noun {
            let (operator, help) = (builtin.name(), Some("both ends have to be of the same kind".to_owned()));
            let (left, right) = (a.span, b.span);
            return self.poison(Error::Incompatible { operator, left_noun, right_noun, left, right, help });
        }
        let difference = self.join(Subtract, b.clone(), a.clone());
        let part = self.join(Multiply, Spanned::new(difference, b.span), t.clone());
        self.join(Add, a.clone(), Spanned::new(part, b.span))
    }

    /// Reports an argument that is no vector.
    fn no_vector(&mut self, builtin: &Builtin, arg: &Spanned<Value<'a>>) -> Value<'a> {
        let text = self.text(arg.span);
        let help = match (builtin.name(), &arg.value) {
            ("length", Value::List(_)) => format!("how many elements there are is `len({text})`"),
            _ => format!("write for example `{}`", builtin.function.example),
        };
        self.wrong_type("a vector", &arg.value.noun(), arg.span, &help)
    }

    fn of_vectors(&mut self, builtin: &Builtin, args: &[Spanned<Value<'a>>], used: Span) -> Value<'a> {
        let mut vectors = Vec::new();
        for arg in args {
            let Some(vector) = vector(&arg.value) else { return self.no_vector(builtin, arg) };
            vectors.push(vector);
        }
        match (builtin.name(), &vectors[..]) {
            ("dot", [(a, da), (b, db)]) => self.result(builtin, args, a.dot(*b), da.times(*db), used),
            ("cross", [(a, da), (b, db)]) => Value::from_triple(a.cross(*b), da.times(*db)),
            ("length", [(a, dimension)]) => self.result(builtin, args, a.length(), *dimension, used),
            ("normalize", [(a, _)]) => match a.try_normalize() {
                Some(unit) => Value::from_triple(unit, Dimension::NONE),
                None => self.result(builtin, args, f64::NAN, Dimension::NONE, used),
            },
            _ => Value::Poison,
        }
    }
}

/// The tangent, infinite where the cosine is nothing but rounding error.
fn tan(angle: f64) -> f64 {
    if libm::cos(angle).abs() < 1e-15 { f64::INFINITY } else { libm::tan(angle) }
}

fn number(value: &Value) -> Option<Quantity> {
    match value {
        Value::Number(quantity) => Some(*quantity),
        _ => None,
    }
}

/// Three numbers of one dimension.
fn vector(value: &Value) -> Option<(DVec3, Dimension)> {
    let Value::Tuple(parts) = value else { return None };
    let dimension = number(parts.first()?)?.dimension;
    let alike = parts.iter().all(|part| number(part).is_some_and(|q| q.dimension == dimension));
    (alike && parts.len() <= 3).then_some((value.triple()?, dimension))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn what_is_declared_is_evaluated_and_what_is_evaluated_is_declared() {
        let declared: BTreeSet<&str> = names().collect();
        let evaluated: BTreeSet<&str> = RULES.iter().map(|(name, _)| *name).collect();
        assert_eq!(declared, evaluated);
        assert_eq!(
            (declared.len(), evaluated.len()),
            (names().count(), RULES.len()),
            "one stands there twice"
        );
    }
}
