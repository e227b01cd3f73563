//! Splitting space: the kd partition that minimises the expected price of a ray.
//!
//! Large cells choose among evenly spaced planes; below a few thousand references the exact sweep takes over, whose
//! sorted events are handed down rather than sorted again (Wald, Havran 2006). References that straddle a plane are
//! clipped to both sides. A cell whose share of the reference budget is used up is divided by objects instead, so the
//! memory of any scene is linear in its size. Subtrees are independent of each other: any number of threads builds the same tree.

use super::clip::clip;
use super::sah::{self, Split};
use crate::math::{Bounds, Vec3};
use crate::render::shape::triangle::LANES;
use std::cmp::Ordering;

/// Below this many references a cell is split by the exact sweep.
const EXACT_BELOW: usize = 4096;
/// Below this many references a subtree is built on one thread.
const PARALLEL_ABOVE: usize = 2048;

/// What the tree is built over: triangles first, then boxes of solids.
pub struct Items<'a> {
    /// World-space corners.
    pub triangles: &'a [[Vec3; 3]],
    /// Boxes of what is not a triangle.
    pub boxes: &'a [Bounds],
}

impl Items<'_> {
    fn count(&self) -> usize {
        self.triangles.len() + self.boxes.len()
    }

    fn bounds(&self, item: u32) -> Bounds {
        match self.triangles.get(item as usize) {
            Some(corners) => Bounds::of(*corners),
            None => self.boxes[item as usize - self.triangles.len()],
        }
    }

    /// The box around the part of an item that lies in `cell`.
    fn clip(&self, item: u32, cell: Bounds) -> Bounds {
        self.triangles.get(item as usize).map_or(cell, |corners| clip(*corners, cell))
    }
}

/// An item in a cell.
#[derive(Clone, Copy, Debug)]
pub struct Reference {
    /// The box around the part of it that lies in the cell.
    pub bounds: Bounds,
    /// Which.
    pub item: u32,
}

/// The order in which the sweep counts faces at the same place.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum EventKind {
    /// A box ends.
    End,
    /// A box without thickness.
    Planar,
    /// A box begins.
    Start,
}

/// A face of a reference's box, orthogonal to the axis whose list it is in.
#[derive(Clone, Copy, Debug)]
pub struct Event {
    /// Where it cuts the axis.
    pub position: f32,
    /// The reference, by its place in its cell.
    pub reference: u32,
    /// Which face.
    pub kind: EventKind,
}

impl Event {
    /// By position, then kind; by place last, so that the order is total.
    fn order(&self, other: &Self) -> Ordering {
        let key = |event: &Self| (event.kind, event.reference);
        self.position.total_cmp(&other.position).then_with(|| key(self).cmp(&key(other)))
    }
}

/// A cell of the partition.
pub enum Cell {
    /// Split in two: by a plane, or by objects.
    Inner {
        /// Both parts.
        children: Box<[Cell; 2]>,
        /// The box around the parts of all items that lie in the cell.
        bounds: Bounds,
    },
    /// Not split any more.
    Leaf {
        /// What lies in it, in increasing order.
        items: Vec<u32>,
        /// The box around the parts of the items that lie in it.
        bounds: Bounds,
    },
}

/// The whole partition.
pub struct Partition {
    /// The cell of everything.
    pub root: Cell,
    /// The box around everything.
    pub bounds: Bounds,
}

/// The deepest that a tree over `count` items may become.
pub fn depth_limit(count: usize) -> usize {
    8 + (1.3 * f64::from(count.max(1).ilog2() + 1)) as usize + 6
}

/// The most references that a tree over `count` items may hold.
pub fn reference_limit(count: usize) -> usize {
    8 * count + 1000
}

/// Splits space for `items`.
pub fn partition(items: &Items) -> Partition {
    let count = items.count();
    let references: Vec<_> =
        (0..count as u32).map(|item| Reference { bounds: items.bounds(item), item }).collect();
    let bounds = references.iter().fold(Bounds::EMPTY, |all, reference| all.union(reference.bounds));
    let task = Task {
        cell: bounds,
        references,
        events: None,
        depth_left: depth_limit(count),
        budget: reference_limit(count),
    };
    let root = task.build(items);
    Partition { root, bounds }
}

