//! The arguments of the language's own functions: by position or by name, in one of the forms that the registry declares.

use super::error::Error;
use super::{Resolver, Value};
use crate::diag::did_you_mean;
use crate::schema::{Arg, Function, Takes, Type};
use crate::source::{Span, Spanned};
use crate::syntax::ast::Name;

/// An argument of a call: its name, where it has one, and its value.
pub type Given<'a, 'n> = (Option<&'n Name>, Spanned<Value<'a>>);

impl<'a> Resolver<'a> {
    /// The arguments in their order, of the types that the function takes; those that no form of it takes are reported.
    pub(super) fn fit(
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
        let is_length = |takes: &Takes| matches!(takes, Takes::Of(Type::Length));
        let lengths = args.iter().zip(takes.clone()).filter(|(_, takes)| is_length(takes));
        self.doubt_written(lengths.map(|(arg, _)| arg));
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
