//! A torus about the y axis: a quartic whose real roots are isolated, not guessed (see [`super::roots`]).

use super::roots;
use super::sphere;
use crate::math::{DVec2, DVec3, Vec2, float};
use std::f64::consts::{PI, TAU};

/// A ring in the plane y = 0, in the frame of the object.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Torus {
    /// From the centre to the middle of the tube.
    pub major: f64,
    /// The radius of the tube; greater than 0, less than `major`.
    pub minor: f64,
}

impl Torus {
    /// The first intersection that `within` accepts: what it made of the ray parameter.
    pub fn intersect(&self, o: DVec3, d: DVec3, mut within: impl FnMut(f64) -> Option<f32>) -> Option<f32> {
        let length = d.length();
        let d = d / length;
        let shift = -o.dot(d);
        let o = o + d * shift;
        let [from, to] = self.reach(o, d)?;

        // Along the ray, with u from 0 to 1 between `from` and `to`: f = (p² + R² − r²)² − 4 R² (x² + z²).
        let (start, step) = (o + d * from, d * (to - from));
        let square = [start.length_squared(), 2.0 * start.dot(step), step.length_squared()];
        let k = [square[0] + (self.major - self.minor) * (self.major + self.minor), square[1], square[2]];
        let ring = 4.0 * self.major * self.major;
        let (flat, across) = (DVec2::new(start.x, start.z), DVec2::new(step.x, step.z));
        let expanded = [
            k[0] * k[0] - ring * flat.length_squared(),
            2.0 * (k[0] * k[1] - ring * flat.dot(across)),
            2.0 * k[0] * k[2] + k[1] * k[1] - ring * across.length_squared(),
            2.0 * k[1] * k[2],
            k[2] * k[2],
        ];
        // Turning points come from the expanded polynomial, signs from a product that does not cancel.
        let value = |u: f64| {
            let p = start + step * u;
            let (x, y) = (p.x.hypot(p.z), p.y);
            let level = |x: f64| (x.hypot(y) - self.minor) * (x.hypot(y) + self.minor);
            (level(x - self.major) * level(x + self.major), roots::evaluate(&expanded, u).1)
        };
        let found = roots::monotone(roots::critical_points(&expanded), [value(0.0).0, value(1.0).0], value);
        found.as_slice().iter().find_map(|u| within((from + (to - from) * u + shift) / length))
    }

    /// The part of the line that is near: within the ball around the torus, and between the planes that touch it.
    ///
    /// `d` is a unit vector, `o` the point of the line nearest to the centre.
    fn reach(&self, o: DVec3, d: DVec3) -> Option<[f64; 2]> {
        /// Ends lie surely outside.
        const SLACK: f64 = 1.0 + 1e-9;
        let (outer, upper) = ((self.major + self.minor) * SLACK, self.minor * SLACK);
        let distance = o.length();
        let half = ((outer - distance) * (outer + distance)).sqrt();
        let crossing = [(-upper - o.y) / d.y, (upper - o.y) / d.y];
        let (from, to) = if d.y == 0.0 {
            if o.y.abs() > upper {
                return None;
            }
            (-half, half)
        } else {
            ((-half).max(crossing[0].min(crossing[1])), half.min(crossing[0].max(crossing[1])))
        };
        // NaN where the ball is missed.
        (half > 0.0 && from < to).then_some([from, to])
    }

    /// The point, the outward unit normal, and the texture point where the ray meets the surface near parameter `t`.
    ///
    /// u is the longitude, v runs around the tube: 0 on the inside of the ring, 1/4 at its bottom, 1/2 on the outside.
    pub fn surface(&self, o: DVec3, d: DVec3, t: f64) -> (DVec3, DVec3, Vec2) {
        let mut exact = t;
        let mut nearest = f64::INFINITY;
        self.intersect(o, d, |root| {
            if (root - t).abs() < nearest {
                (exact, nearest) = (root, (root - t).abs());
            }
            None
        });
        let p = o + d * exact;
        let around = DVec2::new(p.x, p.z).try_normalize().unwrap_or(DVec2::X);
        let in_tube = DVec2::new(p.x.hypot(p.z) - self.major, p.y).try_normalize().unwrap_or(DVec2::X);
        self.point(around, in_tube)
    }

    /// The point in the direction `around` the axis and `in_tube` about the middle of the tube (outwards, upwards).
    fn point(&self, around: DVec2, in_tube: DVec2) -> (DVec3, DVec3, Vec2) {
        let n = DVec3::new(around.x * in_tube.x, in_tube.y, around.y * in_tube.x);
        let p = DVec3::new(around.x, 0.0, around.y) * self.major + n * self.minor;
        let v = 0.5 + float::atan2_64(in_tube.y, in_tube.x) / TAU;
        let u = sphere::longitude(around.x as f32, around.y as f32);
        (p, n, Vec2::new(u, if v < 1.0 { v as f32 } else { 0.0 }))
    }

    /// The largest extent.
    pub fn size(&self) -> f64 {
        self.major + self.minor
    }

    /// The area in the object's frame (Pappus).
    pub fn area(&self) -> f64 {
        4.0 * PI * PI * self.major * self.minor
    }

