//! All that can be hit, behind one interface: the tree over what is bounded, a list of what is not.

mod gradient;
mod sampling;
mod surface;

pub use gradient::Gradient;
pub use sampling::{AreaSample, DirectionSample, Outline};

use super::accel::{Items, Wide, partition};
use super::shape::solid::{PlacedSolid, SolidHit};
use super::shape::{MaterialId, Mesh, Solid, SourceId};
use crate::math::{Bounds, Ray, Vec2, Vec3};
use std::ops::Range;

/// Index of a primitive: triangles first, mesh by mesh, then solids.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct PrimId(pub u32);

/// The nearest intersection: what is needed to find the full [`SurfacePoint`] later.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Hit {
    /// The ray parameter.
    pub t: f32,
    /// What was hit.
    pub prim: PrimId,
    /// Barycentrics of the second and third vertex for triangles; the shape's own parameters for solids.
    pub uv: Vec2,
}

/// A point on a surface, with all that shading needs.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SurfacePoint {
    /// The point, in world space.
    pub p: Vec3,
    /// A bound on the absolute error of `p`, per axis.
    pub p_error: Vec3,
    /// The unit geometric normal; outwards for closed shapes.
    pub n: Vec3,
    /// The unit shading normal, in the hemisphere of `n`.
    pub ns: Vec3,
    /// A unit tangent, orthogonal to `ns`, along growing texture `u` where that is defined.
    pub tangent: Vec3,
    /// The texture point.
    pub uv: Vec2,
    /// The point in the frame where textures are projected: the object's own, before its transform.
    pub p_object: Vec3,
    /// What it is made of.
    pub material: MaterialId,
    /// What was hit.
    pub prim: PrimId,
    /// The object it belongs to.
    pub source: SourceId,
}

/// All shapes of a scene.
pub struct Geometry {
    meshes: Vec<Mesh>,
    /// The first primitive of each mesh, then the first of the solids.
    first_prims: Vec<u32>,
    solids: Vec<PlacedSolid>,
    tree: Wide,
    /// Solids that no box holds; every ray tries them all.
    unbounded: Vec<u32>,
}

