//! Items: what stands at the top level, in groups, in loops, in the bodies of functions.

use super::error::Error;
use super::fields::EMPTY;
use super::meant::Wanted;
use super::node::{Node, NodeKind, steps_of};
use super::scope::{Definition, Kind, Scope};
use super::{Env, Resolver, Value};
use crate::ir::TransformStep;
use crate::math::DAffine3;
use crate::math::motion::Factor;
use crate::schema::{self, Type};
use crate::source::Span;
use crate::syntax::ast::{Block, Entry, Expr, ExprKind, FileIndex, Item, ItemKind, Name, Object, Place};
use std::rc::Rc;

/// Where items stand that belong to the top level.
const INSIDE: &str = "in a block";
/// What to do about them.
const TO_TOP: &str = "move it to the top level";

/// Where objects go.
pub enum Sink {
    /// Into the picture.
    Scene,
    /// Into a group.
    Group(Vec<Rc<Node>>),
}

impl<'a> Resolver<'a> {
    /// Runs the items of the main file.
    pub(super) fn run_file(&mut self, file: FileIndex) {
        let env = self.root(file);
        self.run_items(file, &env);
    }

    fn run_items(&mut self, file: FileIndex, env: &Env<'a>) {
        let outer = std::mem::replace(&mut self.unit, self.units[file.0 as usize]);
        let program = self.program;
        for item in &program.files[file.0 as usize].items {
            match item.kind {
                ItemKind::Include { file: Some(included), .. } => self.run_items(included, env),
                ItemKind::Include { file: None, .. } | ItemKind::Units(_) => {}
                _ => self.item(item, env, &mut Sink::Scene),
            }
        }
        self.unit = outer;
    }

    fn item(&mut self, item: &'a Item, env: &Env<'a>, sink: &mut Sink) {
        match &item.kind {
            ItemKind::Object(object) if is_setting(object) => self.setting(object, env, sink),
            ItemKind::Object(object) => {
                let value = self.object(object, env);
                self.put(value, object.span, sink);
            }
            ItemKind::Value(expr) => {
                let value = self.eval(expr, env);
                self.put(value, expr.span, sink);
            }
            ItemKind::Place(place) => {
                if let Some(node) = self.placed(place, item.span, env) {
                    self.put_node(node, sink);
                }
            }
            ItemKind::For { name, range, body } => self.for_each(name, range, body, env, sink),
            ItemKind::If { condition, then, otherwise } => {
                self.branch(condition, then, otherwise.as_ref(), env, sink)
            }
            ItemKind::Units(_) => self.misplaced_item("`units`", INSIDE, item.span, TO_TOP),
            ItemKind::Include { .. } => self.misplaced_item("`include`", INSIDE, item.span, TO_TOP),
            ItemKind::Param { .. } if !env.is_root() => {
                let help = "move it to the top level, where `--set` finds it; or make it a `let`";
                self.misplaced_item("a parameter", INSIDE, item.span, help);
            }
            // In source order, so that a long chain of definitions is no deep one.
            ItemKind::Let { name, .. } => self.evaluate_now(name, env),
            // Other definitions are evaluated when something asks for them.
            ItemKind::Import { .. } | ItemKind::Param { .. } | ItemKind::Fn(_) | ItemKind::Poison => {}
        }
    }

    /// Evaluates the definition that this name begins, if it is the one that holds.
    fn evaluate_now(&mut self, name: &'a Name, env: &Env<'a>) {
        if let Some((scope, definition)) = env.find(name)
            && definition.span == name.span
        {
            self.value_of(&scope, &definition);
        }
    }

    /// The items of a block, in a scope of their own.
    fn block_items(&mut self, block: &'a Block, env: &Env<'a>, sink: &mut Sink) {
        self.enter(block.span);
        let scope = self.scope_of(block, env);
        for entry in &block.entries {
            match entry {
                Entry::Item(item) => self.item(item, &scope, sink),
                Entry::Field(field) => {
                    let help = "write an item, such as `sphere { radius: 30cm }`";
                    self.misplaced_item("a field", "where items are wanted", field.name.span, help);
                }
            }
        }
        self.evaluate_block(&scope, env);
    }

