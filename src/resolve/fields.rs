//! Reading a block by what the registry declares of its kind.

use super::dimension::Quantity;
use super::error::Error;
use super::{Env, Resolver, Value};
use crate::diag::nearest;
use crate::ir::Input;
use crate::math::{DVec3, Rgb};
use crate::schema::{self, Field, Literal, Need};
use crate::source::{Span, Spanned};
use crate::syntax::ast::{self, Block, Entry, Name};
use std::rc::Rc;

/// A block with nothing in it.
pub static EMPTY: Block = Block { entries: Vec::new(), span: Span::new(0, 0), poisoned: false };

/// A block whose fields were read: each absent, or poisoned, or of its declared type.
pub struct Fields<'a> {
    pub block: &'static schema::Block,
    /// The words before the brace.
    pub head: Span,
    /// Parallel to the block's declared fields.
    slots: Vec<Option<Spanned<Value<'a>>>>,
    /// Whether something in it was wrong and has been reported.
    pub poisoned: bool,
}

impl<'a> Resolver<'a> {
    /// Reads `body` by what `block` declares. `head` is what a missing field is reported at.
    pub(super) fn read(
        &mut self,
        block: &'static schema::Block,
        head: Span,
        body: &'a Block,
        env: &Env<'a>,
    ) -> Fields<'a> {
        let mut fields = Fields { poisoned: body.poisoned, ..Fields::empty(block, head) };
        let mut unread = Unread { has_strays: body.poisoned, names: Vec::new() };
        // A definition among fields is misplaced; what uses it is not wrong once more.
        let scope = if block.holds_items() { Rc::clone(env) } else { self.scope_of(body, env) };
        let mut names: Vec<Option<&Name>> = vec![None; block.field_count()];
        for entry in &body.entries {
            match entry {
                Entry::Field(field) => {
                    let Some((index, declared)) = self.declared(block, &field.name) else {
                        fields.poisoned = true;
                        unread.names.push(&field.name);
                        self.misspelt(block, field, &names, env);
                        continue;
                    };
                    if let Some(first) = names[index] {
                        let (first, second) = (first.span, field.name.span);
                        self.report(Error::DuplicateField { field: field.name.value.clone(), first, second });
                        continue;
                    }
                    names[index] = Some(&field.name);
                    let value = self.eval_as(&field.value, declared.ty, &scope);
                    let value = self.in_range(value, declared, field.value.span);
                    fields.poisoned |= value.is_poison();
                    fields.slots[index] = Some(Spanned::new(value, field.value.span));
                }
                Entry::Item(_) if block.holds_items() => {}
                Entry::Item(item) => {
                    (fields.poisoned, unread.has_strays) = (true, true);
                    // In a body that could not be read, what looks like an item may be the rest of a mistake.
                    if !body.poisoned {
                        self.misplaced_in(block, item);
                    }
                }
            }
        }
        self.report_missing(&mut fields, &unread);
        self.report_choices(&mut fields, &unread);
        fields
    }

    fn declared(&mut self, block: &'static schema::Block, name: &Name) -> Option<(usize, &'static Field)> {
        let found = block.fields().enumerate().find(|(_, field)| field.name == name.value);
        if found.is_none() {
            let help = unknown_field_help(block, name);
            let (block, field) = (block.kind.to_owned(), name.value.clone());
            self.report(Error::UnknownField { block, field, used: name.span, help });
        }
        found
    }

    /// Looks for mistakes in the value of a misspelt field, as in that of the one that it is nearest to.
    fn misspelt(
        &mut self,
        block: &schema::Block,
        field: &'a ast::Field,
        given: &[Option<&Name>],
        env: &Env<'a>,
    ) {
        let left = block.fields().enumerate().filter(|(index, _)| given[*index].is_none());
        let names: Vec<&str> = left.map(|(_, field)| field.name).collect();
        let meant = nearest(&field.name, names).first().and_then(|name| block.field(name));
        if let Some(meant) = meant {
            self.eval_as(&field.value, meant.ty, env);
        }
    }

    /// The value, unless it lies outside the range that its field declares.
    fn in_range(&mut self, value: Value<'a>, field: &Field, used: Span) -> Value<'a> {
        let (Some(range), Value::Number(Quantity { value: number, .. })) = (field.range, &value) else {
            return value;
        };
        if range.physical || range.contains(*number) {
            return value;
        }
        let found = format!("`{}`", field.ty.write(*number));
        let nearest = range.nearest(*number).map(|nearest| field.ty.write(nearest));
        let example = nearest.unwrap_or_else(|| field.example().to_owned());
        let (range, help) =
            (range.describe(field.ty), format!("write for example `{}: {example}`", field.name));
        self.poison(Error::OutOfRange { field: field.name.to_owned(), range, found, used, said: None, help })
    }

    /// Reports fields that are missing, alone or beside others, unless they may be what could not be read.
    fn report_missing(&mut self, fields: &mut Fields<'a>, unread: &Unread<'_>) {
        let is_missing = |field: &Field| !fields.has(field.name) && field.need == Need::Required;
        let mut missing: Vec<&'static Field> =
            fields.block.fields().filter(|field| is_missing(field)).collect();
        let beside = fields.block.fields().filter(|field| fields.has(field.name));
        let wanted = beside.filter_map(|field| fields.block.field(field.beside?));
        missing.extend(wanted.filter(|field| !fields.has(field.name)));
        for field in missing {
            fields.poisoned = true;
            if !unread.may_be(fields.block, field.name) {
                self.missing(fields, field);
            }
        }
    }

    fn missing(&mut self, fields: &Fields<'a>, field: &Field) {
        let (block, name) = (fields.block.kind.to_owned(), field.name.to_owned());
        let help = format!("write {} for it, such as `{name}: {}`", field.ty.noun(), field.example());
        self.report(Error::MissingField { block, field: name, head: fields.head, help });
    }

    /// Reports choices that were not made, made by half, or made twice.
    fn report_choices(&mut self, fields: &mut Fields<'a>, unread: &Unread<'_>) {
        for choice in fields.block.choices {
            let taken: Vec<&[&str]> =
                choice.ways.iter().copied().filter(|way| fields.first_of(way).is_some()).collect();
            match taken[..] {
                [] if choice.required => self.needs_one(fields, choice, unread),
                [way] => self.report_rest(fields, way, unread),
                [one, other, ..] => self.conflict(fields, one, other),
                [] => {}
            }
        }
    }

    /// Reports the first field that a way lacks.
    fn report_rest(&mut self, fields: &mut Fields<'a>, way: &[&'static str], unread: &Unread<'_>) {
        let lacking = fields.mandatory(way).into_iter().find(|name| !fields.has(name));
        let Some(field) = lacking.and_then(|name| fields.block.field(name)) else { return };
        fields.poisoned = true;
        if !unread.may_be(fields.block, field.name) {
            self.missing(fields, field);
        }
    }

    /// Reports that none of the ways of a choice was taken.
    fn needs_one(&mut self, fields: &mut Fields<'a>, choice: &schema::Choice, unread: &Unread<'_>) {
        fields.poisoned = true;
        if choice.ways.iter().copied().flatten().any(|field| unread.may_be(fields.block, field)) {
            return;
        }
        let ways: Vec<String> = choice.ways.iter().map(|way| fields.mandatory(way).join("` and `")).collect();
        let example =
            |name: &&str| format!("`{name}: {}`", fields.block.field(name).map_or("", Field::example));
        let examples: Vec<String> = fields.mandatory(choice.ways[0]).iter().map(example).collect();
        let (block, field) = (fields.block.kind.to_owned(), ways.join("` or `"));
        let help = format!("say one of them, such as {}", examples.join(" and "));
        self.report(Error::MissingField { block, field, head: fields.head, help });
    }

    /// Reports two ways to say the same thing.
    fn conflict(&mut self, fields: &Fields<'a>, one: &[&'static str], other: &[&'static str]) {
        let ways = [one, other].map(|way| fields.mandatory(way));
        let help = match ways.iter().any(|way| way.len() > 1) {
            true => format!("write `{}`, or `{}`", ways[0].join("` and `"), ways[1].join("` and `")),
            false => "keep one of them".to_owned(),
        };
        let (Some((one, first)), Some((other, second))) = (fields.first_of(one), fields.first_of(other))
        else {
            return;
        };
        let (one, other) = (one.to_owned(), other.to_owned());
        self.report(Error::ConflictingFields { help, one, other, first, second });
    }
}

