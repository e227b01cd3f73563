//! Tubes along curves in space.

use super::tessellate::{Triangles, segments_around};
use crate::ir::CurveKind;
use crate::ir::shape::{Caps, Path};
use crate::math::{DVec3, Vec2};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A tube, as `ir` says it.
pub struct Tube<'a> {
    /// Its middle.
    pub path: &'a Path,
    /// The radius at the start and at the end.
    pub radii: [f64; 2],
    /// What closes its ends.
    pub caps: Caps,
    /// Whether its end is joined to its start.
    pub closed: bool,
}

/// A point of the middle, and the way there.
#[derive(Clone, Copy)]
struct Station {
    p: DVec3,
    /// A unit vector along the path.
    along: DVec3,
    /// The corner that it is at.
    mitre: Option<Mitre>,
}

/// How the inner side of a corner between straight pieces is cut, so that the tube does not run into itself: by the plane
/// that halves the corner.
#[derive(Clone, Copy)]
struct Mitre {
    /// What the path turns about: a unit vector.
    axis: DVec3,
    /// Towards the inner side, in the plane of the cut, as long as the cut is stretched there.
    inwards: DVec3,
}

/// A ring of the tube.
#[derive(Clone, Copy)]
struct Ring {
    center: DVec3,
    along: DVec3,
    /// Where u = 0 is: a unit vector across the path.
    across: DVec3,
    radius: f64,
    /// The normal leans by this tangent against the path.
    lean: f64,
    v: f64,
    mitre: Option<Mitre>,
}

impl Ring {
    /// How far it reaches in the direction `out`, in its radii: on the inner side of a corner as far as the cut.
    fn reach(&self, out: DVec3) -> DVec3 {
        let Some(Mitre { axis, inwards }) = self.mitre else { return out };
        let depth = out.dot(axis.cross(self.along));
        if depth > 0.0 { axis * out.dot(axis) + inwards * depth } else { out }
    }
}

/// The tube as triangles whose chords stay within `tolerance` of it.
///
/// Rings turn about the path as little as they can (the double reflection of Wang, Jüttler, Zheng, Liu 2008); on a closed
/// path what is left of a turn is spread over all of it. At corners of the path rings turn about the corner, so that the
/// outer side is round; their inner side, between straight pieces that are long enough, lies in the plane that halves it.
pub fn tube(tube: &Tube<'_>, tolerance: f64) -> Triangles {
    let widest = tube.radii[0].max(tube.radii[1]);
    let around = segments_around(widest, tolerance);
    let stations = stations(tube.path, tube.closed, widest, tolerance, around);
    let rings = rings(tube, &stations);
    let mut out = Triangles { normals: Some(Vec::new()), uvs: Some(Vec::new()), ..Triangles::default() };
    let mut all = Vec::new();
    if let (false, Some(first), Some(last)) = (tube.closed, rings.first(), rings.last()) {
        all.extend(end(first, -1.0, tube.caps, around));
        all.extend(rings.iter().copied());
        all.extend(end(last, 1.0, tube.caps, around).into_iter().rev());
    } else {
        all.extend(rings.iter().copied());
    }
    for ring in &all {
        out.add_tube_ring(ring, around);
    }
    out.join_rings(0, all.len() as u32, around);
    if tube.caps == Caps::Flat && !tube.closed {
        for (ring, sign) in rings.first().map(|r| (r, -1.0)).into_iter().chain(rings.last().map(|r| (r, 1.0)))
        {
            out.add_tube_end(ring, sign, around);
        }
    }
    out
}

/// The rings of a round end, from its pole on; none for other ends.
fn end(ring: &Ring, sign: f64, caps: Caps, around: u32) -> Vec<Ring> {
    let steps = (around / 4).max(2);
    let at = |i: u32| {
        let (sin, cos) = libm::sincos(FRAC_PI_2 * f64::from(i) / f64::from(steps));
        Ring {
            center: ring.center + ring.along * (sign * ring.radius * cos),
            radius: if i == 0 { 0.0 } else { ring.radius * sin },
            mitre: None,
            lean: sign * cos / sin.max(1e-9),
            ..*ring
        }
    };
    if caps == Caps::Round { (0..steps).map(at).collect() } else { Vec::new() }
}

