//! The camera: from a pixel to a ray.

use crate::math::{Ray, Vec2, Vec3, float, warp};
use std::f32::consts::TAU;

/// What a camera is built from.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CameraSpec {
    /// The centre of the lens, in metres.
    pub position: Vec3,
    /// Where it looks; not zero.
    pub direction: Vec3,
    /// What appears upright; not along `direction`.
    pub up: Vec3,
    /// The tangent of half the horizontal field of view.
    pub tan_half_fov_x: f32,
    /// The tangent of half the vertical field of view.
    pub tan_half_fov_y: f32,
    /// A lens with an opening; without one everything is sharp.
    pub lens: Option<LensSpec>,
    /// Columns of the picture.
    pub width: u32,
    /// Rows of the picture.
    pub height: u32,
    /// How samples spread about pixel centres.
    pub filter: Filter,
}

/// A thin lens.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LensSpec {
    /// The radius of the opening, in metres; 0 is a pinhole.
    pub radius: f32,
    /// The distance of the plane in focus from the lens, along the view direction, in metres.
    pub focus_distance: f32,
    /// The number of blades that bound the opening; 0 for a round one.
    pub blades: u32,
    /// How far the blades are turned, in radians.
    pub rotation: f32,
}

/// The reconstruction filter. Samples are drawn in proportion to it, so that all weigh the same.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Filter {
    /// Constant over a square.
    Box {
        /// Half its side, in pixels.
        radius: f32,
    },
    /// A pyramid.
    Tent {
        /// Half the side of its base, in pixels.
        radius: f32,
    },
    /// A bell whose standard deviation is a third of where it is cut off.
    Gaussian {
        /// The radius of the disk where it is cut off, in pixels.
        radius: f32,
    },
    /// None: every sample lies at the pixel's lower left corner, as in the first programs of many a course.
    Corner,
}

impl Filter {
    /// The offset from the pixel's centre, in pixels, for `u` in [0, 1)².
    pub fn sample(self, u: Vec2) -> Vec2 {
        match self {
            Self::Box { radius } => (u * 2.0 - 1.0) * radius,
            Self::Tent { radius } => Vec2::new(warp::sample_tent(u.x), warp::sample_tent(u.y)) * radius,
            Self::Gaussian { radius } => {
                // Box & Muller 1958, with the radius cut off by scaling u.
                let sigma = radius / 3.0;
                let inside = -float::exp_m1(-0.5 * (radius / sigma) * (radius / sigma));
                let r = sigma * (-2.0 * float::ln_1p(-u.x * inside)).sqrt();
                let (sin_phi, cos_phi) = float::sin_cos(TAU * u.y);
                Vec2::new(r * cos_phi, r * sin_phi)
            }
            Self::Corner => Vec2::new(-0.5, 0.5),
        }
    }
}

/// A perspective camera with a pinhole or a thin lens.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Camera {
    position: Vec3,
    forward: Vec3,
    /// Unit vectors of the picture: to the right, and upwards.
    right: Vec3,
    up: Vec3,
    /// World offsets on the plane at distance 1: half the picture's width to the right, and half its height up.
    half_width: Vec3,
    half_height: Vec3,
    lens: Option<LensSpec>,
    width: u32,
    height: u32,
    filter: Filter,
}

impl Camera {
    /// A camera from its specification.
    pub fn new(spec: CameraSpec) -> Self {
        let forward = spec.direction.as_dvec3().normalize();
        let right = forward.cross(spec.up.as_dvec3()).normalize();
        let up = right.cross(forward);
        Self {
            position: spec.position,
            forward: forward.as_vec3(),
            right: right.as_vec3(),
            up: up.as_vec3(),
            half_width: (right * f64::from(spec.tan_half_fov_x)).as_vec3(),
            half_height: (up * f64::from(spec.tan_half_fov_y)).as_vec3(),
            lens: spec.lens.filter(|lens| lens.radius > 0.0),
            width: spec.width,
            height: spec.height,
            filter: spec.filter,
        }
    }

    /// Columns of the picture.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows of the picture.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Whether rays start on a lens: only then is `u_lens` of [`Self::ray`] looked at.
    pub fn has_lens(&self) -> bool {
        self.lens.is_some()
    }

