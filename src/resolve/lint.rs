//! What the text alone shows: names defined twice, hidden, or never used.
//!
//! This looks at every branch, whether it is evaluated or not.

use super::doubt::Doubt;
use super::error::Error;
use super::item::called_by_name;
use crate::diag::Problems;
use crate::schema::{self, Type};
use crate::source::Span;
use crate::syntax::ast::{
    Arg, BinaryOp, Block, Entry, Expr, ExprKind, FileIndex, Function, Item, ItemKind, Name, Object, Place,
    Program,
};
use rustc_hash::FxHashMap;

/// A definition that nothing uses.
pub struct Unused<'a> {
    kind: &'static str,
    pub name: &'a str,
    defined: Span,
}

impl Unused<'_> {
    pub fn error(&self) -> Error {
        Error::Unused { kind: self.kind, name: self.name.to_owned(), defined: self.defined }
    }
}

/// What the text alone shows of its names.
pub struct Findings<'a> {
    /// What the main file defines for nothing.
    pub unused: Vec<Unused<'a>>,
    /// What is unknown in parts that evaluation may not enter.
    pub doubts: Vec<Doubt>,
}

/// Notes what is wrong with the names that `program` defines, and returns what else is odd about names.
pub fn lint<'a>(program: &'a Program, problems: &mut Problems) -> Findings<'a> {
    let mut lint = Lint {
        program,
        problems,
        scopes: Vec::new(),
        main: false,
        seen: vec![false; program.files.len()],
        unused: Vec::new(),
        regions: Vec::new(),
        doubts: Vec::new(),
    };
    lint.root(FileIndex(0));
    for index in 1..program.files.len() {
        // What the main file includes was seen as part of it.
        if !lint.seen[index] {
            lint.root(FileIndex(index as u32));
        }
    }
    if is_library(program) {
        lint.unused.retain(|unused| unused.kind == "the import");
    }
    lint.unused.sort_by_key(|unused| unused.defined);
    Findings { unused: lint.unused, doubts: lint.doubts }
}

/// Whether the main file holds definitions only: then they are for those who import it.
fn is_library(program: &Program) -> bool {
    let defines = |item: &Item| {
        matches!(
            item.kind,
            ItemKind::Import { .. }
                | ItemKind::Units(_)
                | ItemKind::Param { .. }
                | ItemKind::Let { .. }
                | ItemKind::Fn(_)
        )
    };
    program.files[0].items.iter().all(defines)
}

pub(super) struct Lint<'a, 'p> {
    pub(super) program: &'a Program,
    problems: &'p mut Problems,
    pub(super) scopes: Vec<Names<'a>>,
    /// Whether we are in the main file, where unused definitions are worth a word.
    main: bool,
    seen: Vec<bool>,
    unused: Vec<Unused<'a>>,
    /// The parts that evaluation may not enter in which we are, by the offsets at which they begin.
    pub(super) regions: Vec<u32>,
    pub(super) doubts: Vec<Doubt>,
}

/// The names of a scope.
type Names<'a> = FxHashMap<&'a str, Found<'a>>;

/// A definition.
pub(super) struct Found<'a> {
    span: Span,
    /// What it is, when it is worth a word that nothing uses it.
    kind: Option<&'static str>,
    pub(super) what: What<'a>,
    used: bool,
}

/// What the text alone shows of a definition.
#[derive(Clone, Copy)]
pub(super) enum What<'a> {
    Function(&'a Function),
    Module(FileIndex),
    Value,
}

