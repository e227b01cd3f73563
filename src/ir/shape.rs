//! Shapes, each in its own frame.

use super::Handle;
use super::material::Material;
use crate::math::{DVec2, DVec3};
use crate::source::{Span, Spanned};

/// A shape.
#[derive(Clone, PartialEq, Debug)]
pub struct Shape {
    /// Which.
    pub kind: ShapeKind,
    /// Where it was written.
    pub span: Span,
    /// The material written in its own block.
    pub material: Option<Handle<Material>>,
    /// The calls of functions in which it was made, the innermost first: the function's name, where it is called.
    pub calls: Vec<Spanned<String>>,
}

/// The kinds of shapes. Lengths in metres.
#[derive(Clone, PartialEq, Debug)]
pub enum ShapeKind {
    /// A ball.
    Sphere {
        /// Its centre.
        center: DVec3,
        /// Its radius.
        radius: Spanned<f64>,
    },
    /// All points p with `normal · p = offset`.
    Plane {
        /// A unit vector.
        normal: Spanned<DVec3>,
        /// Distance from the origin along the normal.
        offset: f64,
    },
    /// A flat round plate.
    Disk {
        /// Its centre.
        center: DVec3,
        /// Its normal, not necessarily a unit vector.
        normal: Spanned<DVec3>,
        /// Its radius.
        radius: Spanned<f64>,
    },
    /// A parallelogram with the normal `edge_u × edge_v`.
    Quad {
        /// A corner.
        origin: DVec3,
        /// One edge.
        edge_u: Spanned<DVec3>,
        /// The other.
        edge_v: Spanned<DVec3>,
    },
    /// A box along the axes.
    Box {
        /// The lowest corner.
        min: Spanned<DVec3>,
        /// The highest corner.
        max: Spanned<DVec3>,
    },
    /// One triangle, counter-clockwise seen from its front.
    Triangle {
        /// The corners.
        corners: [Spanned<DVec3>; 3],
    },
    /// Triangles from a file.
    Mesh {
        /// The file as written, with the place of the string.
        file: Spanned<String>,
        /// A factor on its coordinates, which count as metres.
        scale: Spanned<f64>,
        /// Whether normals are interpolated; `None`: as the file says.
        smooth: Option<bool>,
        /// Whether a missing file is a warning only (`missing: skip`).
        skip_missing: bool,
    },
    /// A profile turned about the y axis.
    Revolve {
        /// Points (radius, height).
        profile: Curve,
        /// How it is intersected.
        method: Method,
    },
    /// An outline in the xy plane, drawn out along z.
    Extrude {
        /// The outer edge.
        outline: Outline,
        /// What is cut out.
        holes: Vec<Outline>,
        /// From z = 0 to this.
        depth: Spanned<f64>,
    },
}

/// A closed curve in the xy plane; the last point joins the first.
pub type Outline = Curve;

/// A curve in the plane.
#[derive(Clone, PartialEq, Debug)]
pub struct Curve {
    /// How the points are joined.
    pub kind: CurveKind,
    /// The (control) points.
    pub points: Vec<DVec2>,
    /// Where it was written.
    pub span: Span,
}

/// How points become a curve.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum CurveKind {
    /// Straight lines.
    Polyline,
    /// Cubic Bézier pieces: 3n + 1 points.
    Bezier,
    /// One Bézier curve of the degree that the points give.
    BezierOneCurve,
    /// A uniform cubic B-spline.
    Bspline,
}

/// How a surface of revolution is intersected.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Method {
    /// By its equation, in double precision.
    Exact,
    /// As triangles that stay within this distance of it, in metres; `None`: a thousandth of its size.
    Tessellated(Option<Spanned<f64>>),
}
