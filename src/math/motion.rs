//! Transforms that change while a shutter is open.
//!
//! A motion is a chain of factors. Each goes its own way: shifts and stretches in a straight line, turns at an even speed
//! about their axis, so that what turns keeps its shape, however far it turns. Two transforms that are not written alike
//! are taken apart first, into a shift, a rotation and a stretch (Shoemake & Duff 1992), and the rotation becomes a turn
//! about the one axis that leads from the first to the second (Shoemake 1985: spherical linear interpolation).

use super::{DAffine3, DMat3, DVec3, float};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A factor of a transform, as the time s goes from 0 to 1.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Factor {
    /// From one matrix to another, number by number.
    Straight {
        /// At s = 0.
        from: DAffine3,
        /// At s = 1.
        to: DAffine3,
    },
    /// About an axis through the origin, counter-clockwise seen from its tip.
    Turn {
        /// A unit vector.
        axis: DVec3,
        /// The angle at s = 0, in radians.
        from: f64,
        /// The angle at s = 1; turns beyond the first count.
        to: f64,
    },
}

impl Factor {
    /// One that stands still.
    pub const fn still(matrix: DAffine3) -> Self {
        Self::Straight { from: matrix, to: matrix }
    }

    /// A rotation that stands still, by an angle in radians.
    pub const fn turned(axis: DVec3, angle: f64) -> Self {
        Self::Turn { axis, from: angle, to: angle }
    }

    /// The factor at a time in [0, 1].
    pub fn at(&self, s: f64) -> DAffine3 {
        match *self {
            Self::Straight { from, to } if from == to => from,
            Self::Straight { from, to } => blend(&from, &to, s),
            Self::Turn { axis, from, to } => DAffine3::from_mat3(rotation(axis, from + (to - from) * s)),
        }
    }

    /// Whether it is the same all the time.
    pub fn is_still(&self) -> bool {
        match self {
            Self::Straight { from, to } => from == to,
            Self::Turn { from, to, .. } => from == to,
        }
    }

    /// The part of its way that it has gone at the time `s`, as a whole way.
    #[must_use]
    pub fn until(&self, s: f64) -> Self {
        match *self {
            Self::Straight { from, .. } => Self::Straight { from, to: self.at(s) },
            Self::Turn { axis, from, to } => Self::Turn { axis, from, to: from + (to - from) * s },
        }
    }

