//! Operators between values.

use super::budget::Limit;
use super::dimension::{Dimension, Quantity};
use super::error::Error;
use super::{Env, Resolver, Value};
use crate::ir::material::Join;
use crate::ir::{self, Input};
use crate::math::Rgb;
use crate::schema::Type;
use crate::source::{Span, Spanned};
use crate::syntax::ast::{BinaryOp, Expr, ExprKind};
use std::rc::Rc;

/// A value with the place it came from.
type Operand<'a> = Spanned<Value<'a>>;

impl<'a> Resolver<'a> {
    /// `a + b - c ..`: a chain is walked, not descended, so that its length costs no stack.
    pub(super) fn binary(&mut self, expr: &'a Expr, env: &Env<'a>) -> Value<'a> {
        let mut chain = Vec::new();
        let mut first = expr;
        while let ExprKind::Binary { op, left, right } = &first.kind {
            chain.push((op.value, &**right, first.span));
            first = left;
        }
        let mut left = Spanned::new(self.eval(first, env), first.span);
        for (op, right, span) in chain.into_iter().rev() {
            left = Spanned::new(self.step(op, left, right, env), span);
        }
        left.value
    }

    fn step(&mut self, op: BinaryOp, left: Operand<'a>, right: &'a Expr, env: &Env<'a>) -> Value<'a> {
        match (op, &left.value) {
            (BinaryOp::And, Value::Bool(false)) => Value::Bool(false),
            (BinaryOp::Or, Value::Bool(true)) => Value::Bool(true),
            _ => {
                if matches!(op, BinaryOp::And | BinaryOp::Or) {
                    self.enter(right.span);
                }
                let right = Spanned::new(self.eval(right, env), right.span);
                self.join(op, left, right)
            }
        }
    }

    pub(super) fn join(&mut self, op: BinaryOp, left: Operand<'a>, right: Operand<'a>) -> Value<'a> {
        use BinaryOp::{And, Divide, Equal, Multiply, NotEqual, Or, Per, Range, RangeInclusive, Then};
        match (op, &left.value, &right.value) {
            (_, Value::Poison, _) | (_, _, Value::Poison) => Value::Poison,
            (Range | RangeInclusive, Value::Number(a), Value::Number(b)) if a.dimension == b.dimension => {
                Value::Range(*a, *b, op == RangeInclusive)
            }
            (_, Value::Number(a), Value::Number(b)) => self.numbers(op, (*a, left.span), (*b, right.span)),
            (And | Or, Value::Bool(_), Value::Bool(_)) => right.value,
            (Or, Value::Stop(a), Value::Stop(b)) => Value::Stop(either(*a, *b)),
            (Equal | NotEqual, Value::Bool(a), Value::Bool(b)) => Value::Bool((a == b) == (op == Equal)),
            (Equal | NotEqual, Value::Text(a), Value::Text(b)) => Value::Bool((a == b) == (op == Equal)),
            (Equal | NotEqual, Value::Color(a), Value::Color(b)) => Value::Bool((a == b) == (op == Equal)),
            (Equal | NotEqual, Value::Tuple(a), Value::Tuple(b))
                if left.value.noun() == right.value.noun() =>
            {
                Value::Bool(numbers_of(a).eq(numbers_of(b)) == (op == Equal))
            }
            // Counted, for `a then a` doubles what `a` holds.
            (Then, Value::Transform(a), Value::Transform(b)) => {
                match self.spend(Limit::Elements, (a.len() + b.len()) as u64, right.span) {
                    true => Value::Transform(a.iter().chain(&**b).copied().collect()),
                    false => Value::Poison,
                }
            }
            (Per, Value::Color(color), Value::Number(_)) => {
                let color = *color;
                match self.coerce(right.value, Type::Length, right.span) {
                    Value::Number(length) => Value::Absorption(color, length.value),
                    _ => Value::Poison,
                }
            }
            (Multiply | BinaryOp::Add | BinaryOp::Subtract, Value::Texture(_), _)
            | (Multiply | BinaryOp::Add | BinaryOp::Subtract, _, Value::Texture(_)) => {
                self.textures(op, &left, &right)
            }
            (Multiply, Value::Color(a), Value::Color(b)) => Value::Color(*a * *b),
            (BinaryOp::Add, Value::Color(a), Value::Color(b)) => Value::Color(*a + *b),
            (BinaryOp::Subtract, Value::Color(a), Value::Color(b)) => Value::Color(*a - *b),
            (Multiply, Value::Color(c), Value::Number(q)) | (Multiply, Value::Number(q), Value::Color(c))
                if q.dimension == Dimension::NONE =>
            {
                Value::Color(*c * q.value as f32)
            }
            (Divide, Value::Color(c), Value::Number(q))
                if q.dimension == Dimension::NONE && q.value != 0.0 =>
            {
                Value::Color(*c / q.value as f32)
            }
            (Multiply | Divide, Value::Tuple(parts), Value::Number(_)) => {
                let parts = Rc::clone(parts);
                self.each(&parts, |this, part| {
                    this.join(op, Spanned::new(part.clone(), left.span), right.clone())
                })
            }
            (Multiply, Value::Number(_), Value::Tuple(parts)) => {
                let parts = Rc::clone(parts);
                self.each(&parts, |this, part| {
                    this.join(op, left.clone(), Spanned::new(part.clone(), right.span))
                })
            }
            (BinaryOp::Add | BinaryOp::Subtract, Value::Tuple(a), Value::Tuple(b)) if a.len() == b.len() => {
                let (a, b) = (Rc::clone(a), Rc::clone(b));
                let mut others = b.iter().cloned();
                self.each(&a, |this, part| {
                    let other = others.next().unwrap_or(Value::Poison);
                    this.join(op, Spanned::new(part.clone(), left.span), Spanned::new(other, right.span))
                })
            }
            _ => self.incompatible(op, &left, &right, None),
        }
    }

    /// A texture joined with a texture, a colour or a plain number.
    fn textures(&mut self, op: BinaryOp, left: &Operand<'a>, right: &Operand<'a>) -> Value<'a> {
        let input = |side: &Operand<'a>| match &side.value {
            Value::Texture(handle) => Some(Input::Texture(Spanned::new(*handle, side.span))),
            Value::Color(color) => Some(Input::Constant(Spanned::new(*color, side.span))),
            Value::Number(q) if q.dimension == Dimension::NONE => {
                Some(Input::Constant(Spanned::new(Rgb::gray(q.value as f32), side.span)))
            }
            _ => None,
        };
        let join = match op {
            BinaryOp::Add => Join::Add,
            BinaryOp::Subtract => Join::Subtract,
            _ => Join::Multiply,
        };
        match (input(left), input(right)) {
            (Some(a), Some(b)) => self.join_textures(join, a, b, left.span.to(right.span)),
            _ => self.incompatible(op, left, right, None),
        }
    }

    fn each(
        &mut self,
        parts: &Rc<[Value<'a>]>,
        mut of: impl FnMut(&mut Self, &Value<'a>) -> Value<'a>,
    ) -> Value<'a> {
        let values: Rc<[Value]> = parts.iter().map(|part| of(self, part)).collect();
        if values.iter().any(Value::is_poison) { Value::Poison } else { Value::Tuple(values) }
    }

    /// A tuple of numbers times a plain number.
    pub(super) fn scale_tuple(&mut self, tuple: &Value<'a>, factor: f64, span: Span) -> Value<'a> {
        let factor = Spanned::new(Value::number(factor), span);
        self.join(BinaryOp::Multiply, Spanned::new(tuple.clone(), span), factor)
    }

    fn numbers(
        &mut self,
        op: BinaryOp,
        (a, left): (Quantity, Span),
        (b, right): (Quantity, Span),
    ) -> Value<'a> {
        use BinaryOp::{
            Add, Divide, Equal, Greater, GreaterEqual, Less, LessEqual, Multiply, NotEqual, Power, Remainder,
            Subtract,
        };
        let same = a.dimension == b.dimension;
        let (x, y) = (a.value, b.value);
        let number = |value, dimension| (value, Some(dimension));
        let (value, dimension) = match op {
            Add if same => number(x + y, a.dimension),
            Subtract if same => number(x - y, a.dimension),
            Remainder if same => number(x % y, a.dimension),
            Multiply => number(x * y, a.dimension.times(b.dimension)),
            Divide => number(x / y, a.dimension.over(b.dimension)),
            Power if b.dimension == Dimension::NONE => (libm::pow(x, y), a.dimension.power(y)),
            Equal if same => return Value::Bool(x == y),
            NotEqual if same => return Value::Bool(x != y),
            Less if same => return Value::Bool(x < y),
            LessEqual if same => return Value::Bool(x <= y),
            Greater if same => return Value::Bool(x > y),
            GreaterEqual if same => return Value::Bool(x >= y),
            _ => (x, None),
        };
        let Some(dimension) = dimension else {
            let help = unit_help(a, b);
            let (a, b) = (Spanned::new(Value::Number(a), left), Spanned::new(Value::Number(b), right));
            return self.incompatible(op, &a, &b, help);
        };
        if value.is_finite() {
            return Value::Number(Quantity::new(value, dimension));
        }
        let text = format!("`{} {} {}`", a.write(), sign(op), b.write());
        let (why, help) = match op {
            Divide | Remainder if y == 0.0 => {
                (format!("{text} divides by 0"), "divide by something else than 0")
            }
            _ if value.is_nan() || (x == 0.0 && y < 0.0) => (format!("{text} is not defined"), SEE),
            _ => (format!("{text} is too large"), SEE),
        };
        self.poison(Error::NotFinite { why, used: left.to(right), help: help.to_owned() })
    }

    fn incompatible(
        &mut self,
        op: BinaryOp,
        left: &Operand<'a>,
        right: &Operand<'a>,
        help: Option<String>,
    ) -> Value<'a> {
        let joins_alike =
            matches!(sign(op), "+" | "-" | "==" | "!=" | "<" | "<=" | ">" | ">=" | ".." | "..=");
        let (a, b) = (self.text(left.span), self.text(right.span));
        let help = match (&left.value, &right.value) {
            (Value::Transform(_), Value::Transform(_)) => Some(format!("write `{a} then {b}`")),
            (Value::Stop(_), Value::Stop(_)) => {
                Some(format!("what comes first ends the picture: write `{a} or {b}`"))
            }
            (Value::Bool(_), Value::Number(_)) if is_comparison(op) => {
                Some("compare two at a time: `a < b and b < c`".to_owned())
            }
            (Value::Color(_), Value::Number(_)) if op == BinaryOp::Divide => {
                Some("divide by a plain number other than 0".to_owned())
            }
            (Value::Number(_), Value::Number(_)) if op == BinaryOp::Power => {
                Some(match right.value.is_plain() {
                    true => format!("take its unit away first, as in `({a} / 1m) ^ {b}`"),
                    false => "the exponent is a plain number".to_owned(),
                })
            }
            (Value::Text(_), Value::Text(_)) => None,
            _ => help.or(joins_alike.then(|| "both sides have to be of the same kind".to_owned())),
        };
        self.poison(Error::Incompatible {
            operator: sign(op),
            left_noun: left.value.noun(),
            right_noun: right.value.noun(),
            left: left.span,
            right: right.span,
            help,
        })
    }
}