impl Cell {
    /// The box around the parts of all items that lie in the cell; empty when there are none.
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Inner { bounds, .. } | Self::Leaf { bounds, .. } => *bounds,
        }
    }

    /// Builds two tasks, at the same time if they are large, under one node.
    fn join([low, high]: [Task; 2], build: impl Fn(Task) -> Self + Sync) -> Self {
        let children = if low.references.len() + high.references.len() > PARALLEL_ABOVE {
            rayon::join(|| build(low), || build(high))
        } else {
            (build(low), build(high))
        };
        let bounds = children.0.bounds().union(children.1.bounds());
        Self::Inner { children: Box::new(children.into()), bounds }
    }

    /// Inner nodes on the longest way down.
    pub fn depth(&self) -> usize {
        match self {
            Self::Inner { children, .. } => 1 + children[0].depth().max(children[1].depth()),
            Self::Leaf { .. } => 0,
        }
    }

    /// References in all leaves.
    pub fn references(&self) -> usize {
        match self {
            Self::Inner { children, .. } => children[0].references() + children[1].references(),
            Self::Leaf { items, .. } => items.len(),
        }
    }
}

/// A cell to be split.
struct Task {
    cell: Bounds,
    references: Vec<Reference>,
    /// Sorted faces along each axis, once the cell is small enough for the exact sweep.
    events: Option<[Vec<Event>; 3]>,
    depth_left: usize,
    /// The most references that the leaves below may hold together.
    budget: usize,
}

impl Task {
    fn build(mut self, items: &Items) -> Cell {
        let count = self.references.len();
        if count <= 1 || self.depth_left == 0 {
            return self.leaf();
        }
        let split = self.choose_split();
        if split.cost >= sah::leaf_cost(count) {
            return self.leaf();
        }
        let sides: Vec<_> = self.references.iter().map(|reference| Side::of(reference, &split)).collect();
        let straddling = sides.iter().filter(|side| **side == Side::Both).count();
        if count + straddling > self.budget {
            return self.divide_objects();
        }
        let tasks = self.divide_space(items, &split, &sides);
        drop((self, sides));
        Cell::join(tasks, |task| task.build(items))
    }

    fn choose_split(&mut self) -> Split {
        if self.references.len() >= EXACT_BELOW {
            return sah::binned(self.cell, &self.references);
        }
        let references = &self.references;
        let events = self
            .events
            .get_or_insert_with(|| [0, 1, 2].map(|axis| sorted_events((0..).zip(references), axis)));
        sah::sweep(self.cell, references.len(), events)
    }

    fn leaf(self) -> Cell {
        let bounds = self.references.iter().fold(Bounds::EMPTY, |all, reference| all.union(reference.bounds));
        let mut items: Vec<_> = self.references.iter().map(|reference| reference.item).collect();
        items.sort_unstable();
        Cell::Leaf { items, bounds }
    }

    /// Both sides of a plane; what straddles it goes to both, clipped.
    fn divide_space(&self, items: &Items, split: &Split, sides: &[Side]) -> [Task; 2] {
        let [low, high] = self.cell.split(split.axis, split.position);
        let mut below = self.half(items, sides, Side::Below, low);
        let mut above = self.half(items, sides, Side::Above, high);
        // What the budget leaves for more duplicates is shared in proportion.
        let (low, high) = (below.references.len(), above.references.len());
        let spare = (self.budget - low - high) as u128;
        below.budget = low + (spare * low as u128 / (low + high) as u128) as usize;
        above.budget = self.budget - below.budget;
        [below, above]
    }

