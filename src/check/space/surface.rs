//! Surfaces of triangles: whether they are closed, which way they face, and what they enclose.

use super::MeshPart;
use super::region::Extent;
use crate::math::DVec3;
use rustc_hash::FxHashMap;
use std::f64::consts::TAU;
use std::hash::Hash;
use std::rc::Rc;

/// Triangles with their corners welded: what lies in one place is one vertex.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Surface {
    points: Rc<[DVec3]>,
    triangles: Vec<[u32; 3]>,
}

/// What the edges of a surface say of it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) struct Seams {
    /// Edges with an odd number of triangles: there is a gap.
    pub(super) open: usize,
    /// Closed edges whose triangles disagree about which side is outside.
    pub(super) mixed: usize,
}

/// The two corners of an edge, the lower one first.
type Edge = (u32, u32);

/// How triangles use an edge.
#[derive(Clone, Copy, Default)]
struct Uses {
    count: u32,
    /// How many more go along it from its lower to its higher corner than back.
    forwards: i32,
}

impl Uses {
    fn add(&mut self, count: u32, forwards: i32) {
        self.count += count;
        self.forwards += forwards;
    }

    fn is_open(&self) -> bool {
        self.count % 2 == 1
    }
}

impl Seams {
    fn of(edges: impl Iterator<Item = Uses>) -> Self {
        let mut seams = Self::default();
        for uses in edges {
            seams.open += usize::from(uses.is_open());
            seams.mixed += usize::from(!uses.is_open() && uses.forwards != 0);
        }
        seams
    }
}

/// Surfaces with more open edges than this are not looked at for corners on sides.
const MOST_OPEN: usize = 4_000;
/// How far a corner may be from a side that it lies on, as a share of the side.
const ON_EDGE: f64 = 1e-6;

impl Surface {
    /// Welds corners that `key` takes for the same place. Triangles that come down to a line vanish.
    pub(super) fn weld<K: Hash + Eq>(
        corners: impl IntoIterator<Item = [DVec3; 3]>,
        key: impl Fn(DVec3) -> K,
    ) -> Self {
        let mut weld = Weld::default();
        let corners = corners.into_iter().map(|triangle| triangle.map(|p| weld.vertex(p, key(p))));
        let triangles = corners.filter(spans_area).collect();
        Self { points: weld.points.into(), triangles }
    }

