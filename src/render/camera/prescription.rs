//! A real lens: rays are traced through each of its surfaces.
//!
//! Film points send rays only towards the part of the rear element through which something gets to the front, their exit
//! pupil: it is found once for film points at growing distances from the middle, row by row, and turned for all others
//! (Kolb, Mitchell, Hanrahan 1995; Pharr, Jakob, Humphreys 2016, section 6.4.5, who bound it by rectangles).

use crate::math::{DVec2, DVec3, Ray, Vec2};

/// A surface of a lens, from the front to the back.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Interface {
    /// Of curvature, in metres: positive when it bulges to the front; 0 for a flat one.
    pub radius: f64,
    /// The distance to the next surface, or of the last to the film, in metres.
    pub thickness: f64,
    /// The refractive index of what lies behind it.
    pub ior: f64,
    /// The radius of its opening, in metres.
    pub aperture: f64,
}

/// A lens that is focused, and ready for rays.
#[derive(Clone, PartialEq, Debug)]
pub struct Prescription {
    surfaces: Vec<Interface>,
    /// How far the pupil through which it looks lies before the film: the origin of the camera's frame.
    pupil: f64,
    /// Half the width and the height of the film, in metres.
    half_film: DVec2,
    /// What film points farther and farther from the middle see of the rear element.
    pupils: Vec<Pupil>,
    /// What makes the mean weight of rays from the middle of the film 1.
    scale: f64,
}

/// A part of the rear element: rows of equal height, each from one side to another.
#[derive(Clone, PartialEq, Debug)]
struct Pupil {
    /// The lower edge of the first row, and the height of each.
    low: f64,
    step: f64,
    rows: Vec<[f64; 2]>,
    /// The share of the area up to the end of each row.
    cumulative: Vec<f64>,
    /// In square metres.
    area: f64,
}

/// Points of the rear element, seen or not from a point of the film, in a square grid.
struct Seen {
    low: DVec2,
    step: f64,
    /// The first and last point that is seen in each row.
    rows: Vec<Option<[usize; 2]>>,
    count: usize,
}

/// Film points for which the exit pupil is found.
const RADII: usize = 33;
/// Points tried along each axis: more, where the opening is so small that fewer miss it.
const GRIDS: [usize; 3] = [64, 256, 1024];

impl Prescription {
    /// A lens whose last thickness reaches the film. `pupil`: how far its entrance pupil lies before the film.
    ///
    /// The picture is `half_film` to each side, in metres.
    pub fn new(surfaces: Vec<Interface>, pupil: f64, half_film: DVec2) -> Self {
        let mut lens = Self { surfaces, pupil, half_film, pupils: Vec::new(), scale: 1.0 };
        let farthest = half_film.length();
        let grid = GRIDS.into_iter().find(|&grid| lens.look(0.0, lens.rear_square(), grid).count > 0);
        let Some(grid) = grid else {
            return Self { pupils: vec![Pupil::NOTHING], scale: 0.0, ..lens };
        };
        let seen: Vec<Seen> =
            (0..RADII).map(|i| lens.seen(farthest * i as f64 / (RADII - 1) as f64, grid)).collect();
        // Between two film points the pupil lies within both of theirs.
        lens.pupils = seen.windows(2).map(|pair| Pupil::around(&pair[0], &pair[1])).collect();
        let middle = seen[0].count as f64 * seen[0].step * seen[0].step;
        lens.scale = 1.0 / middle;
        lens
    }

    /// Whether nothing gets through to the middle of the film.
    pub fn is_blind(&self) -> bool {
        self.scale == 0.0
    }

    /// A ray in the frame of the camera (right, up, forward) from its entrance pupil, and its weight: the share of light
    /// that reaches the film there, seen from the film, with the middle of the picture counting 1.
    ///
    /// `film` goes from (−1, −1) at the lower left of the picture to (1, 1). `None` where the lens lets nothing through.
    pub fn ray(&self, film: Vec2, u: Vec2) -> Option<(Ray, f32)> {
        // The picture on the film is upside down.
        let p = -film.as_dvec2() * self.half_film;
        let radius = p.length();
        let bin = (radius / self.half_film.length() * (RADII - 1) as f64) as usize;
        let pupil = &self.pupils[bin.min(self.pupils.len() - 1)];
        let along = if radius > 0.0 { p / radius } else { DVec2::X };
        let drawn = pupil.sample(u.as_dvec2())?;
        let rear = DVec3::from((along * drawn.x + along.perp() * drawn.y, self.back()));
        let o = p.extend(0.0);
        let d = (rear - o).normalize();
        let (o, d) = self.trace(o, d)?;
        let cos = (rear - p.extend(0.0)).normalize().z;
        let weight = pupil.area * self.scale * cos * cos * cos * cos;
        let o = (o - DVec3::Z * self.pupil).as_vec3();
        Some((Ray::new(o, d.as_vec3().normalize()), weight as f32))
    }

