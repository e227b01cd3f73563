//! All that can be hit, behind one interface: the tree over what is bounded, a list of what is not.

mod gradient;
mod instance;
mod sampling;
mod surface;
mod terminator;

pub use gradient::{Gradient, Spread};
pub use sampling::{AreaSample, DirectionSample, Outline};

use super::accel::Wide;
use super::shape::solid::{PlacedSolid, SolidHit};
use super::shape::{Instance, MaterialId, Mesh, Solid, SourceId};
use crate::math::{Bounds, Ray, Vec2, Vec3};
use instance::{PlacedMesh, SharedMesh};
use std::ops::Range;

/// Index of a primitive: triangles first, mesh by mesh, then those of each instance, then solids.
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
    /// When it is there: the time of the ray that met it.
    pub time: f32,
    /// The width of what the ray that met it stands for, in metres.
    pub footprint: f32,
    /// By how much that grows for each metre further on.
    pub angle: f32,
    /// How far that reaches over textures, where they are filtered.
    pub spread: Spread,
}

/// What geometry is made of.
#[derive(Default)]
pub struct Shapes {
    /// Triangles, each mesh in one place.
    pub meshes: Vec<Mesh>,
    /// Triangles that instances place, in frames of their own.
    pub shared: Vec<Mesh>,
    /// The places of those.
    pub instances: Vec<Instance>,
    /// Exact shapes.
    pub solids: Vec<Solid>,
}

/// All shapes of a scene.
pub struct Geometry {
    meshes: Vec<Mesh>,
    shared: Vec<SharedMesh>,
    instances: Vec<PlacedMesh>,
    solids: Vec<PlacedSolid>,
    /// The first primitive of each mesh, then of each instance, then of the solids.
    first_prims: Vec<u32>,
    /// Over the triangles of meshes and the boxes of instances and solids.
    tree: Wide,
    /// Solids that no box holds; every ray tries them all.
    unbounded: Vec<u32>,
}