    /// The time at which it flattens what it moves, if there is one in [0, 1].
    ///
    /// The determinant of a straight way is a cubic in s; where that is least, or changes its sign, it is looked at.
    pub fn flat_at(&self) -> Option<f64> {
        let Self::Straight { from, to } = *self else { return None };
        let det = |s: f64| blend(&from, &to, s).matrix3.determinant();
        let size = |m: &DMat3| m.x_axis.length() * m.y_axis.length() * m.z_axis.length();
        let scale = size(&from.matrix3).max(size(&to.matrix3));
        let sign = det(0.0);
        // The cubic a + b s + c s² + d s³ through four of its points.
        let [y0, y1, y2, y3] = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].map(det);
        let b = (-11.0 * y0 + 18.0 * y1 - 9.0 * y2 + 2.0 * y3) / 2.0;
        let c = 9.0 * (2.0 * y0 - 5.0 * y1 + 4.0 * y2 - y3) / 2.0;
        let d = 9.0 * (y3 - 3.0 * y2 + 3.0 * y1 - y0) / 2.0;
        let root = (c * c - 3.0 * b * d).max(0.0).sqrt();
        let turning = [(-c + root) / (3.0 * d), (-c - root) / (3.0 * d), -b / (2.0 * c)];
        let looked_at = [0.0, 1.0].into_iter().chain(turning.into_iter().filter(|s| (0.0..=1.0).contains(s)));
        /// What is below this share of the volume is the rounding of the cubic.
        const VANISHING: f64 = 1e-9;
        let flat =
            looked_at.into_iter().find(|&s| det(s) * sign <= 0.0 || det(s).abs() <= VANISHING * scale)?;
        // Where the sign has changed, it was flat before.
        let (mut before, mut after) = (0.0, flat);
        while det(flat) * sign < 0.0 && after - before > f64::from(f32::EPSILON) {
            let middle = 0.5 * (before + after);
            if det(middle) * sign > 0.0 { before = middle } else { after = middle }
        }
        Some(after)
    }

    /// Whether lengths and handedness stay as they are, to rounding.
    pub fn is_rigid(&self) -> bool {
        let Self::Straight { from, to } = self else { return true };
        let is_rotation = |m: &DMat3| {
            let skew = (m.transpose() * *m - DMat3::IDENTITY).to_cols_array();
            skew.iter().all(|x| x.abs() < 1e-9) && m.determinant() > 0.0
        };
        let change = (from.matrix3 - to.matrix3).to_cols_array();
        is_rotation(&from.matrix3) && change.iter().all(|x| x.abs() < 1e-9)
    }

    /// The factors that lead from one chain to another, both standing still and with the innermost first.
    pub fn between(from: &[Self], to: &[Self]) -> Vec<Self> {
        let pairs: Option<Vec<_>> = from
            .iter()
            .zip(to)
            .map(|(a, b)| a.alike(b))
            .collect::<Option<_>>()
            .filter(|_| from.len() == to.len());
        pairs.unwrap_or_else(|| decomposed(&product(from, 0.0), &product(to, 0.0)))
    }

    /// The way to another factor that is written alike: a shift, a stretch along the axes, a turn about the same axis.
    fn alike(&self, other: &Self) -> Option<Self> {
        match (*self, *other) {
            (a, b) if a == b => Some(a),
            (Self::Straight { from, .. }, Self::Straight { from: to, .. }) => {
                let shifts = |m: &DAffine3| m.matrix3 == DMat3::IDENTITY;
                let stretches = |m: &DAffine3| {
                    m.translation == DVec3::ZERO && m.matrix3 == DMat3::from_diagonal(diagonal(m))
                };
                let is_alike = shifts(&from) && shifts(&to) || stretches(&from) && stretches(&to);
                is_alike.then_some(Self::Straight { from, to })
            }
            (Self::Turn { axis, from, .. }, Self::Turn { axis: other, from: to, .. }) if axis == other => {
                Some(Self::Turn { axis, from, to })
            }
            (Self::Turn { axis, from, .. }, Self::Turn { axis: other, from: to, .. }) if axis == -other => {
                Some(Self::Turn { axis, from, to: -to })
            }
            _ => None,
        }
    }
}

/// A transform that changes as the time s goes from 0 to 1.
#[derive(Clone, PartialEq, Debug)]
pub struct Motion {
    /// The innermost first.
    factors: Vec<Factor>,
}

impl Motion {
    /// The product of factors that are applied from first to last; `None` where all of them stand still.
    pub fn new(factors: impl IntoIterator<Item = Factor>) -> Option<Self> {
        let mut merged: Vec<Factor> = Vec::new();
        for factor in factors {
            match merged.last_mut() {
                Some(last) if last.is_still() && factor.is_still() => {
                    *last = Factor::still(factor.at(0.0) * last.at(0.0));
                }
                _ => merged.push(factor),
            }
        }
        let moves = merged.iter().any(|factor| !factor.is_still());
        moves.then_some(Self { factors: merged })
    }

    /// Its factors, the innermost first.
    pub fn factors(&self) -> &[Factor] {
        &self.factors
    }

    /// The transform at a time in [0, 1].
    pub fn at(&self, s: f64) -> DAffine3 {
        product(&self.factors, s)
    }

    /// The first part of it, up to the time `s`, between two transforms that stand still.
    pub fn part(&self, inner: DAffine3, s: f64, outer: DAffine3) -> Option<Self> {
        let own = self.factors.iter().map(|factor| factor.until(s));
        Self::new([Factor::still(inner)].into_iter().chain(own).chain([Factor::still(outer)]))
    }

    /// A box that holds at every time what fills the box from `low` to `high` in its own frame.
    pub fn sweep_box(&self, low: DVec3, high: DVec3) -> (DVec3, DVec3) {
        let inner = [0, 1, 2].map(|axis| Interval::new(low[axis], high[axis]));
        self.sweep(|moved| moved.apply(inner))
    }

