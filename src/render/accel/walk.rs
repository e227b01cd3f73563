//! The way of a ray through the tree.

use super::kernel::{BoxRay, EXIT_SLACK, Kernel};
use super::wide::{Child, Kind, Wide};
use crate::math::Ray;
use crate::render::geometry::{Hit, Nearest, PrimId};
use crate::render::shape::triangle::ShearedRay;

/// Stacks up to this size need no memory from the heap.
const SMALL_STACK: usize = 96;

/// What is asked of a tree.
pub struct Query<'a> {
    /// The tree.
    pub tree: &'a Wide,
    /// The ray.
    pub ray: &'a Ray,
    /// Where the ray meets a solid.
    pub hit_solid: &'a dyn Fn(u32) -> Option<Hit>,
}

/// A node or leaf yet to be visited, and where the ray enters its box.
#[derive(Clone, Copy, Default)]
struct Entry {
    t: f32,
    child: Child,
}

/// Offers to `nearest` what can come before it; with `ANY`, stops at the first that does.
#[inline(always)]
pub fn walk<K: Kernel, const ANY: bool>(kernel: K, query: &Query<'_>, nearest: &mut Nearest) {
    if query.tree.stack() <= SMALL_STACK {
        walk_with::<K, ANY>(kernel, query, nearest, &mut [Entry::default(); SMALL_STACK]);
    } else {
        walk_with::<K, ANY>(kernel, query, nearest, &mut vec![Entry::default(); query.tree.stack()]);
    }
}

#[inline(always)]
fn walk_with<K: Kernel, const ANY: bool>(
    kernel: K,
    query: &Query<'_>,
    nearest: &mut Nearest,
    stack: &mut [Entry],
) {
    let boxes = BoxRay::new(query.ray);
    let sheared = ShearedRay::new(query.ray);
    let tree = query.tree;
    let mut top = 0;
    let mut child = Child::ROOT;
    loop {
        // Down to what the ray enters first, leaving the rest on the stack.
        if let Kind::Node(node) = child.kind() {
            let node = &tree.nodes[node];
            let (mut mask, entry) = kernel.boxes(&boxes, node, nearest.t);
            if mask != 0 {
                let first = mask.trailing_zeros() as usize;
                mask &= mask - 1;
                child = node.children[first];
                if mask == 0 {
                    continue;
                }
                let mut t = entry[first];
                let base = top;
                while mask != 0 {
                    let i = mask.trailing_zeros() as usize;
                    mask &= mask - 1;
                    let mut pushed = Entry { t: entry[i], child: node.children[i] };
                    if pushed.t < t {
                        (pushed, t, child) = (Entry { t, child }, pushed.t, pushed.child);
                    }
                    prefetch(kernel, tree, pushed.child);
                    let mut place = top;
                    while !ANY && place > base && stack[place - 1].t < pushed.t {
                        stack[place] = stack[place - 1];
                        place -= 1;
                    }
                    stack[place] = pushed;
                    top += 1;
                }
                continue;
            }
        } else {
            match child.kind() {
                Kind::Blocks(blocks) => {
                    for block in &tree.blocks[blocks] {
                        if let Some((inside, mut edges)) = kernel.triangles(&sheared, block) {
                            block.finish(&sheared, &mut edges, inside, |prim, hit| {
                                nearest.offer(Some(Hit { t: hit.t, prim: PrimId(prim), uv: hit.uv }));
                            });
                        }
                    }
                }
                Kind::Solid(solid) => nearest.offer((query.hit_solid)(solid)),
                Kind::Node(_) => {}
            }
            if ANY && nearest.hit.is_some() {
                return;
            }
        }
        // The nearest of what is left, unless the ray ends before it.
        loop {
            if top == 0 {
                return;
            }
            top -= 1;
            let entry = stack[top];
            if entry.t <= nearest.t * EXIT_SLACK {
                child = entry.child;
                break;
            }
        }
    }
}

/// Says that what a child stands for will be read soon.
#[inline(always)]
fn prefetch<K: Kernel>(kernel: K, tree: &Wide, child: Child) {
    match child.kind() {
        Kind::Node(node) => kernel.prefetch(tree.nodes.as_ptr().wrapping_add(node)),
        Kind::Blocks(blocks) => kernel.prefetch(tree.blocks.as_ptr().wrapping_add(blocks.start)),
        Kind::Solid(_) => {}
    }
}
