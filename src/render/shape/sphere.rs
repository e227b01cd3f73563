//! The unit sphere about the origin.

use crate::math::{DVec3, Vec2, float};
use std::f32::consts::{FRAC_1_PI, TAU};

/// The two parameters at which the line `o + t·d` meets the sphere, the smaller first; `None` if it does not.
///
/// The discriminant comes from the part of `o` perpendicular to `d`, the smaller root from the product of both, so
/// small, distant, and wall-sized spheres keep their digits (Haines, Günther, Akenine-Möller 2019).
pub fn intersect(o: DVec3, d: DVec3) -> Option<[f64; 2]> {
    let a = d.length_squared();
    let b = -o.dot(d);
    let nearest = o + d * (b / a);
    let distance = nearest.length();
    let discriminant = (1.0 - distance) * (1.0 + distance);
    if discriminant < 0.0 || discriminant.is_nan() {
        return None;
    }
    let q = b + (a * discriminant).sqrt().copysign(if b < 0.0 { -1.0 } else { 1.0 });
    let c = (o.length() - 1.0) * (o.length() + 1.0);
    let (t0, t1) = (c / q, q / a);
    Some(if t0 <= t1 { [t0, t1] } else { [t1, t0] })
}

/// The texture point: u by [`longitude`], v from the south pole in [0, 1].
pub fn uv(p: DVec3) -> Vec2 {
    let p = p.as_vec3();
    let v = (float::atan2((p.x * p.x + p.z * p.z).sqrt(), -p.y) * FRAC_1_PI).min(1.0);
    Vec2::new(longitude(p.x, p.z), v)
}

/// How far around the y axis a point lies, in [0, 1): 1/2 at +z, and growing to the right for who looks from outside, so
/// that the middle of a picture faces +z and its sides meet behind.
pub fn longitude(x: f32, z: f32) -> f32 {
    let u = 0.5 + float::atan2(x, z) / TAU;
    if u < 1.0 { u } else { 0.0 }
}

/// The direction in which the longitude grows; zero at the poles.
pub fn tangent(p: DVec3) -> DVec3 {
    DVec3::new(p.z, 0.0, -p.x)
}
