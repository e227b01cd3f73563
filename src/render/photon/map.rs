//! A kd-tree over photons that finds the k nearest within a radius.
//!
//! The tree is balanced by count, so its shape follows from the number of photons alone: leaves are buckets of sixteen
//! photons, coordinates side by side, and inner nodes are eight bytes in depth-first order. Points are split by their
//! order, never by value, so that any number of equal coordinates is no obstacle.

use super::occupancy::Occupancy;
use crate::math::{Bounds, Rgb, Vec3};
use rayon::prelude::*;
use std::cmp::Ordering;
use std::ops::ControlFlow;

/// Photons in a leaf.
const BUCKET: usize = 16;
/// Subtrees with more buckets are built by several threads.
const PARALLEL_ABOVE: usize = 256;
/// More inner nodes than on any way down: fewer than 2³² photons make fewer than 2²⁸ buckets.
const STACK: usize = 32;

/// A photon where it landed.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Photon {
    /// Where, in metres.
    pub p: Vec3,
    /// The unit direction that it came from.
    pub wi: Vec3,
    /// The unit geometric normal of the surface, on the side of `wi`.
    pub n: Vec3,
    /// Its power, in watts.
    pub power: Rgb,
    /// Vertices of its path, this one and the one on the light included.
    pub depth: u32,
}

/// Where photons are gathered: a flat disc rather than a ball, so that none comes through a wall or around a corner.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Disc {
    /// Its centre, in metres.
    pub p: Vec3,
    /// Its unit normal.
    pub n: Vec3,
    /// The largest radius, in metres. Finite.
    pub radius: f32,
    /// The most photons, at least 1.
    pub k: usize,
}

/// A disc of radius r reaches this share of r along its normal, to either side.
const HALF_THICKNESS: f32 = 0.1;

/// A photon found.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Neighbor {
    /// The square of the radius of the smallest disc that holds it: its distance, or ten times its height if that is more.
    pub radius2: f32,
    /// Its place in the map.
    pub index: u32,
}

impl Neighbor {
    /// The nearest first; ties by index.
    pub fn order(&self, other: &Self) -> Ordering {
        self.radius2.total_cmp(&other.radius2).then(self.index.cmp(&other.index))
    }
}

/// A plane between two halves of the photons.
#[derive(Clone, Copy, Default)]
struct Node {
    position: f32,
    axis: u32,
}

/// A map of photons.
#[derive(Default)]
pub struct PhotonMap {
    /// In the order of the leaves.
    photons: Vec<Photon>,
    /// Coordinates of each bucket; what is missing in the last one is infinitely far away.
    buckets: Vec<[[f32; BUCKET]; 3]>,
    nodes: Vec<Node>,
    occupancy: Occupancy,
}

impl PhotonMap {
    /// Builds the tree. The same photons in the same order make the same map for any number of threads.
    ///
    /// # Panics
    /// When there are 2³² photons or more.
    pub fn new(photons: &[Photon]) -> Self {
        let count = u32::try_from(photons.len()).expect("fewer than 2³² photons");
        let mut points: Vec<_> =
            (0..count).map(|index| Point { p: photons[index as usize].p, index }).collect();
        let bucket_count = points.len().div_ceil(BUCKET);
        let mut nodes = vec![Node::default(); bucket_count.saturating_sub(1)];
        split(&mut points, &mut nodes);
        let buckets = points.par_chunks(BUCKET).map(bucket).collect();
        let photons: Vec<_> = points.par_iter().map(|point| photons[point.index as usize]).collect();
        let occupancy = Occupancy::new(photons.iter().map(|photon| photon.p));
        Self { photons, buckets, nodes, occupancy }
    }

    /// All photons, in the order of their indices in the map.
    pub fn photons(&self) -> &[Photon] {
        &self.photons
    }

    /// Collects the nearest `disc.k` of the photons that `accepts` wants, the farthest of them last and the others in no
    /// order; if fewer are in reach, all these, in no order.
    ///
    /// Nothing is sorted before more than twice `k` are in hand: then the nearest `k` stay, and the radius shrinks to theirs.
    pub fn nearest(&self, disc: &Disc, accepts: impl Fn(&Photon) -> bool, found: &mut Vec<Neighbor>) {
        found.clear();
        if !self.occupancy.may_hold(disc.p, disc.radius) {
            return;
        }
        self.visit(disc.p, disc.radius * disc.radius, |first, bucket, mut reach2| {
            let radii2 = radii2(disc, bucket);
            for (i, &radius2) in radii2.iter().enumerate() {
                let index = first + i;
                if radius2 <= reach2 && accepts(&self.photons[index]) {
                    found.push(Neighbor { radius2, index: index as u32 });
                }
            }
            if found.len() >= 2 * disc.k.max(BUCKET) {
                reach2 = keep_nearest(found, disc.k);
            }
            reach2
        });
        if found.len() >= disc.k {
            keep_nearest(found, disc.k);
        }
    }

