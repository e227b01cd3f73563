//! Where light ends on coarse meshes with interpolated normals.
//!
//! A facet is black as soon as it turns away from a light, though the round surface that its normals stand for is still lit
//! there: light ends in steps. Such light is let in, from the point of that surface above the facet (Hanika 2021).

use super::{Geometry, Prim, SurfacePoint};
use crate::math::{DVec3, Vec3};
use crate::render::shape::Mesh;

impl Geometry {
    /// The point of the round surface above a facet, seen along `wo`, its shading normal for a normal; `None` where there are
    /// no interpolated normals, or none that bend outwards.
    ///
    /// Each corner's tangent plane is asked how far it lies above the point, and their answers are interpolated (Hanika
    /// 2021, section 2).
    pub fn rounded(&self, surface: &SurfacePoint, wo: Vec3) -> Option<SurfacePoint> {
        let (mesh, triangle, to_world, normal_to_world): (
            &Mesh,
            _,
            &dyn Fn(DVec3) -> DVec3,
            &dyn Fn(DVec3) -> DVec3,
        ) = match self.prim(surface.prim) {
            Prim::Triangle(mesh, triangle) => (mesh, triangle, &|p| p, &|n| n),
            Prim::Placed(placed, mesh, triangle) => {
                (mesh, triangle, &|p| placed.instance.world_from_mesh.transform_point3(p), &|n| {
                    placed.normal(n)
                })
            }
            Prim::Solid(_) => return None,
        };
        let normals = mesh.normals.as_ref()?;
        let (p, n) = (surface.p.as_dvec3(), surface.n.as_dvec3());
        let n = if wo.dot(surface.n) < 0.0 { -n } else { n };
        let corners = mesh.corners(triangle).map(|corner| to_world(corner.as_dvec3()));
        let weights = barycentrics(corners, p)?;
        let mut lift = DVec3::ZERO;
        for ((vertex, corner), weight) in triangle.into_iter().zip(corners).zip(weights) {
            let normal = normal_to_world(normals[vertex as usize].as_dvec3()).normalize_or_zero();
            let normal = if normal.dot(n) < 0.0 { -normal } else { normal };
            lift += normal * ((corner - p).dot(normal).max(0.0) * weight);
        }
        let ns = if wo.dot(surface.n) < 0.0 { -surface.ns } else { surface.ns };
        (lift != DVec3::ZERO).then(|| SurfacePoint { p: (p + lift).as_vec3(), n: ns, ns, ..*surface })
    }
}

/// The barycentrics of a point of a triangle; `None` of none.
fn barycentrics([a, b, c]: [DVec3; 3], p: DVec3) -> Option<[f64; 3]> {
    let cross = (b - a).cross(c - a);
    let area2 = cross.length_squared();
    let second = (p - a).cross(c - a).dot(cross) / area2;
    let third = (b - a).cross(p - a).dot(cross) / area2;
    (area2 > 0.0).then_some([1.0 - second - third, second, third])
}
