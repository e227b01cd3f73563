//! Parallelograms as lights: two triangles that were written as one shape are drawn from as one.

use crate::math::{Bounds, DVec3, Vec2, Vec3, float};
use crate::render::geometry::DirectionSample;

/// A parallelogram that shines to the side of `edges[0] × edges[1]`, or to both.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Parallelogram {
    corner: DVec3,
    edges: [DVec3; 2],
    n: DVec3,
    area: f64,
    /// A bound on the error of its points, per axis.
    p_error: Vec3,
}

impl Parallelogram {
    /// The parallelogram of the triangles (a, b, c) and (a, c, d), if that is what they make up, to within rounding.
    pub fn of([a, b, c, d]: [Vec3; 4]) -> Option<Self> {
        let bounds = Bounds::of([a, b, c, d]);
        let reach = bounds.min.abs().max(bounds.max.abs());
        let gap = (a.as_dvec3() + c.as_dvec3() - b.as_dvec3() - d.as_dvec3()).abs();
        if !gap.cmple((reach * float::gamma(4)).as_dvec3()).all() {
            return None;
        }
        let edges = [b.as_dvec3() - a.as_dvec3(), d.as_dvec3() - a.as_dvec3()];
        let cross = edges[0].cross(edges[1]);
        // As for points of triangles: the rounding of the coordinates, and what a test rounds by (geometry/surface.rs).
        let p_error = (reach + bounds.size().max_element()) * float::gamma(7);
        let area = cross.length();
        (area > 0.0).then(|| Self { corner: a.as_dvec3(), edges, n: cross / area, area, p_error })
    }

    /// A point drawn uniformly by area, as it is seen from `from`; `None` edge-on.
    pub fn sample_toward(&self, from: Vec3, u: Vec2) -> Option<DirectionSample> {
        let u = u.as_dvec2();
        let p = self.corner + self.edges[0] * u.x + self.edges[1] * u.y;
        let to = p - from.as_dvec3();
        let distance = to.length();
        let pdf = self.pdf(to)?;
        Some(DirectionSample {
            p: p.as_vec3(),
            p_error: self.p_error,
            n: self.n.as_vec3(),
            wi: (to / distance).as_vec3(),
            distance: distance as f32,
            pdf,
        })
    }

    /// The density per steradian seen from `from` with which [`Self::sample_toward`] draws its point `p`.
    pub fn pdf_toward(&self, from: Vec3, p: Vec3) -> f32 {
        self.pdf(p.as_dvec3() - from.as_dvec3()).unwrap_or(0.0)
    }

    /// distance² / (area · |cos|); `None` edge-on and at distance 0.
    fn pdf(&self, to: DVec3) -> Option<f32> {
        let square = to.length_squared();
        let pdf = (square * square.sqrt() / (self.n.dot(to).abs() * self.area)) as f32;
        (pdf.is_finite() && pdf > 0.0).then_some(pdf)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_parallelograms_are_taken_for_some() {
        let quad = [Vec3::ZERO, Vec3::X, Vec3::new(1.3, 2.0, 0.1), Vec3::new(0.3, 2.0, 0.1)];
        assert!(Parallelogram::of(quad).is_some());
        assert!(Parallelogram::of([quad[0], quad[1], quad[2] + Vec3::X * 1e-4, quad[3]]).is_none());
        assert!(Parallelogram::of([Vec3::ZERO, Vec3::X, Vec3::X * 3.0, Vec3::X * 2.0]).is_none());
    }
}
