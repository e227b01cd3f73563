//! The fastest tests that lack a remedy, in vector registers. Only `benches/hard_cases` asks for them.

use super::super::kernel::{BoxRay, EXIT_SLACK, Kernel, KernelRay};
use super::super::walk::{Query, walk};
use super::super::wide::{Node, Row};
use super::{Avx2, stored};
use crate::math::{Ray, Vec2};
use crate::render::geometry::Nearest;
use crate::render::naive::{Remedy, lacks};
use crate::render::shape::triangle::{TriangleBlock, TriangleHit};
use std::arch::x86_64::{
    __m128, _CMP_GE_OQ, _CMP_LE_OQ, _mm_add_ps, _mm_and_ps, _mm_cmp_ps, _mm_div_ps, _mm_fmadd_ps,
    _mm_fmsub_ps, _mm_load_ps, _mm_movemask_ps, _mm_mul_ps, _mm_set1_ps, _mm_setzero_ps, _mm_sub_ps,
    _mm256_cmp_ps, _mm256_fmsub_ps, _mm256_load_ps, _mm256_max_ps, _mm256_min_ps, _mm256_movemask_ps,
    _mm256_set1_ps, _mm256_setzero_ps, _mm256_storeu_ps,
};

/// Walks through a tree without the remedies that are left out, and says so; does nothing where none is, or where the
/// processor lacks fused multiply-adds.
#[inline(always)]
pub fn walk_naively<const ANY: bool>(avx2: Avx2, query: &Query<'_>, nearest: &mut Nearest) -> bool {
    let (boxes, triangles) = (lacks(Remedy::Boxes), lacks(Remedy::Triangles));
    if !(boxes || triangles) || !is_x86_feature_detected!("fma") {
        return false;
    }
    // SAFETY: `avx2` proves that the processor has AVX2, and it has fused multiply-adds.
    unsafe {
        match (boxes, triangles) {
            (true, true) => walk_compiled::<true, true, ANY>(avx2, query, nearest),
            (true, false) => walk_compiled::<true, false, ANY>(avx2, query, nearest),
            (false, _) => walk_compiled::<false, true, ANY>(avx2, query, nearest),
        }
    }
    true
}

#[target_feature(enable = "avx2,bmi1,fma")]
fn walk_compiled<const BOXES: bool, const TRIANGLES: bool, const ANY: bool>(
    avx2: Avx2,
    query: &Query<'_>,
    nearest: &mut Nearest,
) {
    walk::<_, ANY>(Naive::<BOXES, TRIANGLES>(avx2), query, nearest);
}

/// A processor with AVX2 and fused multiply-adds, that tests boxes or triangles naively.
#[derive(Clone, Copy)]
struct Naive<const BOXES: bool, const TRIANGLES: bool>(Avx2);

/// A ray for tests of both kinds.
struct NaiveRay {
    careful: KernelRay,
    /// The origin over the direction.
    shift: [f32; 3],
    ray: Ray,
}

impl<const BOXES: bool, const TRIANGLES: bool> Kernel for Naive<BOXES, TRIANGLES> {
    type Ray = NaiveRay;
    const SLACK: f32 = if BOXES { 1.0 } else { EXIT_SLACK };

    #[inline(always)]
    fn prepare(self, ray: &Ray) -> NaiveRay {
        let careful = KernelRay::new(ray);
        let BoxRay { o, inverse, .. } = careful.boxes;
        NaiveRay { careful, shift: [0, 1, 2].map(|axis| o[axis] * inverse[axis]), ray: *ray }
    }

