//! Profiles and outlines.

use super::Check;
use super::error::CheckError;
use crate::ir::{Curve, CurveKind};
use crate::math::DVec2;
use crate::schema::Type;
use crate::source::Span;

/// Pieces into which a cubic is cut to look at it.
const PIECES: usize = 16;
/// Outlines with more pieces than this are not searched for crossings, which takes the square of their number.
pub(super) const MOST_PIECES: usize = 3_000;

impl Check<'_> {
    /// A profile is turned about the axis: it stays on one side of it.
    pub(super) fn profile(&mut self, curve: &Curve) {
        if !self.points(curve, 2) {
            return;
        }
        let points = flatten(curve, false);
        let size = points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let least = points.iter().map(|p| p.x).fold(f64::INFINITY, f64::min);
        // A B-spline that ends on the axis may miss it by rounding.
        if least < -1e-9 * size {
            let found = Type::Length.write((least * 1e6).round() / 1e6);
            return self.report(CheckError::NegativeRadius { found, used: curve.span });
        }
        let is_on_axis = points.iter().all(|p| p.x <= 1e-9 * size);
        let is_point = points.iter().all(|p| *p == points[0]);
        if is_on_axis || is_point {
            let what = match is_on_axis {
                true => "this profile lies on the axis, and turning it makes no surface".to_owned(),
                false => "all points of this profile are one".to_owned(),
            };
            let help = "points are (radius, height): move them away from the axis, and apart";
            self.report(CheckError::Degenerate { what, used: curve.span, help });
        }
    }

    /// An outline is closed, encloses something, and does not cross itself.
    pub(super) fn outline(&mut self, curve: &Curve) {
        if !self.points(curve, 3) {
            return;
        }
        let points = flatten(curve, true);
        let size = points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        if area(&points).abs() <= 1e-12 * size * size {
            let what = "this outline encloses no area".to_owned();
            return self.report(CheckError::Degenerate {
                what,
                used: curve.span,
                help: "move its points apart",
            });
        }
        if let Some(index) = crossing(&points) {
            let near = index * curve.points.len() / points.len() + 1;
            self.report(CheckError::CrossingOutline { used: curve.span, near });
        }
    }

    /// A hole lies inside of its outline.
    pub(super) fn hole(&mut self, outline: &Curve, hole: &Curve) {
        let (around, points) = (flatten(outline, true), flatten(hole, true));
        if around.len() < 3 || points.len() < 3 || around.len() * points.len() > MOST_PIECES * MOST_PIECES {
            return;
        }
        let size = around.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        // A corner that lies on the outline is neither inside nor outside.
        let is_decided = |p: &&DVec2| distance_to(&around, **p) > 1e-9 * size;
        let inside: Vec<bool> = points.iter().filter(is_decided).map(|p| holds(&around, *p)).collect();
        let how = match (inside.contains(&true), inside.contains(&false)) {
            (true, true) => "crosses",
            (false, true) => "lies outside of",
            _ => return,
        };
        self.report(CheckError::HoleOutside { how, hole: hole.span, outline: outline.span });
    }

    /// Whether there are as many points as the kind of curve needs.
    fn points(&mut self, curve: &Curve, least_of_lines: usize) -> bool {
        self.enough_points(curve.kind, curve.points.len(), least_of_lines, curve.span)
    }

    /// Whether `n` points are as many as the kind of curve needs.
    pub(super) fn enough_points(
        &mut self,
        kind: CurveKind,
        n: usize,
        least_of_lines: usize,
        used: Span,
    ) -> bool {
        let (good, wanted) = match kind {
            CurveKind::Bezier => (n >= 4 && n % 3 == 1, "a chain of cubic Bezier curves takes 3k + 1 points"),
            CurveKind::BezierOneCurve => {
                (n >= least_of_lines, "a Bezier curve takes at least 2 points, or 3 if closed")
            }
            CurveKind::Bspline => (n >= 4, "a cubic B-spline takes at least 4 points"),
            CurveKind::Polyline if least_of_lines == 2 => (n >= 2, "a polyline takes at least 2 points"),
            CurveKind::Polyline => (n >= 3, "an outline takes at least 3 points"),
        };
        if !good {
            let found = if n == 1 { "is 1".to_owned() } else { format!("are {n}") };
            let help = match kind {
                CurveKind::Bezier if n > 4 => format!(
                    "add {}, or take {} away; `bezier(degree: all, [..])` makes one curve of any number",
                    (4 - n % 3) % 3,
                    (n + 2) % 3
                ),
                CurveKind::Bezier => "a start point, then three more for each curve".to_owned(),
                _ => "add points".to_owned(),
            };
            self.report(CheckError::CurvePoints { wanted, found, used, help });
        }
        good
    }
}

/// Points along a curve.
pub(super) fn flatten(curve: &Curve, closed: bool) -> Vec<DVec2> {
    let p = &curve.points;
    match curve.kind {
        CurveKind::Polyline => p.clone(),
        CurveKind::BezierOneCurve => {
            (0..=PIECES * p.len()).map(|i| casteljau(p, i, PIECES * p.len())).collect()
        }
        CurveKind::Bezier => {
            let cubics = (0..p.len() / 3).flat_map(|k| (0..PIECES).map(move |i| (k, i)));
            let inner = cubics.map(|(k, i)| casteljau(&p[3 * k..3 * k + 4], i, PIECES));
            inner.chain(p.last().copied()).collect()
        }
        CurveKind::Bspline => {
            let spans = if closed { p.len() } else { p.len() - 3 };
            let at = |k: usize, i: usize| {
                let control = |j: usize| p[(k + j) % p.len()];
                bspline([control(0), control(1), control(2), control(3)], i as f64 / PIECES as f64)
            };
            let pieces = (0..spans).flat_map(|k| (0..PIECES).map(move |i| (k, i)));
            let last = (!closed).then(|| at(spans - 1, PIECES));
            pieces.map(|(k, i)| at(k, i)).chain(last).collect()
        }
    }
}

