//! Which names are visible where. Definitions are found before any is evaluated, so their order does not matter.

use super::mixed::BareUnit;
use super::value::Value;
use crate::source::Span;
use crate::syntax::ast::{Block, Entry, Expr, FileIndex, Function, Item, ItemKind, Name, Place, Program};
use rustc_hash::FxHashMap;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// The definitions of a file with what it includes, of a block, of one turn of a loop, of a call.
pub struct Scope<'a> {
    parent: Option<Rc<Self>>,
    definitions: RefCell<FxHashMap<&'a str, Rc<Definition<'a>>>>,
}

/// A name with what defines it.
pub struct Definition<'a> {
    pub name: &'a str,
    /// Where the name stands.
    pub span: Span,
    pub kind: Kind<'a>,
    /// What a bare length of its file is.
    pub unit: BareUnit,
    pub state: RefCell<State<'a>>,
    /// The id that objects placed under this name carry.
    pub name_id: Cell<Option<u32>>,
}

/// What defines a name.
#[derive(Clone, Copy)]
pub enum Kind<'a> {
    Let(&'a Expr),
    Param {
        ty: &'a Name,
        value: &'a Expr,
        range: Option<&'a Expr>,
        doc: Option<&'a str>,
    },
    Function(&'a Function),
    Import(Option<FileIndex>),
    /// `place .. as NAME`.
    Instance(&'a Place, Span),
    /// A loop's name or a function's argument: known when it is defined.
    Given,
}

/// How far the evaluation of a definition has come.
pub enum State<'a> {
    Waiting,
    Running,
    Done(Value<'a>),
}

impl<'a> Scope<'a> {
    /// An empty scope; names that are not in it are looked for in `parent`.
    pub fn new(parent: Option<Rc<Self>>) -> Rc<Self> {
        Rc::new(Self { parent, definitions: RefCell::default() })
    }

    /// Whether it is the top level of a file.
    pub const fn is_root(&self) -> bool {
        self.parent.is_none()
    }

    /// The innermost definition of a name, and the scope that holds it.
    pub fn find(self: &Rc<Self>, name: &str) -> Option<(Rc<Self>, Rc<Definition<'a>>)> {
        let mut scope = self;
        loop {
            if let Some(found) = scope.own(name) {
                return Some((Rc::clone(scope), found));
            }
            scope = scope.parent.as_ref()?;
        }
    }

    /// The definition of a name in this very scope.
    pub fn own(&self, name: &str) -> Option<Rc<Definition<'a>>> {
        self.definitions.borrow().get(name).map(Rc::clone)
    }

    /// Every visible definition, in alphabetical order, inner before outer.
    pub fn visible(&self) -> Vec<Rc<Definition<'a>>> {
        let mut all: Vec<_> = self.definitions.borrow().values().map(Rc::clone).collect();
        all.sort_by_key(|definition| definition.name);
        all.extend(self.parent.iter().flat_map(|parent| parent.visible()));
        all
    }

    /// Its own definitions in source order.
    pub fn in_order(&self) -> Vec<Rc<Definition<'a>>> {
        let mut own: Vec<_> = self.definitions.borrow().values().map(Rc::clone).collect();
        own.sort_by_key(|definition| definition.span);
        own
    }

    /// Defines a name whose value is known.
    pub fn give(&self, name: &'a str, span: Span, value: Value<'a>) {
        self.insert(name, span, Kind::Given, BareUnit::METRE, State::Done(value));
    }

    /// Gives a name of this scope another value. `false`: it is not defined yet, or someone holds on to its definition.
    pub fn give_again(&self, name: &str, value: &Value<'a>) -> bool {
        match self.definitions.borrow().get(name) {
            Some(definition) if Rc::strong_count(definition) == 1 => {
                *definition.state.borrow_mut() = State::Done(value.clone());
                definition.name_id.set(None);
                true
            }
            _ => false,
        }
    }

    /// Defines what the items of a file define, and those of the files it includes.
    pub fn declare_file(&self, program: &'a Program, file: FileIndex, units: &[BareUnit]) {
        let unit = units[file.0 as usize];
        for item in &program.files[file.0 as usize].items {
            match &item.kind {
                ItemKind::Include { file: Some(included), .. } => {
                    self.declare_file(program, *included, units)
                }
                _ => self.declare_item(item, unit),
            }
        }
    }

    /// Defines what the items of a block define.
    pub fn declare_block(&self, block: &'a Block, unit: BareUnit) {
        for entry in &block.entries {
            if let Entry::Item(item) = entry {
                self.declare_item(item, unit);
            }
        }
    }

    fn declare_item(&self, item: &'a Item, unit: BareUnit) {
        let (name, kind) = match &item.kind {
            ItemKind::Let { name, value } => (name, Kind::Let(value)),
            ItemKind::Param { name, ty, value, range } => {
                (name, Kind::Param { ty, value, range: range.as_ref(), doc: item.doc.as_deref() })
            }
            ItemKind::Fn(function) => (&function.name, Kind::Function(function)),
            ItemKind::Import { alias, file, .. } => (alias, Kind::Import(*file)),
            ItemKind::Place(place) => match &place.name {
                Some(name) => (name, Kind::Instance(place, item.span)),
                None => return,
            },
            _ => return,
        };
        self.insert(&name.value, name.span, kind, unit, State::Waiting);
    }

    /// The first definition of a name stays; the second is reported elsewhere.
    fn insert(&self, name: &'a str, span: Span, kind: Kind<'a>, unit: BareUnit, state: State<'a>) {
        self.definitions.borrow_mut().entry(name).or_insert_with(|| {
            Rc::new(Definition {
                name,
                span,
                kind,
                unit,
                state: RefCell::new(state),
                name_id: Cell::new(None),
            })
        });
    }
}
