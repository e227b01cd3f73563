//! What each word of a well-formed file is for, read off its syntax tree.

use snell::source::{SourceMap, Span};
use snell::syntax::ast::{BinaryOp, Block, Entry, Expr, ExprKind, File, Item, ItemKind, Name, Object};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// What a word is for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Role {
    /// The kind of a block: `sphere`.
    Block,
    /// Before a colon: a field, or the name of an argument.
    Field,
    /// The use of a name that the scene or the language defines.
    Name,
    /// After a numeral.
    Unit,
    /// One of a few words that may stand there: `gold`, `white`, `true`, a type, `bezier`.
    Word,
    /// Where a name is given; left alone, since its uses are as wrong as it is.
    Binder,
}

/// A field with its value.
#[derive(Clone, Debug)]
pub struct FieldSite {
    /// Its name.
    pub name: String,
    /// The place of all of it.
    pub range: Range<usize>,
    /// Its value.
    pub value: Expr,
    /// The place of its value.
    pub value_range: Range<usize>,
}

/// A call of a function.
#[derive(Clone, Debug)]
pub struct CallSite {
    /// What is called.
    pub function: String,
    /// The place of all of it.
    pub range: Range<usize>,
    /// The arguments, and whether a name stands in them.
    pub args: Vec<(Range<usize>, bool)>,
}

/// The parts of a file that may be made wrong.
#[derive(Default, Debug)]
pub struct Roles {
    /// Words by where they begin.
    pub words: BTreeMap<usize, (Range<usize>, Role)>,
    /// Fields with their values.
    pub fields: Vec<FieldSite>,
    /// Calls.
    pub calls: Vec<CallSite>,
    /// The items of the file.
    pub items: Vec<Range<usize>>,
    /// Those of them that give a name, or stand once in a scene.
    pub single: Vec<Range<usize>>,
    /// The functions of the file: how many parameters each has, `None` when some may be left out.
    pub functions: BTreeMap<String, Option<usize>>,
    /// Branches that are not taken: what they mean is not looked at.
    pub idle: Vec<Range<usize>>,
    /// The files that it names: the place of the text, that of the item, the path.
    pub files: Vec<(Range<usize>, Range<usize>, String)>,
    base: u32,
    names: BTreeSet<String>,
    /// The parameters of the file with their defaults.
    defaults: BTreeMap<String, Expr>,
}

/// The roles of the words of a file; `names` are those that the scene defines.
pub fn roles(file: &File, sources: &SourceMap, names: &BTreeSet<String>) -> Roles {
    let base = sources.file(file.source).base;
    let mut roles = Roles { base, names: names.clone(), ..Roles::default() };
    for item in &file.items {
        if let ItemKind::Param { name, value, .. } = &item.kind {
            roles.defaults.insert(name.value.clone(), value.clone());
        }
    }
    for item in &file.items {
        let range = roles.local(item.span);
        if is_single(item) {
            roles.single.push(range.clone());
        }
        roles.items.push(range);
        roles.item(item);
    }
    roles
}

/// The names that the items of a file define, at any depth.
pub fn defined_names(file: &File, sources: &SourceMap) -> BTreeSet<String> {
    let roles = roles(file, sources, &BTreeSet::new());
    let text = &sources.file(file.source).text;
    let binders = roles.words.values().filter(|(_, role)| *role == Role::Binder);
    binders.map(|(range, _)| text[range.clone()].to_owned()).collect()
}

/// Whether a second item like this one is a mistake.
fn is_single(item: &Item) -> bool {
    match &item.kind {
        ItemKind::Let { .. } | ItemKind::Param { .. } | ItemKind::Fn(_) | ItemKind::Import { .. } => true,
        ItemKind::Object(object) => matches!(object.kind.as_str(), "render" | "environment"),
        _ => false,
    }
}

impl Roles {
    fn local(&self, span: Span) -> Range<usize> {
        (span.start - self.base) as usize..(span.end - self.base) as usize
    }

