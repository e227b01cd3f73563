//! Where to split: the surface area heuristic (MacDonald, Booth 1990), exact and binned.

use super::build::{Event, EventKind, Reference};
use crate::math::Bounds;
use crate::render::shape::triangle::LANES;

/// The price of visiting an inner node; that of a leaf's block of triangles is 1.
const TRAVERSAL_COST: f64 = 1.0;
/// The factor on the price of a split that cuts off empty space (Wald, Havran 2006, section 3.2).
const EMPTY_BONUS: f64 = 0.8;
/// Planes tried along an axis where the sweep would be too dear.
const PLANES: usize = 64;
/// Slots along an axis into which objects are sorted where they are divided.
const SLOTS: usize = 32;

/// A plane that splits a cell.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Split {
    /// The axis that the plane is orthogonal to.
    pub axis: usize,
    /// Where it cuts that axis; NaN where the cell is divided by objects.
    pub position: f32,
    /// Whether references that lie in the plane go below it.
    pub planar_below: bool,
    /// The expected price of a ray through the cell, split so.
    pub cost: f64,
}

/// The price of a leaf with `count` references.
pub fn leaf_cost(count: usize) -> f64 {
    count.div_ceil(LANES) as f64
}

/// The best plane among those through the faces of the references' boxes; infinitely dear if there is none.
///
/// `events` holds the faces, sorted, for each axis (Wald, Havran 2006, algorithm 4).
pub fn sweep(cell: Bounds, count: usize, events: &[Vec<Event>; 3]) -> Split {
    let mut best = Chooser::new(cell);
    for (axis, events) in events.iter().enumerate() {
        let (mut below, mut above) = (0, count);
        let mut i = 0;
        while i < events.len() {
            let position = events[i].position;
            let mut run = |kind| {
                let first = i;
                while i < events.len() && events[i].position == position && events[i].kind == kind {
                    i += 1;
                }
                i - first
            };
            let ends = run(EventKind::End);
            let planar = run(EventKind::Planar);
            let starts = run(EventKind::Start);
            above -= ends + planar;
            best.consider(axis, position, [below, above], planar);
            below += starts + planar;
        }
    }
    best.split
}

/// The best of a few dozen planes: evenly spaced ones, and faces of references picked here and there, which find
/// their way into small clusters of large scenes.
pub fn binned(cell: Bounds, references: &[Reference]) -> Split {
    let mut best = Chooser::new(cell);
    for axis in 0..3 {
        let planes = candidates(cell, references, axis);
        let (mut starts, mut ends) = ([0_usize; PLANES + 1], [0_usize; PLANES + 1]);
        for Reference { bounds, .. } in references {
            starts[planes.partition_point(|plane| *plane <= bounds.min[axis])] += 1;
            ends[planes.partition_point(|plane| *plane < bounds.max[axis])] += 1;
        }
        let (mut below, mut above) = (0, references.len());
        for (i, plane) in planes.into_iter().enumerate() {
            below += starts[i];
            above -= ends[i];
            best.consider(axis, plane, [below, above], 0);
        }
    }
    best.split
}

/// Planes to try along an axis, in increasing order.
fn candidates(cell: Bounds, references: &[Reference], axis: usize) -> [f32; PLANES] {
    let (min, size) = (cell.min[axis], cell.size()[axis]);
    let mut planes = [0.0; PLANES];
    for (i, pair) in planes.chunks_exact_mut(2).enumerate() {
        pair[0] = min + size * ((i + 1) as f32 / (PLANES / 2 + 1) as f32);
        let picked = references[i * references.len() / (PLANES / 2)].bounds;
        pair[1] = if i % 2 == 0 { picked.min[axis] } else { picked.max[axis] };
    }
    planes.sort_unstable_by(f32::total_cmp);
    planes
}

/// A way to divide references into two sets with boxes of their own.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ObjectSplit {
    slots: Slots,
    /// The first slot above.
    first_above: usize,
    /// The expected price of a ray through the cell, divided so.
    pub cost: f64,
}

/// Slots of equal width for the centres of boxes along an axis.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Slots {
    axis: usize,
    low: f32,
    scale: f32,
}

