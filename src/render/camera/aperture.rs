//! A thin lens: its opening, and what it has in focus.

use crate::math::{Ray, Vec2, Vec3, float, warp};
use std::f32::consts::TAU;

/// A thin lens.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ThinLens {
    /// The radius of the opening, in metres; 0 is a pinhole.
    pub radius: f32,
    /// The distance of the plane in focus from the lens, along the view direction, in metres.
    pub focus_distance: f32,
    /// The number of blades that bound the opening; 0 for a round one.
    pub blades: u32,
    /// How far the blades are turned, in radians.
    pub rotation: f32,
    /// How many times as high as wide the opening is, at the same height: 1 is round, 2 as of anamorphic lenses.
    pub anamorphic: f32,
    /// How far the barrel cuts the opening in the corners of the picture, in radii; 0 does not.
    pub cat_eye: f32,
    /// How far the picture is shifted to the right and upwards, in shares of its width and height.
    pub shift: Vec2,
    /// How the lens is turned against the film.
    pub tilt: Option<Tilt>,
}

/// A lens that is turned against the film, and so has a tilted plane in focus (Scheimpflug 1904).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Tilt {
    /// The unit normal of the lens, in the frame of the camera (right, up, forward); its last part is positive.
    pub normal: Vec3,
    /// The focal length, in metres.
    pub focal_length: f32,
}

impl ThinLens {
    /// Focused at a distance, round, and as simple as can be.
    pub const fn new(radius: f32, focus_distance: f32) -> Self {
        Self {
            radius,
            focus_distance,
            blades: 0,
            rotation: 0.0,
            anamorphic: 1.0,
            cat_eye: 0.0,
            shift: Vec2::ZERO,
            tilt: None,
        }
    }

    /// Whether it does nothing that a pinhole does not.
    pub fn is_plain_pinhole(&self) -> bool {
        self.radius == 0.0 && self.shift == Vec2::ZERO && self.tilt.is_none()
    }

    /// The ray, in the frame of the camera (right, up, forward), of a film point seen along `dir` (forward part 1).
    ///
    /// `corner` tells how far from the middle of the picture the point is, in half its diagonal. `None` where the barrel
    /// is in the way.
    pub fn ray(&self, dir: Vec3, corner: Vec2, u: Vec2) -> Option<Ray> {
        let opening = self.sample(u);
        if self.cat_eye > 0.0 && (opening + corner * (self.cat_eye * self.radius)).length() > self.radius {
            return None;
        }
        Some(match self.tilt {
            None => {
                let shift = Vec3::new(opening.x, opening.y, 0.0);
                Ray::new(shift, (dir * self.focus_distance - shift).normalize())
            }
            Some(tilt) => tilt.ray(dir, self.focus_distance, opening),
        })
    }

    /// A uniform point of the opening, in metres from its centre.
    pub fn sample(&self, u: Vec2) -> Vec2 {
        let p = self.sample_round(u);
        if self.anamorphic == 1.0 { p } else { Vec2::new(p.x / self.anamorphic, p.y) }
    }

    fn sample_round(&self, u: Vec2) -> Vec2 {
        if self.blades < 3 {
            return warp::square_to_uniform_disk(u) * self.radius;
        }
        // One of the triangles between the centre and two corners, then a point in it.
        let scaled = u.x * self.blades as f32;
        let blade = scaled.floor();
        let b = warp::square_to_uniform_triangle(Vec2::new(scaled - blade, u.y));
        let corner = |k: f32| {
            let (sin, cos) = float::sin_cos(self.rotation + TAU * k / self.blades as f32);
            Vec2::new(cos, sin) * self.radius
        };
        corner(blade) * b.x + corner(blade + 1.0) * b.y
    }
}

