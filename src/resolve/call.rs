//! Calls of functions: those of the language and those of the scene.

use super::constructor::is_curve;
use super::error::Error;
use super::meant::Wanted;
use super::scope::Scope;
use super::value::Function;
use super::{Env, Resolver, Step, Value};
use crate::diag::did_you_mean;
use crate::schema::Type;
use crate::source::{Span, Spanned};
use crate::syntax::ast::{self, Arg, Expr, ExprKind, Formal, Name};
use std::rc::Rc;

impl<'a> Resolver<'a> {
    /// `ring(12, radius: 1m)`.
    pub(super) fn call(&mut self, callee: &'a Expr, args: &'a [Arg], used: Span, env: &Env<'a>) -> Value<'a> {
        if let ExprKind::Name(name) = &callee.kind
            && is_curve(name)
            && env.find(name).is_none()
            && let Some(curve) = self.curve_call(name, args, used, env)
        {
            return curve;
        }
        let function = match &callee.kind {
            ExprKind::Name(name) => self.name(name, callee.span, Wanted::Function, env),
            _ => self.eval(callee, env),
        };
        match function {
            Value::Builtin(builtin) => {
                let mut given = |(index, arg): (usize, &'a Arg)| {
                    let value = match &arg.value.kind {
                        ExprKind::Number { value, unit, .. } => {
                            self.numeral(*value, unit.as_ref(), builtin.type_of_argument(index))
                        }
                        _ => self.eval(&arg.value, env),
                    };
                    (arg.name.as_ref(), Spanned::new(value, arg.value.span))
                };
                let given: Vec<_> = args.iter().enumerate().map(&mut given).collect();
                self.call_builtin(builtin, given, used)
            }
            Value::Function(function) => self.call_function(&function, args, used, env),
            Value::Poison => {
                // The arguments may hold mistakes of their own; a word after a colon may be one that the function knows.
                let is_word = |arg: &&Arg| arg.name.is_some() && matches!(arg.value.kind, ExprKind::Name(_));
                for arg in args.iter().filter(|arg| !is_word(arg)) {
                    self.eval(&arg.value, env);
                }
                Value::Poison
            }
            other => {
                self.wrong_type("a function", &other.noun(), callee.span, "only functions can be called")
            }
        }
    }

    fn call_function(
        &mut self,
        function: &Function<'a>,
        args: &'a [Arg],
        used: Span,
        env: &Env<'a>,
    ) -> Value<'a> {
        let definition = function.definition;
        let name = &definition.name;
        if self.calls.contains(&name.span) {
            let error = Error::Recursion { name: name.value.clone(), called: used, defined: name.span };
            return self.poison(error);
        }
        let scope = Scope::new(Some(Rc::clone(&function.scope)));
        let complete = self.bind(function, args, used, env, &scope);
        // Without all of its arguments the body would tell of what is missing once more.
        if !complete {
            return Value::Poison;
        }
        self.called.insert(name.span);
        self.trail.push(Step::Call(name, used));
        let value = self.run(function, &scope);
        self.trail.pop();
        value
    }

