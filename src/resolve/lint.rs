//! What the text alone shows: names defined twice, hidden, or never used.
//!
//! This looks at every branch, whether it is evaluated or not.

use super::error::Error;
use super::item::called_by_name;
use crate::diag::Problems;
use crate::source::Span;
use crate::syntax::ast::{
    Arg, Block, Entry, Expr, ExprKind, FileIndex, Function, Item, ItemKind, Name, Object, Place, Program,
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

/// Notes what is wrong with the names of `program`, and returns what the main file defines for nothing.
pub fn lint<'a>(program: &'a Program, problems: &mut Problems) -> Vec<Unused<'a>> {
    let seen = vec![false; program.files.len()];
    let mut lint = Lint { program, problems, scopes: Vec::new(), main: false, seen, unused: Vec::new() };
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
    lint.unused
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

struct Lint<'a, 'p> {
    program: &'a Program,
    problems: &'p mut Problems,
    scopes: Vec<Names<'a>>,
    /// Whether we are in the main file, where unused definitions are worth a word.
    main: bool,
    seen: Vec<bool>,
    unused: Vec<Unused<'a>>,
}

/// The names of a scope.
type Names<'a> = FxHashMap<&'a str, Found>;

/// A definition.
struct Found {
    span: Span,
    /// What it is, when it is worth a word that nothing uses it.
    kind: Option<&'static str>,
    used: bool,
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
            ItemKind::Let { name, .. } => self.define(name, Some("the value")),
            ItemKind::Param { name, .. } => self.define(name, Some("the parameter")),
            ItemKind::Fn(function) => self.define(&function.name, Some("the function")),
            // An import that could not be read is wrong already.
            ItemKind::Import { alias, file, .. } => self.define(alias, file.map(|_| "the import")),
            ItemKind::Place(Place { name: Some(name), .. }) => self.define(name, None),
            _ => {}
        }
    }

    fn define(&mut self, name: &'a Name, kind: Option<&'static str>) {
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
        let found = Found { span: name.span, kind, used: false };
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
            ItemKind::Units(block) => self.block(block),
            ItemKind::Param { value, range, .. } => {
                self.expr(value);
                self.exprs(range.as_ref());
            }
            ItemKind::Let { value, .. } | ItemKind::Value(value) => self.expr(value),
            ItemKind::Fn(function) => self.function(function),
            ItemKind::For { name, range, body } => {
                self.expr(range);
                self.turn(name, |this| this.block(body));
            }
            ItemKind::If { condition, then, otherwise } => self.choice(condition, then, otherwise.as_ref()),
            ItemKind::Place(place) => {
                if let Some(named) = called_by_name(place) {
                    self.mark(&named.kind);
                }
                self.expr(&place.target);
                self.exprs(place.at.as_ref());
                if let Some(body) = &place.body {
                    self.block(body);
                }
            }
            ItemKind::Object(object) => self.object(object),
            ItemKind::Include { .. } | ItemKind::Import { .. } | ItemKind::Poison => {}
        }
    }

    fn function(&mut self, function: &'a Function) {
        self.scopes.push(Names::default());
        for formal in &function.formals {
            self.define(&formal.name, None);
            self.exprs(formal.default.as_ref());
        }
        self.block(&function.body);
        self.leave();
    }

    fn turn(&mut self, name: &'a Name, body: impl FnOnce(&mut Self)) {
        self.scopes.push(Names::default());
        self.define(name, None);
        body(self);
        self.leave();
    }

    fn choice(&mut self, condition: &'a Expr, then: &'a Block, otherwise: Option<&'a Block>) {
        self.expr(condition);
        self.block(then);
        if let Some(otherwise) = otherwise {
            self.block(otherwise);
        }
    }

    fn object(&mut self, object: &'a Object) {
        self.block(&object.body);
    }

    fn block(&mut self, block: &'a Block) {
        self.scopes.push(Names::default());
        for entry in &block.entries {
            if let Entry::Item(item) = entry {
                self.declare(item);
            }
        }
        for entry in &block.entries {
            match entry {
                Entry::Field(field) => self.expr(&field.value),
                Entry::Item(item) => self.item(item),
            }
        }
        self.leave();
    }

    fn exprs(&mut self, exprs: impl IntoIterator<Item = &'a Expr>) {
        for expr in exprs {
            self.expr(expr);
        }
    }

    fn expr(&mut self, mut expr: &'a Expr) {
        // The left side of a chain of operators is walked, not descended.
        while let ExprKind::Binary { left, right, .. } = &expr.kind {
            self.expr(right);
            expr = left;
        }
        match &expr.kind {
            ExprKind::Name(name) => self.mark(name),
            ExprKind::Access { base, .. } => self.expr(base),
            ExprKind::Call { callee, args } => {
                self.expr(callee);
                self.exprs(args.iter().map(|arg: &Arg| &arg.value));
            }
            ExprKind::Index { base, index } => self.exprs([&**base, &**index]),
            ExprKind::Tagged { value, .. } | ExprKind::On(value) => self.expr(value),
            ExprKind::Size(width, height) => self.exprs([&**width, &**height]),
            ExprKind::List(parts) | ExprKind::Tuple(parts) => self.exprs(parts),
            ExprKind::Comprehension { value, name, range, filter } => {
                self.expr(range);
                self.turn(name, |this| {
                    this.expr(value);
                    this.exprs(filter.as_deref());
                });
            }
            ExprKind::Unary { operand, .. } => self.expr(operand),
            ExprKind::If { condition, then, otherwise } => self.choice(condition, then, otherwise.as_ref()),
            ExprKind::Object(object) => self.object(object),
            ExprKind::Block(block) => self.block(block),
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
}