/// What of a block could not be read: it may be what seems to be missing.
struct Unread<'n> {
    /// Whether something in it was no field at all.
    has_strays: bool,
    /// Names that are no fields of such a block.
    names: Vec<&'n Name>,
}

impl Unread<'_> {
    /// Whether some of it may be this field.
    fn may_be(&self, block: &schema::Block, field: &str) -> bool {
        let may_mean = |name: &&Name| match called_here(block, name) {
            Some(ours) => ours == field,
            None => {
                let near = nearest(name, block.fields().map(|field| field.name));
                near.is_empty() || near.contains(&field)
            }
        };
        self.has_strays || self.names.iter().any(may_mean)
    }
}

/// The field of a block that other programs call by this name.
fn called_here(block: &schema::Block, name: &str) -> Option<&'static str> {
    // What one block calls its centre is the position of another.
    match schema::foreign_field(name).unwrap_or(name) {
        "center" | "position" => ["center", "position"].into_iter().find(|ours| block.field(ours).is_some()),
        ours => block.field(ours).map(|field| field.name),
    }
}

/// Near names, then what other programs call it, then all there is.
pub fn unknown_field_help(block: &schema::Block, name: &Name) -> String {
    if let Some(ours) = called_here(block, name) {
        return match (ours, name.as_str()) {
            ("transform", "rotation") => "write `transform: rotate_y(..)`".to_owned(),
            ("stop", word) if word != "stop" => "write `stop: samples(64)`".to_owned(),
            ("transform", word) => format!("write `transform: {word}(..)`"),
            _ => format!("it is called `{ours}` here"),
        };
    }
    match (block.kind, name.as_str()) {
        ("environment", "image" | "map" | "file" | "texture" | "picture" | "hdri" | "background") => {
            return "write `radiance: image(\"sky.hdr\")`".to_owned();
        }
        ("environment", "color" | "colour" | "intensity" | "power") => {
            return "it is called `radiance` here".to_owned();
        }
        _ => {}
    }
    let near = nearest(name, block.fields().map(|field| field.name));
    if !near.is_empty() {
        return format!("did you mean {}?", schema::quoted(&near));
    }
    let all: Vec<&str> = block.fields().map(|field| field.name).collect();
    format!("its fields are {}", all.join(", "))
}

