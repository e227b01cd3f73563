//! The way of a ray through the tree.

use super::kernel::Kernel;
use super::wide::{Child, Kind, Node, Row, Wide};
use crate::math::Ray;
use crate::render::geometry::{Hit, Nearest, PrimId};

/// Stacks up to this size need no memory from the heap.
const SMALL_STACK: usize = 96;

/// What is asked of a tree.
pub struct Query<'a> {
    /// The tree.
    pub tree: &'a Wide,
    /// The ray.
    pub ray: &'a Ray,
    /// The primitive of the tree's first triangle.
    pub first_prim: u32,
    /// Offers what the ray meets of something in a box.
    pub hit_boxed: &'a dyn Fn(u32, &mut Nearest),
}

/// Offers to `nearest` what can come before it; with `ANY`, stops at the first that does.
#[inline(always)]
pub fn walk<K: Kernel, const ANY: bool>(kernel: K, query: &Query<'_>, nearest: &mut Nearest) {
    if query.tree.stack() <= SMALL_STACK {
        let stack = Stack { entries: &mut [Entry::default(); SMALL_STACK], top: 0 };
        walk_with::<K, ANY>(kernel, query, nearest, stack);
    } else {
        let stack = Stack { entries: &mut vec![Entry::default(); query.tree.stack()], top: 0 };
        walk_with::<K, ANY>(kernel, query, nearest, stack);
    }
}

#[inline(always)]
fn walk_with<K: Kernel, const ANY: bool>(
    kernel: K,
    query: &Query<'_>,
    nearest: &mut Nearest,
    mut stack: Stack<'_>,
) {
    let ray = kernel.prepare(query.ray);
    let tree = query.tree;
    let mut child = Some(Child::ROOT);
    while let Some(here) = child {
        match here.kind() {
            // Down to what the ray enters first, leaving the rest on the stack.
            Kind::Node(node) => {
                let node = &tree.nodes[node];
                let (met, entry) = kernel.boxes(&ray, node, nearest.t);
                if met != 0 {
                    child =
                        Some(stack.enter::<ANY>(node, met, &entry, |child| prefetch(kernel, tree, child)));
                    continue;
                }
            }
            Kind::Blocks(blocks) => {
                for block in &tree.blocks[blocks] {
                    kernel.triangles(&ray, block, |prim, hit| {
                        let prim = PrimId(query.first_prim + prim);
                        nearest.offer(Some(Hit { t: hit.t, prim, uv: hit.uv }));
                    });
                }
                if ANY && nearest.hit.is_some() {
                    return;
                }
            }
            Kind::Boxed(number) => {
                (query.hit_boxed)(number, nearest);
                if ANY && nearest.hit.is_some() {
                    return;
                }
            }
        }
        child = stack.pop(nearest.t * K::SLACK);
    }
}

/// Says that what a child stands for will be read soon.
#[inline(always)]
fn prefetch<K: Kernel>(kernel: K, tree: &Wide, child: Child) {
    match child.kind() {
        Kind::Node(node) => kernel.prefetch(tree.nodes.as_ptr().wrapping_add(node)),
        Kind::Blocks(blocks) => kernel.prefetch(tree.blocks.as_ptr().wrapping_add(blocks.start)),
        Kind::Boxed(_) => {}
    }
}

/// A node or leaf yet to be visited, and where the ray enters its box.
#[derive(Clone, Copy, Default)]
struct Entry {
    t: f32,
    child: Child,
}

/// What is yet to be visited.
struct Stack<'a> {
    entries: &'a mut [Entry],
    top: usize,
}

impl Stack<'_> {
    /// Pushes the children of `node` that are `met`, all but the one that the ray enters first, which it returns.
    ///
    /// The farthest comes first; with `ANY` they come in any order, which is good enough for who wants any hit.
    #[inline(always)]
    fn enter<const ANY: bool>(
        &mut self,
        node: &Node,
        met: u32,
        entry: &Row,
        prefetch: impl Fn(Child),
    ) -> Child {
        let at = |lane: usize| Entry { t: entry[lane], child: node.children[lane] };
        let lane = met.trailing_zeros() as usize;
        let mut rest = met & (met - 1);
        if rest == 0 {
            return node.children[lane]; // most often
        }
        let mut first = at(lane);
        let base = self.top;
        while rest != 0 {
            let mut pushed = at(rest.trailing_zeros() as usize);
            rest &= rest - 1;
            if pushed.t < first.t {
                (first, pushed) = (pushed, first);
            }
            prefetch(pushed.child);
            let mut place = self.top;
            while !ANY && place > base && self.entries[place - 1].t < pushed.t {
                self.entries[place] = self.entries[place - 1];
                place -= 1;
            }
            self.entries[place] = pushed;
            self.top += 1;
        }
        first.child
    }

    /// The last that was pushed and that the ray enters by `t_max`.
    #[inline(always)]
    fn pop(&mut self, t_max: f32) -> Option<Child> {
        while self.top > 0 {
            self.top -= 1;
            let entry = self.entries[self.top];
            if entry.t <= t_max {
                return Some(entry.child);
            }
        }
        None
    }
}
