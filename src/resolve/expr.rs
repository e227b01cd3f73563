//! Expressions: each gives a value.

use super::budget::Limit;
use super::builtin;
use super::dimension::{Dimension, Quantity, with_unit};
use super::error::Error;
use super::meant::{Wanted, unknown_unit};
use super::scope::{Definition, Kind, Scope};
use super::{Env, Resolver, Step, Value, color};
use crate::ir;
use crate::schema::Type;
use crate::source::Span;
use crate::syntax::ast::{Block, Expr, ExprKind, Name, UnaryOp};
use std::rc::Rc;

impl<'a> Resolver<'a> {
    /// The value of an expression of which nothing is expected.
    pub(super) fn eval(&mut self, expr: &'a Expr, env: &Env<'a>) -> Value<'a> {
        self.deeper(expr.span, |this| this.eval_kind(expr, env))
    }

    fn eval_kind(&mut self, expr: &'a Expr, env: &Env<'a>) -> Value<'a> {
        match &expr.kind {
            ExprKind::Number { value, unit, .. } => self.numeral(*value, unit.as_ref(), None),
            ExprKind::FNumber(value) => Value::Number(Quantity::new(*value, Dimension::F_NUMBER)),
            ExprKind::Size(width, height) => self.size(width, height, env),
            ExprKind::Color(bytes) => Value::Color(color::from_bytes(*bytes)),
            ExprKind::Text(text) => Value::Text(text.as_str().into()),
            ExprKind::Bool(value) => Value::Bool(*value),
            ExprKind::Name(name) => self.name(name, expr.span, Wanted::Anything, env),
            ExprKind::Access { base, field } => self.access(base, field, env),
            ExprKind::Call { callee, args } => self.call(callee, args, expr.span, env),
            ExprKind::Index { base, index } => self.index(base, index, env),
            ExprKind::Tagged { tag, value } => self.tagged(tag, value, env),
            ExprKind::On(target) => self.on(target, env),
            ExprKind::Data(numbers) => match self.spend(Limit::Elements, numbers.len() as u64, expr.span) {
                true => Value::List(numbers.iter().map(|&x| Value::number(x)).collect()),
                false => Value::Poison,
            },
            ExprKind::List(parts) => self.list(parts, expr.span, env),
            ExprKind::Comprehension { value, name, range, filter } => {
                self.comprehension(value, name, range, filter.as_deref(), env)
            }
            ExprKind::Tuple(parts) => self.tuple(parts, env),
            ExprKind::Unary { op, operand } => self.unary(op.value, operand, env),
            ExprKind::Binary { .. } => self.binary(expr, env),
            ExprKind::If { condition, then, otherwise } => {
                self.choice(condition, then, otherwise.as_ref(), expr.span, env)
            }
            ExprKind::Object(object) => self.object(object, env),
            ExprKind::Block(_) => self.poison(Error::Misplaced {
                what: "a block without a name".to_owned(),
                place: "here",
                used: Span::new(expr.span.start, expr.span.start + 1),
                help: "write what it is before the brace, such as `diffuse {`".to_owned(),
            }),
            ExprKind::Poison => Value::Poison,
        }
    }

    /// A number; `wanted` is the type that is expected of it.
    pub(super) fn numeral(&mut self, value: f64, unit: Option<&Name>, wanted: Option<Type>) -> Value<'a> {
        let Some(unit) = unit else { return Value::number(value) };
        with_unit(value, unit).map_or_else(|| self.poison(unknown_unit(unit, wanted)), Value::Number)
    }

    fn size(&mut self, width: &'a Expr, height: &'a Expr, env: &Env<'a>) -> Value<'a> {
        let mut side = |expr: &'a Expr| {
            let value = self.eval_as(expr, Type::Pixels, env);
            let Value::Number(pixels) = value else { return None };
            if pixels.value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&pixels.value) {
                return Some(pixels.value as u32);
            }
            self.wrong_type(
                "a whole number of pixels",
                "a number with a fraction",
                expr.span,
                "write it such as `1024 x 768`",
            );
            None
        };
        match (side(width), side(height)) {
            (Some(width), Some(height)) => Value::Size(width, height),
            _ => Value::Poison,
        }
    }

    /// A name: what the scene defines, or a built-in function, or a colour.
    pub(super) fn name(&mut self, name: &str, used: Span, wanted: Wanted, env: &Env<'a>) -> Value<'a> {
        if let Some((scope, definition)) = env.find(name) {
            return self.value_of(&scope, &definition);
        }
        if let Some(builtin) = builtin::find(name) {
            return Value::Builtin(builtin);
        }
        if let Some(color) = color::named(name) {
            return Value::Color(color);
        }
        self.unknown_name(name, used, wanted, env)
    }

    /// `mat.gold`, `p.x`.
    fn access(&mut self, base: &'a Expr, field: &'a Name, env: &Env<'a>) -> Value<'a> {
        if let ExprKind::Name(name) = &base.kind
            && self.is_unknown(base, env)
        {
            return self.part_of_unknown(name, base.span, env);
        }
        match self.eval(base, env) {
            Value::Poison => Value::Poison,
            Value::Module(scope) => self.member(&scope, base.span, field),
            Value::Tuple(parts) => {
                let part = ["x", "y", "z"].iter().position(|axis| *axis == field.value);
                part.and_then(|i| parts.get(i)).cloned().unwrap_or_else(|| {
                    let axes = if parts.len() == 2 { "`x` and `y`" } else { "`x`, `y` and `z`" };
                    let owner = if parts.len() == 2 { "this pair" } else { "this point" };
                    self.unknown_member(owner, field, Some(format!("its parts are {axes}")))
                })
            }
            Value::Color(color) => match field.as_str() {
                "r" => Value::number(color.r.into()),
                "g" => Value::number(color.g.into()),
                "b" => Value::number(color.b.into()),
                _ => self.unknown_member(
                    "this colour",
                    field,
                    Some("its parts are `r`, `g` and `b`".to_owned()),
                ),
            },
            Value::List(_) => {
                let counts = ["len", "length", "size", "count"].contains(&field.as_str());
                let text = self.text(base.span);
                let count = || format!("how many elements there are is `len({text})`");
                let help = if counts { count() } else { format!("its first element is `{text}[0]`") };
                self.unknown_member("a list", field, Some(help))
            }
            other => {
                let help = "parts are taken of points (`.x`), colours (`.r`) and imports";
                self.unknown_member(&other.noun(), field, Some(help.to_owned()))
            }
        }
    }

    fn member(&mut self, scope: &Env<'a>, module: Span, field: &Name) -> Value<'a> {
        if let Some(definition) = scope.own(field) {
            return self.value_of(scope, &definition);
        }
        let names = scope.in_order();
        let help = self.propose(field, names.iter().map(|definition| definition.name));
        let help = help.or_else(|| what_it_holds(&names));
        let owner = format!("`{}`", self.text(module));
        self.unknown_member(&owner, field, help)
    }

    fn unknown_member(&mut self, owner: &str, field: &Name, help: Option<String>) -> Value<'a> {
        let name = field.value.clone();
        self.poison(Error::UnknownMember { owner: owner.to_owned(), name, used: field.span, help })
    }

    fn index(&mut self, base: &'a Expr, index: &'a Expr, env: &Env<'a>) -> Value<'a> {
        let (list, at) = (self.eval(base, env), self.eval_as(index, Type::Int, env));
        let parts = match list {
            Value::List(parts) | Value::Tuple(parts) => parts,
            Value::Poison => return Value::Poison,
            other => {
                let help = "lists are written `[1, 2, 3]`";
                return self.wrong_type("a list", &other.noun(), base.span, help);
            }
        };
        let Value::Number(Quantity { value: at, .. }) = at else { return Value::Poison };
        let found = if at < 0.0 { None } else { parts.get(at as usize) };
        found.cloned().unwrap_or_else(|| {
            let (elements, help) = match parts.len() {
                0 => ("no elements".to_owned(), "nothing can be taken from it".to_owned()),
                1 => ("1 element".to_owned(), "it is number 0".to_owned()),
                len => (format!("{len} elements"), format!("they are numbered from 0 to {}", len - 1)),
            };
            self.poison(Error::OutOfBounds { index: at, elements, used: index.span, help })
        })
    }

    /// `on goblet`: the name under which it will be placed.
    fn on(&mut self, target: &'a Expr, env: &Env<'a>) -> Value<'a> {
        let instance = match &target.kind {
            ExprKind::Name(name) => {
                env.find(name).filter(|(_, found)| matches!(found.kind, Kind::Instance(..)))
            }
            _ => None,
        };
        let id = match instance {
            Some((_, definition)) => self.name_id(&definition),
            None => match self.object_named(target, env) {
                Value::Poison => return Value::Poison,
                value => match named(&value) {
                    Some(id) => id,
                    None => {
                        let help = "name it with `let`, or with `place .. as NAME`";
                        return self.wrong_type("the name of an object", &value.noun(), target.span, help);
                    }
                },
            },
        };
        Value::Focus(Rc::new(ir::Focus::On(id, self.text(target.span))))
    }

    /// The value of what stands after `on`.
    fn object_named(&mut self, target: &'a Expr, env: &Env<'a>) -> Value<'a> {
        match &target.kind {
            ExprKind::Name(name) => self.name(name, target.span, Wanted::Value(Type::Object), env),
            _ => self.eval(target, env),
        }
    }

    fn list(&mut self, parts: &'a [Expr], span: Span, env: &Env<'a>) -> Value<'a> {
        if !self.spend(Limit::Elements, parts.len() as u64, span) {
            return Value::Poison;
        }
        Value::List(parts.iter().map(|part| self.eval(part, env)).collect())
    }

    fn tuple(&mut self, parts: &'a [Expr], env: &Env<'a>) -> Value<'a> {
        let values: Rc<[Value]> = parts.iter().map(|part| self.eval(part, env)).collect();
        if values.iter().any(Value::is_poison) { Value::Poison } else { Value::Tuple(values) }
    }

    fn comprehension(
        &mut self,
        value: &'a Expr,
        name: &'a Name,
        range: &'a Expr,
        filter: Option<&'a Expr>,
        env: &Env<'a>,
    ) -> Value<'a> {
        let mut list = Vec::new();
        let complete = self.repeat(name, range, env, |this, turn| {
            let keep = filter.is_none_or(|filter| {
                this.enter(filter.span);
                !matches!(this.eval_as(filter, Type::Bool, turn), Value::Bool(false))
            });
            if keep {
                this.enter(value.span);
                list.push(this.eval(value, turn));
            }
            this.spend(Limit::Elements, 1, value.span)
        });
        if complete { Value::List(list.into()) } else { Value::Poison }
    }

    /// Runs `turn` for each element of a range or list, in a scope where `name` is the element. A poisoned range
    /// takes one turn, so that mistakes in the body are found. The result says whether all turns were taken.
    pub(super) fn repeat(
        &mut self,
        name: &'a Name,
        range: &'a Expr,
        env: &Env<'a>,
        mut turn: impl FnMut(&mut Self, &Env<'a>) -> bool,
    ) -> bool {
        let over = self.eval(range, env);
        let mut scope = Scope::new(Some(Rc::clone(env)));
        let mut one = |this: &mut Self, value: Value<'a>| {
            let number = match value {
                Value::Number(quantity) => Some(quantity),
                _ => None,
            };
            // Something that a turn made may still see its scope; mostly nothing does, and it serves again.
            if Rc::strong_count(&scope) > 1 || !scope.give_again(&name.value, &value) {
                scope = Scope::new(Some(Rc::clone(env)));
                scope.give(&name.value, name.span, value);
            }
            this.trail.push(Step::Turn(name, number));
            let go_on = turn(this, &scope);
            this.trail.pop();
            go_on && !this.is_full()
        };
        match over {
            Value::Range(start, end, inclusive) => {
                let turns = self.turns(start, end, inclusive, range.span);
                let Some(turns) = turns.filter(|&turns| self.spend(Limit::Turns, turns, range.span)) else {
                    return false;
                };
                (0..turns).all(|i| one(self, Value::number(start.value + i as f64)))
            }
            Value::List(parts) => {
                self.spend(Limit::Turns, parts.len() as u64, range.span)
                    && parts.iter().all(|part| one(self, part.clone()))
            }
            Value::Poison => {
                one(self, Value::Poison);
                false
            }
            other => {
                self.wrong_type(
                    "a range or a list",
                    &other.noun(),
                    range.span,
                    "write a range such as `0..10`",
                );
                false
            }
        }
    }

    /// The number of whole steps in a range of whole numbers.
    fn turns(&mut self, start: Quantity, end: Quantity, inclusive: bool, span: Span) -> Option<u64> {
        let plain = start.dimension == Dimension::NONE;
        if !plain || start.value.fract() != 0.0 || end.value.fract() != 0.0 {
            let found = if plain { "a range between fractions" } else { "a range of quantities" };
            let help = "count with whole numbers, and multiply in the body: `i * 10cm`";
            self.wrong_type("a range of whole numbers", found, span, help);
            return None;
        }
        Some((end.value - start.value + f64::from(u8::from(inclusive))).max(0.0) as u64)
    }

    fn unary(&mut self, op: UnaryOp, operand: &'a Expr, env: &Env<'a>) -> Value<'a> {
        let value = self.eval(operand, env);
        match (op, value) {
            (_, Value::Poison) => Value::Poison,
            (UnaryOp::Not, value) => match self.coerce(value, Type::Bool, operand.span) {
                Value::Bool(value) => Value::Bool(!value),
                _ => Value::Poison,
            },
            (UnaryOp::Plus, value @ (Value::Number(_) | Value::Tuple(_))) => value,
            (UnaryOp::Minus, Value::Number(q)) => Value::Number(Quantity::new(-q.value, q.dimension)),
            (UnaryOp::Minus, value @ Value::Tuple(_)) => self.scale_tuple(&value, -1.0, operand.span),
            (_, other) => {
                let noun = other.noun();
                self.wrong_type("a number", &noun, operand.span, "a sign belongs before a number or a point")
            }
        }
    }

    pub(super) fn choice(
        &mut self,
        condition: &'a Expr,
        then: &'a Block,
        otherwise: Option<&'a Block>,
        span: Span,
        env: &Env<'a>,
    ) -> Value<'a> {
        let condition = self.eval_as(condition, Type::Bool, env);
        // Told whether the condition holds or not, for the next `--set` may turn it.
        let Some(otherwise) = otherwise else { return self.no_else(span) };
        match condition {
            Value::Bool(true) => self.body(then, env),
            Value::Bool(false) => self.body(otherwise, env),
            _ => {
                // The condition is poisoned: look for mistakes in both branches, and stay silent.
                self.body(then, env);
                self.body(otherwise, env);
                Value::Poison
            }
        }
    }
}

/// The id of the name that an object has.
fn named(value: &Value) -> Option<u32> {
    match value {
        Value::Object(node) => node.name(),
        _ => None,
    }
}

/// The first names of an import, for those who ask for another.
fn what_it_holds(names: &[Rc<Definition<'_>>]) -> Option<String> {
    const MOST: usize = 12;
    let shown: Vec<&str> = names.iter().take(MOST).map(|definition| definition.name).collect();
    let more = if names.len() > MOST { " .." } else { "" };
    (!shown.is_empty()).then(|| format!("it holds {}{more}", shown.join(", ")))
}