    /// Calls a function with values in place of what could be written; one that takes fewer or more is a mistake.
    pub(super) fn call_with(&mut self, function: &Function<'a>, args: &[Value<'a>], used: Span) -> Value<'a> {
        let definition = function.definition;
        let name = &definition.name;
        self.called.insert(name.span);
        if definition.formals.len() != args.len() {
            let (function, found) = (name.value.clone(), definition.formals.len());
            let wanted = format!("{} parameters", args.len());
            let help = format!("define it as `fn {function}(u: number, v: number) -> number {{ .. }}`");
            return self.poison(Error::ArgumentCount { function, wanted, found, used, help });
        }
        if self.calls.contains(&name.span) {
            let error = Error::Recursion { name: name.value.clone(), called: used, defined: name.span };
            return self.poison(error);
        }
        let scope = Scope::new(Some(Rc::clone(&function.scope)));
        for (formal, value) in definition.formals.iter().zip(args) {
            let ty = self.type_named(&formal.ty);
            let value = ty.map_or(Value::Poison, |ty| self.coerce(value.clone(), ty, formal.ty.span));
            scope.give(&formal.name.value, formal.name.span, value);
        }
        self.trail.push(Step::Call(name, used));
        let value = self.run(function, &scope);
        self.trail.pop();
        value
    }

    /// Gives the arguments their names. `false`: some are missing or too many, which is reported.
    fn bind(
        &mut self,
        function: &Function<'a>,
        args: &'a [Arg],
        used: Span,
        env: &Env<'a>,
        scope: &Env<'a>,
    ) -> bool {
        let formals = &function.definition.formals;
        let mut given: Vec<Option<&'a Expr>> = vec![None; formals.len()];
        for (position, arg) in args.iter().enumerate() {
            let Some(index) = self.formal_of(function, position, arg, args.len(), used) else { return false };
            if given[index].is_some() {
                let name = formals[index].name.value.clone();
                self.report(Error::DuplicateArgument { name, used: arg.value.span });
                return false;
            }
            given[index] = Some(&arg.value);
        }
        for (formal, arg) in formals.iter().zip(given) {
            let ty = self.type_named(&formal.ty);
            let value = match (arg, &formal.default) {
                (Some(arg), _) => self.typed(arg, ty, env),
                (None, Some(default)) => self.default_of(function, default, ty),
                (None, None) => {
                    self.missing_argument(function, formal, used);
                    return false;
                }
            };
            scope.give(&formal.name.value, formal.name.span, value);
        }
        true
    }

    /// Which parameter an argument is for.
    fn formal_of(
        &mut self,
        function: &Function<'a>,
        position: usize,
        arg: &'a Arg,
        found: usize,
        used: Span,
    ) -> Option<usize> {
        let formals = &function.definition.formals;
        let name = function.definition.name.value.clone();
        match &arg.name {
            Some(wanted) => {
                let index = formals.iter().position(|formal| formal.name.value == wanted.value);
                if index.is_none() {
                    self.report(unknown_argument(function.definition, wanted));
                }
                index
            }
            None if position < formals.len() => Some(position),
            None => {
                let least = formals.iter().filter(|formal| formal.default.is_none()).count();
                let wanted = count_text(least, formals.len());
                let help = format!("write for example `{}`", usage(function));
                self.report(Error::ArgumentCount { function: name, wanted, found, used, help });
                None
            }
        }
    }

    fn missing_argument(&mut self, function: &Function<'a>, formal: &Formal, used: Span) {
        let (name, help) = (formal.name.value.clone(), format!("write for example `{}`", usage(function)));
        let function = function.definition.name.value.clone();
        self.report(Error::MissingArgument { function, name, used, help });
    }

    /// A default is worked out where the function stands.
    fn default_of(&mut self, function: &Function<'a>, default: &'a Expr, ty: Option<Type>) -> Value<'a> {
        self.enter(default.span);
        let unit = std::mem::replace(&mut self.unit, function.unit);
        let value = self.typed(default, ty, &function.scope);
        self.unit = unit;
        value
    }

    fn typed(&mut self, expr: &'a Expr, ty: Option<Type>, env: &Env<'a>) -> Value<'a> {
        match ty {
            Some(ty) => self.eval_as(expr, ty, env),
            None => Value::Poison,
        }
    }

    /// The value of the body, in a scope that holds the arguments.
    fn run(&mut self, function: &Function<'a>, scope: &Env<'a>) -> Value<'a> {
        let definition = function.definition;
        let result = self.type_named(&definition.result);
        let unit = std::mem::replace(&mut self.unit, function.unit);
        self.calls.push(definition.name.span);
        let value = self.deeper(definition.name.span, |this| this.body(&definition.body, scope));
        self.calls.pop();
        let value = match result {
            Some(ty) => self.coerce(value, ty, value_span(&definition.body, definition.result.span)),
            None => Value::Poison,
        };
        self.unit = unit;
        value
    }

    /// Looks for mistakes in a function that nothing calls: with arguments of which nothing is known.
    pub(super) fn try_function(&mut self, function: &Function<'a>) {
        if self.called.contains(&function.definition.name.span) {
            return;
        }
        let scope = Scope::new(Some(Rc::clone(&function.scope)));
        for formal in &function.definition.formals {
            let ty = self.type_named(&formal.ty);
            if let Some(default) = &formal.default {
                self.default_of(function, default, ty);
            }
            scope.give(&formal.name.value, formal.name.span, Value::Poison);
        }
        self.run(function, &scope);
    }

    /// The type of this name.
    pub(super) fn type_named(&mut self, name: &Name) -> Option<Type> {
        let ty = Type::named(name);
        if ty.is_none() {
            let names = || Type::NAMED.iter().map(|known| known.name);
            let foreign = Type::foreign(name).map(|ours| match ours {
                "number" => {
                    "it is called `number` here; with a unit it is a `length`, an `angle`, a `time` .."
                        .to_owned()
                }
                ours => format!("it is called `{ours}` here"),
            });
            let help = foreign
                .or_else(|| did_you_mean(name, names()))
                .unwrap_or_else(|| format!("the types are {}", names().collect::<Vec<_>>().join(", ")));
            self.report(Error::UnknownType { name: name.value.clone(), used: name.span, help });
        }
        ty
    }
}

/// The report of an argument by a name that the function does not have.
pub fn unknown_argument(function: &ast::Function, wanted: &Name) -> Error {
    let names = || function.formals.iter().map(|formal| formal.name.as_str());
    let help = did_you_mean(wanted, names())
        .unwrap_or_else(|| format!("its parameters are {}", names().collect::<Vec<_>>().join(", ")));
    let (function, name) = (function.name.value.clone(), wanted.value.clone());
    Error::UnknownArgument { function, name, used: wanted.span, help }
}

/// "1 argument", "2 to 3 arguments".
pub fn count_text(least: usize, most: usize) -> String {
    match (least, most) {
        (1, 1) => "1 argument".to_owned(),
        _ if least == most => format!("{least} arguments"),
        _ => format!("{least} to {most} arguments"),
    }
}

/// A call as it could be written: `ring(n: 3, radius: 30cm)`.
fn usage(function: &Function) -> String {
    let formal = |formal: &Formal| {
        let example = Type::named(&formal.ty).map_or("..", Type::example);
        format!("{}: {example}", formal.name.value)
    };
    let formals: Vec<String> = function.definition.formals.iter().map(formal).collect();
    format!("{}({})", function.definition.name.value, formals.join(", "))
}

/// Where the value of a body stands.
fn value_span(body: &ast::Block, otherwise: Span) -> Span {
    match body.entries.last() {
        Some(ast::Entry::Item(item)) => item.span,
        _ => otherwise,
    }
}
