//! Curves in the plane: as cubic Bézier pieces, and as points.

use crate::ir::{Curve, CurveKind};
use crate::math::DVec2;

/// Control points of one cubic piece.
pub type Cubic = [DVec2; 4];

/// The curve as cubic pieces, in order. Exact but for one Bézier curve of a degree above 3, which is fitted to within
/// 10⁻⁶ of its size.
pub fn cubics(curve: &Curve) -> Vec<Cubic> {
    let points = &curve.points;
    match curve.kind {
        CurveKind::Polyline => points.windows(2).map(|p| line(p[0], p[1])).collect(),
        CurveKind::Bezier => points.windows(4).step_by(3).map(|p| [p[0], p[1], p[2], p[3]]).collect(),
        CurveKind::BezierOneCurve => fit(points),
        CurveKind::Bspline => points.windows(4).map(bspline_piece).collect(),
    }
}

/// A straight line as a cubic.
pub fn line(a: DVec2, b: DVec2) -> Cubic {
    [a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0), b]
}

/// The Bézier points of one span of a uniform cubic B-spline (Farin 2002, section 8.7).
fn bspline_piece(p: &[DVec2]) -> Cubic {
    [
        (p[0] + p[1] * 4.0 + p[2]) / 6.0,
        (p[1] * 2.0 + p[2]) / 3.0,
        (p[1] + p[2] * 2.0) / 3.0,
        (p[1] + p[2] * 4.0 + p[3]) / 6.0,
    ]
}

/// Cubic pieces that meet a Bézier curve of any degree in points and tangents.
fn fit(points: &[DVec2]) -> Vec<Cubic> {
    if let [a, b, c, d] = *points {
        return vec![[a, b, c, d]];
    }
    let size = points.iter().fold(0.0_f64, |size, p| size.max((*p - points[0]).length()));
    let mut count = 4;
    loop {
        let pieces: Vec<Cubic> = (0..count).map(|i| hermite(points, i, count)).collect();
        let error = |i: usize| {
            let (exact, _) = de_casteljau(points, (i as f64 + 0.5) / count as f64);
            (point(&pieces[i], 0.5) - exact).length()
        };
        // Each doubling divides the error by 16, so this ends long before the bound.
        if (0..count).all(|i| error(i) <= 1e-6 * size) || count >= 1024 {
            return pieces;
        }
        count *= 2;
    }
}

fn hermite(points: &[DVec2], i: usize, count: usize) -> Cubic {
    let step = 1.0 / count as f64;
    let (a, da) = de_casteljau(points, i as f64 * step);
    let (b, db) = de_casteljau(points, (i + 1) as f64 * step);
    [a, a + da * step / 3.0, b - db * step / 3.0, b]
}

/// The point at `t` of the Bézier curve over all `points`, and its derivative (de Casteljau).
fn de_casteljau(points: &[DVec2], t: f64) -> (DVec2, DVec2) {
    let degree = points.len() - 1;
    let mut row = points.to_vec();
    let mut derivative = DVec2::ZERO;
    while row.len() > 1 {
        if row.len() == 2 {
            derivative = (row[1] - row[0]) * degree as f64;
        }
        row = row.windows(2).map(|p| p[0].lerp(p[1], t)).collect();
    }
    (row[0], derivative)
}

/// The point at `t` of a cubic piece.
pub fn point(c: &Cubic, t: f64) -> DVec2 {
    let s = 1.0 - t;
    c[0] * (s * s * s) + c[1] * (3.0 * s * s * t) + c[2] * (3.0 * s * t * t) + c[3] * (t * t * t)
}

/// The direction of travel at `t`, a unit vector; where the derivative vanishes, that of the chord beside it.
pub fn tangent(c: &Cubic, t: f64) -> DVec2 {
    let s = 1.0 - t;
    let derivative = (c[1] - c[0]) * (s * s) + (c[2] - c[1]) * (2.0 * s * t) + (c[3] - c[2]) * (t * t);
    let chord = if t < 0.5 { point(c, t + 0.01) - point(c, t) } else { point(c, t) - point(c, t - 0.01) };
    derivative.try_normalize().or(chord.try_normalize()).unwrap_or(DVec2::X)
}

/// Parameters 0 = t₀ < … < tₙ = 1 at which chords stay within `tolerance` of the piece.
///
/// A cubic leaves its chord by at most √3/18 · h² · max|c″| over a parameter step h, and |c″| ≤ 6 · max second difference.
pub fn steps(c: &Cubic, tolerance: f64) -> Vec<f64> {
    let second = (c[0] - c[1] * 2.0 + c[2]).length().max((c[1] - c[2] * 2.0 + c[3]).length());
    let count = ((second * 6.0 / 8.0) / tolerance).sqrt().ceil().clamp(1.0, 256.0) as usize;
    (0..=count).map(|i| i as f64 / count as f64).collect()
}