    /// Shows `visit` the photons within the disc, whatever their number, until it breaks off; `disc.k` does not count.
    pub fn within(&self, disc: &Disc, mut visit: impl FnMut(&Photon) -> ControlFlow<()>) {
        if !self.occupancy.may_hold(disc.p, disc.radius) {
            return;
        }
        let radius2 = disc.radius * disc.radius;
        self.visit(disc.p, radius2, |first, bucket, reach2| {
            let radii2 = radii2(disc, bucket);
            for (i, _) in radii2.iter().enumerate().filter(|(_, r2)| **r2 <= reach2) {
                if visit(&self.photons[first + i]).is_break() {
                    return f32::NEG_INFINITY; // nothing is as near as that
                }
            }
            reach2
        });
    }

    /// Shows `scan` the buckets that reach into the ball of squared radius `reach2`, near ones first.
    ///
    /// `scan` gets the index of the first photon, the coordinates, and the squared radius, and answers with that for the rest.
    fn visit(&self, q: Vec3, mut reach2: f32, mut scan: impl FnMut(usize, &[[f32; BUCKET]; 3], f32) -> f32) {
        let mut stack = [Cell::default(); STACK];
        let mut top = 0;
        let mut cell = Cell { node: 0, bucket: 0, count: self.buckets.len(), offset: Vec3::ZERO };
        if self.buckets.is_empty() {
            return;
        }
        loop {
            while cell.count > 1 {
                let Node { position, axis } = self.nodes[cell.node];
                let [near, far] = cell.children(q[axis as usize] - position, axis as usize);
                if squared_length(far.offset) <= reach2 {
                    stack[top] = far;
                    top += 1;
                }
                cell = near;
            }
            reach2 = scan(cell.bucket * BUCKET, &self.buckets[cell.bucket], reach2);
            loop {
                if top == 0 {
                    return;
                }
                top -= 1;
                cell = stack[top];
                if squared_length(cell.offset) <= reach2 {
                    break;
                }
            }
        }
    }
}

/// Some neighbouring buckets, and how far they are from the query along each axis at least.
#[derive(Clone, Copy, Default)]
struct Cell {
    node: usize,
    bucket: usize,
    count: usize,
    offset: Vec3,
}

impl Cell {
    /// The half on the side of the query, and the other; `above` is the query's height over the plane between them.
    fn children(self, above: f32, axis: usize) -> [Self; 2] {
        let half = self.count.div_ceil(2);
        let low = Self { node: self.node + 1, count: half, ..self };
        let high =
            Self { node: self.node + half, bucket: self.bucket + half, count: self.count - half, ..self };
        let (near, mut far) = if above < 0.0 { (low, high) } else { (high, low) };
        far.offset[axis] = above;
        [near, far]
    }
}

/// x² + y² + z², added up as for each photon: rounding is monotone, so a cell is never farther than what it holds.
fn squared_length(v: Vec3) -> f32 {
    v.x * v.x + v.y * v.y + v.z * v.z
}

/// The squared radii of the discs that just hold each photon of a bucket.
fn radii2(disc: &Disc, bucket: &[[f32; BUCKET]; 3]) -> [f32; BUCKET] {
    let mut radii2 = [0.0; BUCKET];
    for i in 0..BUCKET {
        let (x, y, z) = (bucket[0][i] - disc.p.x, bucket[1][i] - disc.p.y, bucket[2][i] - disc.p.z);
        let distance2 = x * x + y * y + z * z;
        let height = (x * disc.n.x + y * disc.n.y + z * disc.n.z) * (1.0 / HALF_THICKNESS);
        let height2 = height * height;
        radii2[i] = if height2 > distance2 { height2 } else { distance2 };
    }
    radii2
}

/// Drops all but the nearest `k`, the farthest of them last; returns its squared radius.
fn keep_nearest(found: &mut Vec<Neighbor>, k: usize) -> f32 {
    let (_, last, _) = found.select_nth_unstable_by(k - 1, Neighbor::order);
    let radius2 = last.radius2;
    found.truncate(k);
    radius2
}

/// A photon while the tree is built.
#[derive(Clone, Copy)]
struct Point {
    p: Vec3,
    index: u32,
}

/// Orders points so that each half of the buckets lies on its side of its node's plane.
fn split(points: &mut [Point], nodes: &mut [Node]) {
    let Some((node, nodes)) = nodes.split_first_mut() else {
        points.sort_unstable_by_key(|point| point.index);
        return;
    };
    let half = points.len().div_ceil(BUCKET).div_ceil(2);
    let size = Bounds::of(points.iter().map(|point| point.p)).size();
    let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(0);
    let by_place = |a: &Point, b: &Point| a.p[axis].total_cmp(&b.p[axis]).then(a.index.cmp(&b.index));
    let (_, first_above, _) = points.select_nth_unstable_by(half * BUCKET, by_place);
    *node = Node { position: first_above.p[axis], axis: axis as u32 };

    let (below, above) = points.split_at_mut(half * BUCKET);
    let (nodes_below, nodes_above) = nodes.split_at_mut(half - 1);
    if half > PARALLEL_ABOVE {
        rayon::join(|| split(below, nodes_below), || split(above, nodes_above));
    } else {
        split(below, nodes_below);
        split(above, nodes_above);
    }
}

/// The coordinates of up to sixteen points.
fn bucket(points: &[Point]) -> [[f32; BUCKET]; 3] {
    let mut bucket = [[f32::INFINITY; BUCKET]; 3];
    for (i, point) in points.iter().enumerate() {
        for (axis, row) in bucket.iter_mut().enumerate() {
            row[i] = point.p[axis];
        }
    }
    bucket
}
