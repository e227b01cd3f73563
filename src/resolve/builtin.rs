//! The functions of the language: what each does with its arguments. What they are called with, the registry says.

use super::dimension::{Dimension, Quantity};
use super::error::Error;
use super::noise;
use super::{Resolver, Value, color};
use crate::diag::did_you_mean;
use crate::math::{DVec3, Rgb};
use crate::schema::{self, Arg, Function, Takes, Type};
use crate::source::{Span, Spanned};
use crate::syntax::ast::Name;
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
    ("tan", Rule::OfAngle(libm::tan)),
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
    ("clamp", Rule::Same(|x| x[0].max(x[1]).min(x[2]))),
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
    ("samples", Rule::Constructor),
    ("passes", Rule::Constructor),
    ("time", Rule::Constructor),
    ("error", Rule::Constructor),
    ("box", Rule::Constructor),
    ("tent", Rule::Constructor),
    ("gaussian", Rule::Constructor),
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

/// An argument of a call: its name, where it has one, and its value.
pub type Given<'a, 'n> = (Option<&'n Name>, Spanned<Value<'a>>);

impl Builtin {
    /// The function's name.
    pub fn name(&self) -> &'static str {
        self.function.name
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
            Rule::Constructor => self.construct(builtin.name(), &args, used),
            // A curve that got here came through a value, as in `(bezier)([..])`.
            Rule::Curve => self.refuse(&args[0].value, Type::Curve, used),
        }
    }

    /// The arguments in their order, of the types that the function takes; those that no form of it takes are reported.
    fn fit(
        &mut self,
        function: &'static Function,
        args: Vec<Given<'a, '_>>,
        used: Span,
    ) -> Option<Vec<Spanned<Value<'a>>>> {
        let fitting: Vec<_> = function.forms.iter().filter_map(|form| in_order(form, &args)).collect();
        let suits = |(form, order): &&(&[Arg], Vec<usize>)| {
            form.iter()
                .zip(order)
                .all(|(arg, &i)| arg.takes.is_tuple() == matches!(*args[i].1, Value::Tuple(_)))
        };
        let Some((form, order)) = fitting.iter().find(suits).or(fitting.first()) else {
            self.refuse_call(function, &args, used);
            return None;
        };
        let args: Vec<_> = order.iter().map(|&i| args[i].1.clone()).collect();
        if self.is_swapped(function, &args) {
            return None;
        }
        // The last argument of a form may stand for several.
        let takes = form.iter().chain(std::iter::repeat(&form[form.len() - 1])).map(|arg| arg.takes);
        let typed = |(arg, takes): (Spanned<Value<'a>>, Takes)| match takes {
            Takes::Of(ty) => Spanned::new(self.coerce(arg.value, ty, arg.span), arg.span),
            _ => arg,
        };
        let typed: Vec<_> = args.into_iter().zip(takes).map(typed).collect();
        (!typed.iter().any(|arg| arg.is_poison())).then_some(typed)
    }

    /// Reports a call that fits none of the function's forms.
    fn refuse_call(&mut self, function: &'static Function, args: &[Given<'a, '_>], used: Span) {
        let names = || function.forms.iter().copied().flatten().map(|arg| arg.name);
        let help = format!("write for example `{}`", function.example);
        let unknown =
            args.iter().filter_map(|(name, _)| *name).find(|name| !names().any(|known| known == name.value));
        if let Some(name) = unknown {
            let help = did_you_mean(name, names()).unwrap_or(help);
            let (function, used) = (function.name.to_owned(), name.span);
            return self.report(Error::UnknownArgument { function, name: name.value.clone(), used, help });
        }
        let (least, most) = function.counts();
        let (found, function) = (args.len(), function.name.to_owned());
        let wanted = super::call::count_text(least, most);
        self.report(Error::ArgumentCount { function, wanted, found, used, help });
    }

    /// Whether the axis and the angle of a rotation have changed places, which is reported.
    fn is_swapped(&mut self, function: &Function, args: &[Spanned<Value<'a>>]) -> bool {
        let ("rotate", [angle, axis]) = (function.name, args) else { return false };
        if !matches!((&angle.value, &axis.value), (Value::Number(_), Value::Tuple(_))) {
            return false;
        }
        let (angle_text, axis_text) = (self.text(angle.span), self.text(axis.span));
        let help = format!("the axis comes first: `rotate({axis_text}, {angle_text})`");
        self.wrong_type("an axis", &angle.value.noun(), angle.span, &help);
        true
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
            "len" => match &args[0].value {
                Value::List(parts) => Value::number(parts.len() as f64),
                _ => Value::Poison,
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
        match (builtin.name(), &vectors[..]) {
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

/// For each argument in the order of `form`, its index among those given. `None`: they do not fit.
fn in_order<'f>(form: &'f [Arg], given: &[Given<'_, '_>]) -> Option<(&'f [Arg], Vec<usize>)> {
    let (least, most) = Function::count(form);
    if !(least..=most).contains(&given.len()) {
        return None;
    }
    let mut order = vec![usize::MAX; given.len()];
    for (i, (name, _)) in given.iter().enumerate() {
        let place = match name {
            Some(name) => form.iter().position(|arg| arg.name == name.value)?,
            None => i,
        };
        match order.get_mut(place) {
            Some(slot @ &mut usize::MAX) => *slot = i,
            _ => return None,
        }
    }
    Some((form, order))
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
