//! The part of a triangle that lies in a box.

use crate::math::{Bounds, DVec3, Vec3};

/// A convex polygon: a triangle cut by at most six planes.
struct Polygon {
    corners: [DVec3; 9],
    count: usize,
}

impl Polygon {
    fn push(&mut self, corner: DVec3) {
        self.corners[self.count] = corner;
        self.count += 1;
    }

    /// What remains where `sign · (p[axis] − plane) ≤ 0` (Sutherland, Hodgman 1974).
    fn cut(&self, axis: usize, plane: f64, sign: f64) -> Self {
        let mut kept = Self { corners: [DVec3::ZERO; 9], count: 0 };
        let height = |p: DVec3| sign * (p[axis] - plane);
        for i in 0..self.count {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % self.count]);
            let (above, next) = (height(a), height(b));
            if above <= 0.0 {
                kept.push(a);
            }
            if (above < 0.0 && next > 0.0) || (above > 0.0 && next < 0.0) {
                let mut crossing = a + (b - a) * (above / (above - next));
                crossing[axis] = plane;
                kept.push(crossing);
            }
        }
        kept
    }
}

/// The box around the part of a triangle inside `cell`, rounded outwards, within `cell`.
///
/// Where rounding leaves nothing of it, the answer is `cell`: a triangle is never lost.
pub fn clip(corners: [Vec3; 3], cell: Bounds) -> Bounds {
    let mut polygon = Polygon { corners: [DVec3::ZERO; 9], count: 0 };
    corners.iter().for_each(|corner| polygon.push(corner.as_dvec3()));
    let whole = Bounds::of(corners);
    for axis in 0..3 {
        if whole.min[axis] < cell.min[axis] {
            polygon = polygon.cut(axis, f64::from(cell.min[axis]), -1.0);
        }
        if whole.max[axis] > cell.max[axis] {
            polygon = polygon.cut(axis, f64::from(cell.max[axis]), 1.0);
        }
    }
    let inside = &polygon.corners[..polygon.count];
    let low = inside.iter().fold(DVec3::INFINITY, |low, p| low.min(*p));
    let high = inside.iter().fold(DVec3::NEG_INFINITY, |high, p| high.max(*p));
    let clipped = if inside.is_empty() { cell } else { Bounds::enclosing(low, high).intersection(cell) };
    if clipped.is_empty() { cell } else { clipped }
}