    /// From the rear element to the film.
    fn back(&self) -> f64 {
        self.surfaces.last().map_or(0.0, |rear| rear.thickness)
    }

    /// Through all surfaces, from the film to the front. The axis is z, the film lies at 0.
    fn trace(&self, mut o: DVec3, mut d: DVec3) -> Option<(DVec3, DVec3)> {
        let mut z = 0.0;
        for (i, surface) in self.surfaces.iter().enumerate().rev() {
            z += surface.thickness;
            let (t, n) = surface.meet(o - DVec3::Z * z, d)?;
            o += d * t;
            if o.truncate().length_squared() > surface.aperture * surface.aperture {
                return None;
            }
            let ahead = if i == 0 { 1.0 } else { self.surfaces[i - 1].ior };
            if ahead != surface.ior {
                d = refract(d, n, surface.ior / ahead)?;
            }
        }
        Some((o, d))
    }

    /// What of the rear element a film point at `radius` sees through the lens.
    fn seen(&self, radius: f64, grid: usize) -> Seen {
        let coarse = self.look(radius, self.rear_square(), grid);
        if coarse.count == 0 {
            return coarse;
        }
        // Once more, where there is something to see.
        let (low, high) = coarse.bounds();
        self.look(radius, (low, (high - low).max_element()), GRIDS[0])
    }

    /// The square around the rear element: its lower corner and its side.
    fn rear_square(&self) -> (DVec2, f64) {
        let reach = self.surfaces.last().map_or(0.0, |rear| rear.aperture);
        (DVec2::splat(-reach), 2.0 * reach)
    }

    /// Tries a grid over a square with its lower corner at `low`.
    fn look(&self, radius: f64, (low, side): (DVec2, f64), grid: usize) -> Seen {
        let step = side / grid as f64;
        let film = DVec3::new(radius, 0.0, 0.0);
        let gets_through = |i: usize, j: usize| {
            let p = low + (DVec2::new(i as f64, j as f64) + 0.5) * step;
            let d = (p.extend(self.back()) - film).normalize();
            self.trace(film, d).is_some()
        };
        let mut count = 0;
        let rows = (0..grid).map(|j| {
            let mut row: Option<[usize; 2]> = None;
            for i in (0..grid).filter(|&i| gets_through(i, j)) {
                count += 1;
                row = Some([row.map_or(i, |[first, _]| first), i]);
            }
            row
        });
        let rows = rows.collect();
        Seen { low, step, rows, count }
    }
}

impl Seen {
    /// A box around what is seen; its rim lies between a point that is seen and its neighbour that is not.
    fn bounds(&self) -> (DVec2, DVec2) {
        let rows = self.rows.iter().enumerate().filter_map(|(j, row)| Some((j, (*row)?)));
        let corners = rows.map(|(j, [first, last])| {
            let at = |i: usize, j: usize| self.low + DVec2::new(i as f64, j as f64) * self.step;
            (at(first, j) - self.step, at(last + 1, j + 1) + self.step)
        });
        corners.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), (a, b)| (low.min(a), high.max(b)))
    }

    /// What is seen at heights from `low` to `high`, and a step beyond.
    fn span(&self, low: f64, high: f64) -> Option<[f64; 2]> {
        let near = |j: usize| {
            let bottom = self.low.y + j as f64 * self.step;
            bottom <= high + self.step && bottom + self.step >= low - self.step
        };
        let rows = self.rows.iter().enumerate().filter(|(j, _)| near(*j)).filter_map(|(_, row)| *row);
        let [first, last] = rows.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
        let at = |i: usize| self.low.x + i as f64 * self.step;
        Some([at(first) - self.step, at(last + 1) + self.step])
    }
}

impl Pupil {
    const NOTHING: Self = Self { low: 0.0, step: 0.0, rows: Vec::new(), cumulative: Vec::new(), area: 0.0 };