impl<'a> Lint<'a, '_> {
    fn root(&mut self, file: FileIndex) {
        self.scopes.push(Names::default());
        self.declare_file(file);
        self.walk_file(file);
        self.leave();
    }

    fn declare_file(&mut self, file: FileIndex) {
        self.seen[file.0 as usize] = true;
        let outer = std::mem::replace(&mut self.main, file.0 == 0);
        let program = self.program;
        for item in &program.files[file.0 as usize].items {
            match &item.kind {
                ItemKind::Include { file: Some(included), .. } => self.declare_file(*included),
                _ => self.declare(item),
            }
        }
        self.main = outer;
    }

    fn walk_file(&mut self, file: FileIndex) {
        let outer = std::mem::replace(&mut self.main, file.0 == 0);
        let program = self.program;
        for item in &program.files[file.0 as usize].items {
            match &item.kind {
                ItemKind::Include { file: Some(included), .. } => self.walk_file(*included),
                _ => self.item(item),
            }
        }
        self.main = outer;
    }

    fn declare(&mut self, item: &'a Item) {
        match &item.kind {
            ItemKind::Let { name, .. } => self.define(name, Some("the value"), What::Value),
            ItemKind::Param { name, .. } => self.define(name, Some("the parameter"), What::Value),
            ItemKind::Fn(function) => {
                self.define(&function.name, Some("the function"), What::Function(function))
            }
            // An import that could not be read is wrong already.
            ItemKind::Import { alias, file, .. } => {
                self.define(alias, file.map(|_| "the import"), file.map_or(What::Value, What::Module))
            }
            ItemKind::Place(Place { name: Some(name), .. }) => self.define(name, None, What::Value),
            _ => {}
        }
    }

    fn define(&mut self, name: &'a Name, kind: Option<&'static str>, what: What<'a>) {
        let key = name.value.as_str();
        let (inner, outside) = self.scopes.split_last().expect("a root scope is open");
        if let Some(first) = inner.get(key).map(|found| found.span) {
            self.problems.push(Error::DuplicateName { name: name.value.clone(), first, second: name.span });
            return;
        }
        if let Some(outer) = outside.iter().rev().find_map(|names| names.get(key)) {
            let (inner, outer) = (name.span, outer.span);
            self.problems.push(Error::Shadowed { name: name.value.clone(), inner, outer });
        }
        let kind = kind.filter(|_| self.main && !key.starts_with('_'));
        let found = Found { span: name.span, kind, what, used: false };
        self.scopes.last_mut().expect("a root scope is open").insert(key, found);
    }

    /// Closes a scope and notes what nothing used in it.
    fn leave(&mut self) {
        let names = self.scopes.pop().unwrap_or_default();
        let unused = names.into_iter().filter(|(_, found)| !found.used);
        self.unused.extend(
            unused.filter_map(|(name, found)| Some(Unused { kind: found.kind?, name, defined: found.span })),
        );
    }

    fn mark(&mut self, name: &str) {
        if let Some(found) = self.scopes.iter_mut().rev().find_map(|names| names.get_mut(name)) {
            found.used = true;
        }
    }

    fn item(&mut self, item: &'a Item) {
        match &item.kind {
            ItemKind::Units(block) => self.block(block, schema::block("units")),
            ItemKind::Param { ty, value, range, .. } => {
                self.expr(value, Type::named(ty));
                self.exprs(range.as_ref());
            }
            ItemKind::Let { value, .. } | ItemKind::Value(value) => self.expr(value, None),
            ItemKind::Fn(function) => self.function(function),
            ItemKind::For { name, range, body } => {
                self.expr(range, None);
                self.turn(name, |this| this.region(body.span, |this| this.block(body, None)));
            }
            ItemKind::If { condition, then, otherwise } => self.choice(condition, then, otherwise.as_ref()),
            ItemKind::Place(place) => self.place(place),
            ItemKind::Object(object) => self.object(object),
            ItemKind::Include { .. } | ItemKind::Import { .. } | ItemKind::Poison => {}
        }
    }

    fn place(&mut self, place: &'a Place) {
        let block = schema::block("place");
        match called_by_name(place).filter(|named| self.find(&named.kind).is_some()) {
            Some(named) => {
                self.mark(&named.kind);
                self.block(&named.body, block);
            }
            None => self.expr(&place.target, Some(Type::Object)),
        }
        self.exprs(place.at.as_ref());
        if let Some(body) = &place.body {
            self.block(body, block);
        }
    }

    fn function(&mut self, function: &'a Function) {
        self.scopes.push(Names::default());
        for formal in &function.formals {
            self.define(&formal.name, None, What::Value);
        }
        for formal in &function.formals {
            if let Some(default) = &formal.default {
                self.region(default.span, |this| this.expr(default, Type::named(&formal.ty)));
            }
        }
        self.block(&function.body, None);
        self.leave();
    }

    fn turn(&mut self, name: &'a Name, body: impl FnOnce(&mut Self)) {
        self.scopes.push(Names::default());
        self.define(name, None, What::Value);
        body(self);
        self.leave();
    }

    /// A part that evaluation may not enter.
    fn region(&mut self, span: Span, body: impl FnOnce(&mut Self)) {
        self.regions.push(span.start);
        body(self);
        self.regions.pop();
    }

    fn choice(&mut self, condition: &'a Expr, then: &'a Block, otherwise: Option<&'a Block>) {
        self.expr(condition, Some(Type::Bool));
        for block in [Some(then), otherwise].into_iter().flatten() {
            self.region(block.span, |this| this.block(block, None));
        }
    }

    fn object(&mut self, object: &'a Object) {
        let block = self.block_of(object);
        self.block(&object.body, block);
    }

    /// What stands between braces; `declared` says which fields there are, `None` that nobody knows.
    fn block(&mut self, block: &'a Block, declared: Option<&'static schema::Block>) {
        self.scopes.push(Names::default());
        for entry in &block.entries {
            if let Entry::Item(item) = entry {
                self.declare(item);
            }
        }
        for entry in &block.entries {
            match entry {
                Entry::Field(field) => {
                    let ty = declared.and_then(|block| self.type_of(block, &field.name));
                    self.expr(&field.value, ty);
                }
                Entry::Item(item) => self.item(item),
            }
        }
        self.leave();
    }

    fn exprs(&mut self, exprs: impl IntoIterator<Item = &'a Expr>) {
        for expr in exprs {
            self.expr(expr, None);
        }
    }

    /// An expression of which a type is expected, where the text shows that.
    fn expr(&mut self, mut expr: &'a Expr, ty: Option<Type>) {
        // The left side of a chain of operators is walked, not descended.
        while let ExprKind::Binary { op, left, right } = &expr.kind {
            match op.value {
                BinaryOp::And | BinaryOp::Or => self.region(right.span, |this| this.expr(right, None)),
                _ => self.expr(right, None),
            }
            expr = left;
        }
        match &expr.kind {
            ExprKind::Name(name) => {
                self.mark(name);
                self.check_name(name, expr.span, ty);
            }
            ExprKind::Access { base, field } => {
                self.expr(base, None);
                self.check_member(base, field);
            }
            ExprKind::Call { callee, args } => {
                self.expr(callee, None);
                self.args(callee, args);
            }
            ExprKind::Index { base, index } => self.exprs([&**base, &**index]),
            ExprKind::Tagged { value, .. } | ExprKind::On(value) => self.expr(value, None),
            ExprKind::Size(width, height) => self.exprs([&**width, &**height]),
            ExprKind::List(parts) | ExprKind::Tuple(parts) => self.exprs(parts),
            ExprKind::Comprehension { value, name, range, filter } => {
                self.expr(range, None);
                self.turn(name, |this| {
                    if let Some(filter) = filter {
                        this.region(filter.span, |this| this.expr(filter, Some(Type::Bool)));
                    }
                    this.region(value.span, |this| this.expr(value, None));
                });
            }
            ExprKind::Unary { operand, .. } => self.expr(operand, None),
            ExprKind::If { condition, then, otherwise } => self.choice(condition, then, otherwise.as_ref()),
            ExprKind::Object(object) => self.object(object),
            ExprKind::Block(block) => match ty {
                Some(Type::Block(kind)) => self.block(block, schema::block(kind)),
                _ => self.block(block, None),
            },
            ExprKind::Number { unit: Some(unit), .. } => self.check_unit(unit),
            ExprKind::Binary { .. }
            | ExprKind::Number { .. }
            | ExprKind::FNumber(_)
            | ExprKind::Color(_)
            | ExprKind::Text(_)
            | ExprKind::Bool(_)
            | ExprKind::Data(_)
            | ExprKind::Poison => {}
        }
    }

    fn args(&mut self, callee: &Expr, args: &'a [Arg]) {
        let function = self.function_called(callee);
        for (position, arg) in args.iter().enumerate() {
            self.check_arg(function, arg);
            let formal = function.and_then(|function| match &arg.name {
                Some(name) => function.formals.iter().find(|formal| formal.name.value == name.value),
                None => function.formals.get(position),
            });
            // `degree: all`: words that only the function knows.
            if function.is_some() || arg.name.is_none() {
                self.expr(&arg.value, formal.and_then(|formal| Type::named(&formal.ty)));
            }
        }
    }

    /// The innermost definition of a name.
    pub(super) fn find(&self, name: &str) -> Option<&Found<'a>> {
        self.scopes.iter().rev().find_map(|names| names.get(name))
    }
}
