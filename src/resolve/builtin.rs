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

    /// What an argument is, where that is known before its value is.
    pub fn type_of_argument(&self, index: usize) -> Option<Type> {
        let args = self.function.forms.iter().filter_map(|form| form.get(index));
        args.into_iter().find_map(|arg| match arg.takes {
            Takes::Of(ty) => Some(ty),
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

    /// The arguments in their order, of the types that the function takes; those that no form of it takes are reported.
    fn fit(
        &mut self,
        function: &'static Function,
        args: Vec<Given<'a, '_>>,
        used: Span,
    ) -> Option<Vec<Spanned<Value<'a>>>> {
        let (form, args) = match arrange(function, args) {
            Ok(arranged) => arranged,
            Err(args) => {
                self.refuse_call(function, &args, used);
                return None;
            }
        };
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
        let named = |(name, value): &Given<'a, '_>| Some((name.as_ref()?.value.clone(), value.span));
        let is_wanted = function.forms.iter().any(|form| {
            let (least, most) = Function::count(form);
            (least..=most).contains(&args.len())
        });
        if let Some((name, used)) = args.iter().filter_map(named).next().filter(|_| is_wanted) {
            return self.report(Error::DuplicateArgument { name, used });
        }
        let mut counts: Vec<(usize, usize)> =
            function.forms.iter().map(|form| Function::count(form)).collect();
        counts.sort_unstable();
        counts.dedup();
        let wanted = counts.iter().map(|&(least, most)| super::call::count_text(least, most));
        let wanted = wanted.collect::<Vec<_>>().join(" or ");
        let (found, function) = (args.len(), function.name.to_owned());
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
                let help = format!("take its unit away first, as in `({text}) / 1m`");
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

/// The form that the arguments fit, and they in its order; or they as they were given.
fn arrange<'a, 'n>(
    function: &'static Function,
    mut given: Vec<Given<'a, 'n>>,
) -> Result<Arranged<'a>, Vec<Given<'a, 'n>>> {
    let takes_as_many = |form: &&[Arg]| {
        let (least, most) = Function::count(form);
        (least..=most).contains(&given.len())
    };
    let fitting =
        function.forms.iter().copied().filter(takes_as_many).filter(|form| has_places(form, &given));
    let suits = |form: &&[Arg]| {
        given.iter().enumerate().all(|(i, arg)| {
            let takes = place_of(form, i, arg).and_then(|place| form.get(place)).map(|arg| arg.takes);
            takes.is_none_or(|takes| takes.is_tuple() == matches!(*arg.1, Value::Tuple(_)))
        })
    };
    let Some(form) = fitting.clone().find(suits).or_else(|| fitting.clone().next()) else {
        return Err(given);
    };
    if given.iter().any(|(name, _)| name.is_some()) {
        let mut places =
            (0..given.len()).map(|i| place_of(form, i, &given[i])).collect::<Vec<_>>().into_iter();
        given.sort_by_cached_key(|_| places.next());
    }
    Ok((form, given.into_iter().map(|(_, value)| value).collect()))
}

/// A form, and arguments in its order.
type Arranged<'a> = (&'static [Arg], Vec<Spanned<Value<'a>>>);

/// Where an argument stands in a form.
fn place_of(form: &[Arg], position: usize, (name, _): &Given<'_, '_>) -> Option<usize> {
    match name {
        Some(name) => form.iter().position(|arg| arg.name == name.value),
        None => Some(position),
    }
}

/// Whether every argument has a place of its own in a form.
fn has_places(form: &[Arg], given: &[Given<'_, '_>]) -> bool {
    given.iter().all(|(name, _)| name.is_none()) || {
        let places: Vec<_> = given.iter().enumerate().map(|(i, arg)| place_of(form, i, arg)).collect();
        let is_alone = |i: usize| places[i].is_some() && !places[..i].contains(&places[i]);
        (0..places.len()).all(|i| is_alone(i) && places[i] < Some(given.len()))
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
