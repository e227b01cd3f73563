//! Shapes, each in its own frame.

use super::Handle;
use super::material::{Material, Texture};
use crate::math::{DAffine3, DMat3, DVec2, DVec3};
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

impl Shape {
    /// Whether triangles may stand for it within a tolerance.
    pub const fn has_tolerance(&self) -> bool {
        matches!(self.kind, ShapeKind::Revolve { .. } | ShapeKind::Sweep { .. } | ShapeKind::Extrude { .. })
    }
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
        /// Which part of it alone.
        part: Option<Spanned<String>>,
        /// A factor on its coordinates, which count as metres.
        scale: Spanned<f64>,
        /// Whether normals are interpolated; `None`: as the file says.
        smooth: Option<bool>,
        /// Whether a missing file is a warning only (`missing: skip`).
        skip_missing: bool,
    },
    /// A cylinder or cone, or what is left of one when its tip is cut off.
    Cone {
        /// The middle of its bottom.
        base: DVec3,
        /// From there to the middle of its top.
        axis: Spanned<DVec3>,
        /// The radius at the bottom.
        radius: Spanned<f64>,
        /// The radius at the top; `None`: the same, it is a cylinder.
        top_radius: Option<Spanned<f64>>,
        /// Whether both ends are closed.
        caps: bool,
    },
    /// A ring.
    Torus {
        /// Its centre.
        center: DVec3,
        /// What it goes around, not necessarily a unit vector.
        normal: Spanned<DVec3>,
        /// From its centre to the middle of its tube.
        radius: Spanned<f64>,
        /// The radius of the tube.
        tube: Spanned<f64>,
    },
    /// A tube along a curve.
    Sweep {
        /// Its middle.
        path: Path,
        /// The radius of the tube at the start.
        radius: Spanned<f64>,
        /// The radius at the end; `None`: the same.
        end_radius: Option<Spanned<f64>>,
        /// What closes its ends.
        caps: Caps,
        /// Whether its end is joined to its start.
        closed: bool,
        /// How far triangles may lie from it, in metres; `None`: a thousandth of its size.
        tolerance: Option<Spanned<f64>>,
    },
    /// Heights over a grid in the plane y = 0.
    Heightfield {
        /// The heights, as shares of `size.y`.
        heights: Heights,
        /// What it spans from the origin.
        size: Spanned<DVec3>,
        /// Whether normals are interpolated.
        smooth: bool,
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
        /// How far its sides may lie from a curved outline, in metres; `None`: a ten-thousandth of its size.
        tolerance: Option<Spanned<f64>>,
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

/// A curve in space.
#[derive(Clone, PartialEq, Debug)]
pub struct Path {
    /// How the points are joined.
    pub kind: CurveKind,
    /// The (control) points.
    pub points: Vec<DVec3>,
    /// Where it was written.
    pub span: Span,
}

/// What closes the ends of a tube.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[expect(missing_docs, reason = "each is its word")]
pub enum Caps {
    Flat,
    Round,
    None,
}

/// Where heights come from.
#[derive(Clone, PartialEq, Debug)]
pub enum Heights {
    /// The brightness of a picture, from 0 to 1; always an image texture.
    Image(Spanned<Handle<Texture>>),
    /// As numbers.
    Grid {
        /// How many in a row.
        width: usize,
        /// Row by row.
        values: Vec<f32>,
        /// Where they were written.
        span: Span,
    },
}

impl Heights {
    /// The lowest and the highest of them; those of a picture, which is not read yet, lie from 0 to 1.
    pub fn range(&self) -> (f64, f64) {
        match self {
            Self::Image(_) => (0.0, 1.0),
            Self::Grid { values, .. } => {
                let each = || values.iter().map(|&value| f64::from(value));
                (each().fold(f64::INFINITY, f64::min), each().fold(f64::NEG_INFINITY, f64::max))
            }
        }
    }
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

/// A profile turned about the y axis of a frame.
#[derive(Clone, PartialEq, Debug)]
pub struct Turned {
    /// Points (radius, height).
    pub profile: Curve,
    /// Object space from the frame of the profile.
    pub object_from_profile: DAffine3,
}

impl ShapeKind {
    /// The shape as a surface of revolution, for whoever asks what it encloses; within 3·10⁻⁴ of a torus, exact for the
    /// rest. `None` for what is none, or is one whose profile needs no making.
    pub fn turned(&self) -> Option<Turned> {
        match self {
            Self::Cone { base, axis, radius, top_radius, caps } => {
                let height = axis.value.length();
                let top = top_radius.unwrap_or(*radius).value;
                let side = [DVec2::new(radius.value, 0.0), DVec2::new(top, height)];
                let ends = if *caps {
                    vec![DVec2::ZERO, side[0], side[1], DVec2::new(0.0, height)]
                } else {
                    side.to_vec()
                };
                let profile = Curve { kind: CurveKind::Polyline, points: ends, span: axis.span };
                Some(Turned { profile, object_from_profile: upright(axis.value, *base) })
            }
            Self::Torus { center, normal, radius, tube } => {
                let profile = circle(radius.value, tube.value, radius.span);
                Some(Turned { profile, object_from_profile: upright(normal.value, *center) })
            }
            _ => None,
        }
    }
}

/// A circle about (`center`, 0), counter-clockwise, as four cubics that leave it by at most 2.8·10⁻⁴ of its radius.
fn circle(center: f64, radius: f64, span: Span) -> Curve {
    const K: f64 = 0.552_284_749_830_793_4; // 4/3·(√2 − 1)
    let quarter = |i: usize| {
        let turns = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y];
        let (a, b) = (turns[i % 4], turns[(i + 1) % 4]);
        [a, a + b * K, b + a * K]
    };
    let points = (0..4).flat_map(quarter).chain([DVec2::X]);
    let points = points.map(|p| DVec2::new(center, 0.0) + p * radius).collect();
    Curve { kind: CurveKind::Bezier, points, span }
}

/// A right-handed orthonormal frame at `origin` whose y axis lies along `up`, which is not zero.
pub fn upright(up: DVec3, origin: DVec3) -> DAffine3 {
    let y = up.normalize_or(DVec3::Y);
    let x = if y.y.abs() > 0.9 { DVec3::X - y * y.x } else { y.cross(DVec3::Y) };
    let x = x.normalize();
    DAffine3::from_mat3_translation(DMat3::from_cols(x, y, x.cross(y)), origin)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_upright_frame_is_right_handed_and_that_of_the_world_for_up() {
        for up in [DVec3::Y, DVec3::NEG_Y, DVec3::X, DVec3::Z, DVec3::new(1.0, 2.0, 3.0)] {
            let m = upright(up * 7.0, DVec3::ONE).matrix3;
            assert!((m.determinant() - 1.0).abs() < 1e-12 && m.y_axis.distance(up.normalize()) < 1e-12);
        }
        assert_eq!(upright(DVec3::Y, DVec3::ZERO), DAffine3::IDENTITY);
    }
}
