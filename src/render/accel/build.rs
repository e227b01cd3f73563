//! The partition that minimises the expected price of a ray: space is split, or objects are divided, whichever is cheaper.
//!
//! Where the boxes of two sets of objects would overlap, planes that split space are tried too; references that straddle
//! such a plane are clipped to both sides, as in a kd-tree (Stich, Friedrich, Dietrich 2009). Duplicates have a budget,
//! so the memory of any scene is linear in its size. Subtrees are independent of each other: any number of threads
//! builds the same tree.

use super::clip;
use super::objects::{self, ObjectSplit};
use super::sah::{self, TRAVERSAL_COST};
use super::spatial::{self, SpatialSplit};
use super::wide::MAX_BLOCKS;
use crate::math::{Bounds, Vec3};
use crate::render::shape::triangle::LANES;

/// Below this many references a subtree is built on one thread.
const PARALLEL_ABOVE: usize = 2048;
/// Planes are tried where two sets of objects share at least this part of the area of everything (Stich et al. 2009, section 4.5),
const OVERLAP_OF_ALL: f64 = 1e-5;
/// and at least this part of the area of their own cell: less is the width of a triangle, which no plane makes smaller.
const OVERLAP_OF_CELL: f64 = 0.3;

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

    /// The boxes around the parts of an item, of which `bounds` holds what counts, on both sides of a plane.
    pub fn split(&self, item: u32, bounds: Bounds, axis: usize, position: f32) -> [Bounds; 2] {
        match self.triangles.get(item as usize) {
            Some(corners) => clip::split(*corners, bounds, axis, position),
            None => bounds.split(axis, position),
        }
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

impl Reference {
    /// Twice the coordinate of the middle of its box.
    #[inline(always)]
    pub fn twice_center(&self, axis: usize) -> f32 {
        self.bounds.min[axis] + self.bounds.max[axis]
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

impl Cell {
    /// The box around the parts of all items that lie in the cell; empty when there are none.
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Inner { bounds, .. } | Self::Leaf { bounds, .. } => *bounds,
        }
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
    2 * count + 1000
}

/// Finds a partition for `items`.
pub fn partition(items: &Items) -> Partition {
    let count = items.count();
    let mut references: Vec<_> =
        (0..count as u32).map(|item| Reference { bounds: items.bounds(item), item }).collect();
    let bounds = bounds_of(&references);
    let builder = Builder { items, area: bounds.half_area() };
    let spare = reference_limit(count) - count;
    let root =
        builder.build(Task { references: &mut references, bounds, depth_left: depth_limit(count), spare });
    Partition { root, bounds }
}

fn bounds_of(references: &[Reference]) -> Bounds {
    references.iter().fold(Bounds::EMPTY, |all, reference| all.union(reference.bounds))
}

/// A cell to be split.
struct Task<'a> {
    references: &'a mut [Reference],
    bounds: Bounds,
    depth_left: usize,
    /// How many more references there may be in the leaves below.
    spare: usize,
}

struct Builder<'a> {
    items: &'a Items<'a>,
    /// Of the box around everything.
    area: f64,
}

/// The cheapest way to split a cell.
enum Split {
    Objects(ObjectSplit),
    Space(SpatialSplit),
}

