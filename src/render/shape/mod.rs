//! What can be hit.

pub mod frustum;
pub mod revolve;
pub mod roots;
#[cfg(test)]
mod samples;
pub mod solid;
pub mod sphere;
pub mod torus;
pub mod triangle;

use crate::math::{DAffine3, DVec2, Motion, Vec2, Vec3};
pub use frustum::Frustum;
use std::sync::Arc;
pub use torus::Torus;

/// Index of a material in the world.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct MaterialId(pub u32);

/// Index of a scene object: leads back to where it was written.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default)]
pub struct SourceId(pub u32);

/// Triangles that share vertices, in world space unless they are shared by instances.
///
/// The geometric normal of a triangle is `(b − a) × (c − a)`: counter-clockwise seen from outside.
#[derive(Clone)]
pub struct Mesh {
    /// Vertex positions, in metres. Finite.
    pub positions: Vec<Vec3>,
    /// Three vertex indices a triangle; none of zero area.
    pub triangles: Vec<[u32; 3]>,
    /// Unit shading normals, one a vertex; `None` for flat shading.
    pub normals: Option<Vec<Vec3>>,
    /// Texture points, one a vertex; `None` means the barycentrics stand in.
    pub uvs: Option<Vec<Vec2>>,
    /// What it is made of.
    pub material: MaterialId,
    /// Object space from world space, for textures projected in object space.
    pub object_from_world: DAffine3,
    /// Where it came from.
    pub source: SourceId,
}

impl Mesh {
    /// The positions of the vertices of a triangle.
    #[inline]
    pub fn corners(&self, triangle: [u32; 3]) -> [Vec3; 3] {
        triangle.map(|vertex| self.positions[vertex as usize])
    }
}

/// A mesh that is placed in the world, perhaps one of many.
pub struct Instance {
    /// Which of the shared meshes. Those are in a frame of their own; their material and source count for nothing.
    pub mesh: usize,
    /// World space from the frame of the mesh when the shutter opens; not singular. May mirror.
    pub world_from_mesh: DAffine3,
    /// What it is made of.
    pub material: MaterialId,
    /// Where it came from.
    pub source: SourceId,
    /// World space from the frame of the mesh while the shutter is open; `None` of what stands still.
    pub motion: Option<Arc<Motion>>,
}

/// A shape that is intersected exactly, in double precision, in its own frame.
pub struct Solid {
    /// Which, in object space.
    pub kind: SolidKind,
    /// World space from object space when the shutter opens; not singular. May mirror.
    pub world_from_object: DAffine3,
    /// The frame in which textures are projected, from object space.
    pub texture_from_object: DAffine3,
    /// What it is made of.
    pub material: MaterialId,
    /// Where it came from.
    pub source: SourceId,
    /// World space from object space while the shutter is open; `None` of what stands still.
    pub motion: Option<Arc<Motion>>,
}

impl Solid {
    /// The area once it is placed, in m²; infinite for planes.
    pub fn area(&self) -> f64 {
        solid::area(&self.kind, &self.world_from_object)
    }
}

/// The exact shapes, each in the frame where it is simplest.
pub enum SolidKind {
    /// The unit sphere about the origin; normals outwards; u by longitude, 1/2 at +z, v from the south pole.
    Sphere,
    /// The unit disk in the plane z = 0; normal +z; uv = (x, y) mapped from [−1, 1]² to [0, 1]².
    Disk,
    /// The plane z = 0, without end; normal +z; uv = (x, y), in object units.
    Plane,
    /// A profile turned about the y axis; normals to the right of the profile's direction of travel (outwards when the profile runs upwards).
    Revolve(Profile),
    /// A cylinder or cone about the y axis; normals outwards.
    Frustum(Frustum),
    /// A ring about the y axis; normals outwards.
    Torus(Torus),
}

impl SolidKind {
    /// Whether points can be drawn from it, so that it can be a lamp.
    pub const fn can_be_sampled(&self) -> bool {
        !matches!(self, Self::Plane | Self::Revolve(_))
    }
}

/// Cubic Bézier pieces of the curve (radius, height) in the half-plane radius ≥ 0.
#[derive(Clone, PartialEq, Debug)]
pub struct Profile {
    /// Control points of each piece; a piece begins where the one before ended. Straight lines are cubics too.
    pub pieces: Vec<[DVec2; 4]>,
}