    /// All that is seen from either of two film points.
    fn around(a: &Seen, b: &Seen) -> Self {
        let bounds = [a, b].into_iter().filter(|seen| seen.count > 0).map(Seen::bounds);
        let Some((low, high)) = bounds.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))) else {
            return Self::NOTHING;
        };
        let step = (high.y - low.y) / GRIDS[0] as f64;
        let row = |j: usize| {
            let (bottom, top) = (low.y + j as f64 * step, low.y + (j + 1) as f64 * step);
            let spans = [a.span(bottom, top), b.span(bottom, top)].into_iter().flatten();
            spans.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or([0.0; 2])
        };
        let rows: Vec<[f64; 2]> = (0..GRIDS[0]).map(row).collect();
        let width: f64 = rows.iter().map(|[from, to]| to - from).sum();
        let mut so_far = 0.0;
        let share = |[from, to]: &[f64; 2]| {
            so_far += (to - from) / width;
            so_far
        };
        let cumulative = rows.iter().map(share).collect();
        Self { low: low.y, step, rows, cumulative, area: width * step }
    }

    /// A uniform point; `None` of nothing.
    fn sample(&self, u: DVec2) -> Option<DVec2> {
        let row = self.cumulative.partition_point(|&share| share <= u.y).min(self.rows.len().checked_sub(1)?);
        let start = if row == 0 { 0.0 } else { self.cumulative[row - 1] };
        let within = ((u.y - start) / (self.cumulative[row] - start)).clamp(0.0, 1.0);
        let [from, to] = self.rows[row];
        Some(DVec2::new(from + (to - from) * u.x, self.low + (row as f64 + within) * self.step))
    }
}

impl Interface {
    /// Where a ray meets it: the parameter, and the unit normal towards the film. `o` is counted from its vertex.
    fn meet(&self, o: DVec3, d: DVec3) -> Option<(f64, DVec3)> {
        if self.radius == 0.0 {
            let t = -o.z / d.z;
            return (d.z > 0.0).then_some((t, DVec3::NEG_Z));
        }
        // A surface that bulges to the front has its centre behind it, and is the farther of two intersections.
        let from_center = o + DVec3::Z * self.radius;
        let b = from_center.dot(d);
        let c = from_center.length_squared() - self.radius * self.radius;
        let discriminant = b * b - c;
        if discriminant < 0.0 {
            return None;
        }
        let t = -b + discriminant.sqrt().copysign(self.radius);
        let n = (from_center + d * t) / self.radius;
        // Outwards for a bulge to the front, and so towards the scene: turned over.
        Some((t, -n * n.z.signum()))
    }
}

/// The unit direction behind a surface with the unit normal `n` against `d`; `eta` is the index before over that behind.
fn refract(d: DVec3, n: DVec3, eta: f64) -> Option<DVec3> {
    let cos = -d.dot(n);
    let sin2 = eta * eta * (1.0 - cos * cos);
    (sin2 < 1.0).then(|| (d * eta + n * (eta * cos - (1.0 - sin2).sqrt())).normalize())
}

/// What first-order optics says of a lens (Smith 2008, chapter 2). Lengths in metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Paraxial {
    /// The focal length.
    pub focal_length: f64,
    /// From the front vertex back to the entrance pupil.
    pub entrance_pupil: f64,
    /// The radius of the entrance pupil over that of the stop.
    pub pupil_scale: f64,
}

/// First-order properties of a lens with its stop at index `stop`.
pub fn paraxial(surfaces: &[Interface], stop: usize) -> Paraxial {
    let (_, angle) = forwards(surfaces, 1.0, 0.0);
    // From the middle of the stop to the front; seen in that direction every curvature changes its sign.
    let (mut y, mut u) = (0.0, 1.0);
    for i in (0..stop).rev() {
        y += u * surfaces[i].thickness;
        let (n, ahead) = (surfaces[i].ior, if i == 0 { 1.0 } else { surfaces[i - 1].ior });
        u = bend(y, u, n, ahead, -surfaces[i].radius);
    }
    let index = if stop == 0 { 1.0 } else { surfaces[stop - 1].ior };
    Paraxial { focal_length: -1.0 / angle, entrance_pupil: y / u, pupil_scale: index / u }
}

/// How far behind the last surface the lens images a point on its axis, `distance` before its front vertex; negative where
/// there is no real image.
pub fn image_distance(surfaces: &[Interface], distance: f64) -> f64 {
    let (y, u) = forwards(surfaces, distance, 1.0);
    -y / u
}

