//! Parameters: values that the command line may replace.

use super::dimension::{Dimension, Quantity};
use super::error::Error;
use super::scope::{Definition, Kind, Scope};
use super::{Env, Resolver, Setting, Value};
use crate::diag::did_you_mean;
use crate::ir;
use crate::schema::Type;
use crate::source::{Span, Spanned};
use crate::syntax::ast::{BinaryOp, Expr, ExprKind, FileIndex};
use std::rc::Rc;

impl<'a> Resolver<'a> {
    /// Takes the values of the command line, the last of each name, and evaluates every parameter of the scene.
    pub(super) fn set_parameters(&mut self, settings: &'a [Setting]) {
        let root = self.root(FileIndex(0));
        let parameters: Vec<_> =
            root.in_order().into_iter().filter(|found| matches!(found.kind, Kind::Param { .. })).collect();
        for setting in settings {
            match parameters.iter().find(|parameter| parameter.name == setting.name.value) {
                Some(parameter) => {
                    self.settings.retain(|(name, _)| *name != parameter.name);
                    self.settings.push((parameter.name, setting));
                }
                None => self.unknown_parameter(setting, &parameters),
            }
        }
        for parameter in &parameters {
            self.value_of(&root, parameter);
        }
    }

    fn unknown_parameter(&mut self, setting: &Setting, parameters: &[Rc<Definition<'a>>]) {
        let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name).collect();
        let help =
            did_you_mean(&setting.name, names.iter().copied()).unwrap_or_else(|| match names.as_slice() {
                [] => "it has none; write `param name: length = 1m` to make one".to_owned(),
                _ => format!("its parameters are {}", names.join(", ")),
            });
        let name = setting.name.value.clone();
        self.report(Error::UnknownParameter { name, used: setting.name.span, help });
    }

    /// The value of a parameter in this run. Its default is looked at even when it is replaced.
    pub(super) fn parameter(&mut self, env: &Env<'a>, definition: &Rc<Definition<'a>>) -> Value<'a> {
        let Kind::Param { ty, value, range, doc } = definition.kind else { return Value::Poison };
        let Some(ty) = self.type_named(ty) else { return Value::Poison };
        let range = range.and_then(|range| self.parameter_range(range, ty, env));
        let default = self.eval_as(value, ty, env);
        let default = self.in_parameter_range(definition, default, value.span, ty, range);
        // Only the main file and what it includes have parameters that can be set.
        let main =
            self.root(FileIndex(0)).own(definition.name).is_some_and(|own| Rc::ptr_eq(&own, definition));
        let setting =
            self.settings.iter().find(|(name, _)| main && *name == definition.name).map(|(_, s)| *s);
        let (result, span) = match setting {
            Some(setting) => {
                let given = self.eval_as(&setting.value, ty, &Scope::new(None));
                (
                    self.in_parameter_range(definition, given, setting.value.span, ty, range),
                    setting.value.span,
                )
            }
            None => (default, value.span),
        };
        self.scene.params.push(ir::Param {
            name: Spanned::new(definition.name.to_owned(), definition.span),
            value: self.text(span),
            doc: doc.map(str::to_owned),
        });
        result
    }

    /// The ends of `in 1..=500`, in SI units.
    fn parameter_range(
        &mut self,
        range: &'a Expr,
        ty: Type,
        env: &Env<'a>,
    ) -> Option<(f64, f64, bool, Span)> {
        let value = match &range.kind {
            // Each end is of the parameter's type, so that what is wrong with one points at it.
            ExprKind::Binary { op, left, right }
                if matches!(op.value, BinaryOp::Range | BinaryOp::RangeInclusive)
                    && Dimension::of(ty).is_some() =>
            {
                match (self.eval_as(left, ty, env), self.eval_as(right, ty, env)) {
                    (Value::Number(start), Value::Number(end)) => {
                        Value::Range(start, end, op.value == BinaryOp::RangeInclusive)
                    }
                    _ => Value::Poison,
                }
            }
            _ => self.eval(range, env),
        };
        match value {
            Value::Range(..) if Dimension::of(ty).is_none() => {
                let help = "take the range away: only numbers have one";
                self.wrong_type("nothing", "a range", range.span, help);
                None
            }
            Value::Range(start, end, inclusive) => {
                let start = self.coerce(Value::Number(start), ty, range.span);
                let end = self.coerce(Value::Number(end), ty, range.span);
                match (start, end) {
                    (Value::Number(start), Value::Number(end)) if is_empty(start, end, inclusive) => {
                        let help = "write the smaller end first, and `..=` to take the end in";
                        self.wrong_type("a range that holds something", "an empty range", range.span, help);
                        None
                    }
                    (Value::Number(start), Value::Number(end)) => {
                        Some((start.value, end.value, inclusive, range.span))
                    }
                    _ => None,
                }
            }
            Value::Poison => None,
            other => {
                self.wrong_type("a range", &other.noun(), range.span, "write a range such as `1..=10`");
                None
            }
        }
    }

    fn in_parameter_range(
        &mut self,
        definition: &Definition<'a>,
        value: Value<'a>,
        used: Span,
        ty: Type,
        range: Option<(f64, f64, bool, Span)>,
    ) -> Value<'a> {
        let (Value::Number(quantity), Some((min, max, inclusive, said))) = (&value, range) else {
            return value;
        };
        let below = if inclusive { quantity.value <= max } else { quantity.value < max };
        if min <= quantity.value && below {
            return value;
        }
        let range = match inclusive {
            true => format!("from {} to {}", ty.write(min), ty.write(max)),
            false => format!("at least {} and less than {}", ty.write(min), ty.write(max)),
        };
        let found = format!("`{}`", ty.write(quantity.value));
        let field = definition.name.to_owned();
        let nearest = if inclusive && quantity.value > max { max } else { min };
        let help = format!("write for example `{}`, or widen the range", ty.write(nearest));
        self.poison(Error::OutOfRange { field, range, found, used, said: Some(said), help })
    }
}

/// Whether no value lies in a range.
fn is_empty(start: Quantity, end: Quantity, inclusive: bool) -> bool {
    if inclusive { start.value > end.value } else { start.value >= end.value }
}
