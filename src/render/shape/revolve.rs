//! Surfaces of revolution about the y axis, intersected without guessing.
//!
//! Eliminating the ray parameter leaves one polynomial of degree 6 in the profile's parameter; all its roots are
//! isolated (see [`super::roots`]). Plain Newton from a few starts, the usual way, misses roots and finds strangers.
//!
//! Most pieces are settled before that: their ring is missed, or the signs of the polynomial's Bernstein coefficients
//! leave room for no root, or for exactly one (the variation diminishing property: Farin 2002, section 6.3).

use super::Profile;
use super::roots::{self, Roots};
use super::sphere;
use crate::math::{DVec2, DVec3, Vec2, float};
use std::f64::consts::{PI, TAU};

/// Each piece of a profile is cut into so many, whose rings fit better.
const CUTS: usize = 4;
/// A ray of unit direction that rises less than this is level: over the shape, its height changes less than it is known.
const LEVEL: f64 = 1e-10;
/// Above this rise the height gives the ray parameter with all digits that single precision needs.
const STEEP: f64 = 1e-3;

/// Bernstein coefficients nearer to 0 than this share of the squared size may have either sign: a thousand roundings.
const SIGN_SLACK: f64 = 1e-13;

/// A profile, prepared for rays.
pub struct Revolve {
    /// [`CUTS`] for each piece of the profile.
    pieces: Vec<Piece>,
    /// The ring around each piece of the profile, before it was cut.
    rings: Vec<Ring>,
    /// The middle of the shape's heights, and its largest extent.
    middle: f64,
    size: f64,
}

/// A cubic piece of the profile with the ring that holds its turn.
struct Piece {
    /// Control points (radius, height).
    control: [DVec2; 4],
    /// Coefficients of rising powers.
    radius: [f64; 4],
    height: [f64; 4],
    ring: Ring,
    /// Bernstein coefficients of degree 6, heights counted from the shape's middle.
    bernstein: Bernstein,
}

/// The space between two radii and two heights.
#[derive(Clone, Copy)]
struct Ring {
    /// The lowest radius and height.
    low: DVec2,
    /// The highest.
    high: DVec2,
}

/// What the polynomial of degree 6 is made of, in the Bernstein basis of that degree.
struct Bernstein {
    radius2: [f64; 7],
    height2: [f64; 7],
    height: [f64; 7],
}

/// A ray of unit direction from the point of its line that is nearest to the shape's middle.
struct AxisRay {
    o: DVec3,
    d: DVec3,
    /// The squared distance from the axis at parameter s is `a·s² + 2·b·s + c`.
    a: f64,
    b: f64,
    c: f64,
    /// The height of `o` above the shape's middle.
    o_from_middle: f64,
    /// 1 / d.y, and the parameter nearest to the axis (any, for an upright ray).
    rise_inverse: f64,
    nearest_to_axis: f64,
}

impl Revolve {
    /// Prepares a profile.
    pub fn new(profile: &Profile) -> Self {
        let rings: Vec<_> = profile.pieces.iter().map(Ring::around).collect();
        let low = rings.iter().fold(DVec2::INFINITY, |low, ring| low.min(ring.low));
        let high = rings.iter().fold(DVec2::NEG_INFINITY, |high, ring| high.max(ring.high));
        let size = (high.y - low.y).max(high.x).max(0.0);
        let middle = 0.5 * (low.y + high.y);
        let cuts = profile.pieces.iter().flat_map(cut);
        Self { pieces: cuts.map(|control| Piece::new(control, middle)).collect(), rings, middle, size }
    }