    fn note(&mut self, span: Span, role: Role) {
        let range = self.local(span);
        self.words.insert(range.start, (range, role));
    }

    fn item(&mut self, item: &Item) {
        match &item.kind {
            ItemKind::Include { path, .. } => self.file(path, item.span),
            ItemKind::Import { path, alias, .. } => {
                self.file(path, item.span);
                self.note(alias.span, Role::Binder);
            }
            ItemKind::Units(block) => self.block(block),
            ItemKind::Param { name, ty, value, range } => {
                self.note(name.span, Role::Binder);
                self.note(ty.span, Role::Word);
                self.expr(value);
                range.iter().for_each(|range| self.expr(range));
            }
            ItemKind::Let { name, value } => {
                self.note(name.span, Role::Binder);
                self.expr(value);
            }
            ItemKind::Fn(function) => {
                self.note(function.name.span, Role::Binder);
                self.note(function.result.span, Role::Word);
                for formal in &function.formals {
                    self.note(formal.name.span, Role::Binder);
                    self.note(formal.ty.span, Role::Word);
                    formal.default.iter().for_each(|default| self.expr(default));
                }
                let fixed = function.formals.iter().all(|formal| formal.default.is_none());
                self.functions.insert(function.name.value.clone(), fixed.then_some(function.formals.len()));
                self.block(&function.body);
            }
            ItemKind::For { name, range, body } => {
                self.note(name.span, Role::Binder);
                self.expr(range);
                self.block(body);
            }
            ItemKind::If { condition, then, otherwise } => self.choice(condition, then, otherwise.as_ref()),
            ItemKind::Place(place) => {
                self.expr(&place.target);
                place.at.iter().for_each(|at| self.expr(at));
                place.name.iter().for_each(|name| self.note(name.span, Role::Binder));
                place.body.iter().for_each(|body| self.block(body));
            }
            ItemKind::Object(object) => self.object(object),
            ItemKind::Value(value) => self.expr(value),
            ItemKind::Poison => {}
        }
    }

    fn file(&mut self, path: &Name, item: Span) {
        let entry = (self.local(path.span), self.local(item), path.value.clone());
        self.files.push(entry);
    }

    fn object(&mut self, object: &Object) {
        let role = if self.names.contains(&object.kind.value) { Role::Name } else { Role::Block };
        self.note(object.kind.span, role);
        if let Some(second) = &object.second {
            let role = if object.kind.value == "light" { Role::Block } else { Role::Binder };
            self.note(second.span, role);
        }
        self.block(&object.body);
    }

    fn block(&mut self, block: &Block) {
        for entry in &block.entries {
            match entry {
                Entry::Field(field) => {
                    self.note(field.name.span, Role::Field);
                    let (range, value_range) =
                        (self.local(field.name.span.to(field.value.span)), self.local(field.value.span));
                    let (name, value) = (field.name.value.clone(), field.value.clone());
                    self.fields.push(FieldSite { name, range, value, value_range });
                    self.expr(&field.value);
                }
                Entry::Item(item) => self.item(item),
            }
        }
    }

    fn choice(&mut self, condition: &Expr, then: &Block, otherwise: Option<&Block>) {
        self.expr(condition);
        let idle = match self.holds(condition) {
            Some(true) => otherwise,
            Some(false) => Some(then),
            None => None,
        };
        self.idle.extend(idle.map(|block| self.local(block.span)));
        self.block(then);
        otherwise.into_iter().for_each(|block| self.block(block));
    }

    /// Whether a condition holds, as far as parameters with plain defaults tell.
    fn holds(&self, condition: &Expr) -> Option<bool> {
        match &condition.kind {
            ExprKind::Bool(value) => Some(*value),
            ExprKind::Name(name) => self.defaults.get(name).and_then(|default| self.holds(default)),
            ExprKind::Binary { op, left, right } if op.value == BinaryOp::Greater => {
                Some(self.number(left)? > self.number(right)?)
            }
            _ => None,
        }
    }