impl<'a> Fields<'a> {
    /// A block that says nothing.
    pub fn empty(block: &'static schema::Block, head: Span) -> Self {
        Self { block, head, slots: vec![None; block.field_count()], poisoned: false }
    }

    fn slot(&self, name: &str) -> Option<&Spanned<Value<'a>>> {
        self.slots[self.block.position(name)?].as_ref()
    }

    /// The first of these that was written, and where.
    fn first_of<'n>(&self, names: &[&'n str]) -> Option<(&'n str, Span)> {
        names.iter().find_map(|&name| Some((name, self.span(name)?)))
    }

    /// Those of a way's fields that have no default.
    fn mandatory(&self, way: &[&'static str]) -> Vec<&'static str> {
        let has_default = |name: &&str| self.default(name).is_some();
        way.iter().copied().filter(|name| !has_default(name)).collect()
    }

    /// Whether it was written, be it poisoned.
    pub fn has(&self, name: &str) -> bool {
        self.slot(name).is_some()
    }

    /// Where its value stands, when it was written.
    pub fn span(&self, name: &str) -> Option<Span> {
        self.slot(name).map(|slot| slot.span)
    }

    /// Its value, when it was written and makes sense.
    pub fn value(&self, name: &str) -> Option<&Spanned<Value<'a>>> {
        self.slot(name).filter(|slot| !slot.is_poison())
    }

    /// The default that the registry declares, at the block's head.
    fn default(&self, name: &str) -> Option<Spanned<Literal>> {
        match self.block.field(name)?.need {
            Need::Default(literal) => Some(Spanned::new(literal, self.head)),
            _ => None,
        }
    }

    /// A number in SI units, or its default.
    pub fn number(&self, name: &str) -> Option<Spanned<f64>> {
        match self.value(name) {
            Some(Spanned { value: Value::Number(quantity), span }) => {
                Some(Spanned::new(quantity.value, *span))
            }
            _ => match self.default(name)? {
                Spanned { value: Literal::Number(value), span } => Some(Spanned::new(value, span)),
                _ => None,
            },
        }
    }

    /// A whole number, or its default; beyond the type's range, the end of the range.
    pub fn count(&self, name: &str) -> Option<Spanned<u32>> {
        Some(self.number(name)?.map(|value| value as u32))
    }

    /// A number in SI units, when it was written.
    pub fn given(&self, name: &str) -> Option<Spanned<f64>> {
        self.value(name).and_then(|_| self.number(name))
    }

    /// A whole number, when it was written.
    pub fn given_count(&self, name: &str) -> Option<Spanned<u32>> {
        self.value(name).and_then(|_| self.count(name))
    }

    /// `true` or `false`, or its default.
    pub fn flag(&self, name: &str) -> Option<bool> {
        match (self.value(name).map(|slot| &slot.value), self.default(name).map(|literal| literal.value)) {
            (Some(Value::Bool(value)), _) => Some(*value),
            (_, Some(Literal::Bool(value))) => Some(value),
            _ => None,
        }
    }

    /// The default of a size in pixels.
    pub fn size(&self, name: &str) -> Option<Spanned<(u32, u32)>> {
        match self.default(name)? {
            Spanned { value: Literal::Size([width, height]), span } => {
                Some(Spanned::new((width, height), span))
            }
            _ => None,
        }
    }

    /// One of the words that its type lists, or its default.
    pub fn word(&self, name: &str) -> Option<Spanned<&'static str>> {
        match self.value(name) {
            Some(Spanned { value: Value::Word(word), span }) => Some(Spanned::new(word, *span)),
            _ => match self.default(name)? {
                Spanned { value: Literal::Word(word), span } => Some(Spanned::new(word, span)),
                _ => None,
            },
        }
    }

    /// A text.
    pub fn text(&self, name: &str) -> Option<Spanned<String>> {
        match self.value(name)? {
            Spanned { value: Value::Text(text), span } => Some(Spanned::new(text.to_string(), *span)),
            _ => None,
        }
    }

    /// Three numbers in SI units (the third 0 for a pair), or their default.
    pub fn triple(&self, name: &str) -> Option<Spanned<DVec3>> {
        match self.value(name) {
            Some(slot) => slot.triple().map(|triple| Spanned::new(triple, slot.span)),
            None => match self.default(name)? {
                Spanned { value: Literal::Triple(xyz), span } => {
                    Some(Spanned::new(DVec3::from_array(xyz), span))
                }
                Spanned { value: Literal::Pair([x, y]), span } => {
                    Some(Spanned::new(DVec3::new(x, y, 0.0), span))
                }
                _ => None,
            },
        }
    }

    /// A colour, or its default grey.
    pub fn color(&self, name: &str) -> Option<Spanned<Rgb>> {
        match self.value(name) {
            Some(Spanned { value: Value::Color(color), span }) => Some(Spanned::new(*color, *span)),
            _ => match self.default(name)? {
                Spanned { value: Literal::Number(grey), span } => {
                    Some(Spanned::new(Rgb::gray(grey as f32), span))
                }
                _ => None,
            },
        }
    }

    /// A colour or a texture, or the default grey.
    pub fn input(&self, name: &str) -> Option<Input> {
        match self.value(name) {
            Some(Spanned { value: Value::Texture(handle), span }) => {
                Some(Input::Texture(Spanned::new(*handle, *span)))
            }
            _ => self.color(name).map(Input::Constant),
        }
    }

    /// The fields of a block without a head.
    pub fn nested(&self, name: &str) -> Option<&Self> {
        match self.value(name).map(|slot| &slot.value) {
            Some(Value::Block(fields)) => Some(fields),
            _ => None,
        }
    }
}
