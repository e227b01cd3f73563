//! What a ray is expected to cost: the surface area heuristic (MacDonald, Booth 1990).
//!
//! Prices are those of a ray known to meet the box in question, times the box's area, so that they can be added.

use crate::math::Bounds;
use crate::render::shape::triangle::LANES;

/// The price of choosing between two halves; that of a block of triangles is 1.
///
/// Less than it would be for a tree of binary nodes, seven of which become one that tests eight boxes at once.
pub const TRAVERSAL_COST: f64 = 0.4;

/// The price of a leaf with `count` references, whose blocks are filled from the first.
pub fn leaf_cost(count: usize) -> f64 {
    count.div_ceil(LANES) as f64
}

/// What one side of a split holds.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// How many references.
    pub count: usize,
    /// The box around them.
    pub bounds: Bounds,
}

impl Side {
    /// Nothing.
    pub const EMPTY: Self = Self { count: 0, bounds: Bounds::EMPTY };

    /// Adds references within `bounds`.
    pub fn add(&mut self, count: usize, bounds: Bounds) {
        self.count += count;
        self.bounds = self.bounds.union(bounds);
    }

    /// The price of what lies here, were it a leaf.
    pub fn cost(&self) -> f64 {
        self.bounds.half_area() * leaf_cost(self.count)
    }
}

/// The cheapest place between slots, `costs` being those of both sides together: its price and the first slot above.
///
/// `None` where one side is always empty.
pub fn best_border(below: &[Side], above: &[Side]) -> Option<(f64, usize)> {
    let mut best: Option<(f64, usize)> = None;
    // Costs of all above each slot, then of all below, one more at a time.
    for border in 1..below.len() {
        let (low, high) = (&below[border - 1], &above[border]);
        let cost = low.cost() + high.cost();
        if low.count > 0 && high.count > 0 && best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, border));
        }
    }
    best
}
