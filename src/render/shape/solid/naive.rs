//! Spheres in single precision, as they are mostly written. Only `benches/hard_cases` asks for them.

use super::{SolidHit, orthogonal_tangent, round_radius, sphere};
use crate::math::{Ray, Vec2, Vec3, float};
use crate::render::geometry::{PrimId, Spread, SurfacePoint};
use crate::render::shape::{Solid, SolidKind};

/// A round sphere in the world.
pub struct Sphere {
    center: Vec3,
    radius: f32,
}

impl Sphere {
    /// The sphere that a solid is, if it is a round one.
    pub fn of(solid: &Solid) -> Option<Self> {
        let radius = round_radius(&solid.world_from_object.matrix3)?;
        let center = solid.world_from_object.translation.as_vec3();
        matches!(solid.kind, SolidKind::Sphere).then_some(Self { center, radius: radius as f32 })
    }

    /// The first intersection with `t` in the open interval (0, `ray.t_max`), by b² − 4ac.
    pub fn intersect(&self, ray: &Ray) -> Option<SolidHit> {
        let o = ray.o - self.center;
        let (a, b) = (ray.d.dot(ray.d), 2.0 * o.dot(ray.d));
        let discriminant = b * b - 4.0 * a * (o.dot(o) - self.radius * self.radius);
        if discriminant < 0.0 {
            return None;
        }
        let root = discriminant.sqrt();
        let roots = [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)];
        let t = roots.into_iter().find(|t| 0.0 < *t && *t < ray.t_max)?;
        Some(SolidHit { t, uv: Vec2::ZERO })
    }

    /// The point at `t`, pulled back onto the sphere, and known as well as that allows.
    pub fn surface_point(&self, solid: &Solid, ray: &Ray, hit: SolidHit, prim: PrimId) -> SurfacePoint {
        let n = (ray.at(hit.t) - self.center).normalize();
        let (p, object) = (self.center + n * self.radius, n.as_dvec3());
        SurfacePoint {
            p,
            p_error: (self.center.abs() + Vec3::splat(self.radius)) * float::gamma(5),
            n,
            ns: n,
            tangent: orthogonal_tangent(sphere::tangent(object), n),
            uv: sphere::uv(object),
            p_object: solid.texture_from_object.transform_point3(object).as_vec3(),
            material: solid.material,
            prim,
            source: solid.source,
            time: ray.time,
            footprint: 0.0,
            angle: 0.0,
            spread: Spread::NONE,
        }
    }
}