/// Height and angle behind the lens of a paraxial ray at its front.
fn forwards(surfaces: &[Interface], mut y: f64, mut u: f64) -> (f64, f64) {
    let mut n = 1.0;
    for (i, surface) in surfaces.iter().enumerate() {
        u = bend(y, u, n, surface.ior, surface.radius);
        n = surface.ior;
        if i + 1 < surfaces.len() {
            y += u * surface.thickness;
        }
    }
    (y, u)
}

/// n′u′ = n·u − y·(n′ − n)/R.
fn bend(y: f64, u: f64, n: f64, ahead: f64, radius: f64) -> f64 {
    let power = if radius == 0.0 { 0.0 } else { (ahead - n) / radius };
    (n * u - y * power) / ahead
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A single biconvex lens behind a stop.
    fn single(stop: f64) -> Vec<Interface> {
        let glass = |radius: f64, thickness, ior| Interface { radius, thickness, ior, aperture: 0.02 };
        let stop = Interface { radius: 0.0, thickness: 0.002, ior: 1.0, aperture: stop };
        vec![stop, glass(0.1, 0.004, 1.5), glass(-0.1, 0.0, 1.0)]
    }

    #[test]
    fn a_single_lens_has_the_focal_length_that_lensmakers_know() {
        let found = paraxial(&single(0.01), 0).focal_length;
        let expected = 1.0 / (0.5 * (2.0 / 0.1 - 0.5 * 0.004 / (1.5 * 0.1 * 0.1)));
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} for {expected}");
    }

    fn focused(distance: f64, stop: f64) -> Prescription {
        let mut surfaces = single(stop);
        let back = image_distance(&surfaces, distance);
        surfaces[2].thickness = back;
        Prescription::new(surfaces, back + 0.006, DVec2::new(0.018, 0.012))
    }

    #[test]
    fn rays_of_a_film_point_meet_at_the_distance_in_focus() {
        let lens = focused(2.0, 0.004);
        let mut through = 0;
        for i in 0..400 {
            let u = Vec2::new((i as f32 + 0.5) / 400.0, (i as f32 * 0.618_034).fract());
            let Some((ray, weight)) = lens.ray(Vec2::ZERO, u) else { continue };
            through += 1;
            let at = ray.at((2.0 - ray.o.z) / ray.d.z);
            assert!(at.truncate().length() < 1e-3 && weight > 0.0, "{at}");
        }
        assert!(through > 330, "only {through} of 400 get through");
    }

    #[test]
    fn the_middle_weighs_one_and_the_corner_less() {
        let lens = focused(2.0, 0.008);
        let mean = |film: Vec2| {
            let n = 64;
            let weight = |i: usize| {
                let u = Vec2::new((i % n) as f32 + 0.5, (i / n) as f32 + 0.5) / n as f32;
                lens.ray(film, u).map_or(0.0, |(_, weight)| f64::from(weight))
            };
            (0..n * n).map(weight).sum::<f64>() / (n * n) as f64
        };
        let (middle, corner) = (mean(Vec2::ZERO), mean(Vec2::ONE));
        assert!((middle - 1.0).abs() < 0.03, "{middle}");
        assert!(corner < middle && corner > 0.5, "{corner}");
    }

    #[test]
    fn an_opening_that_is_hardly_one_is_found() {
        let lens = focused(2.0, 6e-5);
        let through = (0..100).filter(|&i| {
            let u = Vec2::new((i as f32 + 0.5) / 100.0, (i as f32 * 0.618_034).fract());
            lens.ray(Vec2::new(0.7, -0.3), u).is_some()
        });
        assert!(through.count() > 50);
    }

    #[test]
    fn the_picture_is_upright_and_as_large_as_through_a_pinhole() {
        let lens = focused(50.0, 0.001);
        let (ray, _) = (0..200)
            .find_map(|i| lens.ray(Vec2::new(0.5, 0.5), Vec2::new(0.5, i as f32 / 200.0)))
            .expect("some ray gets through");
        let f = paraxial(&single(0.001), 0).focal_length;
        let slope = f64::from(ray.d.x / ray.d.z);
        assert!(ray.d.y > 0.0 && (slope / (0.009 / f) - 1.0).abs() < 0.05, "{slope}");
    }
}