    /// A box that holds at every time what the unit ball about the origin becomes.
    pub fn sweep_ball(&self) -> (DVec3, DVec3) {
        // Along an axis an ellipsoid reaches as far as that row of the matrix is long.
        self.sweep(|moved| {
            [0, 1, 2].map(|axis| {
                let row = moved.rows[axis];
                let reach = row[..3].iter().map(|x| x.reach() * x.reach()).sum::<f64>().sqrt();
                Interval::new(row[3].low - reach, row[3].high + reach)
            })
        })
    }

    /// The box around what `held` says of every piece of the time: there each number of the matrix lies in an interval, so
    /// that nothing between two moments is overlooked, though the path of a turning thing lies outside of its ends.
    fn sweep(&self, held: impl Fn(&IntervalAffine) -> [Interval; 3]) -> (DVec3, DVec3) {
        /// The angle that a piece may turn, and the fewest and the most pieces.
        const PIECE: f64 = PI / 64.0;
        const PIECES: (f64, f64) = (16.0, 4096.0);
        /// The rounding of it all, far above what it can be.
        const ROUNDING: f64 = 1e-12;
        let turn = |factor: &Factor| match factor {
            Factor::Turn { from, to, .. } => (to - from).abs(),
            Factor::Straight { .. } => 0.0,
        };
        let angle: f64 = self.factors.iter().map(turn).sum();
        let count = (angle / PIECE).ceil().clamp(PIECES.0, PIECES.1) as u32;
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for i in 0..count {
            let [start, end] = [i, i + 1].map(|i| f64::from(i) / f64::from(count));
            let factors = self.factors.iter().map(|factor| IntervalAffine::of(factor, start, end));
            let moved =
                factors.fold(IntervalAffine::still(&DAffine3::IDENTITY), |inner, outer| outer.after(&inner));
            let [x, y, z] = held(&moved);
            low = low.min(DVec3::new(x.low, y.low, z.low));
            high = high.max(DVec3::new(x.high, y.high, z.high));
        }
        let slack = low.abs().max(high.abs()) * ROUNDING;
        (low - slack, high + slack)
    }
}

/// The product of factors at a time, the innermost first.
fn product(factors: &[Factor], s: f64) -> DAffine3 {
    let mut factors = factors.iter();
    let Some(first) = factors.next() else { return DAffine3::IDENTITY };
    factors.fold(first.at(s), |inner, outer| outer.at(s) * inner)
}

fn blend(from: &DAffine3, to: &DAffine3, s: f64) -> DAffine3 {
    DAffine3 {
        matrix3: from.matrix3 * (1.0 - s) + to.matrix3 * s,
        translation: from.translation * (1.0 - s) + to.translation * s,
    }
}

fn diagonal(m: &DAffine3) -> DVec3 {
    DVec3::new(m.matrix3.x_axis.x, m.matrix3.y_axis.y, m.matrix3.z_axis.z)
}

/// The rotation about a unit axis by an angle in radians, counter-clockwise seen from its tip (Rodrigues).
///
/// Quarter turns are exact: sines and cosines within rounding of 0 and ±1 are taken as such.
pub fn rotation(axis: DVec3, radians: f64) -> DMat3 {
    let (sin, cos) = float::sin_cos64(radians);
    let snap = |x: f64| if (x - x.round()).abs() < 1e-15 { x.round() } else { x };
    let (sin, cos) = (snap(sin), snap(cos));
    let DVec3 { x, y, z } = axis;
    let k = 1.0 - cos;
    DMat3::from_cols(
        DVec3::new(cos + x * x * k, y * x * k + z * sin, z * x * k - y * sin),
        DVec3::new(x * y * k - z * sin, cos + y * y * k, z * y * k + x * sin),
        DVec3::new(x * z * k + y * sin, y * z * k - x * sin, cos + z * z * k),
    )
}

