//! Cylinders, cones and truncated cones about the y axis, open or with flat ends.
//!
//! With its ends the shape is convex, so a line is inside of it from the later of two entries to the earlier of two
//! exits: those of the endless double cone and of the slab between the ends. Both hits of a line follow from the same
//! four numbers, so that no ray slips in at a rim and never comes out.

use super::sphere;
use crate::math::{DVec2, DVec3, Vec2, float};
use std::f64::consts::{PI, TAU};

/// From radius `base` at y = 0 to radius `top` at y = `height`, in the frame of the object.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Frustum {
    /// The radius at the bottom; not negative, and not 0 if `top` is.
    pub base: f64,
    /// The radius at the top.
    pub top: f64,
    /// The height; greater than 0.
    pub height: f64,
    /// Whether flat disks close both ends.
    pub caps: bool,
}

/// The parts of the surface.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Part {
    Side,
    Bottom,
    Top,
}

/// Where a line meets the surface.
type Crossing = (f64, Part);

impl Frustum {
    /// The first intersection that `within` accepts: what it made of the ray parameter.
    pub fn intersect(&self, o: DVec3, d: DVec3, within: impl Fn(f64) -> Option<f32>) -> Option<f32> {
        self.crossings(o, d).into_iter().flatten().find_map(|(t, _)| within(t))
    }

    /// The point, the outward unit normal, and the texture point where the ray meets the surface near parameter `t`.
    ///
    /// On the side u is the longitude and v the height from 0 to 1; on the ends (u, v) is (x, z) scaled to [0, 1]².
    pub fn surface(&self, o: DVec3, d: DVec3, t: f64) -> (DVec3, DVec3, Vec2) {
        let crossings = self.crossings(o, d).into_iter().flatten();
        let nearest = crossings.min_by(|(a, _), (b, _)| (a - t).abs().total_cmp(&(b - t).abs()));
        let (t, part) = nearest.unwrap_or((t, Part::Side));
        self.point(part, o + d * t)
    }

    /// The point of a part nearest to `p` across the axis, with its normal and texture point.
    fn point(&self, part: Part, p: DVec3) -> (DVec3, DVec3, Vec2) {
        let flat = DVec2::new(p.x, p.z);
        let (y, radius, n) = match part {
            Part::Side => {
                let y = p.y.clamp(0.0, self.height);
                let radius = self.radius(y);
                let around = flat.try_normalize().unwrap_or(DVec2::X);
                let slope = (self.base - self.top) / self.height;
                let n = DVec3::new(around.x, slope, around.y).normalize();
                let p = DVec3::new(around.x * radius, y, around.y * radius);
                let uv = Vec2::new(sphere::longitude(p.x as f32, p.z as f32), (y / self.height) as f32);
                return (p, n, uv);
            }
            Part::Bottom => (0.0, self.base, DVec3::NEG_Y),
            Part::Top => (self.height, self.top, DVec3::Y),
        };
        (DVec3::new(flat.x, y, flat.y), n, (flat / radius * 0.5 + 0.5).as_vec2())
    }

    /// The radius at a height.
    fn radius(&self, y: f64) -> f64 {
        self.base + (self.top - self.base) * (y / self.height)
    }

    /// The largest extent.
    pub fn size(&self) -> f64 {
        self.base.max(self.top).max(self.height)
    }

    /// The area of the side, of the bottom and of the top.
    fn areas(&self) -> [f64; 3] {
        let slant = (self.height * self.height + (self.base - self.top) * (self.base - self.top)).sqrt();
        let cap = |radius: f64| if self.caps { PI * radius * radius } else { 0.0 };
        [PI * (self.base + self.top) * slant, cap(self.base), cap(self.top)]
    }

    /// The area in the object's frame.
    pub fn area(&self) -> f64 {
        self.areas().into_iter().sum()
    }

    /// A point of the surface, uniform by area in the object's frame, with its normal and texture point.
    pub fn sample(&self, u: Vec2) -> (DVec3, DVec3, Vec2) {
        let [side, bottom, _] = self.areas();
        let at = f64::from(u.x) * self.area();
        let (sin, cos) = float::sin_cos64(TAU * f64::from(u.y));
        let around = |radius: f64, y: f64| DVec3::new(radius * sin, y, radius * cos);
        if at < side {
            // The area below a height grows with the radius: a quadratic, solved without cancellation.
            let (share, sum) = (at / side, self.base + self.top);
            let radius = (self.base * self.base + share * (self.top - self.base) * sum).max(0.0).sqrt();
            let y = self.height * (share * sum / (self.base + radius));
            return self.point(Part::Side, around(radius, y));
        }
        let [part, radius, share] = if at - side < bottom {
            [0.0, self.base, (at - side) / bottom]
        } else {
            [1.0, self.top, (at - side - bottom) / (PI * self.top * self.top)]
        };
        let part = if part == 0.0 { Part::Bottom } else { Part::Top };
        self.point(part, around(radius * share.clamp(0.0, 1.0).sqrt(), 0.0))
    }

