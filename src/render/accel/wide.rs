//! The partition in the shape that rays like: nodes of eight boxes.
//!
//! Binary nodes cost a dependent load and a poorly predicted branch each. Eight cells side by side, each with the box
//! around what it really holds, are tested at once; the cells of a kd partition stay disjoint, so the order of
//! entry is the order in space.

use super::build::{Cell, Partition};
use super::collapse::Plan;
use crate::math::{Bounds, Ray, Vec3, float};
use crate::render::geometry::{Hit, Nearest, PrimId};
use crate::render::shape::triangle::{LANES, ShearedRay, TriangleBlock};

/// Children of a node.
pub(super) const WIDTH: usize = 8;
/// Stacks up to this size need no memory from the heap.
const SMALL_STACK: usize = 96;

type Row = [f32; WIDTH];

/// A child of a node: where it begins in its array, and what it is.
#[derive(Clone, Copy, Debug, Default)]
struct Child {
    first: u32,
    /// 0 for a node; so many blocks of triangles; or, negated, so many solids.
    count: i32,
}

/// Eight boxes. Unused ones are empty, and no ray meets them.
#[derive(Clone)]
#[repr(align(64))]
struct Node {
    /// The lower faces along x, y, z, then the upper ones.
    faces: [Row; 6],
    children: [Child; WIDTH],
}

/// The tree that rays are traced against.
pub struct Wide {
    nodes: Vec<Node>,
    blocks: Vec<TriangleBlock>,
    solids: Vec<u32>,
    bounds: Bounds,
    /// The most entries that a stack can hold.
    stack: usize,
}

impl Wide {
    /// Collapses a partition over `triangles` (items by index) and `solids` (the items after them).
    pub fn collapse(partition: &Partition, triangles: &[[Vec3; 3]], solids: &[u32]) -> Self {
        let mut wide = Self {
            nodes: Vec::new(),
            blocks: Vec::new(),
            solids: Vec::new(),
            bounds: partition.bounds,
            stack: 0,
        };
        let plan = Plan::new(&partition.root, triangles.len());
        let depth = wide.node(&plan, triangles, solids);
        wide.stack = depth * (WIDTH - 1) + 1;
        wide
    }

    /// The box around everything.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// What it takes in memory, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.blocks[..]) + size_of_val(&self.solids[..])
    }

    /// Appends a node for a cell and all below it; returns how many nodes the longest way down passes.
    fn node(&mut self, plan: &Plan, triangles: &[[Vec3; 3]], solids: &[u32]) -> usize {
        let index = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        let mut depth = 0;
        let mut lane = 0;
        for part in plan.children() {
            let children = match part.cell {
                Cell::Inner { .. } => {
                    let first = self.nodes.len() as u32;
                    depth = depth.max(self.node(part, triangles, solids));
                    [Some(Child { first, count: 0 }), None]
                }
                Cell::Leaf { items, .. } => self.leaf(items, triangles, solids),
            };
            for child in children.into_iter().flatten() {
                self.nodes[index].set(lane, child, part.cell.bounds());
                lane += 1;
            }
        }
        depth + 1
    }

    /// Appends the contents of a leaf: a child for its triangles, one for its solids.
    fn leaf(&mut self, items: &[u32], triangles: &[[Vec3; 3]], solids: &[u32]) -> [Option<Child>; 2] {
        let (meshed, solid) =
            items.split_at(items.partition_point(|&item| (item as usize) < triangles.len()));
        let (first_block, first_solid) = (self.blocks.len() as u32, self.solids.len() as u32);
        for four in meshed.chunks(LANES) {
            let four: Vec<_> = four.iter().map(|&item| (triangles[item as usize], item)).collect();
            self.blocks.push(TriangleBlock::new(&four));
        }
        self.solids.extend(solid.iter().map(|&item| solids[item as usize - triangles.len()]));
        let blocks = meshed.len().div_ceil(LANES) as i32;
        [
            (blocks > 0).then_some(Child { first: first_block, count: blocks }),
            (!solid.is_empty()).then_some(Child { first: first_solid, count: -(solid.len() as i32) }),
        ]
    }

    /// Offers to `nearest` what can come before it; with `ANY`, stops at the first that does.
    #[inline]
    pub fn trace<const ANY: bool>(
        &self,
        ray: &Ray,
        nearest: &mut Nearest,
        hit_solid: impl Fn(u32, &Ray) -> Option<Hit>,
    ) {
        if self.stack <= SMALL_STACK {
            self.walk::<ANY>(ray, nearest, hit_solid, &mut [Entry::default(); SMALL_STACK]);
        } else {
            self.walk::<ANY>(ray, nearest, hit_solid, &mut vec![Entry::default(); self.stack]);
        }
    }

    #[inline]
    fn walk<const ANY: bool>(
        &self,
        ray: &Ray,
        nearest: &mut Nearest,
        hit_solid: impl Fn(u32, &Ray) -> Option<Hit>,
        stack: &mut [Entry],
    ) {
        let boxes = BoxRay::new(ray);
        let sheared = ShearedRay::new(ray);
        stack[0] = Entry { t: 0.0, child: Child { first: 0, count: 0 } };
        let mut top = 1;
        while top > 0 {
            top -= 1;
            let Entry { t, child: Child { first, count } } = stack[top];
            if t > nearest.t * EXIT_SLACK {
                continue;
            }
            let first = first as usize;
            if count == 0 {
                top = boxes.enter::<ANY>(&self.nodes[first], nearest.t, stack, top);
            } else if count > 0 {
                for block in &self.blocks[first..first + count as usize] {
                    block.intersect(&sheared, |prim, hit| {
                        nearest.offer(Some(Hit { t: hit.t, prim: PrimId(prim), uv: hit.uv }));
                    });
                }
            } else {
                for &solid in &self.solids[first..first + count.unsigned_abs() as usize] {
                    nearest.offer(hit_solid(solid, ray));
                }
            }
            if ANY && nearest.hit.is_some() {
                return;
            }
        }
    }
}

