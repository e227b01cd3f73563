//! What a word that nothing knows was meant to be: the nearest that is known, what is of the wanted kind first.

use super::dimension::{Dimension, Quantity, with_unit};
use super::error::Error;
use super::scope::{Definition, Kind, State};
use super::{Env, Resolver, Value, builtin};
use crate::diag::{did_you_mean, did_you_mean_one_of, is_slip_of, nearest_of_kind};
use crate::schema::{self, Type};
use crate::source::Span;
use crate::syntax::{ast::Name, spelled_out};
use std::rc::Rc;

/// What may stand where a name does.
#[derive(Clone, Copy, PartialEq)]
pub enum Wanted {
    /// Any value.
    Anything,
    /// Something that can be called.
    Function,
    /// A value of this type.
    Value(Type),
}

impl<'a> Resolver<'a> {
    /// The report of a name that nothing defines. It stays silent where the definition was lost to another mistake.
    pub(super) fn unknown_name(
        &mut self,
        name: &str,
        used: Span,
        wanted: Wanted,
        env: &Env<'a>,
    ) -> Value<'a> {
        let help = self.unknown_name_help(name, wanted, env);
        if self.is_lost(name, used, help.as_deref()) {
            return Value::Poison;
        }
        let help = help.or_else(|| Some(format!("define it with `let {name} = ..`, or take it away")));
        self.poison(Error::UnknownName { name: name.to_owned(), used, help })
    }

    /// The same where a material is wanted.
    pub(super) fn unknown_material(&mut self, name: &str, used: Span, env: &Env<'a>) -> Value<'a> {
        let help = self.unknown_name_help(name, Wanted::Value(Type::Material), env);
        if self.is_lost(name, used, help.as_deref()) {
            return Value::Poison;
        }
        let help = help.or_else(|| Some(format!("define it: `let {name} = diffuse {{ color: #ff8800 }}`")));
        self.poison(Error::UnknownMaterial { name: name.to_owned(), used, help })
    }

    /// What stands before a dot, and is nothing that the scene defines.
    pub(super) fn part_of_unknown(&mut self, name: &str, used: Span, env: &Env<'a>) -> Value<'a> {
        let is_import = |definition: &&Rc<Definition<'a>>| matches!(definition.kind, Kind::Import(_));
        let visible = env.visible();
        let imports = visible.iter().filter(is_import).map(|definition| definition.name);
        let is_of_the_language = builtin::find(name).is_some() || super::color::named(name).is_some();
        if is_of_the_language || schema::block(name).is_some() || did_you_mean(name, imports).is_some() {
            return self.name(name, used, Wanted::Anything, env);
        }
        let own = visible.iter().map(|definition| definition.name);
        let help = did_you_mean(name, own)
            .unwrap_or_else(|| format!("import the file that holds it: `import \"{name}.snell\" as {name}`"));
        if self.is_lost(name, used, Some(&help)) {
            return Value::Poison;
        }
        self.poison(Error::UnknownName { name: name.to_owned(), used, help: Some(help) })
    }

    /// Whether the definition of a name was likely lost: to a line with a mistake of syntax, or with a file that is not
    /// there, unless `help` proposes a name that is one slip away.
    fn is_lost(&self, name: &str, used: Span, help: Option<&str>) -> bool {
        let is_elsewhere = |line: &Span| used.end < line.start || line.end < used.start;
        let lines = self.doubtful.get(name).map_or(&[][..], Vec::as_slice);
        let proposed = help.and_then(|help| help.split('`').nth(1));
        let is_slip = proposed.is_some_and(|proposed| is_slip_of(proposed, name));
        self.program.lacks_files && !is_slip || lines.iter().any(is_elsewhere)
    }

    /// What to say of a name that nothing defines, unless nothing is like it.
    fn unknown_name_help(&mut self, name: &str, wanted: Wanted, env: &Env<'a>) -> Option<String> {
        if let Some(block) = schema::block(name) {
            return Some(format!("`{name}` needs its braces, as in `{}`", block.example));
        }
        if matches!(
            name.to_ascii_lowercase().as_str(),
            "vec" | "vec3" | "vector" | "vector3" | "float3" | "point3"
        ) {
            return Some("points and vectors stand in parentheses alone: `(0m, 1m, 0m)`".to_owned());
        }
        let visible = env.visible();
        if let Some(help) = self.imported_name_help(name, &visible) {
            return Some(help);
        }
        let own = visible.iter().map(|definition| (definition.name, fits(definition, wanted)));
        let near = nearest_of_kind(name, own.chain(known_words(wanted)));
        self.proposed.extend(near.iter().map(|&name| name.to_owned()));
        let is_bare_block = |name: &&&str| schema::block(name).is_some() && builtin::find(name).is_none();
        if let Some(kind) = near.first().filter(is_bare_block).filter(|name| env.find(name).is_none()) {
            return Some(format!("did you mean `{kind} {{ .. }}`?"));
        }
        did_you_mean_one_of(&near)
    }

    /// What to say of a name that an import holds.
    fn imported_name_help(&mut self, name: &str, visible: &[Rc<Definition<'a>>]) -> Option<String> {
        let holds = |this: &mut Self, definition: &Definition<'a>| match definition.kind {
            Kind::Import(Some(file)) => this.root(file).own(name).is_some(),
            _ => false,
        };
        let import = visible.iter().find(|definition| holds(self, definition))?.name;
        self.proposed.insert(import.to_owned());
        Some(format!("did you mean `{import}.{name}`?"))
    }
}

/// The report of a unit that is none; one of the wanted dimension is proposed first.
pub fn unknown_unit(unit: &Name, wanted: Option<Type>) -> Error {
    let dimension = wanted.and_then(dimension_wanted);
    let fits = |unit: &str| {
        let quantity = with_unit(1.0, unit);
        dimension.is_none_or(|wanted| quantity.is_some_and(|quantity| quantity.dimension == wanted))
    };
    let known = || schema::UNITS.iter().map(|unit| unit.name);
    let help = spelled_out(unit)
        .map(|short| format!("did you mean `{short}`?"))
        .or_else(|| did_you_mean_one_of(&nearest_of_kind(unit, known().map(|name| (name, fits(name))))))
        .unwrap_or_else(|| format!("the units are {}", known().collect::<Vec<_>>().join(" ")));
    Error::UnknownUnit { unit: unit.value.clone(), used: unit.span, help }
}

/// Whether a definition could stand where this is wanted, as far as that is known by now.
fn fits(definition: &Definition, wanted: Wanted) -> bool {
    let value = match (&definition.kind, wanted) {
        (_, Wanted::Anything) => return true,
        (kind, Wanted::Function) => return matches!(kind, Kind::Function(_)),
        (Kind::Function(_) | Kind::Import(_), Wanted::Value(_)) => return false,
        (_, Wanted::Value(ty)) => ty,
    };
    match &*definition.state.borrow() {
        State::Done(found) => is_like(found, value),
        State::Waiting | State::Running => true,
    }
}

/// Whether a value is about what a type wants.
fn is_like(value: &Value, ty: Type) -> bool {
    use Type::{
        Absorption, Bool, Cells, ColorInput, Curve, Focus, List, Material, Object, Offset, Outline, Outlines,
        Pair, Point, RadianceInput, SkyInput, Text, Texture, Transform, Vector,
    };
    match value {
        Value::Number(Quantity { dimension, .. }) => {
            dimension_wanted(ty).is_none_or(|wanted| wanted == *dimension)
        }
        Value::Bool(_) => ty == Bool,
        Value::Text(_) => ty == Text,
        Value::Color(_) => ty.takes_color() || ty == Absorption,
        Value::Tuple(_) => matches!(ty, Point | Offset | Vector | Pair | Cells | Focus),
        Value::List(_) => matches!(ty, List | Outlines),
        Value::Transform(_) => ty == Transform,
        Value::Curve(_) => matches!(ty, Curve | Outline | Outlines),
        Value::Material(_) => ty == Material,
        Value::Texture(_) => {
            matches!(ty, Texture | ColorInput | RadianceInput | SkyInput | Type::NumberInput)
        }
        Value::Object(_) => matches!(ty, Object | Focus),
        Value::Function(_) | Value::Builtin(_) | Value::Module(_) => false,
        _ => true,
    }
}

/// The dimension of the numbers that a type takes, or is made of; `None` when it is made of none.
fn dimension_wanted(ty: Type) -> Option<Dimension> {
    match ty {
        Type::Point | Type::Offset | Type::Focus => Some(Dimension::LENGTH),
        Type::LightColor | Type::SkyInput => Some(Dimension::TEMPERATURE),
        ty => Dimension::of(ty),
    }
}

/// The words that the language itself knows, and whether they are what is wanted.
fn known_words<'n>(wanted: Wanted) -> impl Iterator<Item = (&'n str, bool)> {
    let ty = match wanted {
        Wanted::Value(ty) => Some(ty),
        _ => None,
    };
    let is_function = wanted == Wanted::Function;
    let any = wanted == Wanted::Anything;
    // What the language calls something else is not proposed where a value of a type is wanted.
    let functions = builtin::names()
        .filter(move |_| is_function || any)
        .map(move |name| -> (&'n str, bool) { (name, is_function) });
    let takes_color = ty.is_some_and(Type::takes_color);
    let colors = schema::COLORS
        .iter()
        .filter(move |_| takes_color || any)
        .map(move |&(name, _)| -> (&'n str, bool) { (name, takes_color || any) });
    let kinds = schema::blocks()
        .filter(move |block| ty == Some(Type::Material) && block.area == schema::Area::Material);
    let words: &[&str] = match ty {
        Some(Type::Bool) => &["true", "false"],
        Some(Type::Exposure) => &["auto"],
        _ => &[],
    };
    let own = kinds
        .map(|block| block.kind)
        .chain(words.iter().copied())
        .map(|word| -> (&'n str, bool) { (word, true) });
    functions.chain(colors).chain(own)
}
