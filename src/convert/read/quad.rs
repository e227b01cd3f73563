//! Parallelograms, of shapes and of lights: by corners, by edges, by a middle and half edges, by a normal and a size.

use super::Reader;
use crate::convert::fields::{Field, Fields};
use crate::convert::parse::Span;
use crate::math::DVec3;

/// A corner and the two edges that leave it.
#[derive(Clone, Copy, Debug)]
pub struct Parallelogram {
    pub origin: DVec3,
    pub edge_u: DVec3,
    pub edge_v: DVec3,
}

impl Parallelogram {
    fn around(middle: DVec3, half_u: DVec3, half_v: DVec3) -> Self {
        Self { origin: middle - half_u - half_v, edge_u: 2.0 * half_u, edge_v: 2.0 * half_v }
    }
}

/// Keys that say where it is.
const PLACES: &[&str] = &["position", "center", "origin", "corner"];

impl Reader<'_> {
    /// The parallelogram that the fields describe, in one of the ways that programs have.
    pub(super) fn parallelogram(&mut self, fields: &mut Fields<'_>) -> Option<Parallelogram> {
        let has_all = |roles: &[&str]| roles.iter().all(|role| fields.has(role));
        let has_place = PLACES.iter().any(|role| fields.has(role));
        let quad = if has_all(&["p1", "p2", "p3"]) {
            self.by_corners(fields)
        } else if has_all(&["min", "max"]) {
            self.by_extent(fields, ["min", "max"])
        } else if has_all(&["a", "b"]) && !has_place {
            self.by_extent(fields, ["a", "b"])
        } else if has_all(&["a", "b"]) {
            self.by_vectors(fields, ["a", "b"], false)
        } else if has_all(&["half edge u", "half edge v"]) {
            self.by_vectors(fields, ["half edge u", "half edge v"], true)
        } else if has_all(&["edge u", "edge v"]) {
            self.by_vectors(fields, ["edge u", "edge v"], false)
        } else if has_all(&["axis u", "axis v"]) {
            self.by_axes(fields)
        } else if fields.has("points") {
            self.by_ranges_of_points(fields)
        } else if ["range x", "range y", "range z"].iter().any(|role| fields.has(role)) {
            self.by_ranges(fields)
        } else {
            self.by_normal(fields)
        }?;
        let head = fields.head.clone();
        self.check_edges(quad, &head)
    }

    fn check_edges(&mut self, quad: Parallelogram, at: &Span) -> Option<Parallelogram> {
        if !is_flat(quad.edge_u, quad.edge_v) {
            return Some(quad);
        }
        self.log.bad_value(
            "the edges of this rectangle are parallel",
            at,
            "write two directions that differ",
        );
        None
    }

    fn place_of<'t>(&mut self, fields: &mut Fields<'t>, to: &str) -> Option<Field<'t>> {
        let found = PLACES.iter().find(|role| fields.has(role)).copied();
        let field = self.log.need(fields, found.unwrap_or("position"))?;
        self.log.mapped(&field.span, to);
        Some(field)
    }

    fn by_corners(&mut self, fields: &mut Fields<'_>) -> Option<Parallelogram> {
        let [a, b, c] = ["p1", "p2", "p3"].map(|role| self.log.vector(fields, role, "a corner"));
        let d = self.log.vector(fields, "p4", "a corner");
        let (origin, neighbour, third) = (a?, b?, c?);
        // Four corners stand in a ring, or row by row; the one opposite the first is not its neighbour.
        let other = match d {
            Some(fourth)
                if (neighbour + third - origin).distance(fourth)
                    < (neighbour + fourth - origin).distance(third) =>
            {
                third
            }
            Some(fourth) => fourth,
            None => third,
        };
        Some(Parallelogram { origin, edge_u: neighbour - origin, edge_v: other - origin })
    }

    /// Two opposite corners that agree in one coordinate.
    fn by_extent(&mut self, fields: &mut Fields<'_>, roles: [&str; 2]) -> Option<Parallelogram> {
        let [a, b] = roles.map(|role| self.log.vector(fields, role, "a corner"));
        let (a, b) = (a?, b?);
        let diagonal = b - a;
        let flat = (0..3).find(|&axis| diagonal[axis] == 0.0)?;
        let [u, v] = [(flat + 1) % 3, (flat + 2) % 3].map(|axis| DVec3::AXES[axis] * diagonal[axis]);
        Some(Parallelogram { origin: a, edge_u: u, edge_v: v })
    }

    /// A point and two vectors: edges from a corner, or half edges from the middle. Lengths, where they
    /// stand beside them, are those of the edges.
    fn by_vectors(
        &mut self,
        fields: &mut Fields<'_>,
        roles: [&'static str; 2],
        is_middle: bool,
    ) -> Option<Parallelogram> {
        let to = if is_middle { "the middle of it" } else { "`origin`" };
        let place = self.place_of(fields, to);
        let to = if is_middle { "half an edge" } else { "an edge" };
        let [u, v] = roles.map(|role| self.log.vector(fields, role, to));
        let [length_u, length_v] =
            ["length u", "length v"].map(|role| self.log.number(fields, role, "the length of an edge"));
        let point = place?.vector();
        let scaled = |way: DVec3, length: Option<f64>| match length {
            Some(length) if is_middle => way.normalize_or_zero() * (0.5 * length),
            Some(length) => way.normalize_or_zero() * length,
            None => way,
        };
        let (u, v) = (scaled(u?, length_u), scaled(v?, length_v));
        Some(match is_middle {
            true => Parallelogram::around(point, u, v),
            false => Parallelogram { origin: point, edge_u: u, edge_v: v },
        })
    }

    /// `origin V U V V V LU F LV F`: the middle, two directions, and how far it reaches along each.
    fn by_axes(&mut self, fields: &mut Fields<'_>) -> Option<Parallelogram> {
        let middle = self.place_of(fields, "the middle of it");
        let [u, v] = ["axis u", "axis v"].map(|role| self.log.vector(fields, role, "the way of an edge"));
        let [lu, lv] =
            ["half length u", "half length v"].map(|role| self.log.number(fields, role, "half an edge"));
        let along = |way: DVec3, length: Option<f64>| match length {
            Some(length) => way.normalize_or_zero() * length,
            None => way,
        };
        Some(Parallelogram::around(middle?.vector(), along(u?, lu), along(v?, lv)))
    }

    /// A middle, a normal and a size; without a second direction the edges lie along the axes as far as they can.
    fn by_normal(&mut self, fields: &mut Fields<'_>) -> Option<Parallelogram> {
        let middle = self.place_of(fields, "the middle of it");
        let normal_role =
            ["normal", "direction", "up"].into_iter().find(|role| fields.has(role)).unwrap_or("normal");
        let normal = self.log.need(fields, normal_role)?;
        self.log.mapped(&normal.span, "the way it faces");
        let across_role = ["half edge u", "axis u", "up"].into_iter().find(|role| fields.has(role));
        let across = across_role.and_then(|role| self.log.vector(fields, role, "the way of an edge"));
        let (width, height) = self.sides(fields)?;
        let n = self.three(&normal)?.normalize_or_zero();
        let across = across.unwrap_or(if n.x.abs() < 0.9 { DVec3::X } else { DVec3::Z });
        let u = (across - n * across.dot(n)).normalize_or_zero();
        let v = n.cross(u);
        Some(Parallelogram::around(middle?.vector(), u * (0.5 * width), v * (0.5 * height)))
    }

    /// Width and height by `size`, `area`, or lengths.
    fn sides(&mut self, fields: &mut Fields<'_>) -> Option<(f64, f64)> {
        if let Some(size) = self.log.take(fields, "size") {
            self.log.mapped(&size.span, "the lengths of its edges");
            return Some((size.number(0), size.numbers.last().map_or(0.0, |last| last.value)));
        }
        if let Some(area) = self.log.take(fields, "area") {
            self.log.approximated(&area.span, "a square of this area");
            let side = area.number(0).max(0.0).sqrt();
            return Some((side, side));
        }
        let lengths =
            ["length u", "length v"].map(|role| self.log.number(fields, role, "the length of an edge"));
        match lengths {
            [Some(u), Some(v)] => Some((u, v)),
            [Some(side), None] | [None, Some(side)] => Some((side, side)),
            [None, None] => {
                self.log.need(fields, "size");
                None
            }
        }
    }

    /// `XZRectangle { points x0 x1 z0 z1 offset y }`; the block's name says which coordinate is fixed.
    fn by_ranges_of_points(&mut self, fields: &mut Fields<'_>) -> Option<Parallelogram> {
        let name = fields.block.to_ascii_uppercase();
        let fixed = match name.as_bytes() {
            [b'X', b'Y', ..] => 2,
            [b'X', b'Z', ..] => 1,
            [b'Y', b'Z', ..] => 0,
            _ => return None,
        };
        let points = self.log.take(fields, "points")?;
        self.log.mapped(&points.span, "its extent");
        let offset = self.log.need_number(fields, "offset", "where it is")?;
        let facing = self.log.take(fields, "normal");
        if let Some(field) = &facing {
            self.log.mapped(&field.span, "the way it faces");
        }
        let axes = match fixed {
            2 => [0, 1],
            1 => [0, 2],
            _ => [1, 2],
        };
        let range = |i: usize| (points.number(2 * i), points.number(2 * i + 1));
        let quad = between(fixed, offset, [(axes[0], range(0)), (axes[1], range(1))]);
        let sign = facing.map_or(1.0, |field| field.number(0));
        Some(facing_along(quad, DVec3::AXES[fixed] * sign))
    }

    /// `normal Z- position 14 X -3 3 Y -3 3`, an axis by its name.
    fn by_ranges(&mut self, fields: &mut Fields<'_>) -> Option<Parallelogram> {
        let normal = self.log.need(fields, "normal")?;
        let (fixed, sign) = axis_of(normal.text())?;
        self.log.mapped(&normal.span, "the way it faces");
        let position = self.log.need_number(fields, "position", "where it is")?;
        let [u, v] = [(fixed + 1) % 3, (fixed + 2) % 3].map(|axis| {
            let field = self.log.need(fields, ["range x", "range y", "range z"][axis])?;
            self.log.mapped(&field.span, "its extent");
            Some((axis, (field.number(0), field.number(1))))
        });
        Some(facing_along(between(fixed, position, [u?, v?]), DVec3::AXES[fixed] * sign))
    }
}