impl Builder<'_> {
    fn build(&self, task: Task) -> Cell {
        let count = task.references.len();
        if count <= 1 {
            return leaf(task.references, task.bounds);
        }
        // What is too much for a leaf is halved over and over where no more than the needed levels are left.
        let fits = self.fits_a_leaf(task.references);
        if task.depth_left <= count.ilog2() as usize + 1 {
            return if fits { leaf(task.references, task.bounds) } else { self.halve(task) };
        }
        let area = task.bounds.half_area();
        let price_of_leaf = if fits { area * sah::leaf_cost(count) } else { f64::INFINITY };
        match self.choose(&task) {
            Some((split, cost)) if cost + area * TRAVERSAL_COST < price_of_leaf => self.divide(task, &split),
            _ if fits => leaf(task.references, task.bounds),
            _ => self.halve(task),
        }
    }

    fn fits_a_leaf(&self, references: &[Reference]) -> bool {
        let is_solid = |reference: &&Reference| reference.item as usize >= self.items.triangles.len();
        let count = references.len();
        count <= MAX_BLOCKS * LANES
            && (self.items.boxes.is_empty() || references.iter().filter(is_solid).count() <= 1)
    }

    /// The cheapest split and its price, without that of choosing a side; `None` where nothing tells the items apart.
    fn choose(&self, task: &Task) -> Option<(Split, f64)> {
        let objects = objects::divide(task.references);
        let shared = objects.map_or(f64::INFINITY, |split| split.overlap().half_area());
        let enough = (self.area * OVERLAP_OF_ALL).max(task.bounds.half_area() * OVERLAP_OF_CELL);
        let space = (task.spare > 0 && shared >= enough)
            .then(|| spatial::best(self.items, task.references, task.bounds))
            .flatten();
        match (objects, space) {
            (Some(objects), Some(space)) if objects.cost <= space.cost => {
                Some((Split::Objects(objects), objects.cost))
            }
            (_, Some(space)) => Some((Split::Space(space), space.cost)),
            (Some(objects), None) => Some((Split::Objects(objects), objects.cost)),
            (None, None) => None,
        }
    }

    fn divide(&self, task: Task, split: &Split) -> Cell {
        match split {
            Split::Objects(split) => {
                let border = partition_in_place(task.references, |reference| split.is_below(reference));
                let bounds = split.sides.map(|side| side.bounds);
                let (below, above) = task.references.split_at_mut(border);
                self.join([below, above], bounds, task.depth_left, task.spare)
            }
            Split::Space(split) => {
                let mut halves = split.divide(self.items, task.references, task.spare);
                let fresh = (halves[0].len() + halves[1].len()) - task.references.len();
                if halves.iter().any(|half| half.is_empty()) {
                    return self.halve(task);
                }
                let bounds = [bounds_of(&halves[0]), bounds_of(&halves[1])];
                let [below, above] = &mut halves;
                self.join([below, above], bounds, task.depth_left, task.spare - fresh)
            }
        }
    }

    /// Two halves of as many references each, whatever lies where.
    fn halve(&self, task: Task) -> Cell {
        let middle = task.references.len() / 2;
        let (below, above) = task.references.split_at_mut(middle);
        let bounds = [bounds_of(below), bounds_of(above)];
        self.join([below, above], bounds, task.depth_left, 0)
    }

    /// Builds two halves, at the same time if they are large, under one node.
    fn join(
        &self,
        [below, above]: [&mut [Reference]; 2],
        bounds: [Bounds; 2],
        depth_left: usize,
        spare: usize,
    ) -> Cell {
        // What the budget leaves for duplicates is shared in proportion.
        let count = below.len() + above.len();
        let spare_below = (spare as u128 * below.len() as u128 / count as u128) as usize;
        let depth_left = depth_left - 1;
        let low = Task { references: below, bounds: bounds[0], depth_left, spare: spare_below };
        let high = Task { references: above, bounds: bounds[1], depth_left, spare: spare - spare_below };
        let children = if count > PARALLEL_ABOVE {
            rayon::join(|| self.build(low), || self.build(high))
        } else {
            (self.build(low), self.build(high))
        };
        let bounds = bounds[0].union(bounds[1]);
        Cell::Inner { children: Box::new(children.into()), bounds }
    }
}

fn leaf(references: &[Reference], bounds: Bounds) -> Cell {
    let mut items: Vec<_> = references.iter().map(|reference| reference.item).collect();
    items.sort_unstable();
    Cell::Leaf { items, bounds }
}

/// Moves what `is_below` to the front; returns how many those are.
fn partition_in_place(references: &mut [Reference], is_below: impl Fn(&Reference) -> bool) -> usize {
    let (mut low, mut high) = (0, references.len());
    loop {
        while low < high && is_below(&references[low]) {
            low += 1;
        }
        while low < high && !is_below(&references[high - 1]) {
            high -= 1;
        }
        if low == high {
            return low;
        }
        references.swap(low, high - 1);
    }
}