    /// What reaches one side of the plane, with its faces still sorted.
    fn half(&self, items: &Items, sides: &[Side], wanted: Side, cell: Bounds) -> Task {
        let mut references = Vec::with_capacity(sides.len());
        let mut clipped = Vec::new();
        // The place of each reference that is here whole, for the events that it keeps.
        let mut places = vec![u32::MAX; sides.len()];
        for ((reference, side), place) in self.references.iter().zip(sides).zip(&mut places) {
            if *side == wanted {
                *place = references.len() as u32;
                references.push(*reference);
            } else if *side == Side::Both {
                let bounds = items.clip(reference.item, reference.bounds.intersection(cell));
                clipped.push(references.len() as u32);
                references.push(Reference { bounds, item: reference.item });
            }
        }
        let events = self.events.as_ref().map(|events| {
            [0, 1, 2].map(|axis| {
                let fresh = sorted_events(clipped.iter().map(|&i| (i, &references[i as usize])), axis);
                let mut kept = still_here(&events[axis], &places);
                merge(&mut kept, &fresh);
                kept
            })
        });
        Task { cell, references, events, depth_left: self.depth_left - 1, budget: 0 }
    }

    /// Two halves of the objects in the same space, where the SAH over boxes of objects wants it.
    fn divide_objects(self) -> Cell {
        let count = self.references.len();
        if count <= LANES || self.depth_left == 0 {
            return self.leaf();
        }
        let Some(split) = sah::divide_objects(&self.references) else { return self.leaf() };
        if split.cost >= sah::leaf_cost(count) {
            return self.leaf();
        }
        let (below, above): (Vec<_>, Vec<_>) =
            self.references.into_iter().partition(|reference| split.is_below(reference));
        let tasks = [below, above].map(|references| Task {
            cell: self.cell,
            references,
            events: None,
            depth_left: self.depth_left - 1,
            budget: 0,
        });
        Cell::join(tasks, Task::divide_objects)
    }
}

/// Where a reference goes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Below,
    Above,
    Both,
}

impl Side {
    fn of(reference: &Reference, split: &Split) -> Self {
        let (min, max) = (reference.bounds.min[split.axis], reference.bounds.max[split.axis]);
        let planar = min == split.position && max == split.position;
        if planar && !split.planar_below {
            Self::Above
        } else if max <= split.position {
            Self::Below
        } else if min >= split.position {
            Self::Above
        } else {
            Self::Both
        }
    }
}

/// The faces of references, with their places, along an axis, in the order of the sweep.
fn sorted_events<'a>(references: impl Iterator<Item = (u32, &'a Reference)>, axis: usize) -> Vec<Event> {
    let mut events = Vec::with_capacity(references.size_hint().0 * 2);
    for (place, reference) in references {
        let (min, max) = (reference.bounds.min[axis], reference.bounds.max[axis]);
        let event = |position, kind| Event { position, reference: place, kind };
        if min == max {
            events.push(event(min, EventKind::Planar));
        } else {
            events.push(event(min, EventKind::Start));
            events.push(event(max, EventKind::End));
        }
    }
    events.sort_unstable_by(Event::order);
    events
}

/// The faces of the references that have a place, which they take on.
fn still_here(events: &[Event], places: &[u32]) -> Vec<Event> {
    let mut kept = events.to_vec();
    let mut count = 0;
    // Each event is written, and only the count depends on its fate: which is next cannot be predicted.
    for i in 0..kept.len() {
        let event = kept[i];
        let reference = places[event.reference as usize];
        kept[count] = Event { reference, ..event };
        count += usize::from(reference != u32::MAX);
    }
    kept.truncate(count);
    kept
}

/// Merges sorted faces into others, from the last to the first.
fn merge(kept: &mut Vec<Event>, fresh: &[Event]) {
    let (mut i, mut j) = (kept.len(), fresh.len());
    kept.extend_from_slice(fresh);
    let mut slot = kept.len();
    while j > 0 {
        slot -= 1;
        if i > 0 && kept[i - 1].order(&fresh[j - 1]).is_gt() {
            kept[slot] = kept[i - 1];
            i -= 1;
        } else {
            kept[slot] = fresh[j - 1];
            j -= 1;
        }
    }
}
