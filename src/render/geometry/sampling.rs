//! Points on primitives for light: drawn by area, or by the solid angle seen from a point.
//!
//! What shines stands still: all of it is as it is when the shutter opens.

use super::surface::interpolate_point;
use super::{Geometry, Prim, PrimId, SurfacePoint};
use crate::math::{Bounds, DVec3, Vec2, Vec3, warp};
use crate::render::shape::SolidKind;
use crate::render::shape::triangle::cross_of_edges;

/// A point drawn by area.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AreaSample {
    /// The point, in world space.
    pub p: Vec3,
    /// A bound on the absolute error of `p`, per axis.
    pub p_error: Vec3,
    /// The unit geometric normal there.
    pub n: Vec3,
    /// The texture point (barycentrics on a triangle).
    pub uv: Vec2,
    /// The density, per square metre.
    pub pdf_area: f32,
}

/// A point drawn for what is seen from another.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DirectionSample {
    /// The point, in world space.
    pub p: Vec3,
    /// A bound on the absolute error of `p`, per axis.
    pub p_error: Vec3,
    /// The unit geometric normal there.
    pub n: Vec3,
    /// The unit direction to it.
    pub wi: Vec3,
    /// How far it is, in metres.
    pub distance: f32,
    /// The density, per steradian.
    pub pdf: f32,
}

/// Where a primitive lies, and which way it faces.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Outline {
    /// A box that holds it.
    pub bounds: Bounds,
    /// The unit normal of what is flat.
    pub n: Option<Vec3>,
}

impl Geometry {
    /// A box that holds a primitive at every time; `None` for what has no end.
    pub fn prim_bounds(&self, prim: PrimId) -> Option<Bounds> {
        match self.prim(prim) {
            Prim::Triangle(mesh, triangle) => Some(Bounds::of(mesh.corners(triangle))),
            Prim::Placed(placed, mesh, triangle) => {
                Some(placed.swept_bounds(Bounds::of(mesh.corners(triangle))))
            }
            Prim::Solid(solid) => solid.swept_bounds(),
        }
    }

    /// Where a triangle, disk or sphere lies; `None` for a plane.
    pub fn outline(&self, prim: PrimId) -> Option<Outline> {
        match self.prim(prim) {
            Prim::Triangle(mesh, triangle) => Some(self.outline_of(prim, Bounds::of(mesh.corners(triangle)))),
            Prim::Placed(placed, mesh, triangle) => {
                Some(self.outline_of(prim, placed.placement().bounds(Bounds::of(mesh.corners(triangle)))))
            }
            Prim::Solid(solid) => {
                let is_flat = matches!(solid.solid().kind, SolidKind::Disk);
                let n = is_flat.then(|| solid.sample_area(Vec2::ZERO).n);
                Some(Outline { bounds: solid.swept_bounds()?, n })
            }
        }
    }

    /// The area of a primitive in square metres; infinite for planes.
    pub fn area(&self, prim: PrimId) -> f64 {
        match self.prim(prim) {
            Prim::Triangle(..) | Prim::Placed(..) => self.cross(prim).length() * 0.5,
            Prim::Solid(solid) => solid.area(),
        }
    }

    /// Draws a point of a primitive; uniform by area but on what its transform squeezes.
    ///
    /// # Panics
    /// For planes and surfaces of revolution, which do not shine: the former are endless, the latter are tessellated.
    pub fn sample_area(&self, prim: PrimId, u: Vec2) -> AreaSample {
        let b = warp::square_to_uniform_triangle(u);
        let (p, p_error) = match self.prim(prim) {
            Prim::Triangle(mesh, triangle) => {
                let (p, p_error) = interpolate_point(mesh.corners(triangle).map(|p| p.as_dvec3()), b);
                (p.as_vec3(), p_error.as_vec3())
            }
            Prim::Placed(placed, mesh, triangle) => placed.placement().point(mesh, triangle, b),
            Prim::Solid(solid) => return solid.sample_area(u),
        };
        let cross = self.cross(prim);
        let n = cross.normalize().as_vec3().normalize();
        AreaSample { p, p_error, n, uv: b, pdf_area: (2.0 / cross.length()) as f32 }
    }

    fn outline_of(&self, triangle: PrimId, bounds: Bounds) -> Outline {
        Outline { bounds, n: Some(self.cross(triangle).normalize().as_vec3().normalize()) }
    }

    /// A vector along the outward normal of a triangle, twice as long as its area; zero for anything else.
    fn cross(&self, prim: PrimId) -> DVec3 {
        match self.prim(prim) {
            Prim::Triangle(mesh, triangle) => cross_of_edges(mesh.corners(triangle)),
            Prim::Placed(placed, mesh, triangle) => placed.placement().cross(mesh, triangle),
            Prim::Solid(_) => DVec3::ZERO,
        }
    }

    /// Draws a point of a primitive as light that shines on `from`; `None` where it is seen edge-on.
    ///
    /// A sphere seen from outside is drawn uniformly in the cone that it fills, anything else by area.
    pub fn sample_toward(&self, prim: PrimId, from: Vec3, u: Vec2) -> Option<DirectionSample> {
        if let Prim::Solid(solid) = self.prim(prim)
            && let Some(sample) = solid.sample_cone(from, u)
        {
            return Some(sample);
        }
        let AreaSample { p, p_error, n, pdf_area, .. } = self.sample_area(prim, u);
        let (wi, distance, pdf) = solid_angle_density(from, p, n, pdf_area)?;
        Some(DirectionSample { p, p_error, n, wi, distance, pdf })
    }

    /// The density per steradian with which [`Self::sample_toward`] draws the point `at` of `prim`.
    pub fn pdf_toward(&self, prim: PrimId, from: Vec3, at: &SurfacePoint) -> f32 {
        let pdf_area = match self.prim(prim) {
            Prim::Triangle(..) | Prim::Placed(..) => (2.0 / self.cross(prim).length()) as f32,
            Prim::Solid(solid) => match solid.pdf_cone(from) {
                Some(pdf) => return pdf,
                None => solid.pdf_area(at.p, at.n),
            },
        };
        solid_angle_density(from, at.p, at.n, pdf_area).map_or(0.0, |(_, _, pdf)| pdf)
    }
}

/// Direction and distance from `from` to `p`, and a density by area there turned into one by solid angle:
/// `pdf_area · distance² / |cos θ|`. `None` edge-on and at distance 0.
fn solid_angle_density(from: Vec3, p: Vec3, n: Vec3, pdf_area: f32) -> Option<(Vec3, f32, f32)> {
    let to = p.as_dvec3() - from.as_dvec3();
    let square = to.length_squared();
    let distance = square.sqrt();
    let cos = n.as_dvec3().dot(to).abs() / distance;
    let pdf = (f64::from(pdf_area) * square / cos) as f32;
    (cos > 0.0 && pdf.is_finite() && pdf > 0.0).then(|| ((to / distance).as_vec3(), distance as f32, pdf))
}
