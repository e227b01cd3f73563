//! The tree as text, for tests and for those who wonder how a line was read.
//!
//! Every operator stands in parentheses with its operands, every field and item on a line of its own.

use super::ast::{Arg, Block, Entry, Expr, ExprKind, File, Item, ItemKind, Place, Program, UnaryOp};
use std::fmt::{self, Display, Formatter};

/// Shows a whole program, file by file.
pub fn dump(program: &Program) -> String {
    program.files.iter().enumerate().map(|(index, file)| format!("file {index}\n{}", Tree(file, 1))).collect()
}

/// A part of the tree and how deep it lies.
struct Tree<'a, T>(&'a T, usize);

/// Begins a line.
fn indent(f: &mut Formatter<'_>, depth: usize) -> fmt::Result {
    write!(f, "{:1$}", "", 2 * depth)
}

impl Display for Tree<'_, File> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.0.items.iter().try_for_each(|item| write!(f, "{}", Tree(item, self.1)))
    }
}

impl Display for Tree<'_, Item> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self(item, depth) = *self;
        for line in item.doc.iter().flat_map(|doc| doc.lines()) {
            indent(f, depth)?;
            writeln!(f, "/// {line}")?;
        }
        for allow in &item.allows {
            indent(f, depth)?;
            writeln!(f, "allow {} because {:?}", allow.code.value, allow.reason.value)?;
        }
        indent(f, depth)?;
        writeln!(f, "{}", Tree(&item.kind, depth))
    }
}

impl Display for Tree<'_, ItemKind> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self(kind, depth) = *self;
        match kind {
            ItemKind::Include { path, file } => write!(f, "include {:?} = {file:?}", path.value),
            ItemKind::Import { path, alias, file } => {
                write!(f, "import {:?} as {} = {file:?}", path.value, alias.value)
            }
            ItemKind::Units(block) => write!(f, "units {}", Tree(block, depth)),
            ItemKind::Param { name, ty, value, range } => {
                write!(f, "param {}: {} = {}", name.value, ty.value, Tree(value, depth))?;
                range.iter().try_for_each(|range| write!(f, " in {}", Tree(range, depth)))
            }
            ItemKind::Let { name, value } => write!(f, "let {} = {}", name.value, Tree(value, depth)),
            ItemKind::Fn(function) => {
                write!(f, "fn {}(", function.name.value)?;
                for formal in &function.formals {
                    write!(f, "{}: {}", formal.name.value, formal.ty.value)?;
                    formal.default.iter().try_for_each(|value| write!(f, " = {}", Tree(value, depth)))?;
                    write!(f, ", ")?;
                }
                write!(f, ") -> {} {}", function.result.value, Tree(&function.body, depth))
            }
            ItemKind::For { name, range, body } => {
                write!(f, "for {} in {} {}", name.value, Tree(range, depth), Tree(body, depth))
            }
            ItemKind::If { condition, then, otherwise } => {
                choice(f, condition, then, otherwise.as_ref(), depth)
            }
            ItemKind::Place(place) => write!(f, "{}", Tree(place, depth)),
            ItemKind::Object(object) => head(f, object, depth),
            ItemKind::Value(value) => write!(f, "value {}", Tree(value, depth)),
            ItemKind::Poison => write!(f, "poison"),
        }
    }
}

impl Display for Tree<'_, Place> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self(place, depth) = *self;
        write!(f, "place {}", Tree(&place.target, depth))?;
        place.at.iter().try_for_each(|at| write!(f, " at {}", Tree(at, depth)))?;
        place.name.iter().try_for_each(|name| write!(f, " as {}", name.value))?;
        place.body.iter().try_for_each(|body| write!(f, " {}", Tree(body, depth)))
    }
}

fn choice(
    f: &mut Formatter<'_>,
    condition: &Expr,
    then: &Block,
    otherwise: Option<&Block>,
    depth: usize,
) -> fmt::Result {
    write!(f, "if {} {}", Tree(condition, depth), Tree(then, depth))?;
    otherwise.iter().try_for_each(|block| write!(f, " else {}", Tree(*block, depth)))
}

fn head(f: &mut Formatter<'_>, object: &super::ast::Object, depth: usize) -> fmt::Result {
    write!(f, "{}", object.kind.value)?;
    object.second.iter().try_for_each(|second| write!(f, " {}", second.value))?;
    write!(f, " {}", Tree(&object.body, depth))
}

