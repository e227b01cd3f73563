//! What was written: the tree of a scene text, names unresolved and units unapplied.
//!
//! A mistake leaves a poisoned node ([`ExprKind::Poison`], [`ItemKind::Poison`]) on which later phases stay silent.

use crate::source::{FileId, Span, Spanned};

/// All files of a scene: the main one first, then in the order in which `include` and `import` met them.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Program {
    /// Each file once, however often it is named.
    pub files: Vec<File>,
    /// Whether a file that was to be included cannot be read: what it defines is then not known.
    pub lacks_files: bool,
}

/// Index of a [`File`] in its [`Program`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct FileIndex(pub u32);

/// One file.
#[derive(Clone, PartialEq, Debug)]
pub struct File {
    /// The text it came from.
    pub source: FileId,
    /// Its items, in order.
    pub items: Vec<Item>,
}

/// Something that may stand at the top level, in a `group`, a `for` or an `if`.
#[derive(Clone, PartialEq, Debug)]
pub struct Item {
    /// What it is.
    pub kind: ItemKind,
    /// All of it.
    pub span: Span,
    /// The `///` lines above it, joined.
    pub doc: Option<String>,
    /// The warnings that `allow(CODE, "why")` before it silences.
    pub allows: Vec<Allow>,
}

/// `allow(snell::resolve::unused, "used by the next scene")`.
#[derive(Clone, PartialEq, Debug)]
pub struct Allow {
    /// The code of the warning, whole or from its last `::` on.
    pub code: Spanned<String>,
    /// The reason.
    pub reason: Spanned<String>,
}

/// A word with its place.
pub type Name = Spanned<String>;

/// The kinds of items.
#[derive(Clone, PartialEq, Debug)]
pub enum ItemKind {
    /// `include "room.snell"`: its items stand here. `None`: it could not be read, which is reported.
    Include {
        /// The path as written.
        path: Spanned<String>,
        /// The file, `None` also for every inclusion after the first.
        file: Option<FileIndex>,
    },
    /// `import "materials.snell" as mat`.
    Import {
        /// The path as written.
        path: Spanned<String>,
        /// The namespace.
        alias: Name,
        /// The file, `None` when it could not be read.
        file: Option<FileIndex>,
    },
    /// `units { length: cm }`.
    Units(Block),
    /// `param seats: int = 12 in 1..=500`.
    Param {
        /// The name.
        name: Name,
        /// The type.
        ty: Name,
        /// The default.
        value: Expr,
        /// The allowed range.
        range: Option<Expr>,
    },
    /// `let goblet = revolve { .. }`.
    Let {
        /// The name.
        name: Name,
        /// The value.
        value: Expr,
    },
    /// `fn ring(n: int, radius: length = 1m) -> object { .. }`.
    Fn(Function),
    /// `for i in 0..n { .. }`.
    For {
        /// The loop's name.
        name: Name,
        /// What it runs over.
        range: Expr,
        /// What is repeated.
        body: Block,
    },
    /// `if night { .. } else { .. }`; an `else if` is an `if` alone in the `else` block.
    If {
        /// The condition.
        condition: Expr,
        /// Taken when it holds.
        then: Block,
        /// Taken otherwise.
        otherwise: Option<Block>,
    },
    /// `place goblet as hero { .. }`, `place sphere { .. } at (0m, 1m, 0m)`.
    Place(Place),
    /// `sphere { .. }`, `light sphere { .. }`, `camera front { .. }`, `render { .. }`, `units`-like blocks too.
    Object(Object),
    /// A value that stands where an item may: the result of a `fn` body, as in `ring(12)` or `group { .. }`.
    Value(Expr),
    /// Something that could not be read, and was reported.
    Poison,
}

/// A function's definition.
#[derive(Clone, PartialEq, Debug)]
pub struct Function {
    /// The name.
    pub name: Name,
    /// The parameters.
    pub formals: Vec<Formal>,
    /// The type of the result.
    pub result: Name,
    /// Definitions, then the value.
    pub body: Block,
}

/// A function's parameter.
#[derive(Clone, PartialEq, Debug)]
pub struct Formal {
    /// The name.
    pub name: Name,
    /// The type.
    pub ty: Name,
    /// The value when the argument is left out.
    pub default: Option<Expr>,
}

/// A placed object.
#[derive(Clone, PartialEq, Debug)]
pub struct Place {
    /// What is placed. In `place goblet { .. }` it is an object, since only who knows the kinds of blocks can tell.
    pub target: Expr,
    /// `at (x, y, z)`.
    pub at: Option<Expr>,
    /// `as hero`.
    pub name: Option<Name>,
    /// Its own transform and material.
    pub body: Option<Block>,
}

