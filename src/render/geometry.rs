//! All that can be hit, behind one interface: the tree over what is bounded, a list of what is not.

use super::shape::{MaterialId, SourceId};
use crate::math::{Vec2, Vec3};

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
    /// The point in the object's own frame, before its transform.
    pub p_object: Vec3,
    /// What it is made of.
    pub material: MaterialId,
    /// What was hit.
    pub prim: PrimId,
    /// The object it belongs to.
    pub source: SourceId,
}
