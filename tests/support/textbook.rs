//! Formulas as textbooks write them, in single precision, and what they should give.

use snell::math::Vec3;

/// Fresnel's reflectance with cos² θt = 1 − (1 − c²) / η² in single precision, as textbooks write it.
pub fn textbook_fresnel(cos: f32, eta: f32) -> f32 {
    let cos2_t = 1.0 - (1.0 - cos * cos) / (eta * eta);
    if cos2_t <= 0.0 {
        return 1.0;
    }
    let cos_t = cos2_t.sqrt();
    let parallel = (eta * cos - cos_t) / (eta * cos + cos_t);
    let perpendicular = (cos - eta * cos_t) / (cos + eta * cos_t);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}

/// The reflectance by the laws of sines and tangents, an independent way to the same number.
pub fn fresnel_by_angles(cos: f64, eta: f64) -> f64 {
    if eta == 1.0 {
        return 0.0;
    }
    let (i, sin_t) = (cos.acos(), cos.acos().sin() / eta);
    if sin_t >= 1.0 {
        return 1.0;
    }
    if i < 1e-4 {
        return ((eta - 1.0) / (eta + 1.0)).powi(2);
    }
    let t = sin_t.asin();
    let (s, p) = ((i - t).sin() / (i + t).sin(), (i - t).tan() / (i + t).tan());
    0.5 * (s * s + p * p)
}

/// The textbook's quadratic in single precision: a, b and c of |o + t d|² = r², then (−b − √(b² − 4ac)) / 2a.
pub fn textbook_sphere(o: Vec3, d: Vec3, radius: f32) -> Option<f32> {
    let (a, b, c) = (d.dot(d), 2.0 * o.dot(d), o.dot(o) - radius * radius);
    let discriminant = b * b - 4.0 * a * c;
    (discriminant >= 0.0).then(|| (-b - discriminant.sqrt()) / (2.0 * a))
}

/// D(h) of GGX as textbooks write it, in single precision.
pub fn textbook_distribution(alpha: f32, cos: f32) -> f32 {
    let a2 = alpha * alpha;
    let s = cos * cos * (a2 - 1.0) + 1.0;
    a2 / (std::f32::consts::PI * s * s)
}