    /// The largest extent, to which rounding errors of the surface are in proportion.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The first intersection that `within` accepts: what it made of the ray parameter, then (parameter in the piece, piece).
    pub fn intersect(&self, o: DVec3, d: DVec3, within: impl Fn(f64) -> Option<f32>) -> Option<(f32, Vec2)> {
        let length = d.length();
        let d = d / length;
        let shift = -(o - DVec3::Y * self.middle).dot(d);
        let ray = AxisRay::new(o + d * shift, d, self.middle);
        let mut first: Option<(f32, Vec2)> = None;
        let met = self.rings.iter().zip(self.pieces.chunks(CUTS)).enumerate();
        for (i, (_, cuts)) in met.filter(|(_, (ring, _))| ring.met(&ray, self.size)) {
            for (j, piece) in cuts.iter().enumerate().filter(|(_, piece)| piece.ring.met(&ray, self.size)) {
                piece.intersect(&ray, self.size, |s, u| {
                    if let Some(t) = within((s + shift) / length)
                        && first.is_none_or(|(best, _)| t < best)
                    {
                        first = Some((t, Vec2::new(u as f32, (i * CUTS + j) as f32)));
                    }
                });
            }
        }
        first
    }

    /// The point, the outward unit normal, and the texture point, for the parameters that [`Self::intersect`] found.
    ///
    /// `near` lies close to the point and gives its longitude.
    pub fn surface(&self, parameters: Vec2, near: DVec3) -> (DVec3, DVec3, Vec2) {
        let (u, index) = (f64::from(parameters.x), parameters.y as usize);
        let piece = &self.pieces[index];
        let around = DVec2::new(near.x, near.z).try_normalize().unwrap_or(DVec2::X);
        let at = piece.at(u);
        let normal = piece.normal(u);
        let turned = |p: DVec2| DVec3::new(p.x * around.x, p.y, p.x * around.y);
        let longitude = sphere::longitude(around.x as f32, around.y as f32);
        let v = (index as f32 + parameters.x) / self.pieces.len() as f32;
        (turned(at), turned(normal), Vec2::new(longitude, v))
    }

    /// Small parts of the surface, each by its unit normal and area: together they make up all of it.
    pub fn elements(&self) -> impl Iterator<Item = (DVec3, f64)> {
        const STEPS: u32 = 16;
        const TURNS: u32 = 64;
        let parts = (0..STEPS).flat_map(|i| (0..TURNS).map(move |j| (i, j)));
        self.pieces.iter().flat_map(move |piece| {
            parts.clone().map(move |(i, j)| {
                let at = |i: f64| piece.at(i / f64::from(STEPS));
                let middle = f64::from(i) + 0.5;
                let length = at(f64::from(i)).distance(at(f64::from(i + 1)));
                let (sin, cos) = float::sin_cos64(TAU * f64::from(j) / f64::from(TURNS));
                let n = piece.normal(middle / f64::from(STEPS));
                let area = 2.0 * PI * at(middle).x.abs() * length / f64::from(TURNS);
                (DVec3::new(n.x * cos, n.y, n.x * sin), area)
            })
        })
    }
}

impl Ring {
    /// The ring that holds the turn of a curve with these control points.
    fn around(control: &[DVec2; 4]) -> Self {
        Self {
            low: control.iter().copied().fold(DVec2::INFINITY, DVec2::min),
            high: control.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max),
        }
    }

    /// Whether the line of `ray` meets the ring.
    fn met(&self, ray: &AxisRay, size: f64) -> bool {
        let slack = 1e-12 * size;
        if ray.d.y.abs() < LEVEL {
            let nearest = ray.c - ray.b * ray.b / ray.a;
            let inside = self.low.y - slack <= ray.o.y && ray.o.y <= self.high.y + slack;
            return inside && nearest <= (self.high.x + slack) * (self.high.x + slack);
        }
        let crossing =
            [self.low.y - slack, self.high.y + slack].map(|height| (height - ray.o.y) * ray.rise_inverse);
        let [enter, leave] = [crossing[0].min(crossing[1]), crossing[0].max(crossing[1])];
        let (inner, outer) = (self.low.x - slack, self.high.x + slack);
        let nearest = ray.nearest_to_axis.max(enter).min(leave);
        ray.axis_distance2(nearest) <= outer * outer * (1.0 + 1e-12)
            && (inner <= 0.0
                || ray.axis_distance2(enter).max(ray.axis_distance2(leave)) >= inner * inner * (1.0 - 1e-12))
    }
}