/// A node or leaf yet to be visited, and where the ray enters its box.
#[derive(Clone, Copy, Default)]
struct Entry {
    t: f32,
    child: Child,
}

/// The factor on exit distances that makes up for the rounding of both: 1 + 2γ(3) (Ize 2013).
const EXIT_SLACK: f32 = 1.0 + 2.0 * float::gamma(3);

/// A ray, prepared for boxes.
struct BoxRay {
    o: Vec3,
    inverse: Vec3,
    /// Which row holds the face that the ray meets first along each axis; the other is the one it meets last.
    near: [usize; 3],
    far: [usize; 3],
}

impl BoxRay {
    fn new(ray: &Ray) -> Self {
        let backwards = [0, 1, 2].map(|axis| ray.d[axis].is_sign_negative());
        let near = [0, 1, 2].map(|axis| if backwards[axis] { axis + 3 } else { axis });
        Self { o: ray.o, inverse: ray.d.recip(), near, far: near.map(|row| (row + 3) % 6) }
    }

    /// Pushes the children that the ray meets before `t_max`, the nearest on top; returns the new top.
    ///
    /// For `ANY` the order does not matter.
    #[inline(always)]
    fn enter<const ANY: bool>(&self, node: &Node, t_max: f32, stack: &mut [Entry], mut top: usize) -> usize {
        let mut entry: Row = [0.0; WIDTH];
        let mut exit: Row = [t_max; WIDTH];
        for axis in 0..3 {
            let (near, far) = (&node.faces[self.near[axis]], &node.faces[self.far[axis]]);
            let (o, inverse) = (self.o[axis], self.inverse[axis]);
            for i in 0..WIDTH {
                // Written so that NaN, from a ray that runs in a face, changes nothing.
                let first = (near[i] - o) * inverse;
                entry[i] = if first > entry[i] { first } else { entry[i] };
                let last = (far[i] - o) * inverse;
                exit[i] = if last < exit[i] { last } else { exit[i] };
            }
        }
        let mut mask = 0_u32;
        for i in 0..WIDTH {
            mask |= u32::from(entry[i] <= exit[i] * EXIT_SLACK) << i;
        }
        let base = top;
        while mask != 0 {
            let i = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            let pushed = Entry { t: entry[i], child: node.children[i] };
            let mut place = top;
            while !ANY && place > base && stack[place - 1].t < pushed.t {
                stack[place] = stack[place - 1];
                place -= 1;
            }
            stack[place] = pushed;
            top += 1;
        }
        top
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
        children: [Child { first: 0, count: 0 }; WIDTH],
    };

    fn set(&mut self, lane: usize, child: Child, bounds: Bounds) {
        for axis in 0..3 {
            self.faces[axis][lane] = bounds.min[axis];
            self.faces[axis + 3][lane] = bounds.max[axis];
        }
        self.children[lane] = child;
    }
}
