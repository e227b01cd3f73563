//! What a scene offers to whoever renders or imports it: parameters, functions, values, cameras.

use super::Resolver;
use crate::diag::Problems;
use crate::source::{SourceMap, Span, Spanned};
use crate::syntax::ast::{FileIndex, Item, ItemKind, Program};

/// A definition at the top level of a scene.
#[derive(Clone, PartialEq, Debug)]
pub struct Offer {
    /// Its name.
    pub name: Spanned<String>,
    /// What it defines.
    pub what: Offered,
    /// The `///` lines above it.
    pub doc: Option<String>,
}

/// What a definition defines.
#[derive(Clone, PartialEq, Debug)]
pub enum Offered {
    /// A parameter.
    Param {
        /// Its type.
        ty: String,
        /// Where its default stands.
        default: Span,
        /// Where its range stands.
        range: Option<Span>,
    },
    /// A function: the place of its name, arguments and result.
    Function(Span),
    /// A value: what it is, with an article.
    Value(String),
    /// An import: the path as written.
    Import(String),
    /// A camera with a name.
    Camera,
}

/// What the main file and the files it includes define, in the order written. Mistakes go to `problems`.
pub fn survey(program: &Program, sources: &SourceMap, problems: &mut Problems) -> Vec<Offer> {
    let mut offers = Vec::new();
    if !program.files.is_empty() {
        let mut resolver = Resolver::new(program, sources, problems);
        resolver.survey_file(FileIndex(0), &mut offers);
    }
    offers
}

impl<'a> Resolver<'a> {
    fn survey_file(&mut self, file: FileIndex, offers: &mut Vec<Offer>) {
        let program = self.program;
        for item in &program.files[file.0 as usize].items {
            match &item.kind {
                ItemKind::Include { file: Some(included), .. } => self.survey_file(*included, offers),
                _ => offers.extend(self.offer(item)),
            }
        }
    }

    fn offer(&mut self, item: &'a Item) -> Option<Offer> {
        let (name, what) = match &item.kind {
            ItemKind::Param { name, ty, value, range } => {
                let range = range.as_ref().map(|range| range.span);
                (name, Offered::Param { ty: ty.value.clone(), default: value.span, range })
            }
            ItemKind::Fn(function) => {
                let head = function.name.span.to(function.result.span);
                (&function.name, Offered::Function(head))
            }
            ItemKind::Let { name, .. } => (name, Offered::Value(self.noun_of(name))),
            ItemKind::Import { path, alias, .. } => (alias, Offered::Import(path.value.clone())),
            ItemKind::Object(object) if object.kind.value == "camera" => {
                (object.second.as_ref()?, Offered::Camera)
            }
            _ => return None,
        };
        Some(Offer { name: name.clone(), what, doc: item.doc.clone() })
    }

    /// What a name of the main file stands for.
    fn noun_of(&mut self, name: &str) -> String {
        let root = self.root(FileIndex(0));
        root.own(name).map_or_else(String::new, |definition| self.value_of(&root, &definition).noun())
    }
}
