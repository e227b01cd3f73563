//! Dividing references into two sets, whose boxes may overlap.

use super::build::Reference;
use super::sah::{Side, best_border};
use crate::math::Bounds;

/// The most slots along an axis.
const MAX_SLOTS: usize = 32;

/// A way to divide references into two sets.
#[derive(Clone, Copy, Debug)]
pub struct ObjectSplit {
    slots: Slots,
    /// The first slot above.
    border: usize,
    /// The price of both sets.
    pub cost: f64,
    /// Both sets.
    pub sides: [Side; 2],
}

impl ObjectSplit {
    /// Whether a reference goes to the first set.
    pub fn is_below(&self, reference: &Reference) -> bool {
        self.slots.of(reference) < self.border
    }

    /// The part of space that both sets claim.
    pub fn overlap(&self) -> Bounds {
        self.sides[0].bounds.intersection(self.sides[1].bounds)
    }
}

/// Slots of equal width for the centres of boxes along an axis.
#[derive(Clone, Copy, Debug)]
struct Slots {
    axis: usize,
    low: f32,
    scale: f32,
    last: usize,
}

impl Slots {
    /// The slot of a reference; all are in the first where centres do not differ.
    #[inline(always)]
    fn of(&self, reference: &Reference) -> usize {
        (((reference.twice_center(self.axis) - self.low) * self.scale) as usize).min(self.last)
    }
}

/// The best division by the centres of boxes (Wald 2007); `None` where all centres fall together.
pub fn divide(references: &[Reference]) -> Option<ObjectSplit> {
    let centers = Bounds::of(references.iter().map(|r| r.bounds.min + r.bounds.max));
    // Few references need few slots; the sweep over these would cost more than the references do.
    let count = MAX_SLOTS.min(8 + references.len() / 4);
    let slots = [0, 1, 2].map(|axis| {
        let (low, width) = (centers.min[axis], centers.size()[axis]);
        Slots { axis, low, scale: count as f32 / width, last: count - 1 }
    });
    let mut filled = [[Side::EMPTY; MAX_SLOTS]; 3];
    for reference in references {
        for axis in 0..3 {
            filled[axis][slots[axis].of(reference)].add(1, reference.bounds);
        }
    }
    let mut best: Option<ObjectSplit> = None;
    for axis in 0..3 {
        let (below, above) = running_sums(&filled[axis][..count], &filled[axis][..count]);
        let Some((cost, border)) = best_border(&below[..count], &above[..count]) else { continue };
        if best.is_none_or(|best| cost < best.cost) {
            let sides = [below[border - 1], above[border]];
            best = Some(ObjectSplit { slots: slots[axis], border, cost, sides });
        }
    }
    best
}

/// What lies up to each slot, and from each slot on.
pub fn running_sums(up_to: &[Side], from: &[Side]) -> ([Side; MAX_SLOTS], [Side; MAX_SLOTS]) {
    let (mut below, mut above) = ([Side::EMPTY; MAX_SLOTS], [Side::EMPTY; MAX_SLOTS]);
    let mut sum = Side::EMPTY;
    for (out, slot) in below.iter_mut().zip(up_to) {
        sum.add(slot.count, slot.bounds);
        *out = sum;
    }
    sum = Side::EMPTY;
    for (out, slot) in above[..from.len()].iter_mut().zip(from).rev() {
        sum.add(slot.count, slot.bounds);
        *out = sum;
    }
    (below, above)
}