    #[inline(always)]
    fn boxes(self, ray: &NaiveRay, node: &Node, t_max: f32) -> (u32, Row) {
        if !BOXES {
            return self.0.boxes(&ray.careful, node, t_max);
        }
        // SAFETY: as in the careful form; the processor has fused multiply-adds.
        unsafe {
            let (mut entry, mut exit) = (_mm256_setzero_ps(), _mm256_set1_ps(t_max));
            for axis in 0..3 {
                let [near, far] = ray.careful.boxes.rows(axis);
                let near = _mm256_load_ps(node.faces.as_ptr().add(near).cast());
                let far = _mm256_load_ps(node.faces.as_ptr().add(far).cast());
                let inverse = _mm256_set1_ps(ray.careful.boxes.inverse[axis]);
                let shift = _mm256_set1_ps(ray.shift[axis]);
                entry = _mm256_max_ps(_mm256_fmsub_ps(near, inverse, shift), entry);
                exit = _mm256_min_ps(_mm256_fmsub_ps(far, inverse, shift), exit);
            }
            let mask = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(entry, exit));
            let mut entries = [0.0; 8];
            _mm256_storeu_ps(entries.as_mut_ptr(), entry);
            (mask as u32, entries)
        }
    }

    #[inline(always)]
    fn triangles(self, ray: &NaiveRay, block: &TriangleBlock, mut found: impl FnMut(u32, TriangleHit)) {
        if !TRIANGLES {
            return self.0.triangles(&ray.careful, block, found);
        }
        // SAFETY: the processor has AVX2 and fused multiply-adds.
        let (mut inside, [t, u, v]) = unsafe { moeller_trumbore(&ray.ray, block) };
        if inside == 0 {
            return;
        }
        let (t, u, v) = (stored(t), stored(u), stored(v));
        while inside != 0 {
            let i = inside.trailing_zeros() as usize;
            inside &= inside - 1;
            found(block.prims[i], TriangleHit { t: t[i], uv: Vec2::new(u[i], v[i]) });
        }
    }

    #[inline(always)]
    fn prefetch<T>(self, place: *const T) {
        self.0.prefetch(place);
    }
}

type Vectors = [__m128; 3];

/// A bit for each lane that is met; `t` and the barycentrics of the second and third vertex.
///
/// # Safety
/// The processor has AVX2 and fused multiply-adds.
#[inline(always)]
unsafe fn moeller_trumbore(ray: &Ray, block: &TriangleBlock) -> (u32, Vectors) {
    // SAFETY: rows of a block are aligned to 16 bytes as the block is.
    unsafe {
        let row = |vertex: usize, axis: usize| _mm_load_ps(block.vertices[vertex][axis].as_ptr());
        let mut from_a = [[_mm_setzero_ps(); 3]; 3];
        let mut d = [_mm_setzero_ps(); 3];
        for axis in 0..3 {
            let a = row(0, axis);
            from_a[0][axis] = _mm_sub_ps(row(1, axis), a);
            from_a[1][axis] = _mm_sub_ps(row(2, axis), a);
            from_a[2][axis] = _mm_sub_ps(_mm_set1_ps(ray.o[axis]), a);
            d[axis] = _mm_set1_ps(ray.d[axis]);
        }
        let [e1, e2, s] = from_a;
        let h = cross(&d, &e2);
        let f = _mm_div_ps(_mm_set1_ps(1.0), dot(&e1, &h));
        let u = _mm_mul_ps(f, dot(&s, &h));
        let q = cross(&s, &e1);
        let v = _mm_mul_ps(f, dot(&d, &q));
        let zero = _mm_setzero_ps();
        let within = _mm_and_ps(_mm_cmp_ps::<_CMP_GE_OQ>(u, zero), _mm_cmp_ps::<_CMP_GE_OQ>(v, zero));
        let below = _mm_cmp_ps::<_CMP_LE_OQ>(_mm_add_ps(u, v), _mm_set1_ps(1.0));
        let inside = _mm_movemask_ps(_mm_and_ps(within, below)) as u32;
        (inside, [_mm_mul_ps(f, dot(&e2, &q)), u, v])
    }
}

/// # Safety
/// The processor has AVX2 and fused multiply-adds.
#[inline(always)]
unsafe fn cross(a: &Vectors, b: &Vectors) -> Vectors {
    // SAFETY: as above.
    unsafe {
        [
            _mm_fmsub_ps(a[1], b[2], _mm_mul_ps(a[2], b[1])),
            _mm_fmsub_ps(a[2], b[0], _mm_mul_ps(a[0], b[2])),
            _mm_fmsub_ps(a[0], b[1], _mm_mul_ps(a[1], b[0])),
        ]
    }
}

/// # Safety
/// The processor has AVX2 and fused multiply-adds.
#[inline(always)]
unsafe fn dot(a: &Vectors, b: &Vectors) -> __m128 {
    // SAFETY: as above.
    unsafe { _mm_fmadd_ps(a[0], b[0], _mm_fmadd_ps(a[1], b[1], _mm_mul_ps(a[2], b[2]))) }
}
