//! The functions of the language: what each is called with, and what it gives.

use super::dimension::{Dimension, Quantity};
use super::error::Error;
use super::noise;
use super::{Resolver, Value, color};
use crate::math::{DVec3, Rgb};
use crate::schema::Type;
use crate::source::{Span, Spanned};

/// A function of the language.
pub struct Builtin {
    /// Its name.
    pub name: &'static str,
    /// How it is written.
    pub usage: &'static str,
    /// What each argument is.
    takes: Takes,
    pub(super) rule: Rule,
}

/// The arguments of a function.
#[derive(Clone, Copy)]
enum Takes {
    /// Exactly these; the given number of them may be left out at the end.
    These(&'static [Type], usize),
    /// This many to that many, of which the function itself knows more.
    Between(usize, usize),
}

/// What a function does with its arguments.
#[derive(Clone, Copy)]
pub enum Rule {
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
    /// A transform, curve, filter, rule to stop by or texture; see `constructor`.
    Constructor,
}

const fn plain(name: &'static str, usage: &'static str, n: &'static [Type], f: fn(&[f64]) -> f64) -> Builtin {
    Builtin { name, usage, takes: Takes::These(n, 0), rule: Rule::Plain(f) }
}

const fn same(
    name: &'static str,
    usage: &'static str,
    least: usize,
    most: usize,
    f: fn(&[f64]) -> f64,
) -> Builtin {
    Builtin { name, usage, takes: Takes::Between(least, most), rule: Rule::Same(f) }
}

const fn of(name: &'static str, usage: &'static str, takes: Takes, rule: Rule) -> Builtin {
    Builtin { name, usage, takes, rule }
}

const ONE: &[Type] = &[Type::Number];
const TWO: &[Type] = &[Type::Number, Type::Number];
const THREE: &[Type] = &[Type::Number, Type::Number, Type::Number];
const ANGLE: Takes = Takes::These(&[Type::Angle], 0);
const MANY: usize = 64;

const BUILTINS: &[Builtin] = &[
    of("sin", "sin(30deg)", ANGLE, Rule::OfAngle(libm::sin)),
    of("cos", "cos(30deg)", ANGLE, Rule::OfAngle(libm::cos)),
    of("tan", "tan(30deg)", ANGLE, Rule::OfAngle(libm::tan)),
    of("asin", "asin(0.5)", Takes::These(ONE, 0), Rule::ToAngle(libm::asin)),
    of("acos", "acos(0.5)", Takes::These(ONE, 0), Rule::ToAngle(libm::acos)),
    of("atan", "atan(0.5)", Takes::These(ONE, 0), Rule::ToAngle(libm::atan)),
    of("atan2", "atan2(y, x)", Takes::Between(2, 2), Rule::Numeric),
    of("sqrt", "sqrt(2)", Takes::Between(1, 1), Rule::Numeric),
    of("pow", "pow(2, 3)", Takes::Between(2, 2), Rule::Numeric),
    plain("exp", "exp(1)", ONE, |x| libm::exp(x[0])),
    plain("log", "log(2)", ONE, |x| libm::log(x[0])),
    plain("floor", "floor(2.5)", ONE, |x| x[0].floor()),
    plain("ceil", "ceil(2.5)", ONE, |x| x[0].ceil()),
    plain("round", "round(2.5)", ONE, |x| x[0].round()),
    plain("random", "random(seed, i)", TWO, |x| noise::random(x[0], x[1])),
    same("abs", "abs(-1m)", 1, 1, |x| x[0].abs()),
    same("min", "min(1m, 2m)", 1, MANY, |x| x.iter().copied().fold(f64::INFINITY, f64::min)),
    same("max", "max(1m, 2m)", 1, MANY, |x| x.iter().copied().fold(f64::NEG_INFINITY, f64::max)),
    same("clamp", "clamp(x, 0, 1)", 3, 3, |x| x[0].max(x[1]).min(x[2])),
    of("lerp", "lerp(a, b, 0.5)", Takes::Between(3, 3), Rule::Numeric),
    of("dot", "dot(a, b)", Takes::Between(2, 2), Rule::Numeric),
    of("cross", "cross(a, b)", Takes::Between(2, 2), Rule::Numeric),
    of("length", "length(a)", Takes::Between(1, 1), Rule::Numeric),
    of("normalize", "normalize(a)", Takes::Between(1, 1), Rule::Numeric),
    of("noise", "noise(x) or noise((x, y, z))", Takes::Between(1, 1), Rule::Numeric),
    of(
        "rgb",
        "rgb(1, 0.5, 0)",
        Takes::These(THREE, 0),
        Rule::Color(|[r, g, b]| Rgb::new(r as f32, g as f32, b as f32)),
    ),
    of(
        "srgb",
        "srgb(1, 0.5, 0)",
        Takes::These(THREE, 0),
        Rule::Color(|[r, g, b]| Rgb::from_srgb(r as f32, g as f32, b as f32)),
    ),
    of(
        "hsv",
        "hsv(30deg, 1, 1)",
        Takes::These(&[Type::Angle, Type::Number, Type::Number], 0),
        Rule::Color(|[h, s, v]| color::from_hsv(h, s, v)),
    ),
    of("translate", "translate(0m, 1m, 0m)", Takes::Between(1, 3), Rule::Constructor),
    of("scale", "scale(2) or scale(1, 2, 1)", Takes::Between(1, 3), Rule::Constructor),
    of("rotate_x", "rotate_x(30deg)", ANGLE, Rule::Constructor),
    of("rotate_y", "rotate_y(30deg)", ANGLE, Rule::Constructor),
    of("rotate_z", "rotate_z(30deg)", ANGLE, Rule::Constructor),
    of(
        "rotate",
        "rotate((0, 1, 0), 30deg)",
        Takes::These(&[Type::Vector, Type::Angle], 0),
        Rule::Constructor,
    ),
    of(
        "look_at",
        "look_at(from, to)",
        Takes::These(&[Type::Point, Type::Point, Type::Vector], 1),
        Rule::Constructor,
    ),
    of("matrix", "matrix([16 numbers, row by row])", Takes::These(&[Type::List], 0), Rule::Constructor),
    of("samples", "samples(64)", Takes::These(&[Type::Int], 0), Rule::Constructor),
    of("passes", "passes(64)", Takes::These(&[Type::Int], 0), Rule::Constructor),
    of("time", "time(5min)", Takes::These(&[Type::Time], 0), Rule::Constructor),
    of("error", "error(1%)", Takes::These(ONE, 0), Rule::Constructor),
    of("box", "box(0.5px)", Takes::These(&[Type::Pixels], 0), Rule::Constructor),
    of("tent", "tent(1px)", Takes::These(&[Type::Pixels], 0), Rule::Constructor),
    of("gaussian", "gaussian(1.5px)", Takes::These(&[Type::Pixels], 0), Rule::Constructor),
    of("image", "image(\"wood.png\")", Takes::These(&[Type::Text], 0), Rule::Constructor),
];

/// The function of this name.
pub fn find(name: &str) -> Option<&'static Builtin> {
    BUILTINS.iter().find(|builtin| builtin.name == name)
}

