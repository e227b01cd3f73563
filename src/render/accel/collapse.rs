//! Which cells of the binary partition become the children of one wide node.
//!
//! For each cell, bottom up: the least price of showing it as at most 1, 2, … 8 children of the node above it. The best
//! choice at the root then contains the best choices below (Ylitie, Karras, Laine 2017, section 3.1).

use super::build::Cell;
use super::sah::leaf_cost;
use super::wide::WIDTH;

/// The price of testing a ray against a node; that of a block of triangles is 1.
const NODE_COST: f64 = 1.2;

/// A cell with its best choices.
pub struct Plan<'a> {
    /// The cell.
    pub cell: &'a Cell,
    choices: Choices<'a>,
}

/// Half of the cells are leaves, of which little is to be said: for a million triangles that saves 20 MB where memory peaks.
enum Choices<'a> {
    /// How many lanes a leaf takes, and its price.
    Leaf { lanes: u8, price: f64 },
    /// Of a cell that is divided.
    Inner(Box<Inner<'a>>),
}

struct Inner<'a> {
    /// For each number of lanes, the least price if the cell takes at most so many of the node above.
    cost: [f64; WIDTH + 1],
    /// For each number of lanes, how many of them the first half of the cell gets; `None` if the cell takes one, undivided.
    share: [Option<u8>; WIDTH + 1],
    /// How many lanes of the cell's own node its first half gets.
    below: u8,
    halves: [Plan<'a>; 2],
}

impl<'a> Plan<'a> {
    /// Plans for a cell whose items below `first_solid` are triangles.
    pub fn new(cell: &'a Cell, first_solid: usize) -> Self {
        match cell {
            Cell::Leaf { items, .. } => Self::leaf(cell, items, first_solid),
            Cell::Inner { children, .. } => {
                let halves = [0, 1].map(|i| Plan::new(&children[i], first_solid));
                Self::inner(cell, halves)
            }
        }
    }

    /// A leaf takes a lane for its triangles and one for its solids; none if it is empty.
    fn leaf(cell: &'a Cell, items: &[u32], first_solid: usize) -> Self {
        let triangles = items.partition_point(|&item| (item as usize) < first_solid);
        let lanes = usize::from(triangles > 0) + usize::from(triangles < items.len());
        let price = cell.bounds().half_area() * leaf_cost(items.len());
        Self { cell, choices: Choices::Leaf { lanes: lanes as u8, price } }
    }

    /// The least price if the cell takes at most so many lanes of the node above.
    fn cost(&self, most: usize) -> f64 {
        match self.choices {
            Choices::Leaf { lanes, price } if usize::from(lanes) <= most => price,
            Choices::Leaf { .. } => f64::INFINITY,
            Choices::Inner(ref inner) => inner.cost[most],
        }
    }

    fn inner(cell: &'a Cell, halves: [Self; 2]) -> Self {
        let divide = |lanes: usize| {
            let price = |first: usize| halves[0].cost(first) + halves[1].cost(lanes - first);
            let first = (0..=lanes).min_by(|&a, &b| price(a).total_cmp(&price(b))).unwrap_or(0);
            (price(first), first as u8)
        };
        let (mut cost, mut share) = ([f64::INFINITY; WIDTH + 1], [None; WIDTH + 1]);
        // As a node of its own it has all lanes below; those above it are then free for others.
        let (price_below, below) = divide(WIDTH);
        let undivided = price_below + cell.bounds().half_area() * NODE_COST;
        for lanes in 0..=WIDTH {
            let (price, first) = divide(lanes);
            (cost[lanes], share[lanes]) = (price, Some(first));
            if lanes >= 1 && undivided <= cost[lanes] {
                (cost[lanes], share[lanes]) = (undivided, None);
            }
        }
        Self { cell, choices: Choices::Inner(Box::new(Inner { cost, share, below, halves })) }
    }

    /// The cells that become the children of this cell's node.
    pub fn children(&self) -> Vec<&Self> {
        let mut children = Vec::with_capacity(WIDTH);
        match &self.choices {
            Choices::Inner(inner) => inner.spread(inner.below, WIDTH, &mut children),
            Choices::Leaf { .. } => children.push(self),
        }
        children
    }

    /// Collects what this cell shows as in at most `lanes` lanes.
    fn spread<'b>(&'b self, lanes: usize, children: &mut Vec<&'b Self>) {
        if let Choices::Inner(inner) = &self.choices
            && let Some(first) = inner.share[lanes]
        {
            inner.spread(first, lanes, children);
        } else {
            children.push(self);
        }
    }
}

impl<'a> Inner<'a> {
    /// Collects what both halves show as, if the first one gets `first` of the lanes.
    fn spread<'b>(&'b self, first: u8, lanes: usize, children: &mut Vec<&'b Plan<'a>>) {
        let first = usize::from(first);
        self.halves[0].spread(first, children);
        self.halves[1].spread(lanes - first, children);
    }
}
