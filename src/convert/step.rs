//! What the steps of a transform do.

use super::model::Step;
use crate::math::float::sin_cos64;
use crate::math::{DMat3, DVec3};

/// Whether steps, one after the other, flatten what they move: the volume vanishes beside the lengths of the edges.
pub fn flatten(steps: &[Step]) -> bool {
    /// Below this the volume is rounding error.
    const VANISHING: f64 = 1e-11;
    let turned = |way: DVec3| steps.iter().fold(way, |way, step| step.apply_to_direction(way));
    let [x, y, z] = DVec3::AXES.map(turned);
    let volume = DMat3::from_cols(x, y, z).determinant().abs();
    volume <= VANISHING * x.length() * y.length() * z.length()
}

impl Step {
    /// Whether the step leaves everything where it is.
    pub fn is_identity(&self) -> bool {
        match self {
            Self::Scale(by) => *by == DVec3::ONE,
            Self::Translate(by) => *by == DVec3::ZERO,
            _ => false,
        }
    }

    /// What the step does to a direction.
    fn apply_to_direction(&self, way: DVec3) -> DVec3 {
        match self {
            Self::Translate(_) => way,
            Self::Matrix(m) => {
                let row = |i: usize| m[4 * i] * way.x + m[4 * i + 1] * way.y + m[4 * i + 2] * way.z;
                DVec3::new(row(0), row(1), row(2))
            }
            step => step.apply(way),
        }
    }

    /// Where the step takes a point.
    pub fn apply(&self, p: DVec3) -> DVec3 {
        match self {
            Self::Scale(by) => *by * p,
            Self::Translate(by) => *by + p,
            Self::RotateAxis(axis, degrees) => turn(DVec3::AXES[*axis], *degrees, p),
            Self::Rotate(axis, degrees) => turn(axis.normalize(), *degrees, p),
            Self::Matrix(m) => self.apply_to_direction(p) + DVec3::new(m[3], m[7], m[11]),
        }
    }
}

/// Rotates p about a unit axis, right-handed (Rodrigues 1840).
fn turn(axis: DVec3, degrees: f64, p: DVec3) -> DVec3 {
    let (sin, cos) = sin_cos64(degrees.to_radians());
    p * cos + axis.cross(p) * sin + axis * (axis.dot(p) * (1.0 - cos))
}
