//! Triangles: the watertight test, four at a time, and what a single triangle knows about itself.
//!
//! The ray is sheared so that it runs along an axis; the signs of three edge functions then tell inside from outside.
//! Triangles that share an edge compute the same two products for it, so no ray slips between them
//! (Woop, Benthin, Wald 2013). No fused multiply-add may enter an edge function: it would break that symmetry.

use crate::math::{DVec3, Ray, Vec2, Vec3};

/// Triangles tested at once.
pub const LANES: usize = 4;

/// A number for each triangle of a block.
pub type Lanes = [f32; LANES];

/// A ray, prepared for the watertight test.
#[derive(Clone, Copy)]
pub struct ShearedRay {
    /// The origin, its axes permuted so that the direction is largest along the last.
    pub o: [f32; 3],
    /// The permutation.
    axes: [usize; 3],
    /// What shears and scales the direction to (0, 0, 1).
    pub shear: [f32; 3],
}

impl ShearedRay {
    /// Prepares `ray`. A direction that is zero or not finite makes a ray that misses everything.
    pub fn new(ray: &Ray) -> Self {
        let size = ray.d.abs();
        let z = if size.x > size.y && size.x > size.z {
            0
        } else if size.y > size.z {
            1
        } else {
            2
        };
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let d = axes.map(|axis| ray.d[axis]);
        Self { o: axes.map(|axis| ray.o[axis]), axes, shear: [d[0] / d[2], d[1] / d[2], 1.0 / d[2]] }
    }

    /// The axes of the ray's frame in space, each below 3.
    #[inline(always)]
    pub fn axes(&self) -> [usize; 3] {
        self.axes
    }
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct TriangleHit {
    /// The ray parameter.
    pub t: f32,
    /// Barycentrics of the second and third vertex.
    pub uv: Vec2,
}

/// Up to four triangles, their coordinates side by side.
#[derive(Clone, Debug)]
#[repr(align(32))]
pub struct TriangleBlock {
    /// Coordinates by vertex, axis, lane.
    pub vertices: [[Lanes; 3]; 3],
    /// The primitive in each lane; unused lanes repeat the last triangle, which does no harm.
    pub prims: [u32; LANES],
}

/// The three edge functions of four triangles, and the depth of their vertices along the sheared ray.
pub struct Edges {
    /// Of the edge opposite the first vertex.
    pub u: Lanes,
    /// Of the edge opposite the second.
    pub v: Lanes,
    /// Of the edge opposite the third.
    pub w: Lanes,
    /// By vertex.
    pub depth: [Lanes; 3],
}

impl Edges {
    /// A bit for each lane whose edge functions do not differ in sign.
    #[inline(always)]
    pub fn inside(&self) -> u32 {
        let mut inside = 0_u32;
        for i in 0..LANES {
            let (u, v, w) = (self.u[i], self.v[i], self.w[i]);
            let low = if u < v { u } else { v };
            let high = if u > v { u } else { v };
            let low = if low < w { low } else { w };
            let high = if high > w { high } else { w };
            inside |= u32::from((low >= 0.0) | (high <= 0.0)) << i;
        }
        inside
    }
}

impl TriangleBlock {
    /// A block of one to four triangles, each with its primitive index.
    pub fn new(triangles: &[([Vec3; 3], u32)]) -> Self {
        let lane = |i: usize| &triangles[i.min(triangles.len() - 1)];
        let mut block = Self { vertices: [[[0.0; LANES]; 3]; 3], prims: [0; LANES] };
        for i in 0..LANES {
            let (corners, prim) = lane(i);
            block.prims[i] = *prim;
            for (vertex, corner) in corners.iter().enumerate() {
                for axis in 0..3 {
                    block.vertices[vertex][axis][i] = corner[axis];
                }
            }
        }
        block
    }

    /// Calls `found` for each lane whose triangle the line of `ray` meets, whatever the sign of `t`.
    pub fn intersect(&self, ray: &ShearedRay, found: impl FnMut(u32, TriangleHit)) {
        let mut edges = self.edges(ray);
        let inside = edges.inside();
        self.finish(ray, &mut edges, inside, found);
    }

