//! The parts of a triangle on either side of a plane.

use crate::math::{Bounds, DVec3, Vec3};

/// The boxes around the parts of `corners` below and above the plane at `position` on `axis`, each within `bounds`.
///
/// `bounds` holds the part of the triangle that counts and is cut by the plane. Both results are rounded outwards. Where
/// rounding leaves nothing of one, it is that half of `bounds`: a triangle is never lost.
pub fn split(corners: [Vec3; 3], bounds: Bounds, axis: usize, position: f32) -> [Bounds; 2] {
    let (mut below, mut above) = (Bounds::EMPTY, Bounds::EMPTY);
    let plane = f64::from(position);
    for i in 0..3 {
        let (a, b) = (corners[i], corners[(i + 1) % 3]);
        if a[axis] <= position {
            below = below.grow(a);
        }
        if a[axis] >= position {
            above = above.grow(a);
        }
        if (a[axis] < position && b[axis] > position) || (a[axis] > position && b[axis] < position) {
            let crossing = crossing(a.as_dvec3(), b.as_dvec3(), axis, plane);
            (below, above) = (below.union(crossing), above.union(crossing));
        }
    }
    let halves = bounds.split(axis, position);
    let within = |part: Bounds, half: Bounds| {
        let part = part.intersection(half);
        if part.is_empty() { half } else { part }
    };
    [within(below, halves[0]), within(above, halves[1])]
}

/// The smallest box around where the edge from `a` to `b` crosses a plane.
fn crossing(a: DVec3, b: DVec3, axis: usize, plane: f64) -> Bounds {
    let mut at = a + (b - a) * ((plane - a[axis]) / (b[axis] - a[axis]));
    at[axis] = plane;
    Bounds::enclosing(at, at)
}