impl Bernstein {
    fn new(control: [DVec2; 4], middle: f64) -> Self {
        let radius = control.map(|p| p.x);
        let height = control.map(|p| p.y - middle);
        // The constant 1 is the cubic whose coefficients are all 1, so this raises the degree of the height to 6.
        Self {
            radius2: product(&radius, &radius),
            height2: product(&height, &height),
            height: product(&height, &[1.0; 4]),
        }
    }

    /// How often the polynomial's coefficients change sign: it has as many roots in the piece, or fewer by an even number.
    /// `None` where rounding leaves a sign open.
    fn sign_changes(&self, ray: &AxisRay, size: f64) -> Option<usize> {
        let (dy2, oy) = (ray.d.y * ray.d.y, ray.o_from_middle);
        let coefficients: [f64; 7] = std::array::from_fn(|k| {
            let above = self.height[k] - oy;
            let above2 = self.height2[k] - oy * (self.height[k] + above);
            dy2 * (self.radius2[k] - ray.c) - ray.a * above2 - 2.0 * ray.d.y * ray.b * above
        });
        let slack = SIGN_SLACK * size * size;
        let certain = coefficients.iter().fold(true, |certain, c| certain & (c.abs() > slack));
        let changes = coefficients.windows(2).map(|pair| usize::from((pair[0] < 0.0) != (pair[1] < 0.0)));
        certain.then(|| changes.sum())
    }
}

/// The product of two cubics, all in the Bernstein basis (Farin 2002, section 6.10).
fn product(p: &[f64; 4], q: &[f64; 4]) -> [f64; 7] {
    const CHOOSE_3: [f64; 4] = [1.0, 3.0, 3.0, 1.0];
    const CHOOSE_6: [f64; 7] = [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0];
    let mut out = [0.0; 7];
    for i in 0..4 {
        for j in 0..4 {
            out[i + j] += CHOOSE_3[i] * CHOOSE_3[j] * p[i] * q[j] / CHOOSE_6[i + j];
        }
    }
    out
}

impl Piece {
    fn new(control: [DVec2; 4], middle: f64) -> Self {
        let [p0, p1, p2, p3] = control;
        let powers = [p0, (p1 - p0) * 3.0, (p0 - p1 * 2.0 + p2) * 3.0, p3 - p0 + (p1 - p2) * 3.0];
        Self {
            control,
            radius: powers.map(|p| p.x),
            height: powers.map(|p| p.y),
            ring: Ring::around(&control),
            bernstein: Bernstein::new(control, middle),
        }
    }

    fn at(&self, u: f64) -> DVec2 {
        DVec2::new(roots::evaluate(&self.radius, u).0, roots::evaluate(&self.height, u).0)
    }

    /// The unit normal (radius, height), to the right of the direction of travel; by a chord where the speed is 0.
    fn normal(&self, u: f64) -> DVec2 {
        const CHORD: f64 = 1e-3;
        let slope = DVec2::new(roots::evaluate(&self.radius, u).1, roots::evaluate(&self.height, u).1);
        let chord = || self.at((u + CHORD).min(1.0)) - self.at((u - CHORD).max(0.0));
        let size = (self.ring.high - self.ring.low).length();
        let travel = if slope.length() > CHORD * size { slope } else { chord() };
        DVec2::new(travel.y, -travel.x).try_normalize().unwrap_or(DVec2::Y)
    }

    /// Calls `found` with the ray parameter and the profile parameter of each intersection.
    fn intersect(&self, ray: &AxisRay, size: f64, mut found: impl FnMut(f64, f64)) {
        if ray.d.y.abs() < LEVEL {
            let mut height = self.height;
            height[0] -= ray.o.y;
            let ends = [self.control[0].y - ray.o.y, self.control[3].y - ray.o.y];
            let value = |u| roots::evaluate(&height, u);
            for &u in roots::monotone(roots::critical_points(&height), ends, value).as_slice() {
                ray.at_radius(self.at(u).x).into_iter().flatten().for_each(|s| found(s, u));
            }
            return;
        }
        for &u in self.roots(ray, size).as_slice() {
            let at = self.at(u);
            let by_height = (at.y - ray.o.y) / ray.d.y;
            let by_radius = ray.at_radius(at.x).into_iter().flatten();
            let nearest = by_radius.min_by(|s, t| (s - by_height).abs().total_cmp(&(t - by_height).abs()));
            let steep = ray.d.y.abs() > STEEP;
            found(nearest.filter(|_| !steep).unwrap_or(by_height), u);
        }
    }