impl Slots {
    fn new(references: &[Reference], axis: usize) -> Self {
        let centers = references.iter().map(|reference| twice_center(reference, axis));
        let (low, high) =
            centers.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), c| (low.min(c), high.max(c)));
        Self { axis, low, scale: SLOTS as f32 / (high - low) }
    }

    /// The slot of a reference; all are in the first where centres do not differ.
    fn of(&self, reference: &Reference) -> usize {
        (((twice_center(reference, self.axis) - self.low) * self.scale) as usize).min(SLOTS - 1)
    }
}

fn twice_center(reference: &Reference, axis: usize) -> f32 {
    reference.bounds.min[axis] + reference.bounds.max[axis]
}

impl ObjectSplit {
    /// Whether a reference goes to the first set.
    pub fn is_below(&self, reference: &Reference) -> bool {
        self.slots.of(reference) < self.first_above
    }
}

/// The best division by the centres of boxes (Wald 2007); `None` where all centres fall together.
pub fn divide_objects(references: &[Reference]) -> Option<ObjectSplit> {
    let area =
        references.iter().fold(Bounds::EMPTY, |all, reference| all.union(reference.bounds)).half_area();
    let mut best: Option<ObjectSplit> = None;
    for axis in 0..3 {
        let slots = Slots::new(references, axis);
        let mut filled = [(0, Bounds::EMPTY); SLOTS];
        for reference in references {
            let (count, bounds) = &mut filled[slots.of(reference)];
            *count += 1;
            *bounds = bounds.union(reference.bounds);
        }
        // The price of everything above each slot, then that of everything below.
        let mut above = [0.0; SLOTS];
        let (mut count, mut bounds) = (0, Bounds::EMPTY);
        for i in (1..SLOTS).rev() {
            count += filled[i].0;
            bounds = bounds.union(filled[i].1);
            above[i] = bounds.half_area() * leaf_cost(count);
        }
        (count, bounds) = (0, Bounds::EMPTY);
        for i in 1..SLOTS {
            count += filled[i - 1].0;
            bounds = bounds.union(filled[i - 1].1);
            let cost = TRAVERSAL_COST + (bounds.half_area() * leaf_cost(count) + above[i]) / area;
            if 0 < count && count < references.len() && best.is_none_or(|best| cost < best.cost) {
                best = Some(ObjectSplit { slots, first_above: i, cost });
            }
        }
    }
    best
}

/// Keeps the cheapest plane seen.
struct Chooser {
    cell: Bounds,
    inverse_area: f64,
    split: Split,
}

impl Chooser {
    fn new(cell: Bounds) -> Self {
        let split = Split { axis: 0, position: f32::NAN, planar_below: true, cost: f64::INFINITY };
        Self { cell, inverse_area: 1.0 / cell.half_area(), split }
    }

    /// Weighs the plane, its planar references on either side; planes through the faces of the cell do not split it.
    fn consider(&mut self, axis: usize, position: f32, [below, above]: [usize; 2], planar: usize) {
        if !(self.cell.min[axis] < position && position < self.cell.max[axis]) {
            return;
        }
        // The area of a slab is that of its face and of its rim, which grows with its thickness.
        let size = self.cell.size().as_dvec3();
        let (width, height) = (size[(axis + 1) % 3], size[(axis + 2) % 3]);
        let share = |thickness: f64| (width * height + (width + height) * thickness) * self.inverse_area;
        let low = share(f64::from(position) - f64::from(self.cell.min[axis]));
        let high = share(f64::from(self.cell.max[axis]) - f64::from(position));
        let mut weigh = |below: usize, above: usize, planar_below: bool| {
            let bonus = if below == 0 || above == 0 { EMPTY_BONUS } else { 1.0 };
            let cost = bonus * (TRAVERSAL_COST + low * leaf_cost(below) + high * leaf_cost(above));
            if cost < self.split.cost {
                self.split = Split { axis, position, planar_below, cost };
            }
        };
        weigh(below + planar, above, true);
        if planar > 0 {
            weigh(below, above + planar, false);
        }
    }
}
