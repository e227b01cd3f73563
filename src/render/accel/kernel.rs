//! The two tests that a traversal spends its time in, and their portable form.
//!
//! [`Kernel`] names them, so that the walk through the tree is written once: over plain arrays here, over vector
//! registers in [`super::simd`]. Both do the same operations in the same order, and so give the same bits.

use super::wide::{Node, Row, WIDTH};
use crate::math::{Ray, Vec3, float};
use crate::render::shape::triangle::{ShearedRay, TriangleBlock, TriangleHit};

/// The factor on exit distances that makes up for the rounding of both: 1 + 2γ(3) (Ize 2013).
pub const EXIT_SLACK: f32 = 1.0 + 2.0 * float::gamma(3);

/// A ray, prepared for boxes.
#[derive(Clone, Copy)]
pub struct BoxRay {
    /// The origin.
    pub o: [f32; 3],
    /// One over the direction; infinite, with its sign, where that is zero.
    pub inverse: [f32; 3],
    /// Which row of [`Node::faces`] holds the face that the ray meets first along each axis. Below 6.
    near: [usize; 3],
}

impl BoxRay {
    /// Prepares `ray`.
    pub fn new(ray: &Ray) -> Self {
        let near = [0, 1, 2].map(|axis| if ray.d[axis].is_sign_negative() { axis + 3 } else { axis });
        Self { o: ray.o.to_array(), inverse: Vec3::recip(ray.d).to_array(), near }
    }

    /// The rows of the faces that the ray meets first and last along an axis; both below 6.
    #[inline(always)]
    pub fn rows(&self, axis: usize) -> [usize; 2] {
        let near = self.near[axis];
        [near, 2 * axis + 3 - near]
    }
}

/// A ray, prepared for both tests.
#[derive(Clone, Copy)]
pub struct KernelRay {
    /// For boxes.
    pub boxes: BoxRay,
    /// For triangles.
    pub triangles: ShearedRay,
}

impl KernelRay {
    /// Prepares `ray`.
    #[inline(always)]
    pub fn new(ray: &Ray) -> Self {
        Self { boxes: BoxRay::new(ray), triangles: ShearedRay::new(ray) }
    }
}

/// What a traversal asks of a processor.
pub trait Kernel: Copy {
    /// A ray, prepared for the tests.
    type Ray;
    /// A box that the ray enters at `t` is worth a visit if `t` is at most this times the nearest hit.
    const SLACK: f32;

    /// Prepares `ray`.
    fn prepare(self, ray: &Ray) -> Self::Ray;

    /// A bit for each child of `node` that the ray may meet before `t_max`, and where it enters each.
    fn boxes(self, ray: &Self::Ray, node: &Node, t_max: f32) -> (u32, Row);

    /// Calls `found` for each lane of `block` whose triangle the line of the ray meets, whatever the sign of `t`.
    fn triangles(self, ray: &Self::Ray, block: &TriangleBlock, found: impl FnMut(u32, TriangleHit));

    /// Says that `place` will be read soon.
    fn prefetch<T>(self, place: *const T);
}

/// Any processor.
#[derive(Clone, Copy)]
pub struct Portable;

impl Kernel for Portable {
    type Ray = KernelRay;
    const SLACK: f32 = EXIT_SLACK;

    #[inline(always)]
    fn prepare(self, ray: &Ray) -> KernelRay {
        KernelRay::new(ray)
    }

    #[inline(always)]
    fn boxes(self, KernelRay { boxes: ray, .. }: &KernelRay, node: &Node, t_max: f32) -> (u32, Row) {
        let mut entry: Row = [0.0; WIDTH];
        let mut exit: Row = [t_max; WIDTH];
        for axis in 0..3 {
            let [near, far] = ray.rows(axis).map(|row| &node.faces[row]);
            let (o, inverse) = (ray.o[axis], ray.inverse[axis]);
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
        (mask, entry)
    }

    #[inline(always)]
    fn triangles(self, ray: &KernelRay, block: &TriangleBlock, found: impl FnMut(u32, TriangleHit)) {
        let mut edges = block.edges(&ray.triangles);
        let inside = edges.inside();
        block.finish(&ray.triangles, &mut edges, inside, found);
    }

    #[inline(always)]
    fn prefetch<T>(self, _place: *const T) {}
}
