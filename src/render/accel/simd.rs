//! The tests of the traversal in vector registers: the one module of the crate with `unsafe` code.
//!
//! Each function does what its twin in [`super::kernel`] does, operation for operation, so the bits are the same:
//! `min` and `max` of x86 return their second argument where one is NaN, as the comparisons there do, and no
//! multiplication is fused with an addition.
//!
//! Everything called in a loop is written out: a closure handed to `map` is compiled without the vector features, and so
//! cannot become part of the walk.

#![allow(unsafe_code)]

#[cfg(feature = "naive")]
pub mod naive;

use super::kernel::{EXIT_SLACK, Kernel, KernelRay};
use super::walk::{Query, walk};
use super::wide::{Node, Row};
use crate::math::Ray;
use crate::render::geometry::Nearest;
use crate::render::shape::triangle::{Edges, ShearedRay, TriangleBlock, TriangleHit};
use std::arch::x86_64::{
    __m128, _CMP_GE_OQ, _CMP_LE_OQ, _MM_HINT_T0, _mm_cmp_ps, _mm_load_ps, _mm_max_ps, _mm_min_ps,
    _mm_movemask_ps, _mm_mul_ps, _mm_or_ps, _mm_prefetch, _mm_set1_ps, _mm_setzero_ps, _mm_storeu_ps,
    _mm_sub_ps, _mm256_cmp_ps, _mm256_load_ps, _mm256_max_ps, _mm256_min_ps, _mm256_movemask_ps,
    _mm256_mul_ps, _mm256_set1_ps, _mm256_setzero_ps, _mm256_storeu_ps, _mm256_sub_ps,
};

/// A processor with AVX2. There is no way to have one but [`Avx2::detect`].
#[derive(Clone, Copy)]
pub struct Avx2(());

impl Avx2 {
    /// The proof that this processor has what the functions here need.
    pub fn detect() -> Option<Self> {
        let found = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("bmi1");
        found.then_some(Self(()))
    }

    /// Walks through a tree with the whole walk compiled for AVX2.
    pub fn walk<const ANY: bool>(self, query: &Query<'_>, nearest: &mut Nearest) {
        // SAFETY: `self` proves that the processor has the features.
        unsafe { self.walk_compiled::<ANY>(query, nearest) }
    }

    #[target_feature(enable = "avx2,bmi1")]
    fn walk_compiled<const ANY: bool>(self, query: &Query<'_>, nearest: &mut Nearest) {
        walk::<Self, ANY>(self, query, nearest);
    }
}

impl Kernel for Avx2 {
    type Ray = KernelRay;
    const SLACK: f32 = EXIT_SLACK;

    #[inline(always)]
    fn prepare(self, ray: &Ray) -> KernelRay {
        KernelRay::new(ray)
    }

    #[inline(always)]
    fn boxes(self, KernelRay { boxes: ray, .. }: &KernelRay, node: &Node, t_max: f32) -> (u32, Row) {
        // SAFETY: `self` proves that the processor has AVX2. Rows are below 6, so every load is within `faces`, whose
        // rows are aligned to 32 bytes because a node is to 64; the store fills `entries` exactly.
        unsafe {
            let (mut entry, mut exit) = (_mm256_setzero_ps(), _mm256_set1_ps(t_max));
            for axis in 0..3 {
                let [near, far] = ray.rows(axis);
                let near = _mm256_load_ps(node.faces.as_ptr().add(near).cast());
                let far = _mm256_load_ps(node.faces.as_ptr().add(far).cast());
                let (o, inverse) = (_mm256_set1_ps(ray.o[axis]), _mm256_set1_ps(ray.inverse[axis]));
                entry = _mm256_max_ps(_mm256_mul_ps(_mm256_sub_ps(near, o), inverse), entry);
                exit = _mm256_min_ps(_mm256_mul_ps(_mm256_sub_ps(far, o), inverse), exit);
            }
            let exit = _mm256_mul_ps(exit, _mm256_set1_ps(EXIT_SLACK));
            let mask = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(entry, exit));
            let mut entries = [0.0; 8];
            _mm256_storeu_ps(entries.as_mut_ptr(), entry);
            (mask as u32, entries)
        }
    }

    #[inline(always)]
    fn triangles(
        self,
        KernelRay { triangles: ray, .. }: &KernelRay,
        block: &TriangleBlock,
        found: impl FnMut(u32, TriangleHit),
    ) {
        // SAFETY: `self` proves that the processor has AVX2; what is called loads and stores within its arguments.
        let (inside, mut edges) = unsafe {
            let (a, b, c) = (sheared(ray, block, 0), sheared(ray, block, 1), sheared(ray, block, 2));
            let u = _mm_sub_ps(_mm_mul_ps(c[0], b[1]), _mm_mul_ps(c[1], b[0]));
            let v = _mm_sub_ps(_mm_mul_ps(a[0], c[1]), _mm_mul_ps(a[1], c[0]));
            let w = _mm_sub_ps(_mm_mul_ps(b[0], a[1]), _mm_mul_ps(b[1], a[0]));
            let (low, high) = (_mm_min_ps(_mm_min_ps(u, v), w), _mm_max_ps(_mm_max_ps(u, v), w));
            let zero = _mm_setzero_ps();
            let positive = _mm_cmp_ps::<_CMP_GE_OQ>(low, zero);
            let negative = _mm_cmp_ps::<_CMP_LE_OQ>(high, zero);
            let inside = _mm_movemask_ps(_mm_or_ps(positive, negative));
            if inside == 0 {
                return;
            }
            let depth = [stored(a[2]), stored(b[2]), stored(c[2])];
            (inside as u32, Edges { u: stored(u), v: stored(v), w: stored(w), depth })
        };
        block.finish(ray, &mut edges, inside, found);
    }

    #[inline(always)]
    fn prefetch<T>(self, place: *const T) {
        // SAFETY: a prefetch reads nothing, wherever it points.
        unsafe {
            // Two lines: the others follow at once, and the processor fetches ahead by itself.
            _mm_prefetch::<_MM_HINT_T0>(place.cast());
            _mm_prefetch::<_MM_HINT_T0>(place.cast::<i8>().wrapping_add(64));
        }
    }
}

/// One vertex of all lanes relative to the ray: sheared x and y, and the depth before scaling.
///
/// # Safety
/// The processor has AVX2.
#[inline(always)]
unsafe fn sheared(ray: &ShearedRay, block: &TriangleBlock, vertex: usize) -> [__m128; 3] {
    let rows = block.vertices[vertex].as_ptr();
    // SAFETY: axes are below 3, and rows of a block are aligned to 16 bytes as the block is.
    unsafe {
        let [x, y, z] = ray.axes();
        let x = _mm_sub_ps(_mm_load_ps(rows.add(x).cast()), _mm_set1_ps(ray.o[0]));
        let y = _mm_sub_ps(_mm_load_ps(rows.add(y).cast()), _mm_set1_ps(ray.o[1]));
        let z = _mm_sub_ps(_mm_load_ps(rows.add(z).cast()), _mm_set1_ps(ray.o[2]));
        let x = _mm_sub_ps(x, _mm_mul_ps(_mm_set1_ps(ray.shear[0]), z));
        let y = _mm_sub_ps(y, _mm_mul_ps(_mm_set1_ps(ray.shear[1]), z));
        [x, y, z]
    }
}

#[inline(always)]
fn stored(lanes: __m128) -> [f32; 4] {
    let mut out = [0.0; 4];
    // SAFETY: the store fills `out` exactly; SSE is part of every x86-64 processor.
    unsafe { _mm_storeu_ps(out.as_mut_ptr(), lanes) };
    out
}