/// What can be done about a number that is none.
const SEE: &str = "see what the numbers in it may be";

fn is_comparison(op: BinaryOp) -> bool {
    matches!(sign(op), "<" | "<=" | ">" | ">=" | "==" | "!=")
}

/// The components of a tuple.
fn numbers_of(parts: &[Value]) -> impl Iterator<Item = Option<f64>> {
    parts.iter().map(|part| match part {
        Value::Number(quantity) => Some(quantity.value),
        _ => None,
    })
}

/// What to write when a plain number meets a quantity.
fn unit_help(a: Quantity, b: Quantity) -> Option<String> {
    match (a.dimension, b.dimension) {
        (Dimension::NONE, Dimension::LENGTH) => {
            Some(format!("give the number a unit, such as `{}cm`", a.value))
        }
        (Dimension::LENGTH, Dimension::NONE) => {
            Some(format!("give the number a unit, such as `{}cm`", b.value))
        }
        (Dimension::NONE, Dimension::ANGLE) => Some(format!("give the number a unit: `{}deg`", a.value)),
        (Dimension::ANGLE, Dimension::NONE) => Some(format!("give the number a unit: `{}deg`", b.value)),
        _ => None,
    }
}

/// Stops at whichever comes first.
fn either(a: ir::Stop, b: ir::Stop) -> ir::Stop {
    ir::Stop { passes: a.passes.or(b.passes), seconds: a.seconds.or(b.seconds), error: a.error.or(b.error) }
}

/// The operator as it is written.
const fn sign(op: BinaryOp) -> &'static str {
    match op {
        BinaryOp::Then => "then",
        BinaryOp::Or => "or",
        BinaryOp::And => "and",
        BinaryOp::Equal => "==",
        BinaryOp::NotEqual => "!=",
        BinaryOp::Less => "<",
        BinaryOp::LessEqual => "<=",
        BinaryOp::Greater => ">",
        BinaryOp::GreaterEqual => ">=",
        BinaryOp::Range => "..",
        BinaryOp::RangeInclusive => "..=",
        BinaryOp::Per => "per",
        BinaryOp::Add => "+",
        BinaryOp::Subtract => "-",
        BinaryOp::Multiply => "*",
        BinaryOp::Divide => "/",
        BinaryOp::Remainder => "%",
        BinaryOp::Power => "^",
    }
}
