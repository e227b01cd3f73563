//! Splitting space by a plane: references that straddle it go to both sides, clipped (Stich, Friedrich, Dietrich 2009).

use super::build::{Items, Reference};
use super::objects::running_sums;
use super::sah::{Side, best_border};
use crate::math::Bounds;

/// Slabs into which a cell is cut along each axis; planes are tried between them.
const SLABS: usize = 32;

/// A plane that splits a cell.
#[derive(Clone, Copy, Debug)]
pub struct SpatialSplit {
    /// The axis that the plane is orthogonal to.
    axis: usize,
    /// Where it cuts that axis.
    position: f32,
    /// The price of both sides.
    pub cost: f64,
    /// What is on both sides; what straddles counts in both.
    pub sides: [Side; 2],
}

/// The best of evenly spaced planes; `None` where the cell is too thin for any.
pub fn best(items: &Items, references: &[Reference], cell: Bounds) -> Option<SpatialSplit> {
    let mut best: Option<SpatialSplit> = None;
    for axis in 0..3 {
        let planes = planes(cell, axis);
        if !planes.windows(2).all(|pair| pair[0] < pair[1]) {
            continue;
        }
        let (begun, ended) = fill(items, references, axis, &planes);
        let (below, above) = running_sums(&begun, &ended);
        let Some((cost, border)) = best_border(&below, &above) else { continue };
        if best.is_none_or(|best| cost < best.cost) {
            let sides = [below[border - 1], above[border]];
            best = Some(SpatialSplit { axis, position: planes[border], cost, sides });
        }
    }
    best
}

/// The faces of the slabs, from the lowest to the highest.
fn planes(cell: Bounds, axis: usize) -> [f32; SLABS + 1] {
    let (min, size) = (cell.min[axis], cell.size()[axis]);
    let mut planes = [min; SLABS + 1];
    for (i, plane) in planes.iter_mut().enumerate().skip(1) {
        *plane = min + size * (i as f32 / SLABS as f32);
    }
    planes[SLABS] = cell.max[axis];
    planes
}

/// For each slab, the references that begin there, and those that end there, with the boxes of all their parts in it.
fn fill(
    items: &Items,
    references: &[Reference],
    axis: usize,
    planes: &[f32; SLABS + 1],
) -> ([Side; SLABS], [Side; SLABS]) {
    let (mut begun, mut ended) = ([Side::EMPTY; SLABS], [Side::EMPTY; SLABS]);
    let scale = SLABS as f32 / (planes[SLABS] - planes[0]);
    let slab = |x: f32| (((x - planes[0]) * scale) as usize).min(SLABS - 1);
    for reference in references {
        let (first, last) = (slab(reference.bounds.min[axis]), slab(reference.bounds.max[axis]));
        let mut rest = reference.bounds;
        for i in first..last {
            if !(rest.min[axis] < planes[i + 1] && planes[i + 1] < rest.max[axis]) {
                continue;
            }
            let [part, left] = items.split(reference.item, rest, axis, planes[i + 1]);
            begun[i].add(0, part);
            ended[i].add(0, part);
            rest = left;
        }
        begun[last].add(0, rest);
        ended[last].add(0, rest);
        begun[first].count += 1;
        ended[last].count += 1;
    }
    (begun, ended)
}

impl SpatialSplit {
    /// The references of both sides. One that straddles the plane stays whole where that is cheaper than to duplicate it.
    ///
    /// At most `spare` are duplicated.
    pub fn divide(&self, items: &Items, references: &[Reference], spare: usize) -> [Vec<Reference>; 2] {
        let mut halves = self.sides.map(|side| Vec::with_capacity(side.count));
        let [mut low, mut high] = self.sides;
        let mut spare = spare;
        for reference in references {
            let (min, max) = (reference.bounds.min[self.axis], reference.bounds.max[self.axis]);
            let whole = if max <= self.position {
                Some(0)
            } else if min >= self.position {
                Some(1)
            } else {
                self.cheapest_whole(reference, &mut low, &mut high, spare == 0)
            };
            if let Some(side) = whole {
                halves[side].push(*reference);
                continue;
            }
            spare -= 1;
            let parts = items.split(reference.item, reference.bounds, self.axis, self.position);
            for (half, bounds) in halves.iter_mut().zip(parts) {
                half.push(Reference { bounds, item: reference.item });
            }
        }
        halves
    }

    /// The side that a straddling reference should go to whole; `None` where it should be split.
    fn cheapest_whole(
        &self,
        reference: &Reference,
        low: &mut Side,
        high: &mut Side,
        must: bool,
    ) -> Option<usize> {
        let price = |side: &Side, fewer: usize| side.bounds.half_area() * (side.count - fewer) as f64;
        let grown = |side: &Side| Side { bounds: side.bounds.union(reference.bounds), ..*side };
        let split = if must { f64::INFINITY } else { price(low, 0) + price(high, 0) };
        let below = price(&grown(low), 0) + price(high, 1);
        let above = price(low, 1) + price(&grown(high), 0);
        if split <= below && split <= above {
            return None;
        }
        if below <= above {
            (*low, high.count) = (grown(low), high.count - 1);
            Some(0)
        } else {
            (*high, low.count) = (grown(high), low.count - 1);
            Some(1)
        }
    }
}