    /// Small parts of the surface, each by its unit normal and area: together they make up all of it.
    pub fn elements(&self) -> impl Iterator<Item = (DVec3, f64)> {
        const TURNS: u32 = 256;
        let [side, bottom, top] = self.areas();
        let slope = (self.base - self.top) / self.height;
        let around = (0..TURNS).map(move |i| {
            let (sin, cos) = float::sin_cos64(TAU * (f64::from(i) + 0.5) / f64::from(TURNS));
            (DVec3::new(cos, slope, sin).normalize(), side / f64::from(TURNS))
        });
        around.chain([(DVec3::NEG_Y, bottom), (DVec3::Y, top)])
    }

    /// Up to two crossings of the whole line, in order.
    fn crossings(&self, o: DVec3, d: DVec3) -> [Option<Crossing>; 2] {
        // Near the shape numbers are small, and differences keep their digits.
        let shift = (DVec3::Y * (0.5 * self.height) - o).dot(d) / d.length_squared();
        let inside = self.span(o + d * shift, d);
        let Some([enter, leave]) = inside else { return [None; 2] };
        let seen = |(t, part): Crossing| (self.caps || part == Part::Side).then_some((t + shift, part));
        [seen(enter), seen(leave)]
    }

    /// Where the line enters the shape with its ends, and where it leaves it.
    fn span(&self, o: DVec3, d: DVec3) -> Option<[Crossing; 2]> {
        let [enter, leave] = self.slab(o, d)?;
        let slope = (self.top - self.base) / self.height;
        let (radius, growth) = (self.base + slope * o.y, slope * d.y);
        // x² + z² − r(y)² along the line is a·t² + 2·b·t + c.
        let flat = DVec2::new(o.x, o.z);
        let across = DVec2::new(d.x, d.z);
        let a = across.length_squared() - growth * growth;
        let b = flat.dot(across) - radius * growth;
        let c = (flat.length() - radius) * (flat.length() + radius);
        let within = |t0: f64, t1: f64| {
            let enter = if t0 > enter.0 { (t0, Part::Side) } else { enter };
            let leave = if t1 < leave.0 { (t1, Part::Side) } else { leave };
            (enter.0 <= leave.0).then_some([enter, leave])
        };
        // b² − a·c, with the parts of a and c that cancel taken out of it first.
        let turn = flat.perp_dot(across);
        let lean = across * radius - flat * growth;
        let discriminant = lean.length_squared() - turn * turn;
        // A line steeper than the side always meets the double cone, whatever rounding says.
        let discriminant = if a < 0.0 { discriminant.max(0.0) } else { discriminant };
        if discriminant < 0.0 || discriminant.is_nan() {
            return None;
        }
        let q = -(b + discriminant.sqrt().copysign(b));
        let (t0, t1) = (q / a, if q == 0.0 { q / a } else { c / q });
        let (low, high) = if t0 <= t1 { (t0, t1) } else { (t1, t0) };
        if a > 0.0 {
            within(low, high)
        } else if a == 0.0 {
            // Along a line of the side: it is inside on one side of its one crossing, or everywhere, or nowhere.
            match b {
                b if b > 0.0 => within(f64::NEG_INFINITY, -0.5 * c / b),
                b if b < 0.0 => within(-0.5 * c / b, f64::INFINITY),
                _ => (c <= 0.0).then_some([enter, leave]),
            }
        } else if growth > 0.0 {
            within(high, f64::INFINITY)
        } else {
            within(f64::NEG_INFINITY, low)
        }
    }