    /// Welds what lies in the very same place in parts of a mesh; −0 and 0 are one. Positions are multiplied by `scale`.
    pub(super) fn of_parts<'a>(parts: impl IntoIterator<Item = &'a MeshPart<'a>>, scale: f64) -> Self {
        let (mut weld, mut triangles) = (Weld::default(), Vec::new());
        for part in parts {
            let places = part.positions.iter().map(|p| p.as_dvec3() * scale);
            let welded: Vec<u32> = places.map(|p| weld.vertex(p, exactly(p))).collect();
            let corners = part.triangles.iter().map(|t| t.map(|i| welded[i as usize]));
            triangles.extend(corners.filter(spans_area));
        }
        Self { points: weld.points.into(), triangles }
    }

    pub(super) fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    pub(super) fn extent(&self) -> Option<Extent> {
        Extent::of(self.triangles.iter().flatten().map(|&i| self.points[i as usize]))
    }

    /// What the edges say. Where a corner lies on the side of a neighbour there is no gap.
    pub(super) fn seams(&self) -> Seams {
        let edges = self.edges();
        let open: Vec<Edge> =
            edges.iter().filter(|(_, uses)| uses.is_open()).map(|&(edge, _)| edge).collect();
        if !(1..=MOST_OPEN).contains(&open.len()) {
            return Seams::of(edges.into_iter().map(|(_, uses)| uses));
        }
        let mut edges = edges.into_iter().collect();
        self.split(&mut edges, &open);
        Seams::of(edges.into_values())
    }

    /// Each edge once, in order. Sides are sorted rather than hashed: with that, and each vertex welded
    /// once, a file of a million triangles is checked in 1.0 s instead of 1.6 s.
    fn edges(&self) -> Vec<(Edge, Uses)> {
        let directed = |(a, b): Edge| if a < b { (a, b, 1) } else { (b, a, -1) };
        let mut sides: Vec<_> = self.triangles.iter().flat_map(|&t| sides(t)).map(directed).collect();
        sides.sort_unstable();
        let edges = sides.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)).map(|same| {
            let forwards = same.iter().map(|&(_, _, way)| way).sum();
            ((same[0].0, same[0].1), Uses { count: same.len() as u32, forwards })
        });
        edges.collect()
    }

    /// Cuts open edges where corners of other open edges lie on them.
    fn split(&self, edges: &mut FxHashMap<Edge, Uses>, open: &[Edge]) {
        let mut corners: Vec<u32> = open.iter().flat_map(|&(a, b)| [a, b]).collect();
        corners.sort_unstable();
        corners.dedup();
        for &(a, b) in open {
            let (start, way) = (self.points[a as usize], self.points[b as usize] - self.points[a as usize]);
            let mut on_it: Vec<(f64, u32)> = corners
                .iter()
                .filter_map(|&corner| {
                    let p = self.points[corner as usize] - start;
                    let along = p.dot(way) / way.length_squared();
                    let is_on = p.distance(way * along) <= ON_EDGE * way.length();
                    (is_on && along > ON_EDGE && along < 1.0 - ON_EDGE).then_some((along, corner))
                })
                .collect();
            if on_it.is_empty() {
                continue;
            }
            let Some(uses) = edges.remove(&(a, b)) else { continue };
            on_it.sort_by(|x, y| x.0.total_cmp(&y.0));
            let stops = std::iter::once(a).chain(on_it.into_iter().map(|(_, corner)| corner)).chain([b]);
            let stops: Vec<u32> = stops.collect();
            for pair in stops.windows(2) {
                let (from, to) = (pair[0], pair[1]);
                let sign = if from < to { 1 } else { -1 };
                edges.entry((from.min(to), from.max(to))).or_default().add(uses.count, sign * uses.forwards);
            }
        }
    }

    /// The enclosed volume; negative when the triangles face inwards. Only of a surface without seams.
    pub(super) fn volume(&self) -> f64 {
        let middle = self.extent().map_or(DVec3::ZERO, |extent| (extent.min + extent.max) / 2.0);
        let corner = |i: u32| self.points[i as usize] - middle;
        self.triangles.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c))) / 6.0).sum()
    }

    /// The parts that hang together by edges and are closed, each facing one way. Parts with gaps, and parts with edges
    /// between more than two triangles, are left out.
    pub(super) fn closed_parts(&self) -> Vec<(Self, Vec<usize>)> {
        let neighbours = self.neighbours();
        let mut seen = vec![false; self.triangles.len()];
        let mut parts = Vec::new();
        for start in 0..self.triangles.len() {
            if !seen[start] {
                parts.extend(self.closed_part(start, &neighbours, &mut seen));
            }
        }
        parts
    }

    /// For each side of each triangle the one other triangle there, if there is just one.
    fn neighbours(&self) -> Vec<[Option<u32>; 3]> {
        let mut by_edge: FxHashMap<Edge, Vec<u32>> = FxHashMap::default();
        for (index, &t) in self.triangles.iter().enumerate() {
            for (a, b) in sides(t) {
                by_edge.entry((a.min(b), a.max(b))).or_default().push(index as u32);
            }
        }
        let other = |index: usize, (a, b): (u32, u32)| match by_edge[&(a.min(b), a.max(b))].as_slice() {
            [one, two] => Some(if *one as usize == index { *two } else { *one }),
            _ => None,
        };
        self.triangles.iter().enumerate().map(|(i, &t)| sides(t).map(|side| other(i, side))).collect()
    }

    /// The part around `start` with its triangles turned the way `start` faces, and the indices of its triangles here;
    /// `None` when it has a gap or only one side.
    fn closed_part(
        &self,
        start: usize,
        neighbours: &[[Option<u32>; 3]],
        seen: &mut [bool],
    ) -> Option<(Self, Vec<usize>)> {
        let mut turned: FxHashMap<usize, [u32; 3]> = FxHashMap::from_iter([(start, self.triangles[start])]);
        let (mut next, mut is_closed) = (vec![start], true);
        seen[start] = true;
        while let Some(index) = next.pop() {
            let own = turned[&index];
            for (side, other) in neighbours[index].iter().enumerate() {
                let Some(other) = other.map(|other| other as usize) else {
                    is_closed = false;
                    continue;
                };
                // The sides are numbered as the triangle was written; as a pair of ends an edge is the same.
                let (a, b) = sides(self.triangles[index])[side];
                let forwards = sides(own).contains(&(a, b));
                let fits = |t: [u32; 3]| sides(t).contains(&if forwards { (b, a) } else { (a, b) });
                if let Some(&known) = turned.get(&other) {
                    is_closed &= fits(known);
                    continue;
                }
                let [x, y, z] = self.triangles[other];
                turned.insert(other, if fits([x, y, z]) { [x, y, z] } else { [x, z, y] });
                seen[other] = true;
                next.push(other);
            }
        }
        let mut indices: Vec<usize> = turned.keys().copied().collect();
        indices.sort_unstable();
        let triangles = indices.iter().map(|index| turned[index]).collect();
        is_closed.then(|| (Self { points: Rc::clone(&self.points), triangles }, indices))
    }

    /// How often the surface goes round a point: 0 outside, ±1 inside of what is simple. Two points with different numbers
    /// have the surface between them. Only of a surface without seams; not of points on it.
    ///
    /// The sum of the triangles' solid angles over 4π (Van Oosterom & Strackee 1983; Jacobson et al. 2013).
    pub(super) fn winding(&self, p: DVec3) -> Option<i32> {
        /// The sum is a whole number but for rounding; anything else means a point on the surface.
        const ROUNDING: f64 = 1e-3;
        let half_angle = |&[a, b, c]: &[u32; 3]| {
            let [a, b, c] = [a, b, c].map(|i| self.points[i as usize] - p);
            let (la, lb, lc) = (a.length(), b.length(), c.length());
            let y = a.dot(b.cross(c));
            let x = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            libm::atan2(y, x)
        };
        let turns = self.triangles.iter().map(half_angle).sum::<f64>() / TAU;
        ((turns - turns.round()).abs() < ROUNDING).then_some(turns.round() as i32)
    }

    /// The distance from a point to the nearest triangle.
    pub(super) fn distance(&self, p: DVec3) -> f64 {
        let squared = |t: &[u32; 3]| nearest(p, t.map(|i| self.points[i as usize])).distance_squared(p);
        self.triangles.iter().map(squared).fold(f64::INFINITY, f64::min).sqrt()
    }
}

