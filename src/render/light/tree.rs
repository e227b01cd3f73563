//! A choice among many lights that looks from a point: a tree that knows where lights are and where they shine.
//!
//! On the way from the root to a light each turn is taken with the probability that the two sides seem to deserve, seen
//! from the point: intensity over squared distance, less where they shine past it or stand low over its surface. The work
//! grows with the logarithm of the number of lights (Conty Estevez & Kulla 2018; Pharr, Jakob, Humphreys 2023, section
//! 12.6.3). A group is overrated by those of its lights that shine past the point; so a few lights are all looked at instead.

use super::cone::{Cone, cos_less, sin_less, sin_of};
use crate::math::{Bounds, Vec3, float};
use std::f32::consts::{FRAC_PI_2, PI};

/// From where lights are looked at.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Viewpoint {
    /// In metres.
    pub p: Vec3,
    /// The unit normal of a surface that only light from above can reach; `None` where light counts from all sides.
    pub n: Option<Vec3>,
}

/// Where lights are, and how strongly they shine into which directions.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LightBounds {
    /// A box that holds them.
    pub bounds: Bounds,
    /// The sum of their largest radiant intensities, in W·sr⁻¹.
    pub intensity: f32,
    /// A cone that holds their normals.
    pub normals: Cone,
    /// The cosine of the angle from a normal up to which they shine.
    pub cos_reach: f32,
    /// Whether they shine against their normals too.
    pub two_sided: bool,
}

impl LightBounds {
    /// Both in one.
    pub fn union(&self, other: &Self) -> Self {
        Self {
            bounds: self.bounds.union(other.bounds),
            intensity: self.intensity + other.intensity,
            normals: self.normals.union(other.normals),
            cos_reach: self.cos_reach.min(other.cos_reach),
            two_sided: self.two_sided || other.two_sided,
        }
    }

    /// About the irradiance that they may send to a point, in W·m⁻²; 0 only where they send none.
    pub fn importance(&self, from: &Viewpoint) -> f32 {
        let to_point = from.p - self.bounds.center();
        // The ball around the box, a little larger than rounding could make it.
        let radius2 = self.bounds.size().length_squared() * 0.250_01;
        let distance2 = to_point.length_squared();
        let (dir, sin_ball, cos_ball) = if distance2 <= radius2 {
            (to_point.normalize_or(self.normals.axis), 0.0, -1.0)
        } else {
            let sin2 = radius2 / distance2;
            (to_point / distance2.sqrt(), sin2.sqrt(), (1.0 - sin2).sqrt())
        };

        // The angle by which even the light that shines best at the point shines past it.
        let cos_axis = self.normals.axis.dot(dir);
        let cos_axis = if self.two_sided { cos_axis.abs() } else { cos_axis };
        let (sin_axis, sin_normals) = (sin_of(cos_axis), sin_of(self.normals.cos));
        let cos_edge = cos_less(sin_axis, cos_axis, sin_normals, self.normals.cos);
        let sin_edge = sin_less(sin_axis, cos_axis, sin_normals, self.normals.cos);
        let cos_past = cos_less(sin_edge, cos_edge, sin_ball, cos_ball);
        if cos_past <= self.cos_reach {
            return 0.0;
        }
        let arriving = self.intensity * cos_past / distance2.max(radius2);
        match from.n {
            Some(n) => {
                let cos_in = -dir.dot(n);
                arriving * cos_less(sin_of(cos_in), cos_in, sin_ball, cos_ball).max(0.0)
            }
            None => arriving,
        }
    }

    /// What a group costs: its intensity times the directions and the places over which it is spread.
    fn cost(&self, longest: f32) -> f32 {
        let size = self.bounds.size();
        let (o, reach) = (self.normals.angle(), float::acos(self.cos_reach));
        let w = (o + reach).min(PI);
        let ((sin_o, cos_o), cos_2w) = (float::sin_cos(o), float::sin_cos(o - 2.0 * w).1);
        let directions =
            2.0 * PI * (1.0 - cos_o) + FRAC_PI_2 * (2.0 * w * sin_o - cos_2w - 2.0 * o * sin_o + cos_o);
        let area = size.x * size.y + size.y * size.z + size.z * size.x;
        // A line has no area, but it has a length.
        self.intensity * directions * (area + longest * size.max_element() * 1e-3)
    }
}