/// What a primitive index stands for.
enum Prim<'a> {
    Triangle(&'a Mesh, [u32; 3]),
    Placed(&'a PlacedMesh, &'a Mesh, [u32; 3]),
    Solid(&'a PlacedSolid),
}

impl Geometry {
    /// Builds the tree over `meshes` and `solids`.
    ///
    /// # Panics
    /// When there are 2³² primitives or more.
    pub fn build(meshes: Vec<Mesh>, solids: Vec<Solid>) -> Self {
        Self::new(Shapes { meshes, solids, ..Shapes::default() })
    }

    /// Builds a tree over each shared mesh, and one over everything.
    ///
    /// # Panics
    /// When there are 2³² primitives or more.
    pub fn new(shapes: Shapes) -> Self {
        let Shapes { meshes, shared, instances, solids } = shapes;
        let shared: Vec<_> = shared.into_iter().map(SharedMesh::new).collect();
        let instances: Vec<_> = instances.into_iter().map(PlacedMesh::new).collect();
        let solids: Vec<_> = solids.into_iter().map(PlacedSolid::new).collect();
        let placed = instances.iter().map(|placed| &shared[placed.instance.mesh].mesh);
        let first_prims = running_sums(meshes.iter().chain(placed).map(|mesh| mesh.triangles.len()));

        // Boxes: of instances, then of the solids that have one.
        let mut boxes: Vec<_> = instances
            .iter()
            .map(|placed| placed.swept_bounds(shared[placed.instance.mesh].tree.bounds()))
            .collect();
        let mut boxed: Vec<_> = (0..instances.len() as u32).collect();
        let mut unbounded = Vec::new();
        for (i, solid) in (0..).zip(&solids) {
            match solid.swept_bounds() {
                Some(bounds) => {
                    boxes.push(bounds);
                    boxed.push(instances.len() as u32 + i);
                }
                None => unbounded.push(i),
            }
        }
        let triangles = all_corners(&meshes);
        let tree = Wide::new(&triangles, &boxes, &boxed);
        Self { meshes, shared, instances, solids, first_prims, tree, unbounded }
    }

    /// The same geometry, traced by the code for any processor. It gives the same bits, only later.
    #[must_use]
    pub fn without_simd(mut self) -> Self {
        self.tree.without_simd();
        self.shared.iter_mut().for_each(|shared| shared.tree.without_simd());
        self
    }

    /// A box that holds everything but the planes; empty when there is nothing.
    pub fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }

    /// What the trees take in memory, in bytes.
    pub fn tree_bytes(&self) -> usize {
        self.tree.bytes() + self.shared.iter().map(|shared| shared.tree.bytes()).sum::<usize>()
    }

    /// Whether anything is elsewhere at another time.
    pub fn moves(&self) -> bool {
        self.instances.iter().any(|placed| placed.instance.motion.is_some())
            || self.solids.iter().any(|solid| solid.solid().motion.is_some())
    }

    /// The number of primitives: triangles first, mesh by mesh and instance by instance, then solids.
    pub fn prim_count(&self) -> u32 {
        self.first_solid() + self.solids.len() as u32
    }

    /// The primitives of each mesh, in the order given.
    pub fn mesh_prims(&self) -> impl Iterator<Item = (&Mesh, Range<u32>)> {
        self.meshes.iter().zip(self.first_prims.windows(2).map(|pair| pair[0]..pair[1]))
    }

    /// The primitives of each instance, in the order given.
    pub fn instance_prims(&self) -> impl Iterator<Item = (&Instance, Range<u32>)> {
        let ranges = self.first_prims[self.meshes.len()..].windows(2).map(|pair| pair[0]..pair[1]);
        self.instances.iter().map(|placed| &placed.instance).zip(ranges)
    }

    /// A box that holds each instance at every time, in the order given.
    pub fn instance_bounds(&self) -> impl Iterator<Item = (&Instance, Bounds)> {
        let bounds =
            |placed: &PlacedMesh| placed.swept_bounds(self.shared[placed.instance.mesh].tree.bounds());
        self.instances.iter().map(move |placed| (&placed.instance, bounds(placed)))
    }

    /// The primitive of each solid, in the order given.
    pub fn solid_prims(&self) -> impl Iterator<Item = (&Solid, PrimId)> {
        self.solids.iter().map(PlacedSolid::solid).zip((self.first_solid()..).map(PrimId))
    }

    /// What a primitive is made of.
    pub fn material(&self, prim: PrimId) -> MaterialId {
        match self.prim(prim) {
            Prim::Triangle(mesh, _) => mesh.material,
            Prim::Placed(placed, ..) => placed.instance.material,
            Prim::Solid(solid) => solid.solid().material,
        }
    }

    /// The object a primitive belongs to.
    pub fn source(&self, prim: PrimId) -> SourceId {
        match self.prim(prim) {
            Prim::Triangle(mesh, _) => mesh.source,
            Prim::Placed(placed, ..) => placed.instance.source,
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
        self.tree.trace::<false>(ray, 0, &mut nearest, |boxed, nearest| {
            self.hit_boxed::<false>(boxed, ray, nearest)
        });
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
        self.tree.trace::<true>(ray, 0, &mut nearest, |boxed, nearest| {
            self.hit_boxed::<true>(boxed, ray, nearest)
        });
        nearest.hit.is_some()
    }

    fn hit_solid(&self, solid: u32, ray: &Ray) -> Option<Hit> {
        let SolidHit { t, uv } = self.solids[solid as usize].intersect(ray)?;
        Some(Hit { t, prim: PrimId(self.first_solid() + solid), uv })
    }

    /// Offers what the ray meets of an instance, or of a solid after those.
    fn hit_boxed<const ANY: bool>(&self, boxed: u32, ray: &Ray, nearest: &mut Nearest) {
        let Some(placed) = self.instances.get(boxed as usize) else {
            return nearest.offer(self.hit_solid(boxed - self.instances.len() as u32, ray));
        };
        let Some(ray) = placed.at(ray.time).ray_mesh(ray) else { return };
        let first = self.first_prims[self.meshes.len() + boxed as usize];
        // A shared mesh has nothing but triangles.
        self.shared[placed.instance.mesh].tree.trace::<ANY>(&ray, first, nearest, |_, _| {});
    }

    fn first_solid(&self) -> u32 {
        self.first_prims[self.meshes.len() + self.instances.len()]
    }

    fn prim(&self, prim: PrimId) -> Prim<'_> {
        if let Some(solid) = prim.0.checked_sub(self.first_solid()) {
            return Prim::Solid(&self.solids[solid as usize]);
        }
        let place = self.first_prims.partition_point(|&first| first <= prim.0) - 1;
        let triangle = (prim.0 - self.first_prims[place]) as usize;
        match place.checked_sub(self.meshes.len()) {
            None => Prim::Triangle(&self.meshes[place], self.meshes[place].triangles[triangle]),
            Some(instance) => {
                let placed = &self.instances[instance];
                let mesh = &self.shared[placed.instance.mesh].mesh;
                Prim::Placed(placed, mesh, mesh.triangles[triangle])
            }
        }
    }
}

/// Where each of several runs of these lengths begins, and where the last ends.
fn running_sums(lengths: impl Iterator<Item = usize>) -> Vec<u32> {
    let mut sums = vec![0];
    let mut sum = 0;
    for length in lengths {
        sum += length;
        sums.push(u32::try_from(sum).expect("fewer than 2³² triangles"));
    }
    sums
}

/// The corners of all triangles, mesh by mesh.
fn all_corners(meshes: &[Mesh]) -> Vec<[Vec3; 3]> {
    meshes.iter().flat_map(|mesh| mesh.triangles.iter().map(|corners| mesh.corners(*corners))).collect()
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