/// Rings at all stations, turned as little as possible.
fn rings(tube: &Tube<'_>, stations: &[Station]) -> Vec<Ring> {
    let steps: Vec<f64> = stations.windows(2).map(|pair| pair[0].p.distance(pair[1].p)).collect();
    let length: f64 = steps.iter().sum();
    let [start, end] = tube.radii;
    let lean = if length > 0.0 && !tube.closed { (start - end) / length } else { 0.0 };
    let mut across = stations.first().map_or(DVec3::X, |first| first.along.any_orthonormal_vector());
    let mut travelled = 0.0;
    let mut rings = Vec::with_capacity(stations.len());
    for (i, station) in stations.iter().enumerate() {
        if i > 0 {
            across = transported(&stations[i - 1], station, across);
            travelled += steps[i - 1];
        }
        let share = if length > 0.0 { travelled / length } else { 0.0 };
        let radius = if tube.closed { start } else { start + (end - start) * share };
        let Station { p: center, along, mitre } = *station;
        rings.push(Ring { center, along, across, radius, lean, v: share, mitre });
    }
    if tube.closed {
        untwist(&mut rings);
    }
    rings
}

/// A vector across the path, carried from one station to the next by two reflections; at a corner, where they are in one
/// place, by the least turn that takes one direction to the other.
fn transported(from: &Station, to: &Station, across: DVec3) -> DVec3 {
    if from.p == to.p {
        let turned = to.along.dot(across) / (1.0 + from.along.dot(to.along));
        let carried = across - (from.along + to.along) * turned;
        return carried.normalize_or(to.along.any_orthonormal_vector());
    }
    let reflected = |v: DVec3, n: DVec3| {
        let square = n.length_squared();
        if square > 0.0 { v - n * (2.0 * n.dot(v) / square) } else { v }
    };
    let chord = to.p - from.p;
    let (middle, along) = (reflected(across, chord), reflected(from.along, chord));
    let carried = reflected(middle, to.along - along);
    (carried - to.along * carried.dot(to.along)).normalize_or(to.along.any_orthonormal_vector())
}

/// Turns the rings of a closed path so that the last lies on the first.
fn untwist(rings: &mut [Ring]) {
    let (Some(first), Some(last)) = (rings.first().copied(), rings.last().copied()) else { return };
    let across = first.across;
    let twist = libm::atan2(last.across.cross(across).dot(first.along), last.across.dot(across));
    let count = rings.len();
    for ring in rings.iter_mut() {
        let (sin, cos) = libm::sincos(twist * ring.v);
        ring.across = ring.across * cos + ring.along.cross(ring.across) * sin;
    }
    // To the bit, so that the seam is closed.
    rings[count - 1] = Ring { v: 1.0, ..first };
}

/// Points of the path at which chords stay within `tolerance`, corners as several in one place.
fn stations(path: &Path, closed: bool, radius: f64, tolerance: f64, around: u32) -> Vec<Station> {
    let pieces = pieces(path, closed);
    let mut stations: Vec<Station> = Vec::new();
    let turn = TAU / f64::from(around);
    for (i, piece) in pieces.iter().enumerate() {
        if i > 0 {
            corner(&mut stations, &pieces[i - 1], piece, radius, turn);
        }
        let steps = steps(piece, radius, tolerance);
        let from = usize::from(!stations.is_empty());
        for i in from..=steps {
            let t = i as f64 / steps as f64;
            stations.push(Station { p: point(piece, t), along: tangent(piece, t), mitre: None });
        }
    }
    if let (true, Some(last), Some(first)) = (closed, pieces.last(), pieces.first()) {
        corner(&mut stations, last, first, radius, turn);
        // The first ring is the last of this corner.
        if let Some(mitre) = stations.last().map(|last| last.mitre) {
            stations[0].mitre = mitre;
        }
    }
    stations
}

/// How the inner side of the corner between two pieces is cut; `None` where it has to run through itself: at what is bent,
/// or too short for the cut.
fn mitre(before: &Cubic, after: &Cubic, radius: f64) -> Option<Mitre> {
    let [a, b] = [tangent(before, 1.0), tangent(after, 0.0)];
    let half = libm::atan2(a.cross(b).length(), a.dot(b)) / 2.0;
    // Another cut at the other end of a piece may need as much.
    let has_room = |piece: &Cubic| {
        let chord = piece[3] - piece[0];
        // As `pieces` makes lines; their thirds are rounded.
        let is_line =
            piece[1] == piece[0].lerp(piece[3], 1.0 / 3.0) && piece[2] == piece[0].lerp(piece[3], 2.0 / 3.0);
        is_line && 2.0 * radius * libm::tan(half) < chord.length()
    };
    if !(has_room(before) && has_room(after)) {
        return None;
    }
    let inwards = (b - a).try_normalize()? / libm::cos(half);
    Some(Mitre { axis: a.cross(b).try_normalize()?, inwards })
}

