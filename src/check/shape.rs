//! Shapes: sizes greater than 0, edges that span something.

use super::Check;
use super::error::CheckError;
use crate::ir::{Heights, Path, RevolveMethod, Shape, ShapeKind};
use crate::math::DVec3;
use crate::schema::Type;
use crate::source::{Span, Spanned};

/// Farther out, single precision has no room for squares.
const FARTHEST: f64 = 1e15;

impl Check<'_> {
    /// Checks every shape that is placed.
    pub(super) fn shapes(&mut self) {
        for shape in self.scene.shapes.iter() {
            self.calls = &shape.calls;
            self.shape(shape);
        }
        self.calls = &[];
    }

    fn shape(&mut self, shape: &Shape) {
        match &shape.kind {
            ShapeKind::Sphere { center, radius } => {
                self.positive("the radius of this sphere", *radius, Type::Length);
                self.near("the centre of this sphere", Spanned::new(*center, shape.span));
                self.near("the radius of this sphere", radius.map(DVec3::splat));
            }
            ShapeKind::Plane { normal, .. } => self.direction("the normal of this plane", *normal),
            ShapeKind::Disk { center, normal, radius } => {
                self.positive("the radius of this disk", *radius, Type::Length);
                self.direction("the normal of this disk", *normal);
                self.near("the centre of this disk", Spanned::new(*center, shape.span));
            }
            ShapeKind::Quad { origin, edge_u, edge_v } => {
                let what = "the edges of this quad span no area";
                self.spanned(what, edge_u.value, edge_v.value, edge_u.span.to(edge_v.span));
                self.near("a corner of this quad", Spanned::new(*origin, shape.span));
                self.near("an edge of this quad", *edge_u);
                self.near("an edge of this quad", *edge_v);
            }
            ShapeKind::Box { min, max } => self.box_shape(*min, *max),
            ShapeKind::Triangle { corners: [a, b, c] } => {
                let what = "the corners of this triangle lie on a line";
                self.spanned(what, b.value - a.value, c.value - a.value, a.span.to(c.span));
                for corner in [a, b, c] {
                    self.near("a corner of this triangle", *corner);
                }
            }
            ShapeKind::Cone { base, axis, radius, top_radius, .. } => {
                self.cone(*base, *axis, *radius, *top_radius, shape.span);
            }
            ShapeKind::Torus { center, normal, radius, tube } => {
                self.positive("the radius of this torus", *radius, Type::Length);
                self.positive("the radius of its tube", *tube, Type::Length);
                self.direction("the normal of this torus", *normal);
                self.near("the centre of this torus", Spanned::new(*center, shape.span));
                self.near("the radius of this torus", radius.map(DVec3::splat));
                if tube.value >= radius.value && radius.value > 0.0 {
                    let (found, what) = (Type::Length.write(tube.value), "the radius of its tube");
                    let range = format!("less than its `radius`, {}", Type::Length.write(radius.value));
                    let example = Type::Length.write(radius.value / 4.0);
                    self.report(CheckError::OutOfRange { what, found, range, example, used: tube.span });
                }
            }
            ShapeKind::Sweep { path, radius, end_radius, tolerance, .. } => {
                self.positive("the radius of this tube", *radius, Type::Length);
                self.near("the radius of this tube", radius.map(DVec3::splat));
                if let Some(tolerance) = tolerance {
                    self.positive("the tolerance of this sweep", *tolerance, Type::Length);
                }
                if let Some(end) = end_radius.filter(|end| end.value < 0.0) {
                    let (found, range) = (Type::Length.write(end.value), "at least 0m".to_owned());
                    let (what, example) = ("the radius of its end", "end_radius: 0m".to_owned());
                    self.report(CheckError::OutOfRange { what, found, range, example, used: end.span });
                }
                self.path(path);
            }
            ShapeKind::Heightfield { heights, size, .. } => self.heightfield(heights, *size),
            ShapeKind::Mesh { scale, .. } => self.positive("the scale of this mesh", *scale, Type::Number),
            ShapeKind::Revolve { profile, method } => {
                self.profile(profile);
                if let RevolveMethod::Tessellated(Some(tolerance)) = method {
                    self.positive("the tolerance of this revolve", *tolerance, Type::Length);
                }
            }
            ShapeKind::Extrude { outline, holes, depth, tolerance } => {
                if let Some(tolerance) = tolerance {
                    self.positive("the tolerance of this extrude", *tolerance, Type::Length);
                }
                self.positive("the depth of this extrude", *depth, Type::Length);
                self.outline(outline);
                for hole in holes {
                    self.outline(hole);
                    self.hole(outline, hole);
                }
            }
        }
    }

    /// A path goes somewhere.
    fn path(&mut self, path: &Path) {
        if !self.enough_points(path.kind, path.points.len(), 2, path.span) {
            return;
        }
        if path.points.iter().all(|p| *p == path.points[0]) {
            let what = "all points of this path are one".to_owned();
            let help = "move them apart; for a ball use a `sphere`";
            self.report(CheckError::Degenerate { what, used: path.span, help });
        }
        let farthest = path.points.iter().fold(DVec3::ZERO, |most, p| most.max(p.abs()));
        self.near("a point of this path", Spanned::new(farthest, path.span));
    }

    fn heightfield(&mut self, heights: &Heights, size: Spanned<DVec3>) {
        for (axis, what) in [(size.value.x, "its width"), (size.value.z, "its depth")] {
            self.positive(what, Spanned::new(axis, size.span), Type::Length);
        }
        self.near("the size of this heightfield", size);
        if let Heights::Grid { values, span, .. } = heights
            && let Some(bad) = values.iter().find(|value| !value.is_finite())
        {
            let (what, found) = ("a height", bad.to_string());
            let (range, example) = ("finite".to_owned(), "0.5".to_owned());
            self.report(CheckError::OutOfRange { what, found, range, example, used: *span });
        }
    }

    fn cone(
        &mut self,
        base: DVec3,
        axis: Spanned<DVec3>,
        radius: Spanned<f64>,
        top_radius: Option<Spanned<f64>>,
        written: Span,
    ) {
        match top_radius {
            None => self.positive("the radius of this cylinder", radius, Type::Length),
            Some(top) => {
                self.positive("the radius of this cone", radius, Type::Length);
                if top.value < 0.0 {
                    let (found, range) = (Type::Length.write(top.value), "at least 0m".to_owned());
                    let (what, example) = ("the radius of its top", "top_radius: 0m".to_owned());
                    self.report(CheckError::OutOfRange { what, found, range, example, used: top.span });
                }
            }
        }
        if axis.value == DVec3::ZERO {
            let what =
                format!("this {} has no height", if top_radius.is_some() { "cone" } else { "cylinder" });
            let help = "move `top` away from `base`; for something flat use a `disk`";
            self.report(CheckError::Degenerate { what, used: axis.span, help });
        }
        self.near("the bottom of this shape", Spanned::new(base, written));
        self.near("the top of this shape", axis.map(|axis| base + axis));
        self.near("the radius of this shape", radius.map(DVec3::splat));
    }

    fn box_shape(&mut self, min: Spanned<DVec3>, max: Spanned<DVec3>) {
        let size = max.value - min.value;
        let axes = |wanted: fn(f64) -> bool| -> Vec<&str> {
            ["x", "y", "z"]
                .into_iter()
                .zip(size.to_array())
                .filter(|&(_, d)| wanted(d))
                .map(|(name, _)| name)
                .collect()
        };
        let (inverted, flat) = (axes(|d| d < 0.0), axes(|d| d == 0.0));
        if !inverted.is_empty() {
            let axes = inverted.join(" and ");
            self.report(CheckError::InsideOutBox { axes, min: min.span, max: max.span });
        } else if !flat.is_empty() {
            let what = format!("this box has no extent along {}", flat.join(" and "));
            self.report(CheckError::Degenerate {
                what,
                used: max.span,
                help: "for something flat use a `quad`",
            });
        }
        self.near("a corner of this box", min);
        self.near("a corner of this box", max);
    }

    /// Notes a direction of length 0.
    pub(super) fn direction(&mut self, what: &'static str, direction: Spanned<DVec3>) {
        if direction.value == DVec3::ZERO {
            let what = format!("{what} points nowhere");
            let help = "write a direction such as `(0, 1, 0)`";
            self.report(CheckError::Degenerate { what, used: direction.span, help });
        }
    }

    /// Notes two edges that are parallel, or of length 0.
    pub(super) fn spanned(&mut self, what: &'static str, u: DVec3, v: DVec3, used: Span) {
        /// A sine below this is rounding error.
        const PARALLEL: f64 = 1e-12;
        if u.cross(v).length() <= PARALLEL * u.length() * v.length() {
            let help = "move the corners apart";
            self.report(CheckError::Degenerate { what: what.to_owned(), used, help });
        }
    }

    /// Notes what lies farther out than single precision reaches.
    pub(super) fn near(&mut self, what: &'static str, point: Spanned<DVec3>) {
        let farthest = point.value.abs().max_element();
        if farthest > FARTHEST {
            let found = Type::Length.write(farthest);
            self.report(CheckError::TooLarge { what, found, used: point.span });
        }
    }
}