    /// Calls `found` for each lane of `inside` that is inside for certain.
    #[inline(always)]
    pub fn finish(
        &self,
        ray: &ShearedRay,
        edges: &mut Edges,
        mut inside: u32,
        mut found: impl FnMut(u32, TriangleHit),
    ) {
        while inside != 0 {
            let i = inside.trailing_zeros() as usize;
            inside &= inside - 1;
            if let Some(hit) = self.finish_lane(ray, edges, i) {
                found(self.prims[i], hit);
            }
        }
    }

    /// The edge functions of all lanes, in single precision.
    #[inline(always)]
    pub fn edges(&self, ray: &ShearedRay) -> Edges {
        let (a, b, c) = (self.sheared(ray, 0), self.sheared(ray, 1), self.sheared(ray, 2));
        let mut edges =
            Edges { u: [0.0; LANES], v: [0.0; LANES], w: [0.0; LANES], depth: [a[2], b[2], c[2]] };
        for i in 0..LANES {
            edges.u[i] = c[0][i] * b[1][i] - c[1][i] * b[0][i];
            edges.v[i] = a[0][i] * c[1][i] - a[1][i] * c[0][i];
            edges.w[i] = b[0][i] * a[1][i] - b[1][i] * a[0][i];
        }
        edges
    }

    /// One vertex of all lanes relative to the ray: sheared x and y, and the depth before scaling.
    #[inline(always)]
    fn sheared(&self, ray: &ShearedRay, vertex: usize) -> [Lanes; 3] {
        let vertex = &self.vertices[vertex];
        let (x, y, z) = (&vertex[ray.axes[0]], &vertex[ray.axes[1]], &vertex[ray.axes[2]]);
        let mut out = [[0.0; LANES]; 3];
        for i in 0..LANES {
            let depth = z[i] - ray.o[2];
            out[0][i] = (x[i] - ray.o[0]) - ray.shear[0] * depth;
            out[1][i] = (y[i] - ray.o[1]) - ray.shear[1] * depth;
            out[2][i] = depth;
        }
        out
    }

    /// Decides the lane exactly where an edge function rounds to 0, and finds `t` and the barycentrics.
    #[inline(always)]
    fn finish_lane(&self, ray: &ShearedRay, edges: &mut Edges, i: usize) -> Option<TriangleHit> {
        if edges.u[i] == 0.0 || edges.v[i] == 0.0 || edges.w[i] == 0.0 {
            self.refine(ray, edges, i)?;
        }
        let (u, v, w) = (edges.u[i], edges.v[i], edges.w[i]);
        let determinant = u + v + w;
        let depth = u * edges.depth[0][i] + v * edges.depth[1][i] + w * edges.depth[2][i];
        let inverse = 1.0 / determinant;
        let hit = TriangleHit { t: depth * ray.shear[2] * inverse, uv: Vec2::new(v * inverse, w * inverse) };
        (determinant != 0.0).then_some(hit)
    }

    /// The edge functions of one lane again, their products now exact; `None` where the signs disagree after all.
    #[cold]
    fn refine(&self, ray: &ShearedRay, edges: &mut Edges, i: usize) -> Option<()> {
        let [a, b, c] = [0, 1, 2].map(|vertex| {
            let [x, y, _] = self.sheared(ray, vertex);
            [f64::from(x[i]), f64::from(y[i])]
        });
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        (edges.u[i], edges.v[i], edges.w[i]) = (u as f32, v as f32, w as f32);
        let agree = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        agree.then_some(())
    }
}

/// `(b − a) × (c − a)`, from the two shorter edges in double precision, so that slivers keep their plane.
///
/// Its length is twice the area; it points to the side from which the vertices run counter-clockwise.
#[inline]
pub fn cross_of_edges(corners: [Vec3; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let longest = ab.length_squared().max(bc.length_squared()).max(ca.length_squared());
    if longest == bc.length_squared() {
        ca.cross(ab)
    } else if longest == ca.length_squared() {
        ab.cross(bc)
    } else {
        bc.cross(ca)
    }
}
