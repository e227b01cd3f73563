//! How texture points change along a surface: what bump mapping and the handedness of normal maps need.

use super::{Geometry, Prim, SurfacePoint};
use crate::math::{DVec3, Ray, Vec2, Vec3};
use crate::render::shape::Mesh;

/// The change of the texture point and of the object-space point for each metre along the tangent, and along the
/// bitangent `ns × tangent`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Gradient {
    /// Of the texture point.
    pub uv: [Vec2; 2],
    /// Of the point in the frame of projections.
    pub p_object: [Vec3; 2],
}

/// How far what a ray stands for reaches over textures.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Spread {
    /// In texture space: along the tangent, and along the bitangent.
    pub uv: [Vec2; 2],
    /// In the frame of projections, in metres.
    pub space: f32,
}

impl Spread {
    /// That of a line: textures are looked up at a point.
    pub const NONE: Self = Self { uv: [Vec2::ZERO; 2], space: 0.0 };
}

impl Geometry {
    /// How far the footprint of the ray that met a surface reaches over its textures. Across the ray: a surface seen at a
    /// slant is covered farther in one direction, and there no more is blurred than in the other.
    pub fn spread(&self, surface: &SurfacePoint) -> Spread {
        let gradient = self.gradient(surface);
        let [along, across] = gradient.p_object.map(Vec3::length);
        Spread {
            uv: gradient.uv.map(|uv| uv * surface.footprint),
            space: along.min(across) * surface.footprint,
        }
    }

    /// The gradient at a point of a surface. On triangles exact; on solids from neighbouring points; 0 where there is none.
    pub fn gradient(&self, surface: &SurfacePoint) -> Gradient {
        let along = [surface.tangent, surface.ns.cross(surface.tangent)];
        match self.prim(surface.prim) {
            Prim::Triangle(mesh, corners) => triangle_gradient(mesh, corners, along),
            Prim::Placed(placed, mesh, corners) => {
                let placed = placed.at(surface.time);
                triangle_gradient(mesh, corners, along.map(|dir| placed.vector_mesh(dir)))
            }
            Prim::Solid(_) => self.solid_gradient(surface, along),
        }
    }

    fn solid_gradient(&self, surface: &SurfacePoint, along: [Vec3; 2]) -> Gradient {
        /// The way to a neighbour, as a share of the solid's size.
        const STEP: f64 = 1e-3;
        let area = self.area(surface.prim);
        let size = if area.is_finite() { area.sqrt() } else { 1.0 + f64::from(surface.p.length()) };
        let step = (size * STEP) as f32;
        let mut gradient = Gradient { uv: [Vec2::ZERO; 2], p_object: [Vec3::ZERO; 2] };
        for (axis, dir) in along.into_iter().enumerate() {
            let Some(beside) = self.beside(surface, dir * step) else { continue };
            let way = beside.p - surface.p;
            let length = way.dot(dir);
            if length > 0.25 * step {
                // The seam, where u starts again, is no change.
                let uv = beside.uv - surface.uv;
                gradient.uv[axis] = Vec2::new(uv.x - uv.x.round(), uv.y) / length;
                gradient.p_object[axis] = (beside.p_object - surface.p_object) / length;
            }
        }
        gradient
    }

    /// The point of the same solid that lies across from `surface`, moved.
    fn beside(&self, surface: &SurfacePoint, moved: Vec3) -> Option<SurfacePoint> {
        let lift = surface.n * moved.length();
        let ray = Ray { t_max: 4.0, ..Ray::new(surface.p + moved + lift, -lift).at_time(surface.time) };
        let hit = self.hit_solid(surface.prim.0 - self.first_solid(), &ray)?;
        Some(self.surface_point(&ray, &hit))
    }
}

/// Solves d = b₁ e₁ + b₂ e₂ in the plane of the triangle for a direction d; uv changes by b₁ duv₁ + b₂ duv₂.
fn triangle_gradient(mesh: &Mesh, corners: [u32; 3], along: [Vec3; 2]) -> Gradient {
    let [p0, p1, p2] = mesh.corners(corners).map(|p| p.as_dvec3());
    let (e1, e2) = (p1 - p0, p2 - p0);
    let n = e1.cross(e2);
    let [t0, t1, t2] = match &mesh.uvs {
        Some(uvs) => corners.map(|vertex| uvs[vertex as usize]),
        None => [Vec2::ZERO, Vec2::X, Vec2::Y],
    };
    let uv = along.map(|dir| {
        let d: DVec3 = dir.as_dvec3();
        let (b1, b2) = (d.cross(e2).dot(n) / n.length_squared(), e1.cross(d).dot(n) / n.length_squared());
        (t1 - t0) * b1 as f32 + (t2 - t0) * b2 as f32
    });
    let p_object = along.map(|dir| mesh.object_from_world.transform_vector3(dir.as_dvec3()).as_vec3());
    Gradient { uv, p_object }
}