/// A block with its head: `sphere { .. }` has one word, `light sphere { .. }` and `camera front { .. }` two.
#[derive(Clone, PartialEq, Debug)]
pub struct Object {
    /// The first word.
    pub kind: Name,
    /// The second word.
    pub second: Option<Name>,
    /// What stands between the braces.
    pub body: Block,
    /// All of it.
    pub span: Span,
}

/// What stands between braces.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Block {
    /// Fields and items, in the order written.
    pub entries: Vec<Entry>,
    /// From brace to brace.
    pub span: Span,
    /// Whether something in it could not be read: then a missing field is not worth a second report.
    pub poisoned: bool,
}

/// A part of a block.
#[derive(Clone, PartialEq, Debug)]
pub enum Entry {
    /// `radius: 4cm`.
    Field(Field),
    /// An item: an object of a group, a `let` of a function, a bare value as in `1m`.
    Item(Item),
}

/// `name: value`.
#[derive(Clone, PartialEq, Debug)]
pub struct Field {
    /// The name.
    pub name: Name,
    /// The value.
    pub value: Expr,
}

/// A value, or what computes one.
#[derive(Clone, PartialEq, Debug)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// All of it.
    pub span: Span,
}

/// The kinds of expressions.
#[derive(Clone, PartialEq, Debug)]
pub enum ExprKind {
    /// `5`, `2.5cm`, `1%`: the numeral's value and the unit as written.
    Number {
        /// The numeral's value; finite.
        value: f64,
        /// The unit glued to it.
        unit: Option<Name>,
        /// Whether it was written without a point and without an exponent.
        integer: bool,
    },
    /// `f/2.8`.
    FNumber(f64),
    /// `1024 x 768`, also `1024px x 768px`.
    Size(Box<Expr>, Box<Expr>),
    /// `#ff8800`: display values.
    Color([u8; 3]),
    /// `"wood.png"`, without its quotes.
    Text(String),
    /// `true` or `false`.
    Bool(bool),
    /// `goblet`.
    Name(String),
    /// `mat.gold`, `p.x`.
    Access {
        /// Before the dot.
        base: Box<Expr>,
        /// After the dot.
        field: Name,
    },
    /// `ring(12, radius: 1m)`, also `bezier(degree: all, [..])`.
    Call {
        /// What is called.
        callee: Box<Expr>,
        /// The arguments, in order.
        args: Vec<Arg>,
    },
    /// `xs[i]`.
    Index {
        /// The list.
        base: Box<Expr>,
        /// Which element.
        index: Box<Expr>,
    },
    /// `bezier [..]`, `polygon [..]`, `lens "a.dat"`: a word that says how to take what follows.
    Tagged {
        /// The word.
        tag: Name,
        /// What follows.
        value: Box<Expr>,
    },
    /// `on goblet`.
    On(Box<Expr>),
    /// `data [ 1 2 3 ]`: bulk numbers.
    Data(Vec<f64>),
    /// `[a, b]`.
    List(Vec<Expr>),
    /// `[i * 2cm for i in 0..4 if i > 1]`.
    Comprehension {
        /// The element.
        value: Box<Expr>,
        /// The loop's name.
        name: Name,
        /// What it runs over.
        range: Box<Expr>,
        /// Which are kept.
        filter: Option<Box<Expr>>,
    },
    /// `(a, b, c)`; one in parentheses is that one.
    Tuple(Vec<Expr>),
    /// `-x`, `+x`, `not x`.
    Unary {
        /// The operator.
        op: Spanned<UnaryOp>,
        /// What it applies to.
        operand: Box<Expr>,
    },
    /// `a + b`.
    Binary {
        /// The operator.
        op: Spanned<BinaryOp>,
        /// The left side.
        left: Box<Expr>,
        /// The right side.
        right: Box<Expr>,
    },
    /// `if a { .. } else { .. }` as a value.
    If {
        /// The condition.
        condition: Box<Expr>,
        /// Taken when it holds.
        then: Block,
        /// Taken otherwise.
        otherwise: Option<Block>,
    },
    /// `diffuse { .. }`, `sphere { .. }` as a value.
    Object(Box<Object>),
    /// `{ size: 1024 x 768 }`: a block without a head.
    Block(Block),
    /// Something that could not be read, and was reported.
    Poison,
}

/// An argument of a call.
#[derive(Clone, PartialEq, Debug)]
pub struct Arg {
    /// `radius:` before it.
    pub name: Option<Name>,
    /// The value.
    pub value: Expr,
}

/// Operators before their operand.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[expect(missing_docs, reason = "each is its sign")]
pub enum UnaryOp {
    Minus,
    Plus,
    Not,
}

/// Operators between their operands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[expect(missing_docs, reason = "each is its sign")]
pub enum BinaryOp {
    Then,
    Or,
    And,
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Range,
    RangeInclusive,
    Per,
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    Power,
}