/// A closed outline as points, counter-clockwise, without the repeated first one, with the direction of travel that
/// arrives at each point and the one that leaves it.
pub fn outline(curve: &Curve, tolerance: f64) -> Vec<OutlinePoint> {
    let mut pieces = match curve.kind {
        CurveKind::Bspline => cubics(&Curve { points: wrapped(&curve.points), ..curve.clone() }),
        _ => cubics(curve),
    };
    if let (Some(first), Some(last)) = (pieces.first().copied(), pieces.last().copied())
        && first[0] != last[3]
    {
        pieces.push(line(last[3], first[0]));
    }
    pieces.retain(|piece| piece.iter().any(|p| *p != piece[0]));
    if signed_area(&pieces) < 0.0 {
        pieces = pieces.iter().rev().map(|c| [c[3], c[2], c[1], c[0]]).collect();
    }
    let mut points = Vec::new();
    for (i, piece) in pieces.iter().enumerate() {
        let before = &pieces[(i + pieces.len() - 1) % pieces.len()];
        let steps = steps(piece, tolerance);
        for &t in &steps[..steps.len() - 1] {
            let leaving = tangent(piece, t);
            let arriving = if t == 0.0 { tangent(before, 1.0) } else { leaving };
            points.push(OutlinePoint { p: point(piece, t), arriving, leaving });
        }
    }
    points
}

/// A corner or a point of a smooth stretch.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OutlinePoint {
    /// Where.
    pub p: DVec2,
    /// The direction of travel before it.
    pub arriving: DVec2,
    /// The direction of travel after it.
    pub leaving: DVec2,
}

/// The control points of a closed B-spline: the first three again at the end.
fn wrapped(points: &[DVec2]) -> Vec<DVec2> {
    points.iter().chain(points.iter().take(3)).copied().collect()
}

/// The area that the pieces and the chord from the last point to the first enclose; positive when counter-clockwise.
///
/// Exact for cubics: the integral of (x dy − y dx)/2 in closed form over the control points.
pub fn signed_area(pieces: &[Cubic]) -> f64 {
    let piece_area = |c: &Cubic| {
        let x = |i: usize, j: usize| c[i].perp_dot(c[j]);
        (6.0 * x(0, 1) + 3.0 * x(0, 2) + x(0, 3) + 3.0 * x(1, 2) + 3.0 * x(1, 3) + 6.0 * x(2, 3)) / 20.0
    };
    let closing = match (pieces.first(), pieces.last()) {
        (Some(first), Some(last)) => last[3].perp_dot(first[0]) / 2.0,
        _ => 0.0,
    };
    pieces.iter().map(piece_area).sum::<f64>() + closing
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    fn curve(kind: CurveKind, points: &[(f64, f64)]) -> Curve {
        Curve { kind, points: points.iter().map(|&p| p.into()).collect(), span: Span::default() }
    }

    #[test]
    fn the_area_of_a_square_and_of_its_reverse() {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        assert!((signed_area(&cubics(&curve(CurveKind::Polyline, &square))) - 4.0).abs() < 1e-12);
        let reversed: Vec<_> = square.into_iter().rev().collect();
        assert!((signed_area(&cubics(&curve(CurveKind::Polyline, &reversed))) + 4.0).abs() < 1e-12);
    }

    #[test]
    fn pieces_fit_a_curve_of_high_degree() {
        let points = [(0.0, 0.0), (1.0, 3.0), (2.0, -3.0), (3.0, 3.0), (4.0, -2.0), (5.0, 1.0)];
        let points: Vec<DVec2> = points.into_iter().map(DVec2::from).collect();
        let pieces = fit(&points);
        for i in 0..=100 {
            let t = f64::from(i) / 100.0;
            let at = (t * pieces.len() as f64).min(pieces.len() as f64 - 1e-9);
            let (exact, _) = de_casteljau(&points, t);
            let fitted = point(&pieces[at as usize], at.fract());
            assert!((fitted - exact).length() < 1e-5, "at {t}: {fitted} instead of {exact}");
        }
    }

    #[test]
    fn a_closed_spline_is_smooth_and_counter_clockwise() {
        let points = [(1.0, 0.0), (0.0, -1.0), (-1.0, 0.0), (0.0, 1.0)];
        let outline = outline(&curve(CurveKind::Bspline, &points), 1e-4);
        assert!(outline.len() > 16);
        assert!(outline.iter().all(|o| o.arriving.dot(o.leaving) > 0.9999));
        let flat: Vec<DVec2> = outline.iter().map(|o| o.p).collect();
        let area: f64 = (0..flat.len()).map(|i| flat[i].perp_dot(flat[(i + 1) % flat.len()]) / 2.0).sum();
        assert!(area > 0.0);
    }

    #[test]
    fn chords_stay_within_the_tolerance() {
        let piece = [(0.0, 0.0), (0.0, 2.0), (3.0, 2.0), (3.0, 0.0)].map(DVec2::from);
        let steps = steps(&piece, 1e-3);
        for pair in steps.windows(2) {
            let (a, b) = (point(&piece, pair[0]), point(&piece, pair[1]));
            let middle = point(&piece, (pair[0] + pair[1]) / 2.0);
            let distance = (b - a).normalize().perp_dot(middle - a).abs();
            assert!(distance <= 1e-3, "{distance}");
        }
    }
}