/// Vertices by their places.
struct Weld<K> {
    known: FxHashMap<K, u32>,
    points: Vec<DVec3>,
}

impl<K> Default for Weld<K> {
    fn default() -> Self {
        Self { known: FxHashMap::default(), points: Vec::new() }
    }
}

impl<K: Hash + Eq> Weld<K> {
    /// The number of the vertex at `p`, which is known by `key`.
    fn vertex(&mut self, p: DVec3, key: K) -> u32 {
        *self.known.entry(key).or_insert_with(|| {
            self.points.push(p);
            self.points.len() as u32 - 1
        })
    }
}

/// What tells a place from all others; −0 and 0 are one.
fn exactly(p: DVec3) -> [u64; 3] {
    p.to_array().map(|x| (x + 0.0).to_bits())
}

/// Whether the corners of a triangle are three.
fn spans_area(&[a, b, c]: &[u32; 3]) -> bool {
    a != b && b != c && c != a
}

/// The sides of a triangle in its direction.
fn sides([a, b, c]: [u32; 3]) -> [(u32, u32); 3] {
    [(a, b), (b, c), (c, a)]
}

/// The point of a triangle nearest to `p` (Ericson 2005, section 5.1.5).
fn nearest(p: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let (ab, ac, bc) = (b - a, c - a, c - b);
    let (ap, bp, cp) = (p - a, p - b, p - c);
    let (d1, d2, d3, d4, d5, d6) = (ab.dot(ap), ac.dot(ap), ab.dot(bp), ac.dot(bp), ab.dot(cp), ac.dot(cp));
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if d1 <= 0.0 && d2 <= 0.0 {
        a
    } else if d3 >= 0.0 && d4 <= d3 {
        b
    } else if d6 >= 0.0 && d5 <= d6 {
        c
    } else if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        a + ab * (d1 / (d1 - d3))
    } else if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        a + ac * (d2 / (d2 - d6))
    } else if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        b + bc * ((d4 - d3) / ((d4 - d3) + (d5 - d6)))
    } else {
        a + (ab * vb + ac * vc) / (va + vb + vc)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn welded(corners: Vec<[DVec3; 3]>) -> Surface {
        Surface::weld(corners, exactly)
    }

    /// A tetrahedron that faces outwards; its corners are not shared.
    fn tetrahedron() -> Vec<[DVec3; 3]> {
        let p = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].map(|t: [usize; 3]| t.map(|i| p[i])).to_vec()
    }

    #[test]
    fn a_closed_surface_has_no_seams_and_a_volume() {
        let surface = welded(tetrahedron());
        assert_eq!(surface.seams(), Seams::default());
        assert!((surface.volume() - 1.0 / 6.0).abs() < 1e-15);
        assert_eq!(surface.winding(DVec3::splat(0.1)), Some(1));
        assert_eq!(surface.winding(DVec3::splat(1.0)), Some(0));
        assert!((surface.distance(DVec3::splat(-1.0)) - 3.0_f64.sqrt()).abs() < 1e-15);
        assert!((surface.distance(DVec3::splat(1.0)) - 2.0 / 3.0_f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn a_missing_triangle_opens_three_edges_and_a_turned_one_mixes_three() {
        let (mut open, mut mixed) = (tetrahedron(), tetrahedron());
        open.pop();
        mixed[2].swap(0, 1);
        assert_eq!(welded(open).seams(), Seams { open: 3, mixed: 0 });
        assert_eq!(welded(mixed).seams(), Seams { open: 0, mixed: 3 });
    }

    #[test]
    fn a_corner_on_a_side_leaves_no_gap() {
        let mut corners = tetrahedron();
        let [a, b, c] = corners[2];
        corners[2] = [a, b.midpoint(a), c];
        corners.push([a.midpoint(b), b, c]);
        assert_eq!(welded(corners.clone()).seams(), Seams::default());
        corners.pop();
        assert_eq!(welded(corners).seams(), Seams { open: 3, mixed: 0 });
    }

    #[test]
    fn closed_parts_are_found_among_others_and_turned_one_way() {
        let mut corners = tetrahedron();
        corners[1].swap(0, 1);
        corners[3].swap(1, 2);
        corners.push([DVec3::splat(5.0), DVec3::splat(6.0), DVec3::new(5.0, 6.0, 5.0)]);
        let parts = welded(corners).closed_parts();
        assert_eq!(parts.len(), 1);
        assert_eq!(parts[0].0.seams(), Seams::default());
        assert_eq!(parts[0].1, [0, 1, 2, 3]);
        assert_eq!(parts[0].0.winding(DVec3::splat(0.1)), Some(1));
    }
}