/// Turns from the end of one piece to the start of the next in place, by steps of `turn` at most.
fn corner(stations: &mut Vec<Station>, before: &Cubic, after: &Cubic, radius: f64, turn: f64) {
    let Some(last) = stations.last().copied() else { return };
    let along = tangent(after, 0.0);
    let axis = last.along.cross(along);
    let angle = libm::atan2(axis.length(), last.along.dot(along));
    /// Less is rounding: the path is smooth there.
    const STRAIGHT: f64 = 1e-6;
    let steps = if angle > STRAIGHT { (angle / turn).ceil() as usize } else { 0 };
    let axis = axis.normalize_or(last.along.any_orthonormal_vector());
    let mitre = if steps > 0 { mitre(before, after, radius) } else { None };
    if let Some(last) = stations.last_mut() {
        last.mitre = mitre;
    }
    for i in 1..=steps {
        let (sin, cos) = libm::sincos(angle * i as f64 / steps as f64);
        let turned = if i == steps { along } else { last.along * cos + axis.cross(last.along) * sin };
        stations.push(Station { p: last.p, along: turned.normalize(), mitre });
    }
}

/// Control points of a cubic in space.
type Cubic = [DVec3; 4];

/// The path as cubics; one Bézier curve of a degree above 3 as many that meet it in points and tangents.
fn pieces(path: &Path, closed: bool) -> Vec<Cubic> {
    let mut p = path.points.clone();
    let line = |a: DVec3, b: DVec3| [a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0), b];
    let mut pieces: Vec<Cubic> = match path.kind {
        CurveKind::Polyline => p.windows(2).map(|w| line(w[0], w[1])).collect(),
        CurveKind::Bezier => p.windows(4).step_by(3).map(|w| [w[0], w[1], w[2], w[3]]).collect(),
        CurveKind::BezierOneCurve => {
            let count = 8 * p.len();
            let at = |i: usize| de_casteljau(&p, i as f64 / count as f64);
            let hermite = |i: usize| {
                let ((a, da), (b, db)) = (at(i), at(i + 1));
                let third = 1.0 / (3.0 * count as f64);
                [a, a + da * third, b - db * third, b]
            };
            (0..count).map(hermite).collect()
        }
        CurveKind::Bspline => {
            if closed {
                p.extend_from_within(..3);
            }
            p.windows(4).map(bspline_piece).collect()
        }
    };
    if let (true, Some(first), Some(last)) = (closed, pieces.first().copied(), pieces.last().copied())
        && first[0] != last[3]
    {
        match path.kind {
            // Rounding alone keeps the ends of a closed spline apart.
            CurveKind::Bspline => pieces.last_mut().expect("there is a last")[3] = first[0],
            _ => pieces.push(line(last[3], first[0])),
        }
    }
    pieces.retain(|piece| piece.iter().any(|p| *p != piece[0]));
    pieces
}

/// The Bézier points of one span of a uniform cubic B-spline (Farin 2002, section 8.7).
fn bspline_piece(p: &[DVec3]) -> Cubic {
    [
        (p[0] + p[1] * 4.0 + p[2]) / 6.0,
        (p[1] * 2.0 + p[2]) / 3.0,
        (p[1] + p[2] * 2.0) / 3.0,
        (p[1] + p[2] * 4.0 + p[3]) / 6.0,
    ]
}

/// The point at `t` of the Bézier curve over all `points`, and its derivative.
fn de_casteljau(points: &[DVec3], t: f64) -> (DVec3, DVec3) {
    let degree = (points.len() - 1) as f64;
    let (mut row, mut derivative) = (points.to_vec(), DVec3::ZERO);
    while row.len() > 1 {
        if let [a, b] = row[..] {
            derivative = (b - a) * degree;
        }
        row = row.windows(2).map(|p| p[0].lerp(p[1], t)).collect();
    }
    (row[0], derivative)
}

fn point(c: &Cubic, t: f64) -> DVec3 {
    let s = 1.0 - t;
    c[0] * (s * s * s) + c[1] * (3.0 * s * s * t) + c[2] * (3.0 * s * t * t) + c[3] * (t * t * t)
}

