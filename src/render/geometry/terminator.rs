//! Where light ends on coarse meshes with interpolated normals.
//!
//! A facet is black as soon as it turns away from a light, though the round surface that its normals stand for is still lit
//! there: light ends in steps. Such light is let in, from the point of that surface above the facet (Hanika 2021).

use super::{Geometry, Prim, SurfacePoint};
use crate::math::{DVec3, Vec3};

impl Geometry {
    /// The point of the round surface above a facet, seen along `wo`, its shading normal for a normal; `None` where there are
    /// no interpolated normals, or none that bend outwards.
    ///
    /// Each corner's tangent plane is asked how far it lies above the point, and their answers are interpolated (Hanika
    /// 2021, section 2).
    pub fn rounded(&self, surface: &SurfacePoint, wo: Vec3) -> Option<SurfacePoint> {
        let (corners, normals) = self.corners_and_normals(surface)?;
        let (p, n) = (surface.p.as_dvec3(), surface.n.as_dvec3());
        let n = if wo.dot(surface.n) < 0.0 { -n } else { n };
        let weights = barycentrics(corners, p)?;
        let mut lift = DVec3::ZERO;
        for ((corner, normal), weight) in corners.into_iter().zip(normals).zip(weights) {
            let normal = if normal.dot(n) < 0.0 { -normal } else { normal };
            lift += normal * ((corner - p).dot(normal).max(0.0) * weight);
        }
        let ns = if wo.dot(surface.n) < 0.0 { -surface.ns } else { surface.ns };
        (lift != DVec3::ZERO).then(|| SurfacePoint { p: (p + lift).as_vec3(), n: ns, ns, ..*surface })
    }

    /// The corners of the triangle at a point and their unit normals, in the world; `None` without interpolated normals.
    fn corners_and_normals(&self, surface: &SurfacePoint) -> Option<([DVec3; 3], [DVec3; 3])> {
        let (mesh, triangle, placed) = match self.prim(surface.prim) {
            Prim::Triangle(mesh, triangle) => (mesh, triangle, None),
            Prim::Placed(placed, mesh, triangle) => (mesh, triangle, Some(placed.at(surface.time))),
            Prim::Solid(_) => return None,
        };
        let normals = mesh.normals.as_ref()?;
        let corners = mesh.corners(triangle).map(Vec3::as_dvec3);
        let normals = triangle.map(|vertex| normals[vertex as usize].as_dvec3());
        Some(match placed {
            None => (corners, normals.map(DVec3::normalize_or_zero)),
            Some(placed) => {
                (corners.map(|corner| placed.corner(corner)), normals.map(|normal| placed.normal(normal)))
            }
        })
    }
}

/// The barycentrics of a point of a triangle; `None` of none.
pub(super) fn barycentrics([a, b, c]: [DVec3; 3], p: DVec3) -> Option<[f64; 3]> {
    let cross = (b - a).cross(c - a);
    let area2 = cross.length_squared();
    let second = (p - a).cross(c - a).dot(cross) / area2;
    let third = (b - a).cross(p - a).dot(cross) / area2;
    (area2 > 0.0).then_some([1.0 - second - third, second, third])
}