impl Display for Tree<'_, Block> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self(block, depth) = *self;
        writeln!(f, "{}{{", if block.poisoned { "poisoned " } else { "" })?;
        for entry in &block.entries {
            match entry {
                Entry::Field(field) => {
                    indent(f, depth + 1)?;
                    writeln!(f, "{}: {}", field.name.value, Tree(&field.value, depth + 1))?;
                }
                Entry::Item(item) => write!(f, "{}", Tree(item, depth + 1))?,
            }
        }
        indent(f, depth)?;
        write!(f, "}}")
    }
}

impl Display for Tree<'_, Expr> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self(expr, depth) = *self;
        match &expr.kind {
            ExprKind::Number { value, unit, integer } => {
                write!(f, "{value}{}", if *integer || value.fract() != 0.0 { "" } else { ".0" })?;
                unit.iter().try_for_each(|unit| write!(f, "{}", unit.value))
            }
            ExprKind::FNumber(value) => write!(f, "f/{value}"),
            ExprKind::Size(w, h) => write!(f, "({} x {})", Tree(&**w, depth), Tree(&**h, depth)),
            ExprKind::Color([r, g, b]) => write!(f, "#{r:02x}{g:02x}{b:02x}"),
            ExprKind::Text(text) => write!(f, "{text:?}"),
            ExprKind::Bool(value) => write!(f, "{value}"),
            ExprKind::Name(name) => write!(f, "{name}"),
            ExprKind::Access { base, field } => write!(f, "{}.{}", Tree(&**base, depth), field.value),
            ExprKind::Call { callee, args } => write!(f, "{}{}", Tree(&**callee, depth), Tree(args, depth)),
            ExprKind::Index { base, index } => {
                write!(f, "{}[{}]", Tree(&**base, depth), Tree(&**index, depth))
            }
            ExprKind::Tagged { tag, value } => write!(f, "{} {}", tag.value, Tree(&**value, depth)),
            ExprKind::On(target) => write!(f, "on {}", Tree(&**target, depth)),
            ExprKind::Data(numbers) => write!(f, "data {numbers:?}"),
            ExprKind::List(values) => separated(f, "[", values, "]", depth),
            ExprKind::Tuple(values) => separated(f, "(", values, ")", depth),
            ExprKind::Comprehension { value, name, range, filter } => {
                write!(f, "[{} for {} in {}", Tree(&**value, depth), name.value, Tree(&**range, depth))?;
                filter.iter().try_for_each(|filter| write!(f, " if {}", Tree(&**filter, depth)))?;
                write!(f, "]")
            }
            ExprKind::Unary { op, operand } => {
                let sign = match op.value {
                    UnaryOp::Minus => "-",
                    UnaryOp::Plus => "+",
                    UnaryOp::Not => "not ",
                };
                write!(f, "({sign}{})", Tree(&**operand, depth))
            }
            ExprKind::Binary { op, left, right } => {
                write!(f, "({} {:?} {})", Tree(&**left, depth), op.value, Tree(&**right, depth))
            }
            ExprKind::If { condition, then, otherwise } => {
                choice(f, condition, then, otherwise.as_ref(), depth)
            }
            ExprKind::Object(object) => head(f, object, depth),
            ExprKind::Block(block) => write!(f, "{}", Tree(block, depth)),
            ExprKind::Poison => write!(f, "poison"),
        }
    }
}

impl Display for Tree<'_, Vec<Arg>> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "(")?;
        for (index, arg) in self.0.iter().enumerate() {
            write!(f, "{}", if index == 0 { "" } else { ", " })?;
            arg.name.iter().try_for_each(|name| write!(f, "{}: ", name.value))?;
            write!(f, "{}", Tree(&arg.value, self.1))?;
        }
        write!(f, ")")
    }
}

fn separated(f: &mut Formatter<'_>, open: &str, values: &[Expr], close: &str, depth: usize) -> fmt::Result {
    write!(f, "{open}")?;
    for (index, value) in values.iter().enumerate() {
        write!(f, "{}{}", if index == 0 { "" } else { ", " }, Tree(value, depth))?;
    }
    write!(f, "{close}")
}
