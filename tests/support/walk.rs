//! A plain walk through the binary partition, with each rule of the real one left out at will.
//!
//! The hard cases are hard only for programs that lack a remedy: this is such a program.

use super::BruteForce;
use snell::math::{Bounds, Ray, Vec3};
use snell::render::accel::build::{Cell, Partition};
use snell::render::accel::{Items, partition};
use snell::render::shape::Mesh;
use snell::render::shape::triangle::{ShearedRay, TriangleBlock};

/// The span of `t` in which a ray lies in a box; `None` when it misses.
pub type Slab = fn(&Ray, Bounds) -> Option<[f32; 2]>;

/// A walk through the partition of a mesh.
pub struct Walk {
    partition: Partition,
    triangles: Vec<[Vec3; 3]>,
    slab: Slab,
    /// Whether the walk goes on after the first leaf with a hit.
    patient: bool,
    /// Whether hits outside the span of their leaf's box count.
    hits_outside_count: bool,
}

impl Walk {
    /// A walk over a mesh that decides by `slab` which boxes a ray meets; otherwise careful.
    pub fn new(mesh: &Mesh, slab: Slab) -> Self {
        let triangles: Vec<_> = mesh.triangles.iter().map(|triangle| mesh.corners(*triangle)).collect();
        let partition = partition(&Items { triangles: &triangles, boxes: &[] });
        Self { partition, triangles, slab, patient: true, hits_outside_count: true }
    }

    /// The same, but content with the first leaf that has a hit.
    #[must_use]
    pub fn hasty(self) -> Self {
        Self { patient: false, ..self }
    }

    /// The same, but for it a hit outside the span of its leaf's box is none.
    #[must_use]
    pub fn strict(self) -> Self {
        Self { hits_outside_count: false, ..self }
    }

    /// The nearest hit that this walk finds: the bits of `t`, and the triangle.
    pub fn closest_hit(&self, ray: &Ray) -> Option<(u32, u32)> {
        let mut best: Option<(f32, u32)> = None;
        self.visit(&self.partition.root, ray, &ShearedRay::new(ray), &mut best);
        best.map(|(t, prim)| (t.to_bits(), prim))
    }

    fn visit(&self, cell: &Cell, ray: &Ray, sheared: &ShearedRay, best: &mut Option<(f32, u32)>) {
        let Some([enter, exit]) = (self.slab)(ray, cell.bounds()) else { return };
        if best.is_some_and(|(t, _)| !self.patient || t < enter) {
            return;
        }
        match cell {
            Cell::Inner { children, .. } => {
                let distance =
                    |cell: &Cell| (self.slab)(ray, cell.bounds()).map_or(f32::INFINITY, |[t, _]| t);
                let swapped = distance(&children[1]) < distance(&children[0]);
                self.visit(&children[usize::from(swapped)], ray, sheared, best);
                self.visit(&children[usize::from(!swapped)], ray, sheared, best);
            }
            Cell::Leaf { items, .. } => {
                for &item in items {
                    TriangleBlock::new(&[(self.triangles[item as usize], item)]).intersect(
                        sheared,
                        |prim, hit| {
                            let counts = self.hits_outside_count || (enter..=exit).contains(&hit.t);
                            if counts && BruteForce::precedes((hit.t, prim), *best, ray) {
                                *best = Some((hit.t, prim));
                            }
                        },
                    );
                }
            }
        }
    }

    /// Cells whose boxes a ray meets, in order, until nothing before the nearest hit is left.
    pub fn steps(&self, ray: &Ray) -> usize {
        let nearest = self.closest_hit(ray).map_or(f32::INFINITY, |(bits, _)| f32::from_bits(bits));
        let mut open = vec![&self.partition.root];
        let mut count = 0;
        while let Some(cell) = open.pop() {
            if let Cell::Inner { children, .. } = cell
                && (self.slab)(ray, cell.bounds()).is_some_and(|[enter, _]| enter <= nearest)
            {
                count += 1;
                open.extend(children.iter());
            }
        }
        count
    }
}

/// The box test of the renderer: near faces by the sign bit, NaN changes nothing, exit widened (Ize 2013).
pub fn conservative_slab(ray: &Ray, bounds: Bounds) -> Option<[f32; 2]> {
    let mut span = [0.0_f32, ray.t_max];
    for axis in 0..3 {
        let (mut near, mut far) = (bounds.min[axis], bounds.max[axis]);
        if ray.d[axis].is_sign_negative() {
            (near, far) = (far, near);
        }
        let inverse = 1.0 / ray.d[axis];
        let (first, last) = ((near - ray.o[axis]) * inverse, (far - ray.o[axis]) * inverse);
        span[0] = if first > span[0] { first } else { span[0] };
        span[1] = if last < span[1] { last } else { span[1] };
    }
    let exit = span[1] * (1.0 + 2.0 * snell::math::float::gamma(3));
    (span[0] <= exit).then_some([span[0], exit])
}

/// The same as it is mostly written: near faces by comparison with 0, which −0 passes, and no allowance for rounding.
pub fn hasty_slab(ray: &Ray, bounds: Bounds) -> Option<[f32; 2]> {
    let mut span = [0.0_f32, ray.t_max];
    for axis in 0..3 {
        let inverse = 1.0 / ray.d[axis];
        let (mut near, mut far) = (bounds.min[axis], bounds.max[axis]);
        if ray.d[axis] < 0.0 {
            (near, far) = (far, near);
        }
        let (first, last) = ((near - ray.o[axis]) * inverse, (far - ray.o[axis]) * inverse);
        span = [span[0].max(first), span[1].min(last)];
    }
    (span[0] <= span[1]).then_some(span)
}

/// The fastest form, with one fused multiply-add a face: `b · 1/d − o · 1/d`.
pub fn fused_slab(ray: &Ray, bounds: Bounds) -> Option<[f32; 2]> {
    let inverse = ray.d.recip();
    let shift = -ray.o * inverse;
    let mut span = [0.0_f32, ray.t_max];
    for axis in 0..3 {
        let a = bounds.min[axis].mul_add(inverse[axis], shift[axis]);
        let b = bounds.max[axis].mul_add(inverse[axis], shift[axis]);
        span = [span[0].max(a.min(b)), span[1].min(a.max(b))];
    }
    (span[0] <= span[1]).then_some(span)
}
