//! Maps from the unit square to the domains that the renderer samples, with their densities.

use super::float::sin_cos;
use super::{Vec2, Vec3};
use std::f32::consts::{FRAC_1_PI, TAU};

/// Maps the unit square to directions with density `cos θ / π` per steradian.
///
/// `u` lies in `[0, 1)²`. The result is a unit vector in the local frame, `z ≥ 0`.
/// Malley's method: a uniform disk, lifted to the sphere (Pharr et al. 2023, app. A).
pub fn square_to_cosine_hemisphere(u: Vec2) -> Vec3 {
    let (sin_phi, cos_phi) = sin_cos(TAU * u.y);
    let r = u.x.sqrt();
    Vec3::new(r * cos_phi, r * sin_phi, (1.0 - u.x).sqrt())
}

/// The density of [`square_to_cosine_hemisphere`] per steradian; 0 below the horizon.
pub fn square_to_cosine_hemisphere_pdf(w: Vec3) -> f32 {
    w.z.max(0.0) * FRAC_1_PI
}

/// Maps the unit square to the unit disk about the origin, uniformly (density 1/π per unit area).
pub fn square_to_uniform_disk(u: Vec2) -> Vec2 {
    let (sin_phi, cos_phi) = sin_cos(TAU * u.y);
    let r = u.x.sqrt();
    Vec2::new(r * cos_phi, r * sin_phi)
}

/// Maps the unit square to the unit sphere, uniformly (density 1/4π per steradian).
pub fn square_to_uniform_sphere(u: Vec2) -> Vec3 {
    let z = 1.0 - 2.0 * u.x;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin_phi, cos_phi) = sin_cos(TAU * u.y);
    Vec3::new(r * cos_phi, r * sin_phi, z)
}

/// Barycentrics `(b1, b2)` of a uniform point in a triangle.
pub fn square_to_uniform_triangle(u: Vec2) -> Vec2 {
    let root = u.x.sqrt();
    Vec2::new(root * (1.0 - u.y), root * u.y)
}

/// Maps `[0, 1)` to (−1, 1) with the density `1 − |x|` of the tent filter, by inverting its distribution.
pub fn sample_tent(u: f32) -> f32 {
    if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }
}
