//! The partition in the shape that rays like: nodes of eight boxes.
//!
//! Binary nodes cost a dependent load and a poorly predicted branch each. Eight cells side by side, each with the box
//! around what it really holds, are tested at once, and entered in the order in which the ray enters them.

use super::build::{Cell, Items, partition};
use super::collapse::Plan;
use super::kernel::Portable;
#[cfg(target_arch = "x86_64")]
use super::simd::Avx2;
use super::walk::{Query, walk};
use crate::math::{Bounds, Ray, Vec3};
use crate::render::geometry::Nearest;
use crate::render::shape::triangle::{LANES, TriangleBlock};
use std::ops::Range;

/// Children of a node.
pub const WIDTH: usize = 8;
/// The most blocks of triangles in a leaf.
pub const MAX_BLOCKS: usize = 6;

/// A number for each child of a node.
pub type Row = [f32; WIDTH];

/// A child of a node: 3 bits that say what it is, 29 that say where.
///
/// 0 stands for a node, 1 to 6 for so many blocks of triangles, 7 for something else in a box.
#[derive(Clone, Copy, Debug, Default)]
pub struct Child(u32);

/// What a [`Child`] stands for, and its place among those.
pub enum Kind {
    /// A node.
    Node(usize),
    /// A leaf of triangles.
    Blocks(Range<usize>),
    /// Something else, by its number.
    Boxed(u32),
}

impl Child {
    /// The node from which every ray starts.
    pub const ROOT: Self = Self(0);
    const BOXED: usize = 7;

    fn new(first: usize, tag: usize) -> Self {
        assert!(first < 1 << 29 && tag <= Self::BOXED, "fewer than 2²⁹ nodes and blocks");
        Self((first as u32) << 3 | tag as u32)
    }

    /// What it is.
    #[inline(always)]
    pub fn kind(self) -> Kind {
        let (first, tag) = ((self.0 >> 3) as usize, (self.0 & 7) as usize);
        match tag {
            0 => Kind::Node(first),
            Self::BOXED => Kind::Boxed(first as u32),
            _ => Kind::Blocks(first..first + tag),
        }
    }
}

/// Eight boxes. Unused ones are empty, and no ray meets them.
#[derive(Clone)]
#[repr(align(64))]
pub struct Node {
    /// The lower faces along x, y, z, then the upper ones.
    pub faces: [Row; 6],
    /// What is in each box.
    pub children: [Child; WIDTH],
}

/// The tree that rays are traced against.
pub struct Wide {
    pub(super) nodes: Vec<Node>,
    pub(super) blocks: Vec<TriangleBlock>,
    bounds: Bounds,
    /// The most entries that a stack can hold.
    stack: usize,
    #[cfg(target_arch = "x86_64")]
    avx2: Option<Avx2>,
}

impl Wide {
    /// The tree over `triangles` and `boxes` of other things, the number of each of which is in `boxed`.
    pub fn new(triangles: &[[Vec3; 3]], boxes: &[Bounds], boxed: &[u32]) -> Self {
        let partition = partition(&Items { triangles, boxes });
        let mut wide = Self {
            nodes: vec![Node::EMPTY],
            blocks: Vec::new(),
            bounds: partition.bounds,
            stack: 0,
            #[cfg(target_arch = "x86_64")]
            avx2: Avx2::detect(),
        };
        let plan = Plan::new(&partition.root, triangles.len());
        let depth = wide.fill(0, &plan, triangles, boxed);
        wide.stack = depth * (WIDTH - 1) + 1;
        wide
    }

    /// The box around everything.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// What it takes in memory, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.blocks[..])
    }

    /// Fills a node for a cell and appends all below it; returns how many nodes the longest way down passes.
    ///
    /// The leaves of a node lie side by side, and so do the nodes: who needs one soon needs another.
    fn fill(&mut self, index: usize, plan: &Plan, triangles: &[[Vec3; 3]], boxed: &[u32]) -> usize {
        let parts = plan.children();
        let mut lane = 0;
        let first_inner = self.nodes.len();
        let is_inner = |part: &&&Plan| matches!(part.cell, Cell::Inner { .. });
        let inner_count = parts.iter().filter(is_inner).count();
        self.nodes.resize(first_inner + inner_count, Node::EMPTY);
        let mut inner = first_inner..;
        for part in &parts {
            let children = match (part.cell, &mut inner) {
                (Cell::Inner { .. }, inner) => {
                    inner.next().map(|node| Child::new(node, 0)).into_iter().collect()
                }
                (Cell::Leaf { items, .. }, _) => self.leaf(items, triangles, boxed),
            };
            for child in children {
                self.nodes[index].set(lane, child, part.cell.bounds());
                lane += 1;
            }
        }
        let below = parts.iter().filter(is_inner).zip(first_inner..);
        1 + below.map(|(part, node)| self.fill(node, part, triangles, boxed)).max().unwrap_or(0)
    }

    /// Appends the contents of a leaf: a child for its triangles, one for each of its boxes.
    fn leaf(&mut self, items: &[u32], triangles: &[[Vec3; 3]], boxed: &[u32]) -> Vec<Child> {
        let (meshed, others) =
            items.split_at(items.partition_point(|&item| (item as usize) < triangles.len()));
        let first = self.blocks.len();
        for four in meshed.chunks(LANES) {
            let four: Vec<_> = four.iter().map(|&item| (triangles[item as usize], item)).collect();
            self.blocks.push(TriangleBlock::new(&four));
        }
        let blocks = self.blocks.len() - first;
        let meshed = (blocks > 0).then(|| Child::new(first, blocks));
        let others = others.iter().map(|&item| boxed[item as usize - triangles.len()] as usize);
        meshed.into_iter().chain(others.map(|number| Child::new(number, Child::BOXED))).collect()
    }

    /// Makes the tree use the code for any processor.
    pub fn without_simd(&mut self) {
        #[cfg(target_arch = "x86_64")]
        {
            self.avx2 = None;
        }
    }

    /// The most entries that a stack can hold.
    pub(super) fn stack(&self) -> usize {
        self.stack
    }

    /// Offers to `nearest` what can come before it; with `ANY`, stops at the first that does.
    ///
    /// The primitives of triangles count from `first_prim`; `hit_boxed` does the same for what is in a box, by its number.
    #[inline]
    pub fn trace<const ANY: bool>(
        &self,
        ray: &Ray,
        first_prim: u32,
        nearest: &mut Nearest,
        hit_boxed: impl Fn(u32, &mut Nearest),
    ) {
        let query = Query { tree: self, ray, first_prim, hit_boxed: &hit_boxed };
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = self.avx2 {
            #[cfg(feature = "naive")]
            if super::simd::naive::walk_naively::<ANY>(avx2, &query, nearest) {
                return;
            }
            return avx2.walk::<ANY>(&query, nearest);
        }
        walk::<Portable, ANY>(Portable, &query, nearest);
    }
}

impl Node {
    const EMPTY: Self = Self {
        faces: [
            [f32::INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
        ],
        children: [Child::ROOT; WIDTH],
    };

    fn set(&mut self, lane: usize, child: Child, bounds: Bounds) {
        for axis in 0..3 {
            self.faces[axis][lane] = bounds.min[axis];
            self.faces[axis + 3][lane] = bounds.max[axis];
        }
        self.children[lane] = child;
    }
}
