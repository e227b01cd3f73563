//! Objects.

use crate::ir::shape::Method;
use crate::ir::{Curve, Shape, ShapeKind};
use crate::math::DVec3;
use crate::resolve::fields::Fields;
use crate::resolve::node::{Node, NodeKind, steps_of};
use crate::resolve::{Env, Resolver, Value};
use crate::source::{Span, Spanned};
use crate::syntax::ast::Block;
use std::cell::Cell;
use std::rc::Rc;

impl<'a> Resolver<'a> {
    /// The object of a block.
    pub(super) fn shape(
        &mut self,
        fields: &Fields<'a>,
        body: &'a Block,
        span: Span,
        env: &Env<'a>,
    ) -> Option<Rc<Node>> {
        let transform = steps_of(fields.value("transform").map(|slot| &slot.value));
        let material = match fields.value("material").map(|slot| &slot.value) {
            Some(Value::Material(handle)) => Some(*handle),
            _ => None,
        };
        let kind = if fields.block.kind == "group" {
            NodeKind::Group(self.members(body, env))
        } else {
            let kind = self.shape_kind(fields)?;
            NodeKind::Shape(Box::new(Shape { kind, span, material }), Cell::new(None))
        };
        self.node(kind, transform, material, span)
    }

    fn shape_kind(&mut self, fields: &Fields<'a>) -> Option<ShapeKind> {
        let point = |name| fields.triple(name).map(|point| point.value);
        Some(match fields.block.kind {
            "sphere" => ShapeKind::Sphere { center: point("center")?, radius: fields.number("radius")? },
            "plane" => self.plane(fields)?,
            "disk" => ShapeKind::Disk {
                center: point("center")?,
                normal: fields.triple("normal")?,
                radius: fields.number("radius")?,
            },
            "quad" => ShapeKind::Quad {
                origin: point("origin")?,
                edge_u: fields.triple("edge_u")?,
                edge_v: fields.triple("edge_v")?,
            },
            "box" => self.box_shape(fields)?,
            "triangle" => ShapeKind::Triangle {
                corners: [fields.triple("a")?, fields.triple("b")?, fields.triple("c")?],
            },
            "mesh" => ShapeKind::Mesh {
                file: fields.text("file")?,
                scale: fields.number("scale")?,
                smooth: fields.flag("smooth"),
                skip_missing: fields.word("missing")?.value == "skip",
            },
            "revolve" => ShapeKind::Revolve { profile: curve(fields, "profile")?, method: method(fields) },
            _ => ShapeKind::Extrude {
                outline: curve(fields, "outline")?,
                holes: self.holes(fields),
                depth: fields.number("depth")?,
            },
        })
    }

    fn plane(&mut self, fields: &Fields<'a>) -> Option<ShapeKind> {
        let Some(name) = self.either(fields, &["y", "x", "z", "normal"]) else {
            self.needs_one(fields, &["y", "x", "z", "normal"]);
            return None;
        };
        let axis = match name {
            "x" => DVec3::X,
            "y" => DVec3::Y,
            "z" => DVec3::Z,
            _ => {
                let offset = fields.number("offset")?.value;
                return Some(ShapeKind::Plane { normal: fields.triple("normal")?, offset });
            }
        };
        self.conflict(fields, name, "offset");
        let offset = fields.number(name)?;
        Some(ShapeKind::Plane { normal: Spanned::new(axis, offset.span), offset: offset.value })
    }

    fn box_shape(&mut self, fields: &Fields<'a>) -> Option<ShapeKind> {
        let pair =
            if fields.has("center") || fields.has("size") { ["center", "size"] } else { ["min", "max"] };
        for other in ["min", "max"] {
            if pair[0] == "center" && fields.has(other) {
                self.either(fields, &["center", "size", other]);
                return None;
            }
        }
        for name in pair {
            if !fields.has(name) {
                self.needs_one(fields, &[name]);
            }
        }
        let (first, second) = (fields.triple(pair[0])?, fields.triple(pair[1])?);
        let (min, max) = match pair {
            ["center", _] => (first.value - second.value / 2.0, first.value + second.value / 2.0),
            _ => (first.value, second.value),
        };
        // A box given by its size is blamed on the size.
        let min_span = if pair[0] == "center" { second.span } else { first.span };
        Some(ShapeKind::Box { min: Spanned::new(min, min_span), max: Spanned::new(max, second.span) })
    }

    fn holes(&mut self, fields: &Fields<'a>) -> Vec<Curve> {
        let Some(Spanned { value: Value::List(parts), span }) = fields.value("holes") else {
            return Vec::new();
        };
        let mut holes = Vec::new();
        for part in parts.iter() {
            match self.coerce(part.clone(), crate::schema::Type::Outline, *span) {
                Value::Curve(curve) => holes.push((*curve).clone()),
                _ => continue,
            }
        }
        holes
    }
}

fn curve(fields: &Fields, name: &str) -> Option<Curve> {
    match &fields.value(name)?.value {
        Value::Curve(curve) => Some((**curve).clone()),
        _ => None,
    }
}

/// A tolerance asks for triangles even when the method is not said.
fn method(fields: &Fields) -> Method {
    let tolerance = fields.number("tolerance");
    let tessellated = fields.word("method").is_some_and(|word| word.value == "tessellated");
    if tessellated || (tolerance.is_some() && !fields.has("method")) {
        Method::Tessellated(tolerance)
    } else {
        Method::Exact
    }
}