    /// Where `dy²·x² = (dy·ox + h·dx)² + (dy·oz + h·dz)²` with radius x, height y and h = y − oy.
    ///
    /// Turning points come from the expanded polynomial, signs from the formula as it stands, which does not cancel.
    fn roots(&self, ray: &AxisRay, size: f64) -> Roots {
        let changes = self.bernstein.sign_changes(ray, size);
        if changes == Some(0) {
            return Roots::default();
        }
        let (o, d) = (ray.o, ray.d);
        let formula = |at: DVec2| {
            let h = at.y - o.y;
            let (x, z) = (d.y * o.x + h * d.x, d.y * o.z + h * d.z);
            ((d.y * at.x) * (d.y * at.x) - x * x - z * z, x, z)
        };
        let value = |u: f64| {
            let (x, x_slope) = roots::evaluate(&self.radius, u);
            let (y, y_slope) = roots::evaluate(&self.height, u);
            let (f, fx, fz) = formula(DVec2::new(x, y));
            (f, 2.0 * (d.y * d.y * x * x_slope - y_slope * (fx * d.x + fz * d.z)))
        };
        let ends = [formula(self.control[0]).0, formula(self.control[3]).0];
        if changes == Some(1) {
            return roots::monotone(Roots::default(), ends, value);
        }
        let mut height = self.height;
        height[0] -= o.y;
        let (radius2, height2) = (square(&self.radius), square(&height));
        let mut expanded: [f64; 7] = std::array::from_fn(|i| d.y * d.y * radius2[i] - ray.a * height2[i]);
        for (i, h) in height.iter().enumerate() {
            expanded[i] -= 2.0 * d.y * ray.b * h;
        }
        expanded[0] -= d.y * d.y * ray.c;
        roots::monotone(roots::critical_points(&expanded), ends, value)
    }
}

impl AxisRay {
    fn new(o: DVec3, d: DVec3, middle: f64) -> Self {
        let (a, b, c) = (d.x * d.x + d.z * d.z, o.x * d.x + o.z * d.z, o.x * o.x + o.z * o.z);
        let nearest_to_axis = if a > 0.0 { -b / a } else { 0.0 };
        Self { o, d, a, b, c, o_from_middle: o.y - middle, rise_inverse: 1.0 / d.y, nearest_to_axis }
    }

    /// The squared distance from the axis.
    fn axis_distance2(&self, s: f64) -> f64 {
        let (x, z) = (self.o.x + s * self.d.x, self.o.z + s * self.d.z);
        x * x + z * z
    }

    /// The parameters at which the ray is `radius` away from the axis.
    fn at_radius(&self, radius: f64) -> [Option<f64>; 2] {
        let across = self.o.x * self.d.z - self.o.z * self.d.x;
        let discriminant = self.a * radius * radius - across * across;
        if self.a == 0.0 || discriminant < 0.0 {
            return [None; 2];
        }
        let root = discriminant.sqrt();
        [Some((-self.b - root) / self.a), Some((-self.b + root) / self.a)]
    }
}

/// The square of a cubic.
fn square(p: &[f64; 4]) -> [f64; 7] {
    let mut product = [0.0; 7];
    for (i, a) in p.iter().enumerate() {
        for (j, b) in p.iter().enumerate() {
            product[i + j] += a * b;
        }
    }
    product
}