/// What a primitive index stands for.
enum Prim<'a> {
    Triangle(&'a Mesh, [u32; 3]),
    Solid(&'a PlacedSolid),
}

impl Geometry {
    /// Builds the tree over `meshes` and `solids`.
    ///
    /// # Panics
    /// When there are 2³² primitives or more.
    pub fn build(meshes: Vec<Mesh>, solids: Vec<Solid>) -> Self {
        let solids: Vec<_> = solids.into_iter().map(PlacedSolid::new).collect();
        let mut first_prims = vec![0];
        let mut triangles = Vec::with_capacity(meshes.iter().map(|mesh| mesh.triangles.len()).sum());
        for mesh in &meshes {
            triangles.extend(mesh.triangles.iter().map(|corners| mesh.corners(*corners)));
            first_prims.push(u32::try_from(triangles.len()).expect("fewer than 2³² triangles"));
        }
        let bounds: Vec<_> = solids.iter().map(PlacedSolid::bounds).collect();
        let unbounded = (0..).zip(&bounds).filter(|(_, bounds)| bounds.is_none()).map(|(i, _)| i).collect();
        let (bounded, boxes): (Vec<_>, Vec<_>) =
            (0..).zip(bounds).filter_map(|(i, bounds)| Some((i, bounds?))).unzip();
        let partition = partition(&Items { triangles: &triangles, boxes: &boxes });
        let tree = Wide::collapse(&partition, &triangles, &bounded);
        Self { meshes, first_prims, solids, tree, unbounded }
    }

    /// The same geometry, traced by the code for any processor. It gives the same bits, only later.
    #[must_use]
    pub fn without_simd(mut self) -> Self {
        self.tree.without_simd();
        self
    }

    /// A box that holds everything but the planes; empty when there is nothing.
    pub fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }

    /// What the tree takes in memory, in bytes.
    pub fn tree_bytes(&self) -> usize {
        self.tree.bytes()
    }

    /// The number of primitives: triangles first, mesh by mesh, then solids.
    pub fn prim_count(&self) -> u32 {
        self.first_solid() + self.solids.len() as u32
    }

    /// The primitives of each mesh, in the order given.
    pub fn mesh_prims(&self) -> impl Iterator<Item = (&Mesh, Range<u32>)> {
        self.meshes.iter().zip(self.first_prims.windows(2).map(|pair| pair[0]..pair[1]))
    }

    /// The primitive of each solid, in the order given.
    pub fn solid_prims(&self) -> impl Iterator<Item = (&Solid, PrimId)> {
        self.solids.iter().map(PlacedSolid::solid).zip((self.first_solid()..).map(PrimId))
    }

    /// What a primitive is made of.
    pub fn material(&self, prim: PrimId) -> MaterialId {
        match self.prim(prim) {
            Prim::Triangle(mesh, _) => mesh.material,
            Prim::Solid(solid) => solid.solid().material,
        }
    }

    /// The object a primitive belongs to.
    pub fn source(&self, prim: PrimId) -> SourceId {
        match self.prim(prim) {
            Prim::Triangle(mesh, _) => mesh.source,
            Prim::Solid(solid) => solid.solid().source,
        }
    }

    /// The nearest intersection with `t` in the open interval (0, `ray.t_max`); of equals, the lowest primitive.
    ///
    /// A ray with a coordinate that is not finite misses.
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        if !is_sane(ray) {
            return None;
        }
        let mut nearest = Nearest { t: ray.t_max, hit: None };
        for &solid in &self.unbounded {
            nearest.offer(self.hit_solid(solid, ray));
        }
        self.tree.trace::<false>(ray, &mut nearest, |solid| self.hit_solid(solid, ray));
        nearest.hit
    }

    /// Whether anything lies in the open interval (0, `ray.t_max`).
    pub fn any_hit(&self, ray: &Ray) -> bool {
        if !is_sane(ray) {
            return false;
        }
        if self.unbounded.iter().any(|&solid| self.hit_solid(solid, ray).is_some()) {
            return true;
        }
        let mut nearest = Nearest { t: ray.t_max, hit: None };
        self.tree.trace::<true>(ray, &mut nearest, |solid| self.hit_solid(solid, ray));
        nearest.hit.is_some()
    }

    fn hit_solid(&self, solid: u32, ray: &Ray) -> Option<Hit> {
        let SolidHit { t, uv } = self.solids[solid as usize].intersect(ray)?;
        Some(Hit { t, prim: PrimId(self.first_solid() + solid), uv })
    }

    fn first_solid(&self) -> u32 {
        self.first_prims[self.meshes.len()]
    }

    fn prim(&self, prim: PrimId) -> Prim<'_> {
        match prim.0.checked_sub(self.first_solid()) {
            Some(solid) => Prim::Solid(&self.solids[solid as usize]),
            None => {
                let mesh = self.first_prims.partition_point(|&first| first <= prim.0) - 1;
                let triangle = prim.0 - self.first_prims[mesh];
                Prim::Triangle(&self.meshes[mesh], self.meshes[mesh].triangles[triangle as usize])
            }
        }
    }
}

/// The nearest hit so far.
pub struct Nearest {
    /// Its parameter, or the end of the ray.
    pub t: f32,
    /// The hit, if there was one.
    pub hit: Option<Hit>,
}

impl Nearest {
    /// Takes `hit` if it comes before the nearest so far; the lowest primitive wins a tie.
    #[inline(always)]
    pub fn offer(&mut self, hit: Option<Hit>) {
        if let Some(hit) = hit
            && 0.0 < hit.t
            && (hit.t < self.t || hit.t == self.t && self.hit.is_some_and(|best| hit.prim < best.prim))
        {
            *self = Self { t: hit.t, hit: Some(hit) };
        }
    }
}

/// Whether every number of the ray means something.
fn is_sane(ray: &Ray) -> bool {
    ray.o.is_finite() && ray.d.is_finite() && ray.t_max > 0.0
}