/// The way from one transform to another: the stretches and the shifts in straight lines, and between them the rotation of
/// the first, turned to that of the second the short way round (Shoemake & Duff 1992).
fn decomposed(from: &DAffine3, to: &DAffine3) -> Vec<Factor> {
    let (Some((r0, s0)), Some((r1, s1))) = (polar(&from.matrix3), polar(&to.matrix3)) else {
        // What is flat has no rotation; whoever checks it says so.
        return vec![Factor::Straight { from: *from, to: *to }];
    };
    let (axis, angle) = axis_angle(&(r1 * r0.transpose()));
    vec![
        Factor::Straight { from: DAffine3::from_mat3(s0), to: DAffine3::from_mat3(s1) },
        Factor::still(DAffine3::from_mat3(r0)),
        Factor::Turn { axis, from: 0.0, to: angle },
        Factor::Straight {
            from: DAffine3::from_translation(from.translation),
            to: DAffine3::from_translation(to.translation),
        },
    ]
}

/// The rotation R and the symmetric S with m = R·S; S mirrors where m does. `None` of what is flat.
///
/// By the iteration Q ← (Q + Q⁻ᵀ) / 2, which doubles the digits each time (Higham 1986).
fn polar(m: &DMat3) -> Option<(DMat3, DMat3)> {
    const MOST: u32 = 100;
    let sign = m.determinant().signum();
    let mut q = *m;
    for _ in 0..MOST {
        let next = (q + q.inverse().transpose()) * 0.5;
        if !next.is_finite() {
            return None;
        }
        let change = (next - q).to_cols_array().iter().map(|x| x.abs()).fold(0.0, f64::max);
        q = next;
        if change < 1e-15 {
            break;
        }
    }
    let rotation = q * sign;
    let stretch = rotation.transpose() * *m;
    Some((rotation, (stretch + stretch.transpose()) * 0.5))
}

/// The axis of a rotation, and its angle in [0, π]; any axis for the angle 0.
fn axis_angle(rotation: &DMat3) -> (DVec3, f64) {
    let q = glam::DQuat::from_mat3(rotation);
    let q = if q.w < 0.0 { -q } else { q };
    let v = DVec3::new(q.x, q.y, q.z);
    (v.try_normalize().unwrap_or(DVec3::Z), 2.0 * float::atan2_64(v.length(), q.w))
}

/// All numbers from `low` to `high`.
#[derive(Clone, Copy)]
struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    fn new(a: f64, b: f64) -> Self {
        Self { low: a.min(b), high: a.max(b) }
    }

    fn times(self, by: f64) -> Self {
        Self::new(self.low * by, self.high * by)
    }

    fn plus(self, other: Self) -> Self {
        Self { low: self.low + other.low, high: self.high + other.high }
    }

    fn product(self, other: Self) -> Self {
        let (low, high) = (other.times(self.low), other.times(self.high));
        Self { low: low.low.min(high.low), high: low.high.max(high.high) }
    }

    /// The largest magnitude.
    fn reach(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// The cosines of the angles between two.
    fn cosines(a: f64, b: f64) -> Self {
        let (a, b) = (a.min(b), a.max(b));
        let mut cosines = Self::new(float::sin_cos64(a).1, float::sin_cos64(b).1);
        let holds = |peak: f64| ((a - peak) / TAU).ceil() * TAU + peak <= b;
        if holds(0.0) {
            cosines.high = 1.0;
        }
        if holds(PI) {
            cosines.low = -1.0;
        }
        cosines
    }
}

/// All transforms whose numbers lie in intervals: three rows, the shift last.
struct IntervalAffine {
    rows: [[Interval; 4]; 3],
}

impl IntervalAffine {
    fn still(m: &DAffine3) -> Self {
        Self::straight(m, m)
    }

