//! Objects.

use crate::ir::shape::Method;
use crate::ir::{Caps, Curve, Path, Shape, ShapeKind};
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
            // Not known, but surely not what a mesh's own file says.
            _ if fields.has("material") => Some(self.stand_in(span)),
            _ => None,
        };
        let kind = if fields.block.kind == "group" {
            NodeKind::Group(self.members(body, env))
        } else {
            let kind = self.shape_kind(fields)?;
            let calls = self.calls_here();
            NodeKind::Shape(Box::new(Shape { kind, span, material, calls }), Cell::new(None))
        };
        self.node(kind, transform, material, span)
    }

    fn shape_kind(&mut self, fields: &Fields<'a>) -> Option<ShapeKind> {
        let point = |name| fields.triple(name).map(|point| point.value);
        Some(match fields.block.kind {
            "sphere" => ShapeKind::Sphere { center: point("center")?, radius: fields.number("radius")? },
            "plane" => plane(fields)?,
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
            "box" => box_shape(fields)?,
            "triangle" => ShapeKind::Triangle {
                corners: [fields.triple("a")?, fields.triple("b")?, fields.triple("c")?],
            },
            "cylinder" | "cone" => ShapeKind::Cone {
                base: point("base")?,
                axis: axis(fields)?,
                radius: fields.number("radius")?,
                top_radius: fields.block.field("top_radius").and_then(|_| fields.number("top_radius")),
                caps: fields.flag("caps")?,
            },
            "sweep" => ShapeKind::Sweep {
                path: path(fields)?,
                radius: fields.number("radius")?,
                end_radius: fields.number("end_radius"),
                caps: match fields.word("caps")?.value {
                    "round" => Caps::Round,
                    "none" => Caps::None,
                    _ => Caps::Flat,
                },
                closed: fields.flag("closed")?,
                tolerance: fields.number("tolerance"),
            },
            "heightfield" => ShapeKind::Heightfield {
                heights: self.heights(fields)?,
                size: fields.triple("size")?,
                smooth: fields.flag("smooth")?,
            },
            "torus" => ShapeKind::Torus {
                center: point("center")?,
                normal: fields.triple("normal")?,
                radius: fields.number("radius")?,
                tube: fields.number("tube")?,
            },
            "mesh" => ShapeKind::Mesh {
                file: fields.text("file")?,
                part: fields.text("part"),
                scale: fields.number("scale")?,
                smooth: fields.flag("smooth"),
                skip_missing: fields.word("missing")?.value == "skip",
            },
            "revolve" => ShapeKind::Revolve { profile: curve(fields, "profile")?, method: method(fields) },
            _ => ShapeKind::Extrude {
                outline: curve(fields, "outline")?,
                holes: self.holes(fields),
                depth: fields.number("depth")?,
                tolerance: fields.number("tolerance"),
            },
        })
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

fn path(fields: &Fields) -> Option<Path> {
    match &fields.value("path")?.value {
        Value::Path(path) => Some((**path).clone()),
        _ => None,
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

/// From the bottom of a cylinder or cone to its top.
fn axis(fields: &Fields) -> Option<Spanned<DVec3>> {
    let base = fields.triple("base")?.value;
    let height = || fields.number("height").map(|height| height.map(|height| DVec3::Y * height));
    fields.triple("top").map(|top| top.map(|top| top - base)).or_else(height)
}

fn plane(fields: &Fields) -> Option<ShapeKind> {
    let axes = [("y", DVec3::Y), ("x", DVec3::X), ("z", DVec3::Z)];
    for (name, axis) in axes {
        if let Some(offset) = fields.number(name) {
            return Some(ShapeKind::Plane { normal: Spanned::new(axis, offset.span), offset: offset.value });
        }
    }
    let offset = fields.number("offset")?.value;
    Some(ShapeKind::Plane { normal: fields.triple("normal")?, offset })
}

fn box_shape(fields: &Fields) -> Option<ShapeKind> {
    if let (Some(center), Some(size)) = (fields.triple("center"), fields.triple("size")) {
        // A box given by its size is blamed on the size.
        let corner = |sign: f64| size.map(|size| center.value + size * (sign / 2.0));
        return Some(ShapeKind::Box { min: corner(-1.0), max: corner(1.0) });
    }
    Some(ShapeKind::Box { min: fields.triple("min")?, max: fields.triple("max")? })
}