/// No point of a curve is farther than this from the line through its [`flatten`]ed points.
///
/// A curve leaves the chord over a parameter step h by at most h²/8 · max|c″|; c″ is at most n (n − 1) times the largest
/// second difference of the control points for a Bézier curve of degree n, and that difference itself for a B-spline.
pub(super) fn chord_error(curve: &Curve) -> f64 {
    let bends = curve.points.windows(3).map(|p| (p[0] - p[1] * 2.0 + p[2]).length());
    let bend = bends.fold(0.0, f64::max);
    let step = 1.0 / PIECES as f64;
    match curve.kind {
        CurveKind::Polyline => 0.0,
        CurveKind::Bezier => step * step / 8.0 * 6.0 * bend,
        CurveKind::BezierOneCurve | CurveKind::Bspline => step * step / 8.0 * bend,
    }
}

/// The point at i/n of a Bézier curve, by repeated halfway points (de Casteljau).
fn casteljau(control: &[DVec2], i: usize, n: usize) -> DVec2 {
    let t = i as f64 / n as f64;
    let mut points = control.to_vec();
    for last in (1..points.len()).rev() {
        for j in 0..last {
            points[j] = points[j].lerp(points[j + 1], t);
        }
    }
    points[0]
}

/// The point of a uniform cubic B-spline span.
fn bspline([a, b, c, d]: [DVec2; 4], t: f64) -> DVec2 {
    let (t2, t3) = (t * t, t * t * t);
    let weights =
        [1.0 - 3.0 * t + 3.0 * t2 - t3, 4.0 - 6.0 * t2 + 3.0 * t3, 1.0 + 3.0 * t + 3.0 * t2 - 3.0 * t3, t3];
    (a * weights[0] + b * weights[1] + c * weights[2] + d * weights[3]) / 6.0
}

/// Whether a point lies inside a closed polygon: whether a ray from it crosses an odd number of edges.
fn holds(polygon: &[DVec2], p: DVec2) -> bool {
    let next = polygon.iter().cycle().skip(1);
    let crosses = |&(a, b): &(&DVec2, &DVec2)| {
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)
    };
    polygon.iter().zip(next).filter(crosses).count() % 2 == 1
}

/// The distance of a point from the edges of a closed polygon.
fn distance_to(polygon: &[DVec2], p: DVec2) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    let to_edge = |(a, b): (&DVec2, &DVec2)| {
        let along = *b - *a;
        let length = along.length_squared();
        let t = if length > 0.0 { ((p - *a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
        (*a + along * t).distance(p)
    };
    polygon.iter().zip(next).map(to_edge).fold(f64::INFINITY, f64::min)
}

/// The signed area of a polygon (the shoelace formula).
fn area(points: &[DVec2]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() / 2.0
}

/// The first edge of a closed polygon that properly crosses a later one.
pub(super) fn crossing(points: &[DVec2]) -> Option<usize> {
    let n = points.len();
    if n > MOST_PIECES {
        return None;
    }
    let edge = |i: usize| (points[i], points[(i + 1) % n]);
    (0..n).find(|&i| {
        let (a, b) = edge(i);
        (i + 2..n).any(|j| {
            let (c, d) = edge(j);
            let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
            side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    fn curve(kind: CurveKind, points: &[[f64; 2]]) -> Curve {
        Curve { kind, points: points.iter().map(|&p| DVec2::from_array(p)).collect(), span: Span::default() }
    }

    #[test]
    fn a_bow_crosses_itself_and_a_square_does_not() {
        let bow = curve(CurveKind::Polyline, &[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
        let square = curve(CurveKind::Polyline, &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(crossing(&flatten(&bow, true)), Some(0));
        assert_eq!(crossing(&flatten(&square, true)), None);
        assert_eq!(area(&square.points), 1.0);
    }

    #[test]
    fn a_point_is_inside_or_at_a_distance() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(DVec2::from_array);
        assert!(holds(&square, DVec2::new(1.0, 0.5)) && !holds(&square, DVec2::new(3.0, 0.5)));
        assert_eq!(distance_to(&square, DVec2::new(1.0, 0.5)), 0.5);
        assert_eq!(distance_to(&square, DVec2::new(5.0, 6.0)), 5.0);
    }

    #[test]
    fn curves_go_through_the_points_they_must() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [3.0, 2.0]];
        let bezier = flatten(&curve(CurveKind::Bezier, &points), false);
        assert_eq!((bezier[0], bezier[PIECES]), (DVec2::new(0.0, 0.0), DVec2::new(3.0, 2.0)));
        assert_eq!(flatten(&curve(CurveKind::BezierOneCurve, &points), false).len(), 4 * PIECES + 1);
        // A B-spline of equal points is that point.
        let still = flatten(&curve(CurveKind::Bspline, &[[2.0, 3.0]; 5]), true);
        assert!(still.iter().all(|p| p.distance(DVec2::new(2.0, 3.0)) < 1e-15));
    }
}