/// A cubic Bézier curve in [`CUTS`] pieces that share their ends exactly (de Casteljau).
fn cut(control: &[DVec2; 4]) -> Vec<[DVec2; 4]> {
    let mut rest = *control;
    let mut pieces = Vec::with_capacity(CUTS);
    for left in (2..=CUTS).rev() {
        let u = 1.0 / left as f64;
        let [a, b, c, d] = rest;
        let (ab, bc, cd) = (a.lerp(b, u), b.lerp(c, u), c.lerp(d, u));
        let (abc, bcd) = (ab.lerp(bc, u), bc.lerp(cd, u));
        let middle = abc.lerp(bcd, u);
        pieces.push([a, ab, abc, middle]);
        rest = [middle, bcd, cd, d];
    }
    pieces.push(rest);
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::shape::samples::Random;
    use std::cell::RefCell;

    fn line(from: DVec2, to: DVec2) -> [DVec2; 4] {
        [from, from.lerp(to, 1.0 / 3.0), from.lerp(to, 2.0 / 3.0), to]
    }

    /// From the axis at height −1 to the axis at height 1, by curves with cusps and loops, an upright and a level line.
    fn random_vase(random: &mut Random) -> Profile {
        let mut from = DVec2::new(0.0, -1.0);
        let pieces = (0..5).map(|i| {
            let mut inner = || DVec2::new(random.unit(), random.unit() * 2.0 - 1.0);
            let (a, b, mut to) = (inner(), inner(), inner());
            let piece = match i {
                1 => line(from, DVec2::new(from.x, to.y)),
                2 => line(from, DVec2::new(to.x, from.y)),
                4 => [from, a, b, DVec2::Y],
                _ => [from, a, b, to],
            };
            to = piece[3];
            from = to;
            piece
        });
        Profile { pieces: pieces.collect() }
    }

    /// All parameters of intersection along the whole line.
    fn crossings(shape: &Revolve, o: DVec3, d: DVec3) -> Vec<f64> {
        let all = RefCell::new(Vec::new());
        shape.intersect(o, d, |t| {
            all.borrow_mut().push(t);
            None
        });
        all.into_inner()
    }

    #[test]
    fn a_line_crosses_a_closed_surface_an_even_number_of_times() {
        let mut random = Random(1);
        let mut total = 0;
        for _ in 0..200 {
            let shape = Revolve::new(&random_vase(&mut random));
            for i in 0..500 {
                // Some rays are level or nearly so, some upright.
                let (o, mut d) = (random.point() * 1.5, random.point());
                d.y *= [1.0, 0.0, 1e-4, 1e-7, 1e-12][i % 5];
                if i % 11 == 0 {
                    d = DVec3::Y;
                }
                let found = crossings(&shape, o, d);
                total += found.len();
                assert!(found.len().is_multiple_of(2), "{found:?} from {o} along {d}");
            }
        }
        assert!(total > 50_000, "only {total} crossings");
    }

    #[test]
    fn hits_lie_on_the_surface_and_on_the_ray() {
        let mut random = Random(2);
        for _ in 0..200 {
            let shape = Revolve::new(&random_vase(&mut random));
            for i in 0..200 {
                let (o, mut d) = (random.point() * 2.0, random.point());
                d.y *= [1.0, 1e-4, 1e-7, 0.0][i % 4];
                let Some((t, parameters)) = shape.intersect(o, d, |t| (t > 0.0).then_some(t as f32)) else {
                    continue;
                };
                let near = o + d * f64::from(t);
                let (p, n, _) = shape.surface(parameters, near);
                assert!(p.distance(near) <= 2e-6 * (1.0 + near.length()), "{p} is not {near}, along {d}");
                assert!((n.length() - 1.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn a_turned_line_is_a_cylinder() {
        let profile = Profile { pieces: vec![line(DVec2::new(0.5, -1.0), DVec2::new(0.5, 1.0))] };
        let shape = Revolve::new(&profile);
        let (t, parameters) = shape
            .intersect(DVec3::new(-2.0, 0.25, 0.0), DVec3::X, |t| Some(t as f32))
            .expect("it is in the way");
        assert!((t - 1.5).abs() < 1e-6);
        let (p, n, _) = shape.surface(parameters, DVec3::new(-0.5, 0.25, 0.0));
        assert!(p.distance(DVec3::new(-0.5, 0.25, 0.0)) < 1e-6 && n.distance(DVec3::NEG_X) < 1e-9);
        let area: f64 = shape.elements().map(|(_, area)| area).sum();
        assert!((area - 2.0 * PI).abs() < 1e-9);
    }
}