impl Tilt {
    /// The film lies where the lens, as it is turned, makes the point straight ahead at `focus` sharp. Any other film point
    /// is imaged by 1/f = 1/u + 1/v, with u and v measured along the normal of the lens; a ray through the middle of the
    /// lens goes straight on, so the image lies along `dir`. Beyond infinity it is virtual, and rays lead away from it.
    fn ray(&self, dir: Vec3, focus: f32, opening: Vec2) -> Ray {
        let (n, f) = (self.normal.as_dvec3(), f64::from(self.focal_length));
        let straight = f64::from(focus) * n.z;
        let film = f * straight / (straight - f) / n.z;
        let dir = dir.as_dvec3();
        let (along, behind) = (dir.dot(n), film * dir.dot(n));
        let right = (crate::math::DVec3::X - n * n.x).normalize();
        let o = right * f64::from(opening.x) + n.cross(right) * f64::from(opening.y);
        // 1/u, which passes through 0 where the plane in focus does through infinity.
        let nearness = 1.0 / f - 1.0 / behind;
        let d = dir / along - o * nearness;
        Ray::new(o.as_vec3(), (d * along.signum()).normalize().as_vec3())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points() -> impl Iterator<Item = Vec2> {
        (0..400).map(|i| Vec2::new((i as f32 + 0.5) / 400.0, (i as f32 * 0.618_034).fract()))
    }

    #[test]
    fn openings_have_their_shape() {
        for blades in [0, 3, 6] {
            let lens = ThinLens { blades, rotation: 0.4, anamorphic: 2.0, ..ThinLens::new(0.2, 3.0) };
            let drawn: Vec<Vec2> = points().map(|u| lens.sample(u)).collect();
            assert!(drawn.iter().all(|p| Vec2::new(p.x * 2.0, p.y).length() <= 0.2 * 1.000_001));
            let mean = drawn.iter().copied().sum::<Vec2>() / drawn.len() as f32;
            assert!(mean.length() < 5e-3, "{mean}");
        }
    }

    #[test]
    fn a_cats_eye_lets_through_all_in_the_middle_and_less_in_the_corner() {
        let lens = ThinLens { cat_eye: 0.5, ..ThinLens::new(0.2, 3.0) };
        let open = |corner| points().filter(|&u| lens.ray(Vec3::Z, corner, u).is_some()).count();
        assert_eq!(open(Vec2::ZERO), 400);
        // Two disks of radius 1 whose centres are 1/2 apart share 0.685 of their area.
        let share = open(Vec2::new(0.6, 0.8)) as f32 / 400.0;
        assert!((share - 0.685).abs() < 0.02, "{share}");
    }

    #[test]
    fn a_tilted_lens_focuses_on_a_tilted_plane() {
        let (sin, cos) = float::sin_cos(0.1);
        let tilt = Tilt { normal: Vec3::new(0.0, sin, cos), focal_length: 0.05 };
        let lens = ThinLens { tilt: Some(tilt), ..ThinLens::new(0.01, 2.0) };
        // Where the rays of one film point meet, by the two that are farthest apart.
        let sharp = |dir: Vec3| {
            let at = |u| lens.ray(dir, Vec2::ZERO, u).expect("no barrel");
            let (a, b) = (at(Vec2::new(0.99, 0.25)), at(Vec2::new(0.99, 0.75)));
            let across = a.d.as_dvec3().cross(b.d.as_dvec3());
            let between = b.o.as_dvec3() - a.o.as_dvec3();
            let t = between.cross(b.d.as_dvec3()).dot(across) / across.length_squared();
            a.o.as_dvec3() + a.d.as_dvec3() * t
        };
        let straight = sharp(Vec3::Z);
        assert!((straight.z - 2.0).abs() < 1e-2, "{straight}");
        // All of it lies in one plane, which meets the planes of film and lens in one line: f / sin from the lens.
        let points =
            [Vec3::new(0.2, 0.1, 1.0), Vec3::new(-0.2, 0.1, 1.0), Vec3::new(0.1, -0.1, 1.0)].map(sharp);
        let plane = (points[1] - points[0]).cross(points[2] - points[0]).normalize();
        assert!((straight - points[0]).dot(plane).abs() < 2e-2, "not in the plane");
        assert!(plane.y.abs() > 0.5, "the plane is not tilted: {plane}");
    }
}