/// Lights with a place, in a binary tree.
pub struct LightTree {
    /// The root first; a branch before its two children.
    nodes: Vec<Node>,
    /// Where each light hangs.
    leaves: Vec<u32>,
}

struct Node {
    bounds: LightBounds,
    parent: u32,
    kind: Kind,
}

#[derive(Clone, Copy)]
enum Kind {
    /// The next node, and this one.
    Branch(u32),
    Leaf(u32),
}

/// Up to so many lights are all looked at.
const FEW: usize = 8;
/// Groups that a branch may be cut between, along each axis.
const BINS: usize = 12;
/// Below this depth groups are halved by number, so that no arrangement of lights makes the tree deep.
const DEEPEST_BY_COST: u32 = 40;

impl LightTree {
    /// A tree over lights that each have an intensity greater than 0.
    pub fn new(lights: &[LightBounds]) -> Self {
        let mut tree = Self { nodes: Vec::new(), leaves: vec![0; lights.len()] };
        let mut items: Vec<(u32, LightBounds)> = (0..).zip(lights.iter().copied()).collect();
        if !items.is_empty() {
            tree.build(&mut items, 0, 0);
        }
        tree
    }

    /// Builds the branch of some lights, and returns its index.
    fn build(&mut self, items: &mut [(u32, LightBounds)], parent: u32, depth: u32) -> u32 {
        let index = self.nodes.len() as u32;
        if let [(light, bounds)] = *items {
            self.leaves[light as usize] = index;
            self.nodes.push(Node { bounds, parent, kind: Kind::Leaf(light) });
            return index;
        }
        let middle = split(items, depth);
        let (low, high) = items.split_at_mut(middle);
        let all = low.iter().chain(high.iter()).map(|(_, bounds)| *bounds);
        let bounds = all.reduce(|a, b| a.union(&b)).expect("a branch has two lights or more");
        self.nodes.push(Node { bounds, parent, kind: Kind::Branch(0) });
        self.build(low, index, depth + 1);
        let second = self.build(high, index, depth + 1);
        self.nodes[index as usize].kind = Kind::Branch(second);
        index
    }

    /// About the irradiance that all lights together may send to a point, in W·m⁻².
    pub fn importance(&self, from: &Viewpoint) -> f32 {
        match self.each(from) {
            Some(each) => each.iter().sum(),
            None => self.nodes.first().map_or(0.0, |root| root.bounds.importance(from)),
        }
    }

    /// The importances of a few lights, so that their sum is a number; `None` of many.
    fn each(&self, from: &Viewpoint) -> Option<[f32; FEW]> {
        if self.leaves.len() > FEW {
            return None;
        }
        let mut each = [0.0; FEW];
        for (importance, &leaf) in each.iter_mut().zip(&self.leaves) {
            *importance = self.nodes[leaf as usize].bounds.importance(from).min(f32::MAX / FEW as f32);
        }
        Some(each)
    }

    /// A light with its probability, by `u` in [0, 1); `None` where none shines at the point.
    pub fn sample(&self, from: &Viewpoint, mut u: f64) -> Option<(u32, f32)> {
        if let Some(each) = self.each(from) {
            return sample_of(&each, u);
        }
        let (mut at, mut pmf) = (0, 1.0);
        loop {
            match self.nodes.get(at as usize)?.kind {
                Kind::Leaf(light) => return Some((light, pmf)),
                Kind::Branch(second) => {
                    let share = self.share(at + 1, second, from)?;
                    let first = f64::from(share);
                    if u < first {
                        (at, u, pmf) = (at + 1, u / first, pmf * share);
                    } else {
                        (at, u, pmf) = (second, (u - first) / (1.0 - first), pmf * (1.0 - share));
                    }
                    u = u.min(1.0 - f64::EPSILON);
                }
            }
        }
    }