/// Whether two edges span nothing: the sine of their angle is rounding error.
pub(super) fn is_flat(u: DVec3, v: DVec3) -> bool {
    u.cross(v).length() <= 1e-11 * u.length() * v.length()
}

/// The rectangle at `offset` on one axis, between two numbers on each of the others.
fn between(fixed: usize, offset: f64, [u, v]: [(usize, (f64, f64)); 2]) -> Parallelogram {
    let edge = |(axis, (low, high)): (usize, (f64, f64))| DVec3::AXES[axis] * (high - low);
    let corner = |(axis, (low, _)): (usize, (f64, f64))| DVec3::AXES[axis] * low;
    Parallelogram {
        origin: DVec3::AXES[fixed] * offset + corner(u) + corner(v),
        edge_u: edge(u),
        edge_v: edge(v),
    }
}

/// The same with its edges in the order that makes it face along `way`.
fn facing_along(quad: Parallelogram, way: DVec3) -> Parallelogram {
    match quad.edge_u.cross(quad.edge_v).dot(way) < 0.0 {
        true => Parallelogram { edge_u: quad.edge_v, edge_v: quad.edge_u, ..quad },
        false => quad,
    }
}

/// The axis, and the sign, that a word such as `Z-` names.
pub(super) fn axis_of(word: &str) -> Option<(usize, f64)> {
    let axis = ["X", "Y", "Z"].iter().position(|name| word.starts_with(name))?;
    match &word[1..] {
        "" | "+" => Some((axis, 1.0)),
        "-" => Some((axis, -1.0)),
        _ => None,
    }
}