/// The unit direction of travel; where the derivative vanishes, that of the chord beside it.
fn tangent(c: &Cubic, t: f64) -> DVec3 {
    let s = 1.0 - t;
    let derivative = (c[1] - c[0]) * (s * s) + (c[2] - c[1]) * (2.0 * s * t) + (c[3] - c[2]) * (t * t);
    let chord = if t < 0.5 { point(c, t + 0.01) - point(c, t) } else { point(c, t) - point(c, t - 0.01) };
    derivative.try_normalize().or(chord.try_normalize()).unwrap_or(DVec3::X)
}

/// Steps of a piece whose chords stay within `tolerance`, on the outer side of the tube, too: h²/8 · max|c″| for its
/// middle, and a turn whose chord leaves a circle of the tube's radius by no more.
fn steps(c: &Cubic, radius: f64, tolerance: f64) -> usize {
    let second = (c[0] - c[1] * 2.0 + c[2]).length().max((c[1] - c[2] * 2.0 + c[3]).length()) * 6.0;
    let middle = (second / (8.0 * tolerance)).sqrt();
    let turn = (1..=8)
        .map(|i| {
            let (a, b) = (tangent(c, f64::from(i - 1) / 8.0), tangent(c, f64::from(i) / 8.0));
            libm::atan2(a.cross(b).length(), a.dot(b))
        })
        .fold(0.0, f64::max)
        * 8.0;
    let bend = turn * (radius / (8.0 * tolerance)).sqrt();
    middle.max(bend).ceil().clamp(1.0, 512.0) as usize
}

impl Triangles {
    fn add_tube_ring(&mut self, ring: &Ring, around: u32) {
        let up = ring.along.cross(ring.across);
        for j in 0..=around {
            let (sin, cos) = libm::sincos(TAU * f64::from(j % around) / f64::from(around));
            let out = ring.across * cos + up * sin;
            let normal = (out + ring.along * ring.lean).normalize();
            let uv = Vec2::new((f64::from(j) / f64::from(around)) as f32, ring.v as f32);
            self.add_vertex(ring.center + ring.reach(out) * ring.radius, normal, uv);
        }
    }

