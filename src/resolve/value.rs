//! What an expression can turn out to be.

use super::builtin::Builtin;
use super::dimension::{Dimension, Quantity};
use super::fields::Fields;
use super::mixed::BareUnit;
use super::node::Node;
use super::scope::Scope;
use crate::ir::{self, Handle, TransformStep};
use crate::math::{DVec3, Rgb};
use crate::syntax::ast;
use std::rc::Rc;

/// A value. Numbers are in SI units, colours linear.
#[derive(Clone)]
pub enum Value<'a> {
    /// A mistake that was reported; whatever is made of it stays silent.
    Poison,
    Number(Quantity),
    Bool(bool),
    Text(Rc<str>),
    /// A word that a field's type knows.
    Word(&'static str),
    Color(Rgb),
    /// `#f4fff6 per 10cm`: what is left after this many metres.
    Absorption(Rgb, f64),
    Size(u32, u32),
    /// From, to, and whether the end belongs to it.
    Range(Quantity, Quantity, bool),
    Tuple(Rc<[Self]>),
    List(Rc<[Self]>),
    Transform(Rc<[TransformStep]>),
    Curve(Rc<ir::Curve>),
    /// A curve in space.
    Path(Rc<ir::Path>),
    Material(Handle<ir::Material>),
    Texture(Handle<ir::Texture>),
    Object(Rc<Node>),
    Lens(Rc<ir::Lens>),
    Focus(Rc<ir::Focus>),
    Filter(ir::Filter),
    Stop(ir::Stop),
    Projection(ir::Projection),
    /// A block without a head, read by the fields of its kind.
    Block(Rc<Fields<'a>>),
    Function(Function<'a>),
    Builtin(&'static Builtin),
    /// What `import` names.
    Module(Rc<Scope<'a>>),
}

/// A function that the scene defines, with the scope that its body sees.
#[derive(Clone)]
pub struct Function<'a> {
    pub definition: &'a ast::Function,
    pub scope: Rc<Scope<'a>>,
    /// What a bare length of its file is.
    pub unit: BareUnit,
}

impl Value<'_> {
    /// A plain number.
    pub const fn number(value: f64) -> Self {
        Self::Number(Quantity::plain(value))
    }

    /// Whether it is a number without a unit.
    pub fn is_plain(&self) -> bool {
        matches!(self, Self::Number(quantity) if quantity.dimension == Dimension::NONE)
    }

    pub const fn is_poison(&self) -> bool {
        matches!(self, Self::Poison)
    }

    /// What it is, with an article: "a length", "a list".
    pub fn noun(&self) -> String {
        let noun = match self {
            Self::Number(quantity) => return quantity.dimension.noun(),
            Self::Tuple(parts) if (2..=3).contains(&parts.len()) => return tuple_noun(parts),
            Self::Poison => "a mistake",
            Self::Bool(_) => "a truth value",
            Self::Text(_) => "a text",
            Self::Word(_) => "a word",
            Self::Color(_) => "a colour",
            Self::Absorption(..) => "a colour per length",
            Self::Size(..) => "a size in pixels",
            Self::Range(..) => "a range",
            Self::Tuple(_) => "a tuple",
            Self::List(_) => "a list",
            Self::Transform(_) => "a transform",
            Self::Curve(_) => "a curve",
            Self::Path(_) => "a curve in space",
            Self::Material(_) => "a material",
            Self::Texture(_) => "a texture",
            Self::Object(_) => "an object",
            Self::Lens(_) => "a lens",
            Self::Focus(_) => "a focus",
            Self::Filter(_) => "a pixel filter",
            Self::Stop(_) => "a rule to stop by",
            Self::Projection(_) => "a projection",
            Self::Block(_) => "a block",
            Self::Function(_) | Self::Builtin(_) => "a function",
            Self::Module(_) => "an import",
        };
        noun.to_owned()
    }

    /// The components of a tuple of numbers, whatever their dimension; missing ones are 0.
    pub fn triple(&self) -> Option<DVec3> {
        let Self::Tuple(parts) = self else { return None };
        let mut xyz = [0.0; 3];
        for (slot, part) in xyz.iter_mut().zip(parts.iter()) {
            let Self::Number(quantity) = part else { return None };
            *slot = quantity.value;
        }
        Some(DVec3::from_array(xyz))
    }

    /// A tuple of three numbers of one dimension.
    pub fn from_triple(v: DVec3, dimension: Dimension) -> Self {
        Self::Tuple(v.to_array().map(|x| Self::Number(Quantity::new(x, dimension))).into())
    }
}

/// "a tuple of 3 lengths", "a tuple of 2 values".
fn tuple_noun(parts: &[Value]) -> String {
    let dimension = |part: &Value| match part {
        Value::Number(quantity) => Some(quantity.dimension),
        _ => None,
    };
    let same = parts.iter().all(|part| dimension(part) == dimension(&parts[0]));
    let what = match dimension(&parts[0]) {
        Some(Dimension::NONE) if same => "plain numbers",
        Some(Dimension::LENGTH) if same => "lengths",
        Some(Dimension::ANGLE) if same => "angles",
        _ => "values",
    };
    format!("a tuple of {} {what}", parts.len())
}
