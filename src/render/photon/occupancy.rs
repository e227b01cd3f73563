//! Where there are photons at all: most of a scene has no caustics, and a look at one cell tells so.

use crate::math::{Bounds, Vec3};

/// Cells along the longest side of the box around all photons.
const CELLS: f32 = 64.0;

/// A coarse grid over some points that knows which of its cells lie next to one, or hold one.
#[derive(Default)]
pub struct Occupancy {
    /// The corner of the first cell.
    origin: Vec3,
    /// The side of a cell.
    cell: f32,
    size: [usize; 3],
    near: Vec<bool>,
}

impl Occupancy {
    /// A grid over `points`.
    pub fn new(points: impl Iterator<Item = Vec3> + Clone) -> Self {
        let bounds = Bounds::of(points.clone());
        let cell = bounds.size().max_element() / CELLS;
        if !(cell > 0.0 && cell.is_finite()) {
            return Self::default(); // no points, or all in one place: knows nothing
        }
        // One empty cell all around, and one for what lies on the far side.
        let origin = bounds.min - cell;
        let size = (bounds.size() / cell).to_array().map(|cells| cells as usize + 4);
        let mut grid = Self { origin, cell, size, near: vec![false; size.iter().product()] };
        for p in points {
            let cell = grid.cell_of(p).map(|cell| grid.index(cell));
            cell.into_iter().for_each(|i| grid.near[i] = true);
        }
        grid.spread(1);
        grid.spread(size[0]);
        grid.spread(size[0] * size[1]);
        grid
    }

    /// Whether there may be a point within `radius` of `p`; if not, there is none.
    pub fn may_hold(&self, p: Vec3, radius: f32) -> bool {
        // A little less than a cell, so that rounding moves nothing farther than to the next one.
        if radius > 0.99 * self.cell {
            return true;
        }
        self.cell_of(p).is_some_and(|cell| self.near[self.index(cell)])
    }

    /// The cell that holds a point; `None` outside of the grid.
    fn cell_of(&self, p: Vec3) -> Option<[usize; 3]> {
        let at = (p - self.origin) / self.cell;
        let cell = at.to_array().map(|x| x as usize); // what is negative becomes 0: a cell of the empty border
        (0..3).all(|axis| cell[axis] < self.size[axis]).then_some(cell)
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.size[0] * (y + self.size[1] * z)
    }

    /// Marks the neighbours, `step` cells before and behind in the list, of all that are marked. The border keeps those at
    /// the ends of rows from meeting: it starts out empty, and takes up what would reach beyond.
    fn spread(&mut self, step: usize) {
        let marked = self.near.clone();
        for i in 0..marked.len() {
            self.near[i] |= i >= step && marked[i - step] || marked.get(i + step).is_some_and(|&near| near);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_point_is_overlooked_and_empty_space_is_known() {
        // Points on a line and in a plane, far from the origin.
        let point = |i: u32| {
            let x = (i as f32 * 0.618_034).fract();
            if i.is_multiple_of(2) {
                Vec3::new(x, 0.0, 0.0)
            } else {
                Vec3::new(0.1 * x, 0.0, (i as f32 * 0.7549).fract())
            }
        };
        for shift in [Vec3::ZERO, Vec3::new(100.0, -40.0, 7.0)] {
            let points: Vec<_> = (0..2_000).map(|i| point(i) + shift).collect();
            let grid = Occupancy::new(points.iter().copied());
            let mut empty = 0;
            for i in 0..20_000 {
                let q = Vec3::new(
                    (i as f32 * 0.755).fract(),
                    (i as f32 * 0.57).fract(),
                    (i as f32 * 0.43).fract(),
                );
                let q = (q - Vec3::Y * 0.5) * 1.4 + shift - 0.2;
                let radius = 0.015 * (i as f32 * 0.317).fract();
                if !grid.may_hold(q, radius) {
                    empty += 1;
                    assert!(points.iter().all(|p| p.distance(q) > radius), "{q} {radius}");
                }
            }
            assert!(empty > 10_000, "{empty}");
        }
    }

    #[test]
    fn points_that_are_one_or_none_are_no_obstacle() {
        assert!(Occupancy::new(std::iter::empty()).may_hold(Vec3::ZERO, 1.0));
        assert!(Occupancy::new([Vec3::ONE; 3].into_iter()).may_hold(Vec3::ONE, 1e-6));
    }
}