    /// A flat end: `sign` 1 faces along the path, −1 against it.
    fn add_tube_end(&mut self, ring: &Ring, sign: f64, around: u32) {
        let base = self.positions.len() as u32;
        let up = ring.along.cross(ring.across);
        self.add_vertex(ring.center, ring.along * sign, Vec2::splat(0.5));
        for j in 0..around {
            let (sin, cos) = libm::sincos(TAU * f64::from(j) / f64::from(around));
            let uv = Vec2::new((0.5 + 0.5 * cos) as f32, (0.5 + 0.5 * sin) as f32);
            let p = ring.center + (ring.across * cos + up * sin) * ring.radius;
            self.add_vertex(p, ring.along * sign, uv);
        }
        for j in 0..around {
            let (a, b) = (base + 1 + j, base + 1 + (j + 1) % around);
            self.indices.push(if sign > 0.0 { [base, a, b] } else { [base, b, a] });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lower::tessellate::tests::{assert_closed, volume};
    use crate::source::Span;
    use std::f64::consts::PI;

    fn path(kind: CurveKind, points: &[[f64; 3]]) -> Path {
        Path { kind, points: points.iter().map(|&p| p.into()).collect(), span: Span::default() }
    }

    fn swept(path: &Path, radii: [f64; 2], caps: Caps, closed: bool) -> Triangles {
        tube(&Tube { path, radii, caps, closed }, 1e-4)
    }

    fn assert_outwards(t: &Triangles) {
        let normals = t.normals.as_ref().expect("tubes are smooth");
        for &[a, b, c] in &t.indices {
            let [p, q, r] = [a, b, c].map(|i| t.positions[i as usize]);
            let n = (q - p).cross(r - p);
            assert!([a, b, c].iter().all(|&i| normals[i as usize].dot(n) > 0.0), "{p} {q} {r}");
        }
    }

    #[test]
    fn a_straight_tube_is_a_cylinder_or_a_cone_with_its_ends() {
        let straight = path(CurveKind::Polyline, &[[0.0, 0.0, 0.0], [1.0, 2.0, 2.0]]);
        for (radii, caps, expected) in [
            ([0.1, 0.1], Caps::Flat, PI * 0.01 * 3.0),
            ([0.2, 0.1], Caps::Flat, PI * (0.04 + 0.02 + 0.01)),
            ([0.1, 0.1], Caps::Round, PI * 0.01 * 3.0 + 4.0 / 3.0 * PI * 0.001),
        ] {
            let tube = swept(&straight, radii, caps, false);
            assert_closed(&tube);
            assert_outwards(&tube);
            assert!((volume(&tube) / expected - 1.0).abs() < 5e-3, "{} for {expected}", volume(&tube));
        }
    }

    #[test]
    fn a_tube_around_a_circle_is_a_ring() {
        // A closed B-spline through a regular 24-gon is as good as a circle.
        let corner = |i: u32| {
            let (sin, cos) = libm::sincos(TAU * f64::from(i) / 24.0);
            [cos, 0.0, sin]
        };
        let points: Vec<[f64; 3]> = (0..24).map(corner).collect();
        let ring = swept(&path(CurveKind::Bspline, &points), [0.2, 0.2], Caps::None, true);
        assert_closed(&ring);
        assert_outwards(&ring);
        let expected = 2.0 * PI * PI * 0.04;
        assert!((volume(&ring) / expected - 1.0).abs() < 0.02, "{} for {expected}", volume(&ring));
    }

    #[test]
    fn rings_turn_about_a_corner_without_twisting() {
        // A corner adds a wedge of a ball on its outer side, and on its inner side takes what the plane cuts from both pieces.
        let bends = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.2, 1.0, 0.3], [0.1, 1.1, -0.4]];
        for (closed, corners) in [(false, &bends[..3]), (false, &bends), (true, &bends)] {
            let tube = swept(&path(CurveKind::Polyline, corners), [0.1, 0.1], Caps::Flat, closed);
            let ends = corners.iter().zip(corners.iter().cycle().skip(1));
            let sides = ends.map(|(a, b)| DVec3::from(*a).distance(DVec3::from(*b)));
            let length: f64 = sides.take(corners.len() - usize::from(!closed)).sum();
            let corner = |[a, b, c]: [[f64; 3]; 3]| {
                let [a, b, c] = [a, b, c].map(DVec3::from);
                let angle = (b - a).angle_between(c - b);
                2.0 / 3.0 * 0.001 * (angle - 2.0 * libm::tan(angle / 2.0))
            };
            let at = |i: usize| corners[i % corners.len()];
            let count = if closed { corners.len() } else { corners.len() - 2 };
            let turns: f64 = (0..count).map(|i| corner([at(i), at(i + 1), at(i + 2)])).sum();
            let expected = PI * 0.01 * length + turns;
            assert!((volume(&tube) / expected - 1.0).abs() < 5e-3, "{} for {expected}", volume(&tube));
        }
    }

    #[test]
    fn tubes_with_bends_corners_and_twists_are_closed() {
        let knot = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.3],
            [1.0, 1.0, -0.4],
            [0.0, 1.0, 0.5],
            [0.5, 0.2, 1.0],
            [0.2, -0.4, 0.1],
            [-0.5, 0.3, 0.2],
        ];
        for (kind, closed) in [
            (CurveKind::Polyline, false),
            (CurveKind::Polyline, true),
            (CurveKind::Bezier, false),
            (CurveKind::Bezier, true),
            (CurveKind::BezierOneCurve, false),
            (CurveKind::Bspline, false),
            (CurveKind::Bspline, true),
        ] {
            let tube = swept(&path(kind, &knot), [0.05, 0.05], Caps::Round, closed);
            assert_closed(&tube);
            assert!(tube.positions.iter().all(|p| p.is_finite()), "{kind:?}");
        }
    }

    #[test]
    fn a_bent_tube_stays_within_its_tolerance() {
        let arc =
            path(CurveKind::Bezier, &[[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5], [1.0, 0.0, 0.5]]);
        let coarse = tube(&Tube { path: &arc, radii: [0.1, 0.1], caps: Caps::None, closed: false }, 1e-3);
        let cubic = pieces(&arc, false)[0];
        let distance = |p: DVec3| {
            (0..=2_000)
                .map(|i| point(&cubic, f64::from(i) / 2_000.0).distance(p))
                .fold(f64::INFINITY, f64::min)
        };
        for &[a, b, c] in coarse.indices.iter().step_by(7) {
            let [p, q, r] = [a, b, c].map(|i| coarse.positions[i as usize]);
            let off = (distance((p + q + r) / 3.0) - 0.1).abs();
            assert!(off <= 2e-3, "{off}");
        }
    }
}