    fn number(&self, expr: &Expr) -> Option<f64> {
        match &expr.kind {
            ExprKind::Number { value, unit: None, .. } => Some(*value),
            ExprKind::Name(name) => self.defaults.get(name).and_then(|default| self.number(default)),
            _ => None,
        }
    }

    fn expr(&mut self, expr: &Expr) {
        match &expr.kind {
            ExprKind::Number { unit, .. } => {
                unit.iter()
                    .filter(|unit| unit.as_str() != "%")
                    .for_each(|unit| self.note(unit.span, Role::Unit));
            }
            ExprKind::Name(name) => {
                let role = if self.names.contains(name) { Role::Name } else { Role::Word };
                self.note(expr.span, role);
            }
            ExprKind::Bool(_) => self.note(expr.span, Role::Word),
            ExprKind::Access { base, field } => {
                self.expr(base);
                let is_component = ["x", "y", "z", "r", "g", "b"].contains(&field.as_str());
                self.note(field.span, if is_component { Role::Binder } else { Role::Name });
            }
            ExprKind::Call { callee, args } => {
                self.expr(callee);
                if let ExprKind::Name(function) = &callee.kind {
                    self.note(callee.span, Role::Name);
                    let range = self.local(callee.span.to(expr.span));
                    let arg = |value: &Expr, name: Option<&Name>| {
                        let start = name.map_or(value.span, |name| name.span);
                        (self.local(start.to(value.span)), holds_name(value))
                    };
                    let args = args.iter().map(|a| arg(&a.value, a.name.as_ref())).collect();
                    self.calls.push(CallSite { function: function.clone(), range, args });
                }
                for arg in args {
                    arg.name.iter().for_each(|name| self.note(name.span, Role::Field));
                    self.expr(&arg.value);
                }
            }
            ExprKind::Index { base, index } => self.exprs([&**base, &**index]),
            ExprKind::Tagged { tag, value } => {
                self.note(tag.span, Role::Word);
                self.expr(value);
            }
            ExprKind::On(value) | ExprKind::Unary { operand: value, .. } => self.expr(value),
            ExprKind::Size(width, height) => self.exprs([&**width, &**height]),
            ExprKind::List(parts) | ExprKind::Tuple(parts) => self.exprs(parts),
            ExprKind::Comprehension { value, name, range, filter } => {
                self.note(name.span, Role::Binder);
                self.exprs([&**value, &**range]);
                self.exprs(filter.as_deref());
            }
            ExprKind::Binary { left, right, .. } => self.exprs([&**left, &**right]),
            ExprKind::If { condition, then, otherwise } => self.choice(condition, then, otherwise.as_ref()),
            ExprKind::Object(object) => self.object(object),
            ExprKind::Block(block) => self.block(block),
            ExprKind::FNumber(_)
            | ExprKind::Color(_)
            | ExprKind::Text(_)
            | ExprKind::Data(_)
            | ExprKind::Poison => {}
        }
    }

    fn exprs<'a>(&mut self, exprs: impl IntoIterator<Item = &'a Expr>) {
        exprs.into_iter().for_each(|expr| self.expr(expr));
    }
}

/// Whether something in `expr` may use a definition, which would be unused without it.
pub fn holds_name(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Number { .. }
        | ExprKind::FNumber(_)
        | ExprKind::Color(_)
        | ExprKind::Text(_)
        | ExprKind::Bool(_)
        | ExprKind::Data(_) => false,
        ExprKind::Size(a, b) => holds_name(a) || holds_name(b),
        ExprKind::Tuple(parts) | ExprKind::List(parts) => parts.iter().any(holds_name),
        ExprKind::Unary { operand, .. } => holds_name(operand),
        ExprKind::Binary { left, right, .. } => holds_name(left) || holds_name(right),
        ExprKind::Tagged { value, .. } => holds_name(value),
        ExprKind::Call { args, .. } => args.iter().any(|arg| holds_name(&arg.value)),
        _ => true,
    }
}
