//! What is unknown in parts that evaluation may not enter: branches not taken, loops without a turn, defaults not used.
//!
//! Where evaluation does come, it says more than the text alone shows; so these are kept until it is known where it came.

use super::build::{block_error, kinds_for};
use super::builtin;
use super::coerce::{is_word_of, unknown_word};
use super::color;
use super::error::Error;
use super::fields::unknown_field_help;
use super::lint::{Lint, What};
use super::meant::unknown_unit;
use crate::diag::{did_you_mean, did_you_mean_one_of, nearest_of_kind};
use crate::schema::{self, Type};
use crate::source::Span;
use crate::syntax::ast::{Arg, Expr, ExprKind, FileIndex, Function, ItemKind, Name, Object};

/// A mistake, if evaluation has not come to the part that begins at `region`.
pub struct Doubt {
    pub region: u32,
    pub error: Error,
}

impl<'a> Lint<'a, '_> {
    /// Keeps what may be a mistake. Outside of regions, evaluation will find it.
    fn doubt(&mut self, error: impl FnOnce(&Self) -> Error) {
        if let Some(&region) = self.regions.last() {
            let error = error(self);
            self.doubts.push(Doubt { region, error });
        }
    }

    /// A name where a value of this type is expected, or of which nothing is known.
    pub(super) fn check_name(&mut self, name: &str, used: Span, ty: Option<Type>) {
        let is_known = self.find(name).is_some()
            || builtin::find(name).is_some()
            || color::named(name).is_some()
            || ty.is_some_and(|ty| is_word_of(ty, name));
        if is_known {
            return;
        }
        let near = |this: &Self| {
            let colors = schema::COLORS.iter().map(|(name, _)| *name);
            let mut visible: Vec<&str> = this.scopes.iter().flat_map(|names| names.keys().copied()).collect();
            visible.sort_unstable();
            for known in builtin::names().chain(colors) {
                visible.push(known);
            }
            did_you_mean(name, visible)
        };
        let owned = name.to_owned();
        self.doubt(|this| match (ty, schema::block(name)) {
            (Some(ty), _) if let Some(words) = ty.words() => unknown_word(name, words, used),
            (_, Some(block)) => {
                let help = Some(format!("`{name}` needs its braces, as in `{}`", block.example));
                Error::UnknownName { name: owned, used, help }
            }
            (Some(Type::Material), None) => Error::UnknownMaterial { name: owned, used, help: near(this) },
            _ => Error::UnknownName { name: owned, used, help: near(this) },
        });
    }

    /// `mat.gold`, where `mat` is an import.
    pub(super) fn check_member(&mut self, base: &Expr, field: &Name) {
        let Some(file) = self.module(base) else { return };
        let names = self.names_of(file);
        if !names.contains(&field.value.as_str()) {
            let owner = match &base.kind {
                ExprKind::Name(name) => format!("`{name}`"),
                _ => "this import".to_owned(),
            };
            let (name, used, help) = (field.value.clone(), field.span, did_you_mean(field, names));
            self.doubt(|_| Error::UnknownMember { owner, name, used, help });
        }
    }

    /// The file that an expression names, where it names one.
    fn module(&self, expr: &Expr) -> Option<FileIndex> {
        let alias = match &expr.kind {
            ExprKind::Name(name) => match self.find(name)?.what {
                What::Module(file) => return Some(file),
                _ => return None,
            },
            ExprKind::Access { base, field } => (self.module(base)?, field),
            _ => return None,
        };
        let (file, name) = alias;
        self.program.files[file.0 as usize].items.iter().find_map(|item| match &item.kind {
            ItemKind::Import { alias, file, .. } if alias.value == name.value => *file,
            _ => None,
        })
    }

    /// What a file defines, with what it includes.
    fn names_of(&self, file: FileIndex) -> Vec<&'a str> {
        let mut names = Vec::new();
        for item in &self.program.files[file.0 as usize].items {
            match &item.kind {
                ItemKind::Let { name, .. } | ItemKind::Param { name, .. } => names.push(name.as_str()),
                ItemKind::Fn(function) => names.push(function.name.as_str()),
                ItemKind::Import { alias, .. } => names.push(alias.as_str()),
                ItemKind::Place(place) => names.extend(place.name.as_ref().map(|name| name.as_str())),
                ItemKind::Include { file: Some(included), .. } => names.extend(self.names_of(*included)),
                _ => {}
            }
        }
        names
    }

    /// The kind of a block, where it is known.
    pub(super) fn block_of(&mut self, object: &Object) -> Option<&'static schema::Block> {
        if object.kind.value == "camera" {
            return schema::block("camera"); // its second word is a name
        }
        let (kind, head) = super::build::kind_of(object);
        let block = schema::block(&kind);
        if block.is_none() {
            self.doubt(|this| {
                let is_defined = this.find(&object.kind).is_some();
                block_error(&kind, head, is_defined).unwrap_or_else(|| {
                    let names = this.scopes.iter().flat_map(|names| names.keys().copied());
                    let known = kinds_for(&object.body).chain(names.map(|name| (name, false)));
                    let help = did_you_mean_one_of(&nearest_of_kind(&kind, known));
                    Error::UnknownBlock { kind: kind.clone(), used: head, help }
                })
            });
        }
        block
    }

    /// The type of a block's field.
    pub(super) fn type_of(&mut self, block: &'static schema::Block, name: &Name) -> Option<Type> {
        let field = block.field(name);
        if field.is_none() {
            let (kind, field, used) = (block.kind.to_owned(), name.value.clone(), name.span);
            let help = unknown_field_help(block, name);
            self.doubt(|_| Error::UnknownField { block: kind, field, used, help });
        }
        field.map(|field| field.ty)
    }

    /// The unit of a number.
    pub(super) fn check_unit(&mut self, unit: &Name) {
        if schema::unit(unit).is_none() {
            self.doubt(|_| unknown_unit(unit, None));
        }
    }

    /// The function of the scene that is called, where the text shows it.
    pub(super) fn function_called(&self, callee: &Expr) -> Option<&'a Function> {
        let ExprKind::Name(name) = &callee.kind else { return None };
        match self.find(name)?.what {
            What::Function(function) => Some(function),
            _ => None,
        }
    }

    /// The name of an argument.
    pub(super) fn check_arg(&mut self, function: Option<&'a Function>, arg: &Arg) {
        let (Some(function), Some(name)) = (function, &arg.name) else { return };
        if !function.formals.iter().any(|formal| formal.name.value == name.value) {
            self.doubt(|_| super::call::unknown_argument(function, name));
        }
    }
}