    /// Those between two, number by number.
    fn straight(a: &DAffine3, b: &DAffine3) -> Self {
        let number = |m: &DAffine3, row: usize, column: usize| match column {
            3 => m.translation[row],
            _ => m.matrix3.col(column)[row],
        };
        let interval = |row, column| Interval::new(number(a, row, column), number(b, row, column));
        Self { rows: [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| interval(row, column))) }
    }

    /// Those of a factor between two times.
    fn of(factor: &Factor, start: f64, end: f64) -> Self {
        let Factor::Turn { axis, from, to } = *factor else {
            return Self::straight(&factor.at(start), &factor.at(end));
        };
        let [a, b] = [start, end].map(|s| from + (to - from) * s);
        let (cos, sin) = (Interval::cosines(a, b), Interval::cosines(a - FRAC_PI_2, b - FRAC_PI_2));
        // Rodrigues' formula, each cosine written once: cos δ + aᵢaⱼ(1 − cos) + sin times the cross product with the axis.
        let number = |row: usize, column: usize| {
            let (same, along) = (f64::from(row == column), axis[row] * axis[column]);
            let cross = match (row + 3 - column) % 3 {
                1 => axis[3 - row - column],
                2 => -axis[3 - row - column],
                _ => 0.0,
            };
            cos.times(same - along).plus(Interval::new(along, along)).plus(sin.times(cross))
        };
        let none = Interval::new(0.0, 0.0);
        Self { rows: [0, 1, 2].map(|row| [number(row, 0), number(row, 1), number(row, 2), none]) }
    }

    /// These after others.
    fn after(&self, inner: &Self) -> Self {
        let entry = |row: usize, column: usize| {
            let along = |k: usize| self.rows[row][k].product(inner.rows[k][column]);
            let sum = along(0).plus(along(1)).plus(along(2));
            if column == 3 { sum.plus(self.rows[row][3]) } else { sum }
        };
        Self { rows: [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| entry(row, column))) }
    }

    /// Where they take the points of a box.
    fn apply(&self, p: [Interval; 3]) -> [Interval; 3] {
        self.rows
            .map(|[x, y, z, shift]| x.product(p[0]).plus(y.product(p[1])).plus(z.product(p[2])).plus(shift))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(i: u32, salt: f64) -> f64 {
        (f64::from(i) * 0.618_033_988_7 + salt).fract() * 2.0 - 1.0
    }

    fn chain(i: u32) -> Motion {
        let v = |k: f64| DVec3::new(random(i, 0.1 * k), random(i, 0.23 * k), random(i, 0.37 * k));
        let axis = v(1.0).normalize();
        let shift = |d: DVec3| DAffine3::from_translation(d);
        Motion::new([
            Factor::Straight { from: DAffine3::from_scale(v(2.0)), to: DAffine3::from_scale(v(3.0)) },
            Factor::still(shift(v(4.0) * 3.0)),
            Factor::Turn { axis, from: random(i, 0.7) * 5.0, to: random(i, 0.9) * 20.0 },
            Factor::Straight { from: shift(v(5.0)), to: shift(v(6.0) * 4.0) },
            Factor::Turn { axis: v(7.0).normalize(), from: 0.0, to: random(i, 0.4) * 3.0 },
        ])
        .expect("it moves")
    }

    #[test]
    fn what_moves_never_leaves_the_box_of_its_sweep() {
        for i in 0..40 {
            let motion = chain(i);
            let (low, high) = (DVec3::new(-0.3, -1.0, 0.2), DVec3::new(0.5, 0.1, 0.9));
            let (swept, ball) = (motion.sweep_box(low, high), motion.sweep_ball());
            let mut reached = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            for step in 0..=5_000 {
                let pose = motion.at(f64::from(step) / 5_000.0);
                for corner in 0..8 {
                    let pick = |bit: usize| if corner >> bit & 1 == 0 { low[bit] } else { high[bit] };
                    let p = pose.transform_point3(DVec3::new(pick(0), pick(1), pick(2)));
                    assert!(swept.0.cmple(p).all() && p.cmple(swept.1).all(), "{i}, {step}: {p} {swept:?}");
                    reached = (reached.0.min(p), reached.1.max(p));
                    let n = DVec3::new(random(corner, 0.2), random(step, 0.6), random(step, 0.8)).normalize();
                    let p = pose.transform_point3(n);
                    assert!(ball.0.cmple(p).all() && p.cmple(ball.1).all(), "{i}, {step}: ball");
                }
            }
            // Nor is the box much larger than it has to be.
            let (room, size) = (swept.1 - swept.0, reached.1 - reached.0);
            assert!(room.max_element() < 1.3 * size.max_element(), "{i}: {room} {size}");
        }
    }

    #[test]
    fn transforms_written_differently_are_taken_apart_and_meet_both_ends() {
        for i in 0..40 {
            let [a, b] = [i, i + 100].map(|i| chain(i).at(0.0));
            let way = Motion::new(Factor::between(&[Factor::still(a)], &[Factor::still(b)]));
            let way = way.expect("it moves");
            if a.matrix3.determinant() * b.matrix3.determinant() > 0.0 {
                for (s, end) in [(0.0, a), (1.0, b)] {
                    let error = (way.at(s).matrix3 - end.matrix3).to_cols_array();
                    assert!(error.iter().all(|x| x.abs() < 1e-12), "{i} at {s}: {error:?}");
                    assert!((way.at(s).translation - end.translation).length() < 1e-12);
                }
            } else {
                assert!(way.factors().iter().any(|factor| factor.flat_at().is_some()), "{i}");
            }
        }
    }

    #[test]
    fn what_only_turns_keeps_its_shape_on_the_way() {
        let [a, b] = [(DVec3::Y, 0.3), (DVec3::new(1.0, 2.0, -1.0).normalize(), 2.9)]
            .map(|(axis, angle)| DAffine3::from_mat3(rotation(axis, angle)));
        let way = Motion::new(Factor::between(&[Factor::still(a)], &[Factor::still(b)])).expect("it moves");
        for i in 0..=20 {
            let m = way.at(f64::from(i) / 20.0).matrix3;
            let skew = (m.transpose() * m - DMat3::IDENTITY).to_cols_array();
            assert!(skew.iter().all(|x| x.abs() < 1e-12), "{i}: {skew:?}");
        }
    }

    #[test]
    fn whole_turns_are_turned_and_written_stretches_go_straight() {
        let turn = |angle| [Factor::turned(DVec3::Y, angle)];
        let way = Motion::new(Factor::between(&turn(0.0), &turn(TAU))).expect("it moves");
        assert!((way.at(0.25).transform_point3(DVec3::Z) - DVec3::X).length() < 1e-12);
        let scale = |by| [Factor::still(DAffine3::from_scale(DVec3::splat(by)))];
        let way = Motion::new(Factor::between(&scale(1.0), &scale(3.0))).expect("it moves");
        assert_eq!(way.at(0.5).matrix3, DMat3::from_diagonal(DVec3::splat(2.0)));
        assert!(Motion::new(Factor::between(&scale(2.0), &scale(2.0))).is_none());
    }

    #[test]
    fn a_quarter_turn_is_exact_and_counter_clockwise() {
        assert_eq!(rotation(DVec3::Z, FRAC_PI_2) * DVec3::X, DVec3::Y);
        assert_eq!(rotation(DVec3::X, FRAC_PI_2) * DVec3::Y, DVec3::Z);
        assert_eq!(rotation(DVec3::Y, FRAC_PI_2) * DVec3::Z, DVec3::X);
    }

    #[test]
    fn a_rotation_keeps_lengths_and_its_axis() {
        let axis = DVec3::new(1.0, 2.0, 3.0).normalize();
        let turned = rotation(axis, 1.234);
        assert!((turned * axis - axis).length() < 1e-15);
        assert!((turned.determinant() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_way_through_something_flat_is_found() {
        let scales = |a: DVec3, b: DVec3| Factor::Straight {
            from: DAffine3::from_scale(a),
            to: DAffine3::from_scale(b),
        };
        // Once through 0, and to 0 and back on the same side.
        let through = scales(DVec3::ONE, DVec3::new(-1.0, 1.0, 1.0));
        let touches = scales(DVec3::ONE, DVec3::new(-2.0, -2.0, 1.0));
        assert!(through.flat_at().is_some_and(|s| (s - 0.5).abs() < 1e-6));
        assert!(touches.flat_at().is_some_and(|s| (s - 1.0 / 3.0).abs() < 1e-6));
        assert_eq!(scales(DVec3::ONE, DVec3::new(0.1, 5.0, 2.0)).flat_at(), None);
        assert_eq!(scales(DVec3::splat(-1.0), DVec3::splat(-3.0)).flat_at(), None);
    }
}
