//! Meshes placed many times, or moving: one tree in the frame of the mesh, a transform for each place and moment.
//!
//! A ray is taken to the frame of the mesh in double precision and rounded there, once for all its triangles, so no ray
//! slips between them. Its direction is not normalised again, so `t` means the same in both frames. Points are found from
//! barycentrics and taken back, with a bound on all errors of the way (Pharr, Jakob, Humphreys 2023, section 6.8).

use super::surface::interpolate_point;
use crate::math::{Bounds, DAffine3, DMat3, DVec3, Ray, Vec2, Vec3, float};
use crate::render::accel::Wide;
use crate::render::shape::triangle::cross_of_edges;
use crate::render::shape::{Instance, Mesh};
use std::borrow::Cow;

/// A mesh with a tree of its own, in its own frame.
pub struct SharedMesh {
    pub mesh: Mesh,
    pub tree: Wide,
}

impl SharedMesh {
    /// Builds the tree over a mesh.
    pub fn new(mesh: Mesh) -> Self {
        let corners: Vec<_> = mesh.triangles.iter().map(|corners| mesh.corners(*corners)).collect();
        Self { tree: Wide::new(&corners, &[], &[]), mesh }
    }
}

/// An instance with what its intersection needs at hand.
pub struct PlacedMesh {
    pub instance: Instance,
    /// As it is when the shutter opens.
    placement: Placement,
}

impl PlacedMesh {
    /// Prepares an instance. Its transform must not be singular.
    pub fn new(instance: Instance) -> Self {
        Self { placement: Placement::new(instance.world_from_mesh), instance }
    }

    /// Its place when the shutter opens.
    pub fn placement(&self) -> &Placement {
        &self.placement
    }

    /// Its place at a time.
    #[inline]
    pub fn at(&self, time: f32) -> Cow<'_, Placement> {
        match &self.instance.motion {
            None => Cow::Borrowed(&self.placement),
            Some(motion) => Cow::Owned(Placement::new(motion.at(time.into()))),
        }
    }

    /// A box in the world around the mesh at every time; it fills `bounds` in its own frame.
    pub fn swept_bounds(&self, bounds: Bounds) -> Bounds {
        let Some(motion) = self.instance.motion.as_ref().filter(|_| !bounds.is_empty()) else {
            return self.placement.bounds(bounds);
        };
        let (min, max) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        let room = rounding_room(bounds);
        let (low, high) = motion.sweep_box(min - room, max + room);
        Bounds::enclosing(low, high)
    }
}

/// Where a mesh is, with what the intersection of rays needs at hand.
#[derive(Clone)]
pub struct Placement {
    world_from_mesh: DAffine3,
    mesh_from_world: DAffine3,
    /// Takes outward normals from the mesh to the world; not normalised.
    normal_from_mesh: DMat3,
}

impl Placement {
    /// By its transform, which must not be singular.
    pub fn new(world_from_mesh: DAffine3) -> Self {
        let mesh_from_world = world_from_mesh.inverse();
        Self { mesh_from_world, normal_from_mesh: mesh_from_world.matrix3.transpose(), world_from_mesh }
    }

    /// The ray in the frame of the mesh; `None` where a number there is too large for single precision.
    pub fn ray_mesh(&self, ray: &Ray) -> Option<Ray> {
        let o = self.mesh_from_world.transform_point3(ray.o.as_dvec3()).as_vec3();
        let d = self.mesh_from_world.transform_vector3(ray.d.as_dvec3()).as_vec3();
        (o.is_finite() && d.is_finite()).then_some(Ray { o, d, ..*ray })
    }

    /// A box in the world around the mesh, which fills `bounds` in its own frame.
    ///
    /// Wider by what a ray may be off once it is rounded in the frame of the mesh.
    pub fn bounds(&self, bounds: Bounds) -> Bounds {
        if bounds.is_empty() {
            return Bounds::EMPTY;
        }
        let (min, max) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        let corners = (0..8).map(|i| {
            let pick = |axis: usize| if i >> axis & 1 == 0 { min[axis] } else { max[axis] };
            self.world_from_mesh.transform_point3(DVec3::new(pick(0), pick(1), pick(2)))
        });
        let (low, high) =
            corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let room = self.error_world(rounding_room(bounds));
        Bounds::enclosing(low - room, high + room)
    }

    /// A vector along the outward normal of a triangle in the world, twice as long as its area there.
    ///
    /// An area vector is taken to the world by the cofactors of the transform: its inverse, transposed, times |det|.
    pub fn cross(&self, mesh: &Mesh, triangle: [u32; 3]) -> DVec3 {
        let determinant = self.world_from_mesh.matrix3.determinant().abs();
        let cross = cross_of_edges(mesh.corners(triangle));
        self.normal_from_mesh * cross * determinant
    }

    /// The point of a triangle with barycentrics `b`, in the world, and the bound on its error there.
    pub fn point(&self, mesh: &Mesh, triangle: [u32; 3], b: Vec2) -> (Vec3, Vec3) {
        let (p, error) = interpolate_point(mesh.corners(triangle).map(|p| p.as_dvec3()), b);
        let p_world = self.world_from_mesh.transform_point3(p);
        // A ray that leaves is rounded at its origin in the frame of the mesh, and here.
        let rounding = p.abs() * f64::from(float::gamma(2));
        let error = self.error_world(error + rounding) + p_world.abs() * f64::from(float::gamma(1));
        (p_world.as_vec3(), error.as_vec3())
    }

    /// A point of the mesh in the world.
    pub fn corner(&self, p: DVec3) -> DVec3 {
        self.world_from_mesh.transform_point3(p)
    }

    /// A vector of the mesh in the world.
    pub fn vector(&self, v: DVec3) -> DVec3 {
        self.world_from_mesh.transform_vector3(v)
    }

    /// A vector of the world in the frame of the mesh.
    pub fn vector_mesh(&self, v: Vec3) -> Vec3 {
        self.mesh_from_world.transform_vector3(v.as_dvec3()).as_vec3()
    }

    /// The unit normal in the world; zero for zero.
    pub fn normal(&self, n: DVec3) -> DVec3 {
        (self.normal_from_mesh * n).normalize_or_zero()
    }

    /// A bound on errors in the frame of the mesh, seen in the world.
    fn error_world(&self, error: DVec3) -> DVec3 {
        let m = self.world_from_mesh.matrix3;
        m.x_axis.abs() * error.x + m.y_axis.abs() * error.y + m.z_axis.abs() * error.z
    }
}

/// By how much a ray may be off once it is rounded in the frame of a mesh that fills a box.
fn rounding_room(bounds: Bounds) -> DVec3 {
    let reach = bounds.min.as_dvec3().abs().max(bounds.max.as_dvec3().abs());
    reach * f64::from(float::gamma(8))
}