    /// A scope with what a block defines; the scope around it when that is nothing.
    pub(super) fn scope_of(&mut self, block: &'a Block, env: &Env<'a>) -> Env<'a> {
        let defines = |entry: &Entry| {
            let named =
                matches!(entry, Entry::Item(Item { kind: ItemKind::Place(Place { name: Some(_), .. }), .. }));
            named || Self::is_definition(entry)
        };
        if !block.entries.iter().any(defines) {
            return Rc::clone(env);
        }
        let scope = Scope::new(Some(Rc::clone(env)));
        scope.declare_block(block, self.unit);
        scope
    }

    /// Evaluates the definitions of a block in `env` that nothing asked for, for their mistakes.
    fn evaluate_block(&mut self, scope: &Env<'a>, env: &Env<'a>) {
        if Rc::ptr_eq(scope, env) {
            return; // it defines nothing
        }
        for definition in scope.in_order() {
            if matches!(definition.kind, Kind::Let(_)) {
                self.value_of(scope, &definition);
            }
        }
    }

    fn for_each(&mut self, name: &'a Name, range: &'a Expr, body: &'a Block, env: &Env<'a>, sink: &mut Sink) {
        self.repeat(name, range, env, |this, turn| {
            this.block_items(body, turn, sink);
            true
        });
    }

    fn branch(
        &mut self,
        condition: &'a Expr,
        then: &'a Block,
        otherwise: Option<&'a Block>,
        env: &Env<'a>,
        sink: &mut Sink,
    ) {
        match self.eval_as(condition, Type::Bool, env) {
            Value::Bool(true) => self.block_items(then, env, sink),
            Value::Bool(false) => {
                if let Some(otherwise) = otherwise {
                    self.block_items(otherwise, env, sink);
                }
            }
            _ => {
                // Which branch it is, nobody knows: look for mistakes in both, and place nothing.
                let mut nowhere = Sink::Group(Vec::new());
                self.block_items(then, env, &mut nowhere);
                if let Some(otherwise) = otherwise {
                    self.block_items(otherwise, env, &mut nowhere);
                }
            }
        }
    }

    /// Puts a value that stands where an item may into the picture or the group.
    fn put(&mut self, value: Value<'a>, span: Span, sink: &mut Sink) {
        if let Value::Object(node) = self.coerce(value, Type::Object, span) {
            self.put_node(node, sink);
        }
    }

    fn put_node(&mut self, node: Rc<Node>, sink: &mut Sink) {
        match sink {
            Sink::Scene => self.emit(&node),
            Sink::Group(members) => members.push(node),
        }
    }

    /// `camera`, `environment` and `render`: they are no objects.
    fn setting(&mut self, object: &'a Object, env: &Env<'a>, sink: &Sink) {
        if matches!(sink, Sink::Group(_)) {
            let what = format!("`{}`", object.kind.value);
            self.misplaced_item(&what, "in a group", object.kind.span, "move it to the top level");
        }
        match object.kind.as_str() {
            "camera" => self.camera(object, env),
            "environment" => self.environment(object, env),
            _ => self.render(object, env),
        }
    }

    /// `place .. as hero` is a definition, evaluated once; the others are placed where they stand.
    fn placed(&mut self, place: &'a Place, span: Span, env: &Env<'a>) -> Option<Rc<Node>> {
        let definition = place.name.as_ref().and_then(|name| env.find(name));
        let value = match definition {
            Some((scope, definition)) if matches!(definition.kind, Kind::Instance(of, _) if std::ptr::eq(of, place)) => {
                self.value_of(&scope, &definition)
            }
            _ => return self.place(place, span, env, None),
        };
        match value {
            Value::Object(node) => Some(node),
            _ => None,
        }
    }

    /// The node of a `place`.
    pub(super) fn place(
        &mut self,
        place: &'a Place,
        span: Span,
        env: &Env<'a>,
        definition: Option<&Definition<'a>>,
    ) -> Option<Rc<Node>> {
        let (target, body) = match called_by_name(place).filter(|named| env.find(&named.kind).is_some()) {
            Some(Object { kind, body, .. }) => {
                let named = self.name(kind, kind.span, Wanted::Value(Type::Object), env);
                (self.coerce(named, Type::Object, kind.span), body)
            }
            None => (self.eval_as(&place.target, Type::Object, env), place.body.as_ref().unwrap_or(&EMPTY)),
        };
        let block = schema::block("place").expect("declared in the registry");
        let fields = self.read(block, span, body, env);
        let at = place.at.as_ref().map(|at| (self.eval_as(at, Type::Point, env), at.span));
        let Value::Object(node) = target else { return None };

        let own = steps_of(fields.value("transform").map(|slot| &slot.value));
        let offset = at.and_then(|(value, span)| Some(translation(value.triple()?, span)));
        let transform = match offset {
            Some(offset) => own.iter().copied().chain([offset]).collect(),
            None => own,
        };
        let material = match fields.value("material").map(|slot| &slot.value) {
            Some(Value::Material(handle)) => Some(*handle),
            _ => None,
        };
        let node = self.node(NodeKind::Place(node), transform, material, span)?;
        Some(match definition {
            Some(definition) => Node::named(node, self.name_id(definition), span),
            None => node,
        })
    }

    /// The value of a body: its definitions hold in it, and one value or object stands in it.
    pub(super) fn body(&mut self, block: &'a Block, env: &Env<'a>) -> Value<'a> {
        self.enter(block.span);
        if block.poisoned {
            return Value::Poison;
        }
        let scope = self.scope_of(block, env);
        let mut result: Option<(Value<'a>, Span)> = None;
        for entry in &block.entries {
            if Self::is_definition(entry) {
                continue;
            }
            let (value, span) = self.body_entry(entry, &scope);
            if let Some((_, first)) = result {
                return self.poison(Error::SeveralValues { first, second: span });
            }
            result = Some((value, span));
        }
        self.evaluate_block(&scope, env);
        result.map_or_else(|| self.no_value(block.span), |(value, _)| value)
    }

    fn no_value(&mut self, used: Span) -> Value<'a> {
        let help = "end it with a value, such as `sphere { radius: 30cm }`";
        self.poison(Error::NoValue { what: "this body", used, help })
    }

    /// An `if` that is to give a value, and has one branch only.
    pub(super) fn no_else(&mut self, used: Span) -> Value<'a> {
        let help = "give it an `else { .. }`";
        self.poison(Error::NoValue { what: "an `if` without `else`", used, help })
    }

    fn body_entry(&mut self, entry: &'a Entry, env: &Env<'a>) -> (Value<'a>, Span) {
        match entry {
            Entry::Field(field) => {
                let help = "write a value";
                self.misplaced_item("a field", "where a value is wanted", field.name.span, help);
                (Value::Poison, field.name.span)
            }
            Entry::Item(item) => (self.body_item(item, env), item.span),
        }
    }

    fn body_item(&mut self, item: &'a Item, env: &Env<'a>) -> Value<'a> {
        match &item.kind {
            ItemKind::Value(expr) => self.eval(expr, env),
            ItemKind::Object(object) => self.object(object, env),
            ItemKind::Place(place) => self.placed(place, item.span, env).map_or(Value::Poison, Value::Object),
            ItemKind::If { condition, then, otherwise } => {
                self.choice(condition, then, otherwise.as_ref(), item.span, env)
            }
            ItemKind::For { .. } => {
                let help = "wrap it: `group { for .. }`";
                self.misplaced_item("a loop", "where one value is wanted", item.span, help);
                Value::Poison
            }
            ItemKind::Poison => Value::Poison,
            _ => {
                self.misplaced_item("this item", "in a body", item.span, "move it to the top level");
                Value::Poison
            }
        }
    }

    /// The members of a group.
    pub(super) fn members(&mut self, body: &'a Block, env: &Env<'a>) -> Vec<Rc<Node>> {
        let mut sink = Sink::Group(Vec::new());
        let scope = self.scope_of(body, env);
        for entry in &body.entries {
            if let Entry::Item(item) = entry {
                self.item(item, &scope, &mut sink);
            }
        }
        self.evaluate_block(&scope, env);
        match sink {
            Sink::Group(members) => members,
            Sink::Scene => Vec::new(),
        }
    }

    pub(super) fn misplaced_item(&mut self, what: &str, place: &'static str, used: Span, help: &str) {
        self.report(Error::Misplaced { what: what.to_owned(), place, used, help: help.to_owned() });
    }

    /// An item in a block that holds fields only.
    pub(super) fn misplaced_in(&mut self, block: &schema::Block, item: &Item) {
        if matches!(item.kind, ItemKind::Poison) {
            return;
        }
        let help = match item.kind {
            ItemKind::Object(_) => {
                "a field has a name before its value: `material: diffuse { .. }`".to_owned()
            }
            ItemKind::Let { .. } | ItemKind::Fn(_) | ItemKind::Param { .. } => {
                "move the definition before the block".to_owned()
            }
            _ => format!("a field is written `name: value`, as in `{}`", block.example),
        };
        self.report(Error::Misplaced {
            what: "this".to_owned(),
            place: "among the fields of a block",
            used: item.span,
            help,
        });
    }

    /// Objects, lights and cameras in a file that is imported, where they would do nothing: one report for the file.
    pub(super) fn definitions_only(&mut self, file: FileIndex) {
        let program = self.program;
        let mut strays = program.files[file.0 as usize].items.iter().filter_map(|item| match &item.kind {
            ItemKind::Object(object) => Some((item, Some(object))),
            ItemKind::Place(_) | ItemKind::For { .. } | ItemKind::Value(_) | ItemKind::If { .. } => {
                Some((item, None))
            }
            _ => None,
        });
        let Some((first, object)) = strays.next() else { return };
        let (noun, help) = match object {
            Some(object) if is_setting(object) => {
                let help = "`include` the file, or move this into the main file";
                (format!("`{}`", object.kind.value), help)
            }
            Some(object) if object.kind.value == "light" => {
                ("a light".to_owned(), "give it a name with `let`, or `include` the file")
            }
            _ => ("an object".to_owned(), "give it a name with `let`, or `include` the file"),
        };
        let what = match strays.count() {
            0 => noun,
            1 => format!("{noun}, like one item after it,"),
            others => format!("{noun}, like {others} items after it,"),
        };
        self.misplaced_item(&what, "in a file that is imported", first.span, help);
    }
}

/// Whether a block says how the picture is taken, and is no object.
fn is_setting(object: &Object) -> bool {
    matches!(object.kind.as_str(), "camera" | "environment" | "render")
}

/// The name and the block of `place goblet { .. }`, where no block of the language is called `goblet`: then the block is
/// that of the `place`.
pub fn called_by_name(place: &Place) -> Option<&Object> {
    match &place.target.kind {
        ExprKind::Object(object) => {
            let is_bare = object.second.is_none() && place.body.is_none();
            (is_bare && schema::block(&object.kind).is_none()).then_some(object)
        }
        _ => None,
    }
}

/// A translation as one step.
pub fn translation(offset: crate::math::DVec3, span: Span) -> TransformStep {
    TransformStep { factor: Factor::still(DAffine3::from_translation(offset)), span }
}