    /// Where the line enters and leaves the slab between the ends.
    fn slab(&self, o: DVec3, d: DVec3) -> Option<[Crossing; 2]> {
        if d.y == 0.0 {
            let everywhere = [(f64::NEG_INFINITY, Part::Bottom), (f64::INFINITY, Part::Top)];
            return (0.0 <= o.y && o.y <= self.height).then_some(everywhere);
        }
        let ends = [(-o.y / d.y, Part::Bottom), ((self.height - o.y) / d.y, Part::Top)];
        Some(if d.y > 0.0 { ends } else { [ends[1], ends[0]] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::shape::Profile;
    use crate::render::shape::revolve::Revolve;
    use crate::render::shape::samples::Random;

    const SHAPES: [Frustum; 5] = [
        Frustum { base: 1.0, top: 1.0, height: 2.0, caps: true },
        Frustum { base: 1.0, top: 0.0, height: 1.5, caps: true },
        Frustum { base: 0.2, top: 1.3, height: 0.4, caps: true },
        Frustum { base: 0.7, top: 0.7, height: 3.0, caps: false },
        Frustum { base: 1e-3, top: 0.0, height: 2.0, caps: true },
    ];

    /// The same shape as a profile to turn: another way to intersect it.
    fn turned(shape: &Frustum) -> Revolve {
        let line = |a: DVec2, b: DVec2| [a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0), b];
        let (bottom, top) = (DVec2::new(shape.base, 0.0), DVec2::new(shape.top, shape.height));
        let mut pieces = vec![line(bottom, top)];
        if shape.caps {
            pieces.insert(0, line(DVec2::ZERO, bottom));
            pieces.push(line(top, DVec2::new(0.0, shape.height)));
        }
        Revolve::new(&Profile { pieces })
    }

    #[test]
    fn it_is_hit_where_its_turned_profile_is() {
        let mut random = Random(5);
        for shape in SHAPES {
            let (oracle, size) = (turned(&shape), shape.size());
            let (mut hits, mut differ) = (0, 0);
            for i in 0..20_000 {
                let target = random.point() * shape.base.max(shape.top) + DVec3::Y * 0.5 * shape.height;
                let o = random.point() * [3.0, 30.0, 0.5][i % 3] * size;
                let mut d = target - o;
                match i % 7 {
                    0 => d.y = 0.0,
                    1 => d = DVec3::Y,
                    _ => {}
                }
                let ahead = |t: f64| (t > 0.0).then_some(t as f32);
                let expected = oracle.intersect(o, d, ahead).map(|(t, _)| t);
                let found = shape.intersect(o, d, ahead);
                hits += usize::from(found.is_some());
                differ += usize::from(match (found, expected) {
                    (Some(a), Some(b)) => (a - b).abs() > 1e-5 * b.abs().max(1e-3),
                    (None, None) => false,
                    _ => true,
                });
            }
            assert!(hits > 2_000, "only {hits} hits of {shape:?}");
            // Rays that graze a rim or the axis may be decided either way.
            assert!(differ <= 4, "{differ} of {hits} differ for {shape:?}");
        }
    }

    #[test]
    fn a_closed_one_is_crossed_twice_or_not_at_all() {
        let mut random = Random(6);
        for shape in SHAPES.into_iter().filter(|shape| shape.caps) {
            for _ in 0..50_000 {
                // Through the rims and the tip, where both rules meet.
                let (at, _, _) = shape.sample(Vec2::new(random.unit() as f32, random.unit() as f32));
                let y = if at.y > 0.5 * shape.height { shape.height } else { 0.0 };
                let rim = DVec3::new(at.x, y, at.z).normalize_or_zero() * shape.radius(y);
                let o = random.point() * 3.0;
                let [enter, leave] = shape.crossings(o, DVec3::new(rim.x, y, rim.z) - o);
                assert_eq!(enter.is_some(), leave.is_some());
            }
        }
    }

    #[test]
    fn points_are_drawn_on_it_and_uniformly() {
        for shape in SHAPES {
            let mut below = 0;
            let n = 64;
            for i in 0..n * n {
                let u = Vec2::new((i % n) as f32 + 0.5, (i / n) as f32 + 0.5) / n as f32;
                let (p, normal, _) = shape.sample(u);
                let flat = p.x.hypot(p.z);
                let on_side = (flat - shape.radius(p.y)).abs() < 1e-9;
                assert!(on_side || (normal.y.abs() == 1.0 && flat <= shape.radius(p.y)), "{p} of {shape:?}");
                below += usize::from(p.y < 0.5 * shape.height);
            }
            let half = Frustum { height: 0.5 * shape.height, top: shape.radius(0.5 * shape.height), ..shape };
            let expected = (half.areas()[0] + half.areas()[1]) / shape.area();
            let share = below as f64 / f64::from(n * n);
            assert!((share - expected).abs() < 0.02, "{share} for {expected} of {shape:?}");
            let area: f64 = shape.elements().map(|(_, area)| area).sum();
            assert!((area / shape.area() - 1.0).abs() < 1e-12);
        }
    }
}