    /// A point of the surface, uniform by area in the object's frame, with its normal and texture point.
    ///
    /// Around the tube the density is 1 + (r/R)·cos φ; its distribution is inverted by Newton's method in a bracket.
    pub fn sample(&self, u: Vec2) -> (DVec3, DVec3, Vec2) {
        let ratio = self.minor / self.major;
        let target = TAU * f64::from(u.y);
        // φ + ratio · sin φ rises from 0 to τ, since ratio < 1; it is Kepler's equation.
        let (mut low, mut high, mut phi) = (0.0, TAU, target);
        for _ in 0..64 {
            let (sin, cos) = float::sin_cos64(phi);
            let excess = phi + ratio * sin - target;
            if excess > 0.0 {
                high = phi;
            } else {
                low = phi;
            }
            let newton = phi - excess / (1.0 + ratio * cos);
            let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
            if (next - phi).abs() <= 4.0 * f64::EPSILON * TAU {
                break;
            }
            phi = next;
        }
        let (sin, cos) = float::sin_cos64(TAU * f64::from(u.x));
        let (up, out) = float::sin_cos64(phi);
        self.point(DVec2::new(sin, cos), DVec2::new(out, up))
    }

    /// Small parts of the surface, each by its unit normal and area: together they make up all of it.
    pub fn elements(&self) -> impl Iterator<Item = (DVec3, f64)> {
        const STEPS: u32 = 64;
        let (major, minor) = (self.major, self.minor);
        (0..STEPS * STEPS).map(move |i| {
            let angle = |i: u32| float::sin_cos64(TAU * (f64::from(i) + 0.5) / f64::from(STEPS));
            let ((sin, cos), (up, out)) = (angle(i / STEPS), angle(i % STEPS));
            let area = TAU * TAU * minor * (major + minor * out) / f64::from(STEPS * STEPS);
            (DVec3::new(cos * out, up, sin * out), area)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::shape::samples::Random;

    const SHAPES: [Torus; 4] = [
        Torus { major: 1.0, minor: 0.3 },
        Torus { major: 1.0, minor: 0.99 },
        Torus { major: 1.0, minor: 1e-3 },
        Torus { major: 2e4, minor: 5e3 },
    ];

    /// Signed, rough: negative inside. Zero on the surface and growing with the distance from it.
    fn outside(shape: &Torus, p: DVec3) -> f64 {
        (p.x.hypot(p.z) - shape.major).hypot(p.y) - shape.minor
    }

    fn crossings(shape: &Torus, o: DVec3, d: DVec3) -> Vec<f64> {
        let mut all = Vec::new();
        shape.intersect(o, d, |t| {
            all.push(t);
            None
        });
        all
    }

    #[test]
    fn every_change_of_sign_along_a_ray_is_found_and_lies_on_the_surface() {
        let mut random = Random(8);
        for shape in SHAPES {
            let size = shape.size();
            let mut total = 0;
            for i in 0..2_000 {
                let o = random.point() * [2.0, 20.0][i % 2] * size;
                let (on_it, _, _) = shape.sample(Vec2::new(random.unit() as f32, random.unit() as f32));
                let mut d = (on_it - o).normalize();
                if i % 5 == 0 {
                    d = DVec3::new(d.x, 0.0, d.z).normalize();
                }
                let found = crossings(&shape, o, d);
                total += found.len();
                assert!(found.len().is_multiple_of(2), "{found:?} of {shape:?}");
                for &t in &found {
                    assert!(outside(&shape, o + d * t).abs() < 1e-7 * size.max(o.length()), "{shape:?}");
                }
                // By brute force: the sign at each of many steps must be what the crossings so far say.
                let steps = 400;
                let reach = o.length() + 2.0 * size;
                for step in 0..steps {
                    let t = reach * f64::from(step) / f64::from(steps);
                    let level = outside(&shape, o + d * t);
                    let inside = found.iter().filter(|&&root| root < t).count() % 2 == 1;
                    let is_clear = level.abs() > 1e-6 * size.max(o.length());
                    assert!(!is_clear || inside == (level < 0.0), "at {t} of {shape:?}: {found:?}");
                }
            }
            assert!(total > 3_000, "only {total} crossings of {shape:?}");
        }
    }

    #[test]
    fn points_are_drawn_on_it_and_uniformly() {
        for shape in SHAPES {
            let (n, mut outer) = (64, 0);
            for i in 0..n * n {
                let u = Vec2::new((i % n) as f32 + 0.5, (i / n) as f32 + 0.5) / n as f32;
                let (p, normal, _) = shape.sample(u);
                assert!(outside(&shape, p).abs() < 1e-12 * shape.size());
                assert!(outside(&shape, p + normal * (0.1 * shape.minor)) > 0.0);
                outer += usize::from(p.x.hypot(p.z) > shape.major);
            }
            // The outer half of the tube has the share 1/2 + r/(π R) of the area (Pappus).
            let expected = 0.5 + shape.minor / (PI * shape.major);
            let share = outer as f64 / f64::from(n * n);
            assert!((share - expected).abs() < 0.02, "{share} for {expected}");
            let area: f64 = shape.elements().map(|(_, area)| area).sum();
            assert!((area / shape.area() - 1.0).abs() < 1e-9);
        }
    }
}