    /// The probability with which [`Self::sample`] draws a light.
    pub fn pmf(&self, from: &Viewpoint, light: u32) -> f32 {
        if let Some(each) = self.each(from) {
            let sum: f32 = each.iter().sum();
            return if sum > 0.0 { each[light as usize] / sum } else { 0.0 };
        }
        let (mut at, mut pmf) = (self.leaves[light as usize], 1.0);
        while at != 0 {
            let parent = self.nodes[at as usize].parent;
            let Kind::Branch(second) = self.nodes[parent as usize].kind else { return 0.0 };
            let Some(share) = self.share(parent + 1, second, from) else { return 0.0 };
            pmf *= if at == second { 1.0 - share } else { share };
            at = parent;
        }
        pmf
    }

    /// The probability of the first of two nodes; `None` if neither shines at the point.
    fn share(&self, first: u32, second: u32, from: &Viewpoint) -> Option<f32> {
        let [a, b] = [first, second].map(|node| self.nodes[node as usize].bounds.importance(from));
        let sum = a + b;
        (sum > 0.0 && sum.is_finite()).then(|| a / sum)
    }
}

/// Draws one in proportion to its importance, with its probability.
fn sample_of(each: &[f32; FEW], u: f64) -> Option<(u32, f32)> {
    let sum: f32 = each.iter().sum();
    let mut rest = u * f64::from(sum);
    let mut drawn = None;
    for (light, &importance) in (0..).zip(each).filter(|(_, importance)| **importance > 0.0) {
        drawn = Some((light, importance / sum));
        rest -= f64::from(importance);
        if rest < 0.0 {
            break;
        }
    }
    drawn
}

/// Orders lights so that those before and those after the index returned make the cheapest pair of groups.
fn split(items: &mut [(u32, LightBounds)], depth: u32) -> usize {
    let centers = Bounds::of(items.iter().map(|(_, light)| light.bounds.center()));
    let size = centers.size();
    let longest = size.max_element();
    let by_cost = (depth < DEEPEST_BY_COST && longest > 0.0 && items.len() > 2)
        .then(|| {
            (0..3).filter_map(|axis| cheapest_cut(items, axis, &centers)).min_by(|a, b| a.0.total_cmp(&b.0))
        })
        .flatten();
    if let Some((_, axis, bin)) = by_cost {
        // Stable, so that the tree follows from the scene alone.
        items.sort_by_key(|(_, light)| bin_of(light, axis, &centers) > bin);
        return items.partition_point(|(_, light)| bin_of(light, axis, &centers) <= bin);
    }
    let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(0);
    items.sort_by(|(_, a), (_, b)| a.bounds.center()[axis].total_cmp(&b.bounds.center()[axis]));
    items.len() / 2
}

/// The bin that the middle of a light falls into.
fn bin_of(light: &LightBounds, axis: usize, centers: &Bounds) -> usize {
    let share = (light.bounds.center()[axis] - centers.min[axis]) / centers.size()[axis];
    ((share * BINS as f32) as usize).min(BINS - 1)
}

/// The cost of the cheapest cut across an axis, the axis, and the last bin before it.
fn cheapest_cut(items: &[(u32, LightBounds)], axis: usize, centers: &Bounds) -> Option<(f32, usize, usize)> {
    let size = centers.size();
    if size[axis] <= 0.0 {
        return None;
    }
    let mut bins: [Option<LightBounds>; BINS] = [None; BINS];
    for (_, light) in items {
        let bin = &mut bins[bin_of(light, axis, centers)];
        *bin = join(*bin, Some(*light));
    }
    // Thin groups cost more the longer they are along the cut axis.
    let stretch = size.max_element() / size[axis];
    let cost = |group: Option<LightBounds>| group.map(|group| group.cost(size.max_element()));
    let cut = |bin: usize| {
        let side = |bins: &[Option<LightBounds>]| bins.iter().copied().fold(None, join);
        let (low, high) = (cost(side(&bins[..=bin]))?, cost(side(&bins[bin + 1..]))?);
        Some(((low + high) * stretch, axis, bin))
    };
    (0..BINS - 1).filter_map(cut).min_by(|a, b| a.0.total_cmp(&b.0))
}

fn join(a: Option<LightBounds>, b: Option<LightBounds>) -> Option<LightBounds> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.union(&b)),
        (a, b) => a.or(b),
    }
}