    /// The angle across a pixel in the middle of the picture, in radians: what it covers grows by that for each metre.
    pub fn pixel_angle(&self) -> f32 {
        self.half_width.length() * 2.0 / self.width as f32
    }

    /// A ray through a pixel, counted from the top left; its direction is a unit vector.
    pub fn ray(&self, [x, y]: [u32; 2], u_filter: Vec2, u_lens: Vec2) -> Ray {
        let offset = self.filter.sample(u_filter);
        let across = (x as f32 + 0.5 + offset.x) * 2.0 / self.width as f32 - 1.0;
        let upwards = 1.0 - (y as f32 + 0.5 + offset.y) * 2.0 / self.height as f32;
        let dir = self.forward + self.half_width * across + self.half_height * upwards;
        match self.lens {
            None => Ray::new(self.position, dir.normalize()),
            Some(lens) => {
                let opening = lens.sample(u_lens);
                let shift = self.right * opening.x + self.up * opening.y;
                Ray::new(self.position + shift, (dir * lens.focus_distance - shift).normalize())
            }
        }
    }
}

impl LensSpec {
    /// A uniform point of the opening, in metres from its centre.
    fn sample(&self, u: Vec2) -> Vec2 {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn spec(lens: Option<LensSpec>) -> CameraSpec {
        CameraSpec {
            position: Vec3::new(0.0, 1.0, 4.0),
            direction: Vec3::NEG_Z,
            up: Vec3::Y,
            tan_half_fov_x: 1.0,
            tan_half_fov_y: 0.5,
            lens,
            width: 4,
            height: 2,
            filter: Filter::Box { radius: 0.5 },
        }
    }

    const CENTER: Vec2 = Vec2::splat(0.5);

    #[test]
    fn the_first_pixel_is_at_the_top_left() {
        let ray = Camera::new(spec(None)).ray([0, 0], CENTER, CENTER);
        let expected = Vec3::new(-0.75, 0.25, -1.0).normalize();
        assert!((ray.d - expected).length() < 1e-6, "{}", ray.d);
    }

    #[test]
    fn an_opening_of_radius_0_is_a_pinhole_to_the_bit() {
        let closed = LensSpec { radius: 0.0, focus_distance: 3.0, blades: 0, rotation: 0.0 };
        let u = Vec2::new(0.3, 0.8);
        assert_eq!(
            Camera::new(spec(Some(closed))).ray([1, 1], u, u),
            Camera::new(spec(None)).ray([1, 1], u, u)
        );
    }

    #[test]
    fn all_rays_of_a_film_point_meet_in_the_plane_of_focus() {
        let lens = LensSpec { radius: 0.2, focus_distance: 3.0, blades: 6, rotation: 0.4 };
        let camera = Camera::new(spec(Some(lens)));
        let at_focus = |u_lens| {
            let ray = camera.ray([3, 0], CENTER, u_lens);
            ray.at((ray.o.z - 1.0) / -ray.d.z)
        };
        let first = at_focus(Vec2::new(0.1, 0.9));
        for i in 0..20 {
            let u = Vec2::new(i as f32 / 20.0, (i as f32 * 0.618).fract());
            assert!((at_focus(u) - first).length() < 1e-5);
            assert!(lens.sample(u).length() <= lens.radius * 1.000_001);
        }
    }

    #[test]
    fn filters_stay_within_their_radius_and_centre_on_the_pixel() {
        for filter in
            [Filter::Box { radius: 0.5 }, Filter::Tent { radius: 1.0 }, Filter::Gaussian { radius: 1.5 }]
        {
            let n = 64;
            let mut sum = Vec2::ZERO;
            for i in 0..n * n {
                let u = Vec2::new((i % n) as f32 + 0.5, (i / n) as f32 + 0.5) / n as f32;
                let offset = filter.sample(u);
                assert!(offset.abs().max_element() <= 1.5);
                sum += offset;
            }
            assert!((sum / (n * n) as f32).length() < 1e-3, "{filter:?}: {sum}");
        }
    }
}