impl Builtin {
    /// What an argument is, where that is known before its value is.
    pub(super) fn type_of_argument(&self, index: usize) -> Option<Type> {
        match self.takes {
            Takes::These(types, _) => types.get(index).copied(),
            Takes::Between(..) => (self.name == "translate").then_some(Type::Length),
        }
    }
}

/// The names of all functions.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    BUILTINS.iter().map(|builtin| builtin.name)
}

impl<'a> Resolver<'a> {
    /// Calls a function of the language.
    pub(super) fn call_builtin(
        &mut self,
        builtin: &'static Builtin,
        args: Vec<Spanned<Value<'a>>>,
        used: Span,
    ) -> Value<'a> {
        if args.iter().any(|arg| arg.is_poison()) {
            return Value::Poison;
        }
        let Some(args) = self.fit(builtin, args, used) else { return Value::Poison };
        let numbers = |args: &[Spanned<Value>]| -> Vec<f64> {
            args.iter().filter_map(|arg| number(&arg.value)).map(|quantity| quantity.value).collect()
        };
        match builtin.rule {
            Rule::Plain(f) => self.finite(f(&numbers(&args)), Dimension::NONE, used, None),
            Rule::OfAngle(f) => self.finite(f(numbers(&args)[0]), Dimension::NONE, used, None),
            Rule::ToAngle(f) => self.finite(f(numbers(&args)[0]), Dimension::ANGLE, used, None),
            Rule::Same(f) => match self.same_dimension(builtin, &args) {
                Some(dimension) => self.finite(f(&numbers(&args)), dimension, used, None),
                None => Value::Poison,
            },
            Rule::Color(f) => match numbers(&args)[..] {
                [a, b, c] => Value::Color(f([a, b, c])),
                _ => Value::Poison,
            },
            Rule::Numeric => self.by_name(builtin, &args, used),
            Rule::Constructor => self.construct(builtin, &args, used),
        }
    }

    /// The arguments in the number and of the types that the function takes.
    fn fit(
        &mut self,
        builtin: &'static Builtin,
        args: Vec<Spanned<Value<'a>>>,
        used: Span,
    ) -> Option<Vec<Spanned<Value<'a>>>> {
        let (least, most) = match builtin.takes {
            Takes::These(types, optional) => (types.len() - optional, types.len()),
            Takes::Between(least, most) => (least, most),
        };
        if !(least..=most).contains(&args.len()) {
            let (function, help) = (builtin.name.to_owned(), format!("write `{}`", builtin.usage));
            let wanted = super::call::count_text(least, most);
            self.report(Error::ArgumentCount { function, wanted, found: args.len(), used, help });
            return None;
        }
        let Takes::These(types, _) = builtin.takes else { return Some(args) };
        if let ("rotate", [angle, axis]) = (builtin.name, args.as_slice())
            && matches!((&angle.value, &axis.value), (Value::Number(_), Value::Tuple(_)))
        {
            let help = format!(
                "the axis comes first: `rotate({}, {})`",
                self.text(axis.span),
                self.text(angle.span)
            );
            self.wrong_type("an axis", &angle.value.noun(), angle.span, &help);
            return None;
        }
        let typed: Vec<_> = args
            .into_iter()
            .zip(types)
            .map(|(arg, &ty)| Spanned::new(self.coerce(arg.value, ty, arg.span), arg.span))
            .collect();
        (!typed.iter().any(|arg| arg.is_poison())).then_some(typed)
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
                let operator = builtin.name;
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
        match builtin.name {
            "sqrt" => self.raise(args, 0.5, used),
            "pow" => match number(&args[1].value).filter(|q| q.dimension == Dimension::NONE) {
                Some(exponent) => self.raise(args, exponent.value, used),
                None => self.refuse(&args[1].value, Type::Number, args[1].span),
            },
            "atan2" => {
                let (Some(_), Some(y), Some(x)) =
                    (self.same_dimension(builtin, args), number(&args[0].value), number(&args[1].value))
                else {
                    return Value::Poison;
                };
                self.finite(libm::atan2(y.value, x.value), Dimension::ANGLE, used, None)
            }
            "lerp" => self.lerp(args),
            "noise" => match (&args[0].value, args[0].value.triple()) {
                (Value::Number(q), _) => Value::number(noise::noise([q.value, 0.0, 0.0])),
                (_, Some(p)) => Value::number(noise::noise(p.to_array())),
                (other, _) => self.refuse(other, Type::Vector, args[0].span),
            },
            _ => self.of_vectors(builtin, args, used),
        }
    }

    fn raise(&mut self, args: &[Spanned<Value<'a>>], exponent: f64, used: Span) -> Value<'a> {
        let Some(base) = number(&args[0].value) else {
            return self.refuse(&args[0].value, Type::Number, args[0].span);
        };
        let value = if exponent == 0.5 { base.value.sqrt() } else { libm::pow(base.value, exponent) };
        match base.dimension.power(exponent) {
            Some(dimension) => self.finite(value, dimension, used, None),
            None => self.refuse(&args[0].value, Type::Number, args[0].span),
        }
    }

    /// `a` at 0, `b` at 1; of numbers, points and colours.
    fn lerp(&mut self, args: &[Spanned<Value<'a>>]) -> Value<'a> {
        use crate::syntax::ast::BinaryOp::{Add, Multiply, Subtract};
        let [a, b, t] = args else { return Value::Poison };
        let difference = self.join(Subtract, b.clone(), a.clone());
        let part = self.join(Multiply, Spanned::new(difference, b.span), t.clone());
        self.join(Add, a.clone(), Spanned::new(part, b.span))
    }

    fn of_vectors(&mut self, builtin: &Builtin, args: &[Spanned<Value<'a>>], used: Span) -> Value<'a> {
        let mut vectors = Vec::new();
        for arg in args {
            let Some(vector) = vector(&arg.value) else {
                return self.refuse(&arg.value, Type::Vector, arg.span);
            };
            vectors.push(vector);
        }
        match (builtin.name, &vectors[..]) {
            ("dot", [(a, da), (b, db)]) => self.finite(a.dot(*b), da.times(*db), used, None),
            ("cross", [(a, da), (b, db)]) => Value::from_triple(a.cross(*b), da.times(*db)),
            ("length", [(a, dimension)]) => self.finite(a.length(), *dimension, used, None),
            ("normalize", [(a, _)]) => match a.try_normalize() {
                Some(unit) => Value::from_triple(unit, Dimension::NONE),
                None => {
                    let help = "see what the vector may be";
                    self.poison(Error::NotFinite { why: "a vector of length 0 has no direction", used, help })
                }
            },
            _ => Value::Poison,
        }
    }
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
